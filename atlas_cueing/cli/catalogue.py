"""`atlas-cueing keys`, `new` and `list`: what a scenario can hold, and a first one."""

from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .options import AsJson

KEYS_EPILOG = """
Examples:

  atlas-cueing keys

  atlas-cueing keys cueing.align

  atlas-cueing keys --method hedge

  atlas-cueing keys platform.wheel --json
"""
NEW_EPILOG = """
Example:

  atlas-cueing new my_flight
"""
LIST_EPILOG = """
Examples:

  atlas-cueing list aircraft

  atlas-cueing list properties c172x
"""
_KINDS = "aircraft, scripts, or properties AIRCRAFT"


def keys_command(
    prefix: Annotated[
        str, typer.Argument(help="Beginning of the keys to list.", metavar="[PREFIX]")
    ] = "",
    method: Annotated[
        str, typer.Option(metavar="NAME", help="Only the keys of this cueing method.")
    ] = "",
    as_json: AsJson = False,
) -> None:
    """List the keys of scenario, methods, platform and sweep.

    Each with default, unit, what is allowed and what it is. A key is set by --set, or in its table.

    Exit status 0: listed. 2: no key begins so, or no such method.
    """
    from dataclasses import asdict

    from ..scenario.keys import keys
    from .text import one_json

    found = keys(prefix, method)
    if not found:
        raise InputError(_none_begins(prefix, method))
    if as_json:
        typer.echo(one_json({"keys": [asdict(entry) for entry in found]}))
        return
    typer.echo("\n".join(entry.line() for entry in found))


def _none_begins(prefix: str, method: str) -> str:
    from ..scenario.cueing_table import TABLES

    word = prefix.removeprefix("cueing.")
    if not method and word in TABLES:
        return (
            f"no key begins with {prefix!r}; those of a method: atlas-cueing keys --method {word}"
        )
    of = f" of method {method}" if method else ""
    return f"no key{of} begins with {prefix!r}; all of them: atlas-cueing keys"


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


def list_command(
    kind: Annotated[str, typer.Argument(help=f"What to list: {_KINDS}.", metavar="KIND")],
    aircraft: Annotated[
        str, typer.Argument(help="Of properties: whose.", metavar="[AIRCRAFT]")
    ] = "",
) -> None:
    """List JSBSim's own aircraft or scripts, or the properties of one of its aircraft.

    Exit status 0: listed. 2: no such kind or aircraft.
    """
    from ..vehicles import own_aircraft, own_scripts
    from ..vehicles.jsbsim.loading import properties

    lists = {"aircraft": own_aircraft, "scripts": own_scripts}
    if kind in lists and not aircraft:
        typer.echo("\n".join(sorted(lists[kind]())))
    elif kind == "properties" and aircraft in own_aircraft():
        typer.echo("\n".join(properties(aircraft)))
    elif kind == "properties" and not aircraft:
        raise InputError(
            "list properties: of which aircraft? as: atlas-cueing list properties f16; all of them:"
            " atlas-cueing list aircraft"
        )
    elif kind == "properties":
        raise InputError(f"aircraft {aircraft!r}: allowed: one of atlas-cueing list aircraft")
    elif kind in lists:
        raise InputError(f"list {kind} {aircraft}: allowed: list {kind}, without {aircraft!r}")
    else:
        raise InputError(f"{kind}: allowed: {_KINDS}")
