"""`atlas-cueing list`: what JSBSim has of its own."""

from typing import Annotated

import typer

from ..errors import InputError

EPILOG = """
Examples:

  atlas-cueing list aircraft

  atlas-cueing list properties c172x
"""
_KINDS = "aircraft, scripts, or properties AIRCRAFT"


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
