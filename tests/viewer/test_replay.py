"""The 3D replay as a file; `test_browser` opens it."""

import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError, OutputError
from atlas_cueing.review import RecordedRun
from atlas_cueing.viewer import write_replay
from atlas_cueing.viewer.recorded_motion import RecordedMotion, wheel_angles
from atlas_cueing.viewer.replay import MOST_FRAMES, RATE_HZ, frames


def test_a_replay(run: RecordedRun, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    write_replay(run.platform, run.flight, tmp_path / "replay.html")
    page = (tmp_path / "replay.html").read_text()
    assert capfd.readouterr() == ("", "")
    assert "__VISER_EMBED_DATA__" in page
    assert not re.search(r"<(script|link)[^>]*(src|href)=[\"']?http", page)
    assert len(page) < 4e6


@pytest.mark.parametrize(
    ("duration", "rate"), [(1.0, 120.0), (6.0, 1000.0), (0.05, 100.0), (0.0, 1.0)]
)
def test_frames_span_the_flight(duration: float, rate: float) -> None:
    time = np.arange(int(duration * rate) + 1) / rate
    shown, pause = frames(time)
    assert (shown[0], shown[-1]) == (0, len(time) - 1)
    assert pause * (len(shown) - 1) == pytest.approx(time[-1])
    assert pause <= 1.5 / RATE_HZ + 1e-9
    assert np.abs(time[shown] - pause * np.arange(len(shown))).max() <= 1.0 / rate + 1e-9


def test_a_long_flight_has_no_more_frames() -> None:
    shown, pause = frames(np.arange(600_001) / 1000.0)
    assert len(shown) == MOST_FRAMES + 1
    assert pause == pytest.approx(600.0 / MOST_FRAMES)


def test_nothing_to_show(run: RecordedRun, tmp_path: Path) -> None:
    empty = replace(run.flight, time=run.flight.time[:0])
    q = run.flight.motion_q_WS.copy()
    q[5, 2] = np.nan
    for flight in (empty, replace(run.flight, motion_q_WS=q)):
        with pytest.raises(InputError, match="no motion to show"):
            write_replay(run.platform, flight, tmp_path / "replay.html")
    assert list(tmp_path.iterdir()) == []


def test_nowhere_to_write(run: RecordedRun, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="No such file or directory"):
        write_replay(run.platform, run.flight, tmp_path / "no" / "replay.html")


def test_without_viser_it_says_what_to_install(
    run: RecordedRun, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(InputError, match=r"pip install 'atlas_cueing\[report\]'"):
        write_replay(run.platform, run.flight, tmp_path / "replay.html")


def test_wheels_turn_by_the_integral_of_their_speed() -> None:
    time = np.linspace(0.0, 3.0, 3001)
    angle = wheel_angles(
        time, np.column_stack([np.cos(time), 2.0 + 0.0 * time, np.full(3001, np.nan)])
    )
    assert angle[:, 0] == pytest.approx(np.sin(time), abs=1e-6)
    assert angle[:, 1] == pytest.approx(2.0 * time)
    assert not angle[:, 2].any()


def test_a_pose_is_a_row_of_the_flight(run: RecordedRun) -> None:
    force = run.flight.felt_f.copy()
    force[7] = np.nan
    pose = RecordedMotion(replace(run.flight, felt_f=force)).pose(7)
    assert tuple(pose.q_WS) == tuple(run.flight.motion_q_WS[7])
    assert tuple(pose.p_W) == tuple(run.flight.motion_p_W[7])
    assert tuple(pose.vehicle_f) == tuple(run.flight.vehicle_f_B[7])
    assert pose.finite
