"""`atlas-cueing run`: one scenario into one log."""

from pathlib import Path

import typer

from .options import AsJson, Force, NewLog, ScenarioFile, Settings, TrustModels
from .text import FIGURES

EPILOG = (
    """
Examples:

  atlas-cueing run scenarios/f16_rolls.toml

  atlas-cueing run scenarios/c172_elevator_doublet.toml -o doublet.mcap --set cueing.method=attitude

  atlas-cueing run flight.toml --set platform.preset=atlas-1.5m --set platform.wheel_limits.speed_rad_s=20 --json
"""  # noqa: E501 - commands to copy
    + FIGURES
)


def run_command(
    scenario: ScenarioFile,
    output: NewLog = None,
    settings: Settings = None,
    trust_models: TrustModels = False,
    as_json: AsJson = False,
    force: Force = False,
) -> None:
    """Fly a scenario and write its log.

    Exit status 0: flown, every limit kept. 1: the vehicle failed, the run was interrupted or a
    limit was violated; the log is
    complete up to there. 2: bad input, nothing was written.
    """
    # Loading JSBSim, scipy and the rest takes far longer than --help should.
    from ..run import check_output, run_scenario
    from ..scenario import load_scenario
    from .progress import shown_progress
    from .summary import end, run_summary
    from .text import one_json

    loaded = load_scenario(scenario, settings or (), trust_models=trust_models)
    read = (scenario, *loaded.inputs())
    asked = output or Path(f"{loaded.name}.mcap")
    log = check_output(asked, inputs=read, force=force, fresh=True)
    with shown_progress(loaded.name, loaded.file.duration_s) as progress:
        result = run_scenario(loaded, log, progress=progress)
    typer.echo(one_json(result.to_json()) if as_json else run_summary(result))
    end(result)
