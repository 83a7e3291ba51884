from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from atlas_cueing.cli import main

SCRIPT = """
name = "short"
duration_s = 0.45
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
"""


@dataclass
class Ended:
    """How a command ended."""

    status: int
    out: str
    err: str


Command = Callable[..., Ended]


@pytest.fixture
def command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Command:
    """The command in an empty folder that has only a scenario `s.toml`."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s.toml").write_text(SCRIPT)

    def ended(*arguments: str) -> Ended:
        status = main(arguments)
        return Ended(status, *capsys.readouterr())

    return ended
