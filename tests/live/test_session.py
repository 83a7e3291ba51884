"""Short runs in real time, through a real ring into a real log.

At 100 Hz; a machine too busy even for that makes a fault of a run, which is then what is looked at.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.live.control.command import Command
from atlas_cueing.live.output.ring_recorder import RingRecorder
from atlas_cueing.live.session import LiveOptions, LiveSession
from atlas_cueing.recording import read_log
from atlas_cueing.review import review_log
from atlas_cueing.run import RunResult
from atlas_cueing.signals import LIVE_STATES

from .rig import scenario

OPTIONS = LiveOptions(rate=100.0, duration=1.6, attended=True)
LATE = "fault"  # what a busy machine makes of any run


class Counting:
    """Drives that keep what they hear."""

    def __init__(self) -> None:
        self.heard: list[tuple[int, int, int]] = []

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        assert command.time == time
        self.heard.append((sequence, due, state))
        return True


def fly(path: Path, options: LiveOptions = OPTIONS, drives: tuple[Counting, ...] = ()) -> RunResult:
    return LiveSession(scenario("atlas-2.9m", "cueing.method=classical"), path, options).run(drives)


def test_a_run_from_a_scenario_to_a_log(tmp_path: Path) -> None:
    """Engaged by itself; the end of its duration parks it just as it sets out."""
    drives = Counting()
    begun = time.monotonic()
    result = fly(tmp_path / "run.mcap", drives=(drives,))
    took = time.monotonic() - begun
    assert result.result in ("ok", LATE)
    assert result.live.lost == 0
    log = read_log(result.log)
    states = [status.state for status in log.statuses]
    assert states[:2] == ["parked", "engaging"]
    assert states[-1] == ("parked" if result.result == "ok" else "stopped")
    assert result.ticks == len(log.column("/motion", "time_s")) == len(drives.heard)
    assert result.duration == pytest.approx(result.ticks * 0.01)
    assert took >= log.column("/timing", "elapsed_s")[-1]
    assert log.metadata["live"] == "true"
    assert log.metadata["rate_hz"] == "100"
    assert log.metadata["result"] == result.result
    assert [sequence for sequence, *_ in drives.heard] == list(range(1, result.ticks + 1))
    found = review_log(result.log)
    if result.result == "ok":
        assert found.clean, [str(finding) for finding in found.findings]
        assert result.clean
        assert result.evaluation.violations == ()
    else:
        assert {finding.check for finding in found.findings} <= {"result", "fault"}


def test_figures_by_name(tmp_path: Path) -> None:
    result = fly(tmp_path / "run.mcap", replace(OPTIONS, duration=0.2))
    figures = result.to_json()
    assert figures["log"] == str(tmp_path / "run.mcap")
    assert figures["ticks"] == result.ticks
    assert figures["realtime"] == {"granted": [], "refused": []}
    timing = figures["timing"]
    assert isinstance(timing, dict)
    assert timing["ticks"] == result.ticks
    assert timing["garbage_collections"] == 0


class Operator(Counting):
    """Another thread that presses a button after the tenth tick, however busy the machine is."""

    def __init__(self, press: Callable[[], None]) -> None:
        super().__init__()
        self._thread = Thread(target=press)

    def send(self, *message: Any) -> bool:
        super().send(*message)
        if len(self.heard) == 10:
            self._thread.start()
            self._thread.join()
        return True


def test_buttons_are_heard(tmp_path: Path) -> None:
    """Nothing engages by itself, and another thread may ask for it."""
    session = LiveSession(
        scenario(), tmp_path / "run.mcap", replace(OPTIONS, duration=0.5, engage=False)
    )
    result = session.run([Operator(partial(session.buttons.press, "engage"))])
    states = [status.state for status in read_log(result.log).statuses]
    assert states[:2] in (["parked", "engaging"], ["parked", "fault_stopping"])


def test_a_slow_disk_does_not_hold_the_loop_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The recorder's process stands still for a quarter of a second at a time; nothing is lost."""
    step = RingRecorder.step

    def slow(self: RingRecorder, now: float) -> object:
        time.sleep(0.25)
        return step(self, now)

    monkeypatch.setattr(RingRecorder, "step", slow)
    result = fly(tmp_path / "run.mcap", replace(OPTIONS, duration=1.0))
    assert result.result in ("ok", LATE)
    assert result.live.lost == 0
    log = read_log(result.log)
    assert len(log.column("/timing", "time_s")) == result.ticks
    if result.result == "ok":
        # or half the ticks would have waited for the disk
        assert result.live.timing["lateness_p50_us"] < 125_000.0


def test_a_log_that_cannot_be_written_is_told_and_the_run_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from atlas_cueing.errors import OutputError
    from atlas_cueing.recording import McapRecorder

    def full(*_: object) -> None:
        raise OutputError("disk full")

    monkeypatch.setattr(McapRecorder, "flush", full)
    result = fly(tmp_path / "run.mcap", replace(OPTIONS, duration=0.3))
    assert result.result in ("recording_failed", LATE)
    assert result.ticks >= 10 or result.result == LATE
    assert not result.clean


@pytest.mark.parametrize("rate", [99.9, 1000.1, float("nan"), -1.0])
def test_rates_out_of_range_are_refused_and_nothing_is_written(tmp_path: Path, rate: float) -> None:
    with pytest.raises(InputError, match=r"allowed: 100 <= rate <= 1000"):
        LiveSession(scenario(), tmp_path / "run.mcap", replace(OPTIONS, rate=rate))
    assert list(tmp_path.iterdir()) == []


def test_states_in_the_log_have_numbers(tmp_path: Path) -> None:
    result = fly(tmp_path / "run.mcap", replace(OPTIONS, duration=0.2))
    numbers = set(read_log(result.log).column("/timing", "state").tolist())
    assert numbers <= set(map(float, range(len(LIVE_STATES))))


def test_a_view_that_dies_ends_the_run_parked_and_the_log_tells(tmp_path: Path) -> None:
    """An attended run, without a duration, of which nobody can press a button any more."""
    session = LiveSession(scenario(), tmp_path / "run.mcap", LiveOptions(rate=100.0, attended=True))
    session.helpers.add(lambda: False, "the view has died", parks=True)
    result = session.run()
    assert result.result in ("viewer_died", LATE)
    assert "the view has died" in [status.reason for status in read_log(result.log).statuses]
