"""`tools/sweep_properties` on what has ended processes before.

The tool itself goes through all properties.
"""

import subprocess
import sys
from pathlib import Path

import pytest

TOOL = Path(__file__).parents[2] / "tools" / "sweep_properties"


@pytest.mark.parametrize(
    ("aircraft", "only"),
    [
        ("c172x", "propulsion/s"),
        ("F450", "simulation/do"),
        ("737", "atmosphere/updownburst"),
        ("c172x", "simulation/p"),
    ],
)
def test_no_process_dies(aircraft: str, only: str) -> None:
    command = [sys.executable, str(TOOL), aircraft, "--only", only]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    first, *_, last = ended.stdout.splitlines()
    assert int(first.split(": ")[1].split()[0]) >= 5
    assert last == "processes that died or hung: 0"


def test_what_must_not_be_set_is_listed() -> None:
    command = [sys.executable, str(TOOL), "c172x", "--only", "atmosphere/updownburst"]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert (
        "number-of-cells refused: JSBSim property 'atmosphere/updownburst/number-of-cells' must not"
        " be set" in told
    )
