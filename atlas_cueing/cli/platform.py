"""`atlas-cueing platform`: the kinematics of a platform."""

from typing import Annotated

import typer

EPILOG = """
Examples:

  atlas-cueing platform atlas-2.9m

  atlas-cueing platform my_platform.toml --json
"""


def platform_command(
    name_or_file: Annotated[
        str,
        typer.Argument(
            help="A platform of the package, or a platform file (TOML).", metavar="PRESET_OR_FILE"
        ),
    ],
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Show a platform's Jacobians, its conditioning and how fast the sphere may turn.

    Exit status 1 when the geometry is singular: its wheels cannot turn the sphere about every axis
        without slip.
    """
    from ..scenario import load_platform
    from .summary import kinematics, platform_summary
    from .text import one_json, say

    figures = kinematics(load_platform(name_or_file))
    typer.echo(one_json(figures) if as_json else platform_summary(figures))
    if not figures["slip_free"]:
        say(
            f"{name_or_file}: wheel: singular, the three induced rows are not independent "
            "(kinematic slip condition); move a contact point or turn a drive direction"
        )
        raise typer.Exit(1)
