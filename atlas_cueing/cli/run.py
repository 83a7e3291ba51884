"""`atlas-cueing run`: one scenario into one log."""

from pathlib import Path
from typing import Annotated

import typer

from .text import TRUST_MODELS

EPILOG = """
Examples:

  atlas-cueing run scenarios/f16_rolls.toml

  atlas-cueing run scenarios/c172_elevator_doublet.toml -o doublet.mcap --set cueing.method=attitude

  atlas-cueing run flight.toml --set platform.preset=atlas-1.5m --set platform.wheel_limits.speed_rad_s=20 --json
"""


def run(
    scenario: Annotated[Path, typer.Argument(help="Scenario file (TOML).", metavar="SCENARIO")],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Log to write; by default ./NAME.mcap with the scenario's name.")
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Set any key of the scenario or its platform; repeatable."),
    ] = None,
    trust_models: Annotated[bool, typer.Option("--trust-models", help=TRUST_MODELS)] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace an existing log.")] = False,
) -> None:
    """Fly a scenario and write its log.

    Exit status 0: flown, every limit kept. 1: the vehicle failed, the run was interrupted or a limit was violated; the log is
    complete up to there. 2: bad input, nothing was written.
    """
    # Loading JSBSim, scipy and the rest takes far longer than --help should.
    from ..batch import check_output, run_scenario
    from ..scenario import load_scenario
    from .progress import shown_progress
    from .summary import run_summary
    from .text import one_json

    loaded = load_scenario(scenario, settings or (), trust_models=trust_models)
    log = output or Path(f"{loaded.name}.mcap")
    check_output(log, force=force, fresh=True)
    with shown_progress(loaded.name, loaded.file.duration_s) as progress:
        result = run_scenario(loaded, log, progress=progress)
    typer.echo(one_json(result.to_json()) if as_json else run_summary(result))
    if not result.clean:
        for finding in ([f"{result.result}: {result.reason}"] if result.reason else []) + list(result.evaluation.violations):
            typer.echo(finding, err=True)
        raise typer.Exit(1)
