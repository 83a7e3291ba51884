"""A short run of every target, and that a crash would be seen.

`tools/fuzz` runs them for as long as one likes.
"""

import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import strategies as st

from atlas_cueing.errors import LogError

from .targets import TARGETS, Tally, Target, run

EXAMPLES = 150
TOOL = Path(__file__).parents[2] / "tools" / "fuzz"


@pytest.mark.parametrize("name", TARGETS)
def test_whatever_is_handed_in_is_taken_or_refused(name: str) -> None:
    tally = Tally()
    run(TARGETS[name], 1, EXAMPLES, tally)
    assert tally.crashes == {}
    assert tally.executions >= EXAMPLES // 2
    assert 0 < tally.refused <= tally.executions, "inputs are neither all good nor all of one kind"


@pytest.mark.parametrize("name", sorted(TARGETS.keys() - {"flightgear"}))
def test_some_inputs_get_through(name: str) -> None:
    """Or only the first look would be tested."""
    tally = Tally()
    for seed in range(2, 12):
        run(TARGETS[name], seed, EXAMPLES, tally)
        if tally.refused < tally.executions:
            return
    raise AssertionError(f"all of {tally.executions} inputs were refused")


def test_crashes_are_counted_and_refusals_are_not() -> None:
    def take(data: bytes, _: Path) -> None:
        if len(data) > 3:
            raise LogError("too long")
        if data:
            raise ZeroDivisionError(data[0])

    tally = Tally()
    run(Target(st.binary(max_size=6), take), 1, 100, tally)
    assert tally.refused > 0
    assert tally.crashes
    assert all(
        line.startswith("ZeroDivisionError") and 0 < len(data) < 4
        for line, data in tally.crashes.items()
    )


def test_the_command() -> None:
    done = subprocess.run(
        [sys.executable, TOOL, "--seconds", "0.2", "setpoint"],
        capture_output=True,
        text=True,
        timeout=300.0,
    )
    assert (done.returncode, done.stderr) == (0, "")
    head, line = done.stdout.splitlines()
    assert head.split() == ["target", "executions", "refused", "crashes", "peak", "MB"]
    name, executions, refused, crashes, peak = line.split()
    assert (name, crashes) == ("setpoint", "0")
    assert int(executions) > 50
    assert int(refused) > 0
    assert 10.0 < float(peak) < 1000.0


def test_an_unknown_target_is_refused_by_name() -> None:
    done = subprocess.run(
        [sys.executable, TOOL, "toaster"], capture_output=True, text=True, timeout=300.0
    )
    assert done.returncode == 2
    assert "invalid choice: 'toaster'" in done.stderr
