"""The pose in its file: what is written and read, where a killed loop has left the platform."""

import json
import os
import signal
from pathlib import Path
from struct import pack
from time import sleep

import pytest
from waiting import until

from atlas_cueing.errors import InputError, OutputError
from atlas_cueing.live.control.certified_axis import six_axes
from atlas_cueing.live.control.pose import Pose, pose_after_stop
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.live.output.pose_file import read_pose, write_pose
from atlas_cueing.live.output.pose_process import PoseProcess
from atlas_cueing.live.start_pose import default_pose_file, start_pose
from atlas_cueing.recording import McapRecorder
from atlas_cueing.rotation import IDENTITY, ZERO, exp, geodesic
from atlas_cueing.signals import Motion, Tick, Timing, WheelSpeeds, live_row

from ..commands import swinging
from ..riding import child, live_tick
from ..rig import Rig, scenario

AWAY = Pose(exp((0.3, -0.2, 0.5)), (1.0, -70.0, 3.5), (0.1, -0.2, 0.05))
PLATFORM = scenario().platform
LIMITS = PLATFORM.wheel_limit_values(), PLATFORM.stage_limit_values()
J = PLATFORM.geometry().sphere_from_wheels
NAME = "atlas-2.9m"


def test_what_is_read_is_what_was_written(tmp_path: Path) -> None:
    file = tmp_path / "new" / "folder" / "pose.json"
    for moving in (True, False):
        write_pose(file, AWAY, NAME, moving=moving)
        pose, moved = read_pose(file, NAME)
        assert moved is moving
        assert geodesic(pose.q_WS, AWAY.q_WS) < 1e-12
        assert (pose.wheel_angle, pose.p_WS_W) == (AWAY.wheel_angle, AWAY.p_WS_W)


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("version", 2, "version = 2, allowed: 1"),
        ("q_ws", [0.0, 0.0, 0.0, 0.0], "q_ws: norm 0, allowed: 1"),
        ("q_ws", [1.0, 0.0, 0.0], "q_ws: allowed: 4 finite numbers"),
        ("stage_m", [0.0, float("nan"), 0.0], "stage_m: allowed: 3 finite numbers"),
        ("wheel_angle_rad", None, "wheel_angle_rad: allowed: 3 finite numbers"),
        ("platform", "other", "platform = 'other', allowed: 'atlas-2.9m'"),
        ("moving", "absent", "key 'moving' is missing"),
    ],
)
def test_a_file_that_holds_no_pose(tmp_path: Path, key: str, value: object, told: str) -> None:
    file = tmp_path / "pose.json"
    write_pose(file, AWAY, NAME, moving=False)
    content = json.loads(file.read_text())
    content[key] = value
    if value == "absent":
        del content[key]
    file.write_text(json.dumps(content))
    with pytest.raises(InputError) as error:
        read_pose(file, NAME)
    assert str(file) in str(error.value)
    assert told in str(error.value)


@pytest.mark.parametrize("rubbish", ["", "{", "[]", "[" * 9000, "null", '{"version": {}}'])
def test_rubbish_is_no_pose(tmp_path: Path, rubbish: str) -> None:
    file = tmp_path / "pose.json"
    file.write_text(rubbish)
    with pytest.raises(InputError, match="holds no pose"):
        read_pose(file, NAME)


def test_a_place_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=r"pose .*: (Not a directory|File exists)"):
        write_pose(tmp_path / "file" / "pose.json", AWAY, NAME, moving=False)


