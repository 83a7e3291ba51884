"""`atlas-cueing new`: a first scenario."""

from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError

EPILOG = """
Example:

  atlas-cueing new my_flight
"""


def new_command(
    name: Annotated[str, typer.Argument(help="Name of the scenario.", metavar="NAME")],
) -> None:
    """Write a scenario with comments, NAME.toml, that flies as it is; NAME may end in .toml.

    Exit status 0: written. 2: no such name, or the file exists.
    """
    from ..scenario.new_scenario import new_scenario

    name = name.removesuffix(".toml")
    text, file = new_scenario(name), Path(f"{name}.toml")
    try:
        with file.open("x", encoding="utf-8") as new:
            new.write(text)
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from error
    typer.echo(f"{file}; fly it: atlas-cueing run {file}")
