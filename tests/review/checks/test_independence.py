"""What judges a log shares no arithmetic with what made it."""

import ast
from pathlib import Path

import pytest

import atlas_cueing.review.checks as checks

FILES = sorted(Path(checks.__file__).parent.glob("*.py"))
ROTATIONS = Path(checks.__file__).parents[1] / "own_rotations.py"
OWN = {"finding", "loads_again", "own_rotations", "recorded_run", *(file.stem for file in FILES)}
# names of topics, states and types, no arithmetic
SHARED = {
    "rotations": {"Array"},
    "scenario": {"Platform"},
    "signals": {"ALL_TOPICS", "LOADS", "TIMING", "StateChange"},
}


LOADS = ROTATIONS.with_name("loads_again.py")


@pytest.mark.parametrize("file", [*FILES, ROTATIONS, LOADS], ids=lambda file: file.stem)
def test_a_check_imports_nothing_that_it_judges(file: Path) -> None:
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            assert not any(alias.name.startswith("atlas_cueing") for alias in node.names)
        if isinstance(node, ast.ImportFrom) and node.level:
            module, names = node.module or "", {alias.name for alias in node.names}
            assert module in OWN or names <= SHARED.get(module, set()), (module, names)