class TestTheStart:
    def test_no_file_is_home_and_nothing_is_written(self, tmp_path: Path) -> None:
        assert start_pose(None, tmp_path / "pose.json", PLATFORM) == Pose()
        assert list(tmp_path.iterdir()) == []

    def test_a_pose_near_home_is_gone_on_from(self, tmp_path: Path) -> None:
        file, near = tmp_path / "pose.json", Pose(IDENTITY, (9.0, 8.0, 7.0), (1e-6, 0.0, 0.0))
        write_pose(file, near, NAME, moving=False)
        assert start_pose(None, file, PLATFORM) == near

    def test_any_other_is_refused_until_it_is_stated(self, tmp_path: Path) -> None:
        file = tmp_path / "pose.json"
        write_pose(file, AWAY, NAME, moving=False)
        with pytest.raises(InputError, match=r"35\.3 deg from upright, 229 mm .* --from home"):
            start_pose(None, file, PLATFORM)
        assert start_pose("home", file, PLATFORM) == Pose()
        assert start_pose(str(file), file, PLATFORM).wheel_angle == AWAY.wheel_angle

    def test_one_that_was_cut_off_while_it_moved(self, tmp_path: Path) -> None:
        file = tmp_path / "pose.json"
        write_pose(file, Pose(), NAME, moving=True)
        with pytest.raises(InputError, match="cut off while it moved"):
            start_pose(None, file, PLATFORM)

    def test_a_log_tells_where_its_platform_came_to_rest(self, tmp_path: Path) -> None:
        log = tmp_path / "log.mcap"
        recorder = McapRecorder(
            log, head_S=(0.0, 0.0, 0.0), metadata={}, attachments={}, started_ns=1
        )
        tick, _ = live_tick(0.1)
        m = tick.motion
        still = Motion(0.1, m.q_WS, ZERO, ZERO, (0.1, 0.2, 0.3), ZERO, ZERO, (0.0, 0.0))
        wheels = WheelSpeeds(0.1, ZERO, ZERO)
        recorder.append_live(_row(Tick(tick.vehicle, tick.cue, still, wheels), live_tick(0.1)[1]))
        recorder.close("ok", "")
        pose = start_pose(str(log), tmp_path / "none", PLATFORM)
        assert geodesic(pose.q_WS, m.q_WS) < 1e-9
        assert pose.p_WS_W == pytest.approx((0.1, 0.2, 0.3))

    @pytest.mark.parametrize("name", ["absent.mcap", "rubbish.mcap", "."])
    def test_what_cannot_be_read_is_refused(self, tmp_path: Path, name: str) -> None:
        (tmp_path / "rubbish.mcap").write_bytes(b"rubbish")
        with pytest.raises(InputError, match="--from"):
            start_pose(str(tmp_path / name), tmp_path / "none", PLATFORM)

    def test_the_default_place(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setenv("XDG_STATE_HOME", "/somewhere")
        assert default_pose_file() == Path("/somewhere/atlas_cueing/pose.json")
        for unset in ("", "relative"):
            monkeypatch.setenv("XDG_STATE_HOME", unset)
            assert default_pose_file() == Path.home() / ".local/state/atlas_cueing/pose.json"


def _row(tick: Tick, timing: Timing) -> bytes:
    numbers = live_row(tick, timing)
    return pack(f"={len(numbers)}d", *numbers)


def test_the_pose_after_a_stop_is_where_the_guard_ends() -> None:
    """Integrated by the loop's own tick, from the same command."""
    rig = Rig(0.002, settings=("cueing.method=attitude",), rate=0.9)
    rig.bring_to(State.RUNNING)
    last, q = rig.tape.commands[-1], rig.motion.q_WS
    rig.tick(lateness=0.025)
    rig.until(State.STOPPED, 3.0)
    pose = pose_after_stop(q, last, six_axes(1e-9, *LIMITS), J)
    assert geodesic(pose.q_WS, rig.motion.q_WS) < 1e-6
    assert pose.wheel_angle == pytest.approx(rig.tape.commands[-1].wheel_angle, abs=1e-9)
    assert pose.p_WS_W == pytest.approx(rig.tape.commands[-1].p_WS_W, abs=1e-9)


@pytest.mark.parametrize("killed", [True, False])
def test_a_loop_that_is_killed_leaves_the_pose_at_which_the_drives_rest(
    tmp_path: Path, killed: bool
) -> None:
    """SIGKILL in mid-swing; or the loop takes its leave, as after any fault."""
    file = tmp_path / "pose.json"
    last = swinging(0.4)
    q = exp((0.1, 0.2, 0.3))

    def loop() -> None:
        keeper = PoseProcess(file, NAME, LIMITS, J, Pose())
        tick, timing = live_tick(0.0)
        for k in range(41):
            keeper.send(k, 0.01 * k, 0, 2, swinging(0.01 * k))
            m = Motion(0.0, q, ZERO, ZERO, ZERO, ZERO, ZERO, (0.0, 0.0))
            keeper.tick(Tick(tick.vehicle, tick.cue, m, tick.wheels), timing)
        if killed:
            until(lambda: moving(file))
            (tmp_path / "ready").touch()
            sleep(60.0)
        assert keeper.finish() == ""

    with child(loop) as pid:
        if killed:
            until((tmp_path / "ready").exists)
            # what was sent last is written 0.1 s after what was written first
            until(lambda: read_pose(file, NAME)[0].wheel_angle == pytest.approx(last.wheel_angle))
            os.kill(pid, signal.SIGKILL)
    until(lambda: file.exists() and not moving(file) and file_moved(file))
    expected = pose_after_stop(q, last, six_axes(1e-9, *LIMITS), J)
    pose, _ = read_pose(file, NAME)
    assert pose.wheel_angle == pytest.approx(expected.wheel_angle)
    assert pose.p_WS_W == pytest.approx(expected.p_WS_W)
    assert geodesic(pose.q_WS, expected.q_WS) < 1e-9


def moving(file: Path) -> bool:
    return file.exists() and read_pose(file, NAME)[1]


def file_moved(file: Path) -> bool:
    return read_pose(file, NAME)[0] != Pose()
