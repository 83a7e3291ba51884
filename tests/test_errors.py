"""What messages tell people to type."""

import re
import shlex
import subprocess
import sys
import tomllib

import pytest
from installed import PACKAGE, ROOT

from atlas_cueing.errors import PIP, MissingExtraError

EXTRAS = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]


def sources() -> list[str]:
    return [path.read_text() for path in PACKAGE.rglob("*.py")]


def test_the_command_is_that_of_the_interpreter_that_runs() -> None:
    """As typed into a shell, it finds the extra's packages here already."""
    message = str(MissingExtraError("a 3D view", "viser", "live"))
    assert message == f"a 3D view needs viser; install it with: {PIP} install 'atlas_cueing[live]'"
    command = shlex.split(message.partition("with: ")[2])
    assert command == [sys.executable, "-m", "pip", "install", "atlas_cueing[live]"]


def test_pip_takes_the_command() -> None:
    """An editable install, so that pip looks for the extra's packages alone."""
    command = [
        sys.executable,
        "-m",
        "pip",
        "install",
        "--dry-run",
        "--no-index",
        "atlas_cueing[live]",
    ]
    message = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    assert message.returncode == 0, message.stderr


def test_no_message_names_another_pip() -> None:
    assert [line for text in sources() for line in text.splitlines() if "pip install" in line] == []


@pytest.mark.parametrize(
    "call",
    sorted(
        {
            call
            for text in sources()
            for call in re.findall(r"raise MissingExtraError\((.+)\)", text)
        }
    ),
)
def test_every_extra_that_is_named_has_the_package(call: str) -> None:
    *_, package, extra = (word.strip(' "') for word in call.split(","))
    # by name, where two of them bring it
    extras = ["live", "report"] if extra == "extra" else [extra]
    module = package.removeprefix("dask.")
    assert all(any(wanted.startswith(module) for wanted in EXTRAS[each]) for each in extras)
