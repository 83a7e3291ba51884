"""`atlas-cueing plant`: a log's schedule on a simulated platform."""

from collections.abc import Mapping
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .input_log import input_log
from .options import AsJson, Force

if TYPE_CHECKING:
    from ..plant import PlantRun
    from ..review import RecordedRun
    from ..scenario.plant_table import PlantTable

EPILOG = """
Examples:

  atlas-cueing plant f16_rolls.mcap -o open.mcap

  atlas-cueing plant f16_rolls.mcap --feedback fix -o closed.mcap

  atlas-cueing plant f16_rolls.mcap --feedback fix --html f16_rolls_plant.html

  atlas-cueing plant f16_rolls.mcap --feedback fix --set platform.plant.fix_latency_s=0.05 --json

  atlas-cueing keys platform.plant
"""


def plant_command(
    log: Annotated[Path, typer.Argument(help="Log (MCAP) whose schedule is flown.", metavar="LOG")],
    feedback: Annotated[
        str,
        typer.Option(
            "--feedback",
            metavar="KIND",
            help="What the loop knows: none, odometry (of the wheels), gyro, fix (gyro and fixes).",
        ),
    ] = "none",
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="NEW", help="Log to write, with /plant and /correction."
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="KEY=VALUE",
            help="Set any key of platform.plant: contacts, drives, sensors; repeatable.",
        ),
    ] = None,
    html: Annotated[
        Path | None,
        typer.Option(
            "--html",
            metavar="FILE",
            help="Page for a browser: orientation with the loop open and closed, slip, felt force.",
        ),
    ] = None,
    as_json: AsJson = False,
    force: Force = False,
) -> None:
    """Fly a log's wheels and stage on a simulated platform whose wheels slip.

    The sphere lies on springs, its wheels transmit force by friction with creep, servos turn them,
    gyro and fix measure it. Told are how far it is from /motion in the end, slip, what the rider
    really feels, and energy. Every number of it that is not of the log or its platform is assumed.

    Without -o and --html it only prints. For the page of a closed loop the open one is flown, too.
    Exit status 0: flown, however far the sphere went astray. 2: bad input, also a log that is
    damaged, and nothing written.
    """
    from ..plant import fly_plant, plant_figures, plant_table, write_plant_log
    from ..review import open_run
    from ..run import check_output
    from .progress import shown_share
    from .text import one_json

    new = check_output(output, inputs=[log], force=force, fresh=True) if output else None
    page = _checked_page(html, [log], new, force=force)
    with input_log(log):
        run = open_run(log)
    table = plant_table(run.platform, settings or ())
    with shown_share("plant") as progress:
        flown = fly_plant(run.log, run.platform, feedback, table, progress)
    figures = plant_figures(flown, run.log)
    if new:
        write_plant_log(run.log, flown, new)
    if page:
        _write_page(run, flown, table, page)
    told = {"log": str(log), "feedback": feedback, "written": str(output or ""), **figures}
    typer.echo(one_json(told) if as_json else "\n".join(_lines(told)))


def _checked_page(
    html: Path | None, inputs: list[Path], new: Path | None, *, force: bool
) -> Path | None:
    """The real file of the page, if one is asked for. Raises before anything is flown."""
    if html is None:
        return None
    from ..review.sections import check_plotly
    from ..run import PAGE, check_output

    check_plotly()
    return check_output(html, PAGE, inputs=inputs, outputs=[new] if new else [], force=force)


def _write_page(run: "RecordedRun", flown: "PlantRun", table: "PlantTable", page: Path) -> None:
    """Write the page, of a closed loop with the open one beside it."""
    from ..plant import fly_plant
    from ..review.plant_page import write_plant_page
    from .progress import shown_share

    opened = None
    if flown.feedback != "none":
        with shown_share("open loop") as progress:
            opened = fly_plant(run.log, run.platform, "none", table, progress)
    write_plant_page(run.log, flown, page, opened)


_ANGLE = "_rad"


def _lines(told: Mapping[str, Any]) -> list[str]:
    """Figures as people read them: angles in degrees."""
    from .text import aligned

    rows = []
    for name, value in told.items():
        if not isinstance(value, float):
            rows.append((name, str(value)))
        elif name.endswith(_ANGLE):
            rows.append((f"{name.removesuffix(_ANGLE)}_deg", f"{degrees(value):.4g}"))
        else:
            rows.append((name, f"{value:.4g}"))
    return aligned([row for row in rows if row[1]], "")
