import io
import sys

import pytest

from atlas_cueing.cli import progress
from atlas_cueing.cli.progress import shown_progress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def shown(monkeypatch: pytest.MonkeyPatch, stderr: io.StringIO, duration: float | None) -> str:
    monkeypatch.setattr(sys, "stderr", stderr)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    with shown_progress("flight", duration) as tell:
        if tell:
            for time in (1.0, 2.0, 3.0):
                tell(time)
    return stderr.getvalue()


def test_nobody_is_looking(monkeypatch: pytest.MonkeyPatch) -> None:
    assert shown(monkeypatch, io.StringIO(), 10.0) == ""


def test_a_short_run_shows_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    assert "flight" not in shown(monkeypatch, Terminal(), 10.0)


@pytest.mark.parametrize("duration", [10.0, None])
def test_a_long_run_shows_how_far_it_is(
    monkeypatch: pytest.MonkeyPatch, duration: float | None
) -> None:
    monkeypatch.setattr(progress, "_SHORT", -1.0)
    text = shown(monkeypatch, Terminal(), duration)
    assert "flight" in text
    assert "3 s flown" in text
    assert "times real time" in text
