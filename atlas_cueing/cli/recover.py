"""`atlas-cueing recover`: a finished log from a broken one."""

from pathlib import Path
from typing import Annotated

import typer

from .options import AsJson, Force

EPILOG = """
Examples:

  atlas-cueing recover broken.mcap -o fixed.mcap

  atlas-cueing recover flight.mcap.part -o flight.mcap
"""


def recover_command(
    broken: Annotated[
        Path,
        typer.Argument(
            help="A cut or damaged log, or the .part of a killed run.", metavar="BROKEN"
        ),
    ],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="FIXED", help="Log to write.")],
    as_json: AsJson = False,
    force: Force = False,
) -> None:
    """Save what is whole in a broken log.

    Every complete chunk of a cut or damaged log goes into a new, finished one, and losses are
    reported.

    Exit status 0: written. 1: nothing in it can be recovered. 2: bad usage, nothing was written.
    """
    from ..review import recover_log as recovered
    from ..run import check_output
    from .text import aligned, one_json

    result = recovered(broken, check_output(output, inputs=[broken], force=force))
    if as_json:
        typer.echo(one_json(result.to_json()))
        return
    rows = [
        ("log", str(result.log)),
        ("recovered", f"{result.seconds:.2f} s, {result.ticks} ticks"),
    ]
    typer.echo(
        "\n".join(aligned([*rows, *[("lost", lost) for lost in result.lost or ("nothing",)]], ""))
    )
