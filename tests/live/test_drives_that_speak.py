"""Loop and drives that tell what they do, on a virtual clock, and as real processes."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from waiting import until

from atlas_cueing.live.control.state_machine import State

from .rig import Rig
from .virtual_drives import VirtualDrives, errors, fly, punctual

MOVING = [State.ENGAGING, State.RUNNING, State.HOLDING, State.PARKING]


def hold_at(slot: int) -> object:
    def press(rig: Rig, now: int) -> None:
        if now == slot:
            rig.press("hold")

    return press


def slot_in(state: State) -> int:
    """A slot of the punctual ride in which the platform moves, in this state."""
    numbers = [timing.state for timing in punctual(100.0).tape.timings]
    if state is State.HOLDING:
        return slot_in(State.RUNNING) + 10
    found = [k for k, number in enumerate(numbers, 1) if number == state.number]
    return found[min(len(found) // 2 + 60, len(found) - 20)]


def ride(drives: VirtualDrives, state: State | None = None) -> Rig:
    held = hold_at(slot_in(State.RUNNING) if state is State.HOLDING else -1)
    return fly(100.0, lambda _: 0.0, drives=drives, speak=True, before_slot=held)[0]  # type: ignore[arg-type]


@pytest.mark.parametrize("rate", [100.0, 250.0])
def test_a_ride_with_words_is_the_ride_without(rate: float) -> None:
    drives = VirtualDrives()
    rig, _ = fly(rate, lambda _: 0.0, drives=drives, speak=True)
    assert rig.controller.outcome.result == "ok"
    assert rig.monitor is not None
    assert rig.monitor.figures()["statuses"] >= 50 * rig.loop.time - 5
    assert max(rig.monitor.wheel_difference, rig.monitor.stage_difference) < 1e-5
    assert rig.monitor.least_margin == pytest.approx(0.008 + rig.dt, abs=1e-6)
    flown, alone = rig.tape.commands, punctual(rate).tape.commands
    assert flown[: len(alone)] == alone
    assert len(flown) - len(alone) <= 0.05 * rate, "until the drives say that they rest"


@pytest.mark.parametrize("state", MOVING)
def test_latched_drives_are_a_fault_within_two_ticks(state: State) -> None:
    drives, slot = VirtualDrives(), slot_in(state)
    due = [sent[2] for sent in punctual(100.0).tape.sent]
    drives.latched = due[slot] - 18_000_000  # when it is sent
    rig = ride(drives, state)
    assert rig.controller.outcome.reason == "the drives have latched: by hand; reset them"
    fault = next(time for time, name, _ in rig.tape.statuses if name == "fault_stopping")
    # a status is sent every 20 ms
    assert slot + 1 <= round(100.0 * fault) <= slot + 1 + 2 + 2
    assert rig.tape.statuses[-1][1] == "stopped"


@pytest.mark.parametrize("state", MOVING)
def test_silent_drives_are_a_fault_after_the_timeout(state: State) -> None:
    drives, slot = VirtualDrives(), slot_in(state)
    due = [sent[2] for sent in punctual(100.0).tape.sent]
    drives.mute = due[slot] - 18_000_000
    rig = ride(drives, state)
    assert "the drives were silent for" in rig.controller.outcome.reason
    fault = next(time for time, name, _ in rig.tape.statuses if name == "fault_stopping")
    assert 4 <= round(100.0 * fault) - slot <= 8
    assert max(errors(rig, drives)[1:]) < 1e-6, "both fly the same stop"


def test_lost_set_points_beyond_the_lead_are_a_fault_of_both() -> None:
    """What the sender cannot know without words: the drives stop, and the loop goes on."""
    drives, slot = VirtualDrives(), slot_in(State.RUNNING)
    drives.lost = frozenset(range(slot, slot + 8))
    rig = ride(drives)
    outcome = rig.controller.outcome
    assert outcome.result == "fault"
    assert "off the command" in outcome.reason or "latched" in outcome.reason
    fault = next(time for time, name, _ in rig.tape.statuses if name == "fault_stopping")
    assert round(100.0 * fault) - slot <= 12


def test_it_does_not_set_out_before_drives_that_are_not_there() -> None:
    drives = VirtualDrives()
    drives.mute = 0
    rig = ride(drives)
    assert rig.controller.outcome.result == "ok"
    assert rig.monitor is not None
    assert rig.monitor.finding.startswith("set points go to nobody")
    told = [reason for _, name, reason in rig.tape.statuses if name == "engaging"]
    assert told[1:] == [rig.monitor.finding]
    assert {command.wheel_angle for command in rig.tape.commands} == {(0.0, 0.0, 0.0)}


TOOL = Path(__file__).parents[2] / "tools" / "receive_setpoints"
LONG = ["--duration", "20", "--lead", "60"]
PROGRAM = Path(sys.executable).with_name("atlas-cueing")
SCENARIO = """
name = "short"
duration_s = 60.0
[vehicle]
source = "signal"
[[vehicle.signal]]
axis = "roll_rate"
shape = "sine"
amplitude_deg_s = 20.0
frequency_rad_s = 2.0
duration_s = 60.0
[platform]
preset = "atlas-2.9m"
[cueing]
method = "attitude"
"""


def test_over_the_loopback_with_real_processes(tmp_path: Path) -> None:
    """The receiver is killed in the ride: the loop stops, and says why."""
    (tmp_path / "s.toml").write_text(SCENARIO)
    command = [sys.executable, TOOL, "--port", "0", "--json", "--duration", "60"]
    drives = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert drives.stderr is not None
    told = tmp_path / "told"
    arguments = ["live", "s.toml", "--json", "--rate", "100", "--pose", "pose.json", *LONG]
    with drives, told.open("w") as err:
        address = drives.stderr.readline().split()[-1]
        live = subprocess.Popen(
            [PROGRAM, *arguments, "--setpoints", address],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=err,
            text=True,
        )
        for line in drives.stderr:
            if "running" in line:
                break
        drives.kill()
    # it stays where it stopped until it is asked to end
    until(lambda: "Ctrl-C or SIGTERM" in told.read_text() or live.poll() is not None, 60.0)
    live.terminate()
    out, _ = live.communicate(timeout=60.0)
    assert "Traceback" not in told.read_text()
    result = json.loads(out)
    assert (live.returncode, result["result"]) == (1, "fault"), result
    assert "the drives were silent for" in result["reason"], result["reason"]
    assert result["drives"]["drive_status"] == "monitored"
    assert result["drives"]["statuses"] > 10
