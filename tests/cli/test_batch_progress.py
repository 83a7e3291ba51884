import io
import re
import sys
from pathlib import Path

import pytest

from atlas_cueing.batch import JobResult, PlannedRun, plan
from atlas_cueing.cli import batch_progress as module
from atlas_cueing.cli.batch_progress import batch_progress, spoken

from .conftest import SCRIPT
from .test_progress import Terminal


@pytest.fixture
def runs(tmp_path: Path) -> list[PlannedRun]:
    (tmp_path / "s.toml").write_text(
        f'{SCRIPT}\n[sweep]\ncueing.method = ["blend", "attitude", "force"]'
    )
    return plan([tmp_path / "s.toml"])


def shown(runs: list[PlannedRun], monkeypatch: pytest.MonkeyPatch, stderr: io.StringIO) -> str:
    monkeypatch.setattr(sys, "stderr", stderr)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    with batch_progress(runs) as tell:
        for run, result in zip(runs, ("ok", "crashed", "ok"), strict=True):
            tell(JobResult(result, ticks=54, duration=0.45, id=run.id))
    return stderr.getvalue()


def test_a_file_gets_a_line_at_the_end_and_now_and_then(
    runs: list[PlannedRun], monkeypatch: pytest.MonkeyPatch
) -> None:
    told = shown(runs, monkeypatch, io.StringIO())
    assert re.fullmatch(r"3 of 3 runs done, 1 failed, \d+ flight s a second\n", told)
    monkeypatch.setattr(module, "_LINE_EVERY", 0.0)
    first, second, last = shown(runs, monkeypatch, io.StringIO()).splitlines()
    assert re.fullmatch(
        r"1 of 3 runs done, 0 failed, \d+ flight s a second, 0 s left at most", first
    )
    assert second.startswith("2 of 3 runs done, 1 failed")
    assert last.startswith("3 of 3 runs done, 1 failed")


def test_a_terminal_gets_a_bar(runs: list[PlannedRun], monkeypatch: pytest.MonkeyPatch) -> None:
    assert "3 of 3 runs done, 1 failed" in shown(runs, monkeypatch, Terminal())


def test_what_is_left_is_measured_by_flight_and_not_by_runs(
    runs: list[PlannedRun], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A third of the ticks in 10 s leaves 20 s.

    A run that fails at once makes the rest no faster.
    """
    count = module.Count(runs)
    monkeypatch.setattr(module.Count, "wall", 10.0)
    count.add(JobResult("ok", ticks=54, duration=0.45, id=runs[0].id))
    assert count.text().endswith("20 s left at most")
    count.add(JobResult("vehicle_failed", id=runs[1].id))
    assert count.text().endswith("10 s left at most")


@pytest.mark.parametrize(
    ("time", "text"), [(0.4, "0 s"), (99.0, "99 s"), (120.0, "2 min"), (9000.0, "2.5 h")]
)
def test_times_are_spoken_in_the_unit_that_fits(time: float, text: str) -> None:
    assert spoken(time) == text
