"""Arguments of the tools: what is wrong with them is one line, and exit status 2."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from environment import PROJECT

SCENARIOS = PROJECT / "scenarios"


class Arguments(argparse.ArgumentParser):
    """A parser for `tools/NAME` whose help is `text` as it stands, and an example of a command."""

    def __init__(self, text: str | None, example: str) -> None:
        super().__init__(
            prog=example.split()[0],
            description=text,
            epilog=f"example:\n  {example}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )

    def error(self, message: str) -> NoReturn:
        """Exit with one line that says what is wrong and where help is."""
        self.exit(2, f"{self.prog}: {message}; see {self.prog} --help\n")


def add_scenarios(parser: Arguments, default: str = "all bundled ones") -> None:
    """Take names of bundled scenarios, or files."""
    about = f"name of a bundled scenario, or a file ({default})"
    parser.add_argument("scenarios", nargs="*", metavar="SCENARIO", help=about)


def scenario_files(
    parser: Arguments, names: Sequence[str], settings: Sequence[str] = ()
) -> list[Path]:
    """The files of these scenarios, of all bundled ones for no names.

    Exits when one of them cannot be flown.
    """
    from atlas_cueing.errors import AtlasError
    from atlas_cueing.scenario import load_scenario

    files = [_file(name) for name in names] or bundled()
    for file in files:
        try:
            load_scenario(file, settings)
        except AtlasError as error:
            parser.error(str(error).splitlines()[0])
    return files


def bundled() -> list[Path]:
    """Every bundled scenario that is one run; a sweep stands for many."""
    return [path for path in sorted(SCENARIOS.glob("*.toml")) if "[sweep" not in path.read_text()]


def _file(name: str) -> Path:
    named = SCENARIOS / f"{name}.toml"
    return named if named.exists() and not Path(name).is_file() else Path(name)
