"""`atlas-cueing platform`: the kinematics of a platform, and the loads it can carry."""

from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from .options import AsJson

if TYPE_CHECKING:
    from ..scenario import Platform

EPILOG = """
Examples:

  atlas-cueing platform atlas-2.9m

  atlas-cueing platform atlas-2.9m-halo --loads

  atlas-cueing platform my_platform.toml --json
"""

PresetOrFile: TypeAlias = Annotated[
    str,
    typer.Argument(
        help="A platform of the package, or a platform file (TOML).", metavar="PRESET_OR_FILE"
    ),
]
WithLoads: TypeAlias = Annotated[
    bool,
    typer.Option("--loads", help="Show what contacts and drives can carry; the file needs masses."),
]


def platform_command(
    name_or_file: PresetOrFile,
    loads: WithLoads = False,
    as_json: AsJson = False,
) -> None:
    """Show a platform's Jacobians, its conditioning, its limits and how fast the sphere may turn.

    With --loads also the loads at rest, the accelerations at which a wheel lifts off, slips or
    lacks torque, and which limits promise more than that.

    Exit status 1 when the geometry is singular: its wheels cannot turn the sphere about every axis
    without slip; and when limits promise more than contacts can give and the platform says
    [traction] report = "finding".
    """
    from ..scenario import load_platform
    from .platform_loads import loads_summary, row_figures, sizes
    from .summary import kinematics, platform_summary
    from .text import one_json, say

    platform = load_platform(name_or_file)
    figures = kinematics(platform) | sizes(platform)
    more, promises = row_figures(platform), list[str]()
    if loads:
        found, promises = _loads(platform)
        more |= found
    if as_json:
        typer.echo(one_json(figures | more | ({"broken_promises": promises} if loads else {})))
    else:
        lines = [*loads_summary(more), *(f"remark: {promise}" for promise in promises)]
        typer.echo("\n".join([platform_summary(figures), *lines]))
    strict = platform.traction is not None and platform.traction.report == "finding"
    if promises and strict:
        for promise in promises:
            say(f"{name_or_file}: {promise}")
        raise typer.Exit(1)
    if not figures["slip_free"]:
        say(
            f"{name_or_file}: wheel: singular, the three induced rows are not independent "
            "(kinematic slip condition); move a contact point or turn a drive direction"
        )
        raise typer.Exit(1)


def _loads(platform: "Platform") -> tuple[dict[str, Any], list[str]]:
    """Figures of the loads, and the limits that promise more than contacts can give."""
    from ..loads import reserve
    from ..run.load_promises import broken_promises
    from .platform_loads import load_figures

    found = reserve(platform.load_model())
    return load_figures(platform, found), broken_promises(platform, found)
