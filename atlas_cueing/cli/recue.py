"""`atlas-cueing recue`: a recorded flight cued in another way."""

from pathlib import Path
from typing import Annotated

import typer

from .options import Force, TrustModels

EPILOG = """
Examples:

  atlas-cueing recue f16_loop.mcap --set cueing.method=attitude -o attitude.mcap

  atlas-cueing recue f16_loop.mcap --set platform.preset=atlas-1.5m -o small.mcap

  atlas-cueing recue f16_loop.mcap --set cueing.method=my_method.py:Mine --trust-models -o my.mcap
"""


def recue_command(
    log: Annotated[Path, typer.Argument(help="Log (MCAP) whose flight is used.", metavar="LOG")],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="NEW", help="Log to write.")],
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="KEY=VALUE",
            help="Set any key of cueing, platform or recording; repeatable.",
        ),
    ] = None,
    trust_models: TrustModels = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the review of the new log as one JSON object.")
    ] = False,
    force: Force = False,
) -> None:
    """Cue a recorded flight in another way.

    The vehicle in the log goes through another method, other parameters or another platform.
    Without --set the new log repeats the old one's cue, motion and wheels exactly.

    Exit status 0: written and clean. 1: the new log has a finding. 2: bad input, also an old log
    that is damaged, and nothing written.
    """
    from ..review import cue_again as recued
    from ..review import review_log as judged
    from ..run import check_output
    from .review import review_summary
    from .text import one_json

    new = check_output(output, inputs=[log], force=force, fresh=True)
    recued(log, settings or (), new, trust_models=trust_models)
    found = judged(new)
    typer.echo(one_json(found.to_json()) if as_json else review_summary(found))
    if not found.clean:
        raise typer.Exit(1)
