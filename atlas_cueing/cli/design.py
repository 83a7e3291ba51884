"""`atlas-cueing design`: wheels laid out for what flights ask of them."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, TypeAlias

import typer

from .options import AsJson

EPILOG = """
Examples:

  atlas-cueing design atlas-2.9m --flights flights -o layouts

  atlas-cueing design atlas-2.9m --flights rolls.mcap spin.mcap -o layouts --vary elevation,skew,preload --also 30/48.2

  atlas-cueing design atlas-2.9m --flights flights -o turned --vary skew --objective condition_number

The first one again, with another row of the table as the platform; it is not searched again:

  atlas-cueing design atlas-2.9m --flights flights -o layouts --choose 7

The folder gets platform.toml (the chosen layout), layouts.json, index.html, and part-*.json:
what has been worked out, so that a design that was stopped goes on where it was. Remove them
to save room. A folder with a design of other logs or options is refused.
"""  # noqa: E501 - commands to copy

PlatformName: TypeAlias = Annotated[
    str,
    typer.Argument(
        help="What to begin with: a platform of the package, or a file; it needs masses.",
        metavar="PLATFORM",
    ),
]
Flights: TypeAlias = Annotated[
    list[Path],
    typer.Option("--flights", metavar="LOG...|FOLDER", help="Logs of rides, or folders of them."),
]
Output: TypeAlias = Annotated[
    Path,
    typer.Option("-o", "--output", metavar="FOLDER", help="Where everything goes."),
]
MoreLogs: TypeAlias = Annotated[
    list[Path] | None, typer.Argument(help="Further logs of --flights.", metavar="[LOG]...")
]
Vary: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        "--vary",
        metavar="WORD,...",
        help="Of elevation, skew, azimuth, radius, gear, preload; by default the first three.",
    ),
]
Ranges: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        "--range",
        metavar="WORD=LOW:HIGH",
        help="Range of a word of --vary, in deg, m or turns; repeatable.",
    ),
]
Objectives: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        "--objective",
        metavar="FIGURE",
        help="What layouts are to be good at; repeatable; by default preload, wheel load,"
        " torque and wheel speed.",
    ),
]
Also: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        metavar="ELEVATION/SKEW[/AZIMUTH]", help="Measure this layout too, deg; repeatable."
    ),
]
Searches: TypeAlias = Annotated[
    int, typer.Option(min=1, max=10_000, help="Mixtures of the objectives that are searched.")
]
Seed: TypeAlias = Annotated[
    int, typer.Option(min=0, max=2**31 - 1, help="The same seed gives the same layouts.")
]
Choose: TypeAlias = Annotated[
    int | None,
    typer.Option(
        min=0, help="Row of the table that platform.toml gets; by default the nearest to ideal."
    ),
]
Jobs: TypeAlias = Annotated[
    int | None,
    typer.Option(min=1, max=1024, help="Processes; by default one for each core."),
]
Cluster: TypeAlias = Annotated[
    str | None,
    typer.Option(
        metavar="tcp://HOST:PORT", help="Search on a dask cluster; 'local' starts one here."
    ),
]


def design_command(
    platform: PlatformName,
    flights: Flights,
    output: Output,
    more: MoreLogs = None,
    vary: Vary = None,
    ranges: Ranges = None,
    objectives: Objectives = None,
    also: Also = None,
    searches: Searches = 16,
    seed: Seed = 0,
    choose: Choose = None,
    jobs: Jobs = None,
    cluster: Cluster = None,
    as_json: AsJson = False,
) -> None:
    """Search layouts of the wheels for what real rides ask of them.

    The rides are held fixed: the sphere's motion as it is in the logs, the platform's masses,
    preloads, supports, limits, friction and motors. The wheels stand evenly around z; what --vary
    names is searched, by default elevation, skew and azimuth. Nothing is said of what the rides
    would be within the limits of another layout. With preload, the chosen platform gets a force
    straight down that keeps its traction margin on all rides.

    The table has the layouts of which none is better in every objective, measured at every tick of
    every ride. Exit status 0: done. 1: stopped; the same command goes on. 2: bad input, also a log
    that is damaged, and nothing was written.
    """
    from ..design import (
        Problem,
        check_objectives,
        design_stamp,
        has_rows,
        layout_of,
        log_files,
        ranges_of,
        read_flights,
    )
    from ..design.variation import layout_asked
    from ..scenario import load_platform
    from .design_run import DesignRun, check_choice
    from .text import say

    begun = load_platform(platform)
    start, model = layout_of(begun), begun.load_model()
    searched, preloaded = ranges_of(vary or ["elevation,skew,azimuth"], ranges or (), start, begun)
    goals = check_objectives(objectives or _usual([*searched]), rows=has_rows(begun))
    asked = [layout_asked(text, start) for text in also or ()]
    logs = log_files([*flights, *(more or ())])
    check_choice(choose, 1 + len(asked) + searches)
    run = DesignRun(platform, begun, output, logs, preloaded=preloaded, choose=choose)
    run.check()
    ridden, names = read_flights(model, logs)
    problem = Problem(begun, start, searched, goals, ridden)
    run.check_same(design_stamp(problem, asked, searches, seed))
    rides = f"{len(names)} ride{'s' if len(names) > 1 else ''}"
    say(f"{rides} with {len(ridden)} ticks; searching {', '.join(searched)}")
    workers = jobs or len(os.sched_getaffinity(0))
    front = run.search(problem, asked, searches, seed, workers, cluster)
    typer.echo(run.finish(front, names, as_json=as_json))


def _usual(searched: Sequence[str]) -> Sequence[str]:
    """With the gear searched, what the motor has to give is an objective too."""
    from ..design import USUAL

    return (*USUAL, "motor_torque_max_n_m", "motor_speed_max_rad_s") if "gear" in searched else ()
