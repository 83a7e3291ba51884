"""`atlas-cueing operate` beside a run, or without one."""

import os
from pathlib import Path

import pytest

from atlas_cueing.live.output.operator_desk import OperatorDesk
from atlas_cueing.telemetry import OperatorButtons, live_ring
from atlas_cueing.telemetry.command_socket import open_socket

from .conftest import Command


@pytest.fixture(autouse=True)
def runtime(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    return tmp_path


def test_a_run_is_operated(command: Command) -> None:
    buttons = OperatorButtons()
    _, listener = open_socket(os.getpid())
    desk = OperatorDesk(live_ring(1.0, 300.0), buttons.press, listener, typed=False)
    try:
        for process in (["--latest"], [str(os.getpid())]):
            engaged = command("operate", *process, "engage")
            assert (engaged.status, engaged.out) == (0, "ok: engage asked at 0.00 s, parked\n")
            assert buttons.edges() == ("engage",)
        refused = command("operate", "--latest", "hold")
        assert (refused.status, refused.out) == (1, "no: hold does nothing when parked\n")
        unknown = command("operate", "--latest", "jump")
        assert unknown.status == 2
        assert "'jump', allowed: engage, hold, park, reset, stop, state" in unknown.err
    finally:
        desk.close()


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (["--latest", "hold"], "no live run listens in"),
        (["4711", "hold"], "4711.sock: no live run answers there: No such file"),
        (["../x", "hold"], "PID '../x', allowed: a number"),
        (["hold"], "operate PID COMMAND"),
        (["--latest", "1", "hold"], "operate PID COMMAND"),
    ],
)
def test_without_a_run(command: Command, arguments: list[str], why: str) -> None:
    ended = command("operate", *arguments)
    assert (ended.status, ended.out) == (2, "")
    assert why in ended.err
