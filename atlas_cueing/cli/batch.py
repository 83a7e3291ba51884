"""`atlas-cueing batch`: thousands of runs, on one machine or many."""

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from ..errors import InputError
from .batch_files import check_plotly, write_reviews, write_table
from .batch_progress import batch_progress
from .batch_summary import end, plan_text, swept_settings, table_json, table_text
from .options import AsJson, TrustModels
from .text import say

if TYPE_CHECKING:
    from ..batch import Fly

EPILOG = """
Examples:

  atlas-cueing batch scenarios -o results

  atlas-cueing batch scenarios/jsbsim_collection.toml -o collection --jobs 2 --sort force_rms_m_s2

The same command again flies only what is missing. On many machines, or to try it here, with the
extra cluster: a scheduler, workers on every machine, then the batch, to a folder that all of them
see:

  export DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES=1

  dask scheduler --host 127.0.0.1 --port 8786 --dashboard-address 127.0.0.1:8787

  dask worker tcp://127.0.0.1:8786 --host 127.0.0.1 --dashboard-address 127.0.0.1:0 --nworkers 8 --nthreads 1

  atlas-cueing batch sweep.toml -o /shared/sweep --cluster tcp://127.0.0.1:8786

Or to a URL that fsspec has a driver for, which every worker uploads its finished runs to. No lock
keeps a second batch out. For s3 fsspec needs s3fs:

  atlas-cueing batch sweep.toml -o file:///shared/sweep

  atlas-cueing batch sweep.toml -o s3://bucket/sweep --cluster tcp://127.0.0.1:8786

Whoever reaches a scheduler or worker can run any program there: use addresses of a private network
only, in place of each 127.0.0.1 above; without --dashboard-address both answer the whole world over
HTTP.

A file with a [sweep] table stands for many runs:

  [sweep]

  cueing.method = ["blend", "force"]

  vehicle.script = "c172*"

  draws = 10

  cueing.align_rate_deg_s = { low = 0.5, high = 10.0 }
"""  # noqa: E501 - commands to copy

SORTED_BY = "mismatch"  # an rms of the direction is 0 as well where no tick has one
_SHOWN_NAMES = 5  # metrics that a wrong --sort is answered with

Paths: TypeAlias = Annotated[
    list[Path],
    typer.Argument(help="Scenario files, sweeps, and folders of them.", metavar="PATH..."),
]
Output: TypeAlias = Annotated[
    str,
    typer.Option(
        "-o",
        "--output",
        metavar="FOLDER|URL",
        help="Where logs, results and table go; URL: file://, s3://...",
    ),
]
Jobs: TypeAlias = Annotated[
    int | None,
    typer.Option(min=1, max=1024, help="Runs at a time; by default one for each core."),
]
Cluster: TypeAlias = Annotated[
    str | None,
    typer.Option(metavar="tcp://HOST:PORT", help="Fly on a dask cluster; 'local' starts one here."),
]
AllSettings: TypeAlias = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Set any key in all scenarios; repeatable."),
]
Sort: TypeAlias = Annotated[
    str, typer.Option(metavar="METRIC", help="What the table is sorted by.")
]
Top: TypeAlias = Annotated[int, typer.Option(min=0, help="Rows of the table that are printed.")]
TimeLimit: TypeAlias = Annotated[
    float, typer.Option("--time-limit", min=0.1, help="Wall time for one run, s.")
]
MemoryLimit: TypeAlias = Annotated[
    float, typer.Option("--memory-limit", min=0.5, help="Address space for one run, GB.")
]
Retry: TypeAlias = Annotated[
    bool, typer.Option("--retry", help="Fly again what crashed or went over a limit.")
]
Pages: TypeAlias = Annotated[
    bool,
    typer.Option(
        "--pages", help="Write the review of each run for a browser; MBs and seconds each."
    ),
]
DryRun: TypeAlias = Annotated[
    bool, typer.Option("--dry-run", help="Check everything, show the plan, fly nothing.")
]


def batch_command(
    paths: Paths,
    output: Output,
    jobs: Jobs = None,
    cluster: Cluster = None,
    settings: AllSettings = None,
    sort: Sort = SORTED_BY,
    top: Top = 20,
    time_limit: TimeLimit = 1800.0,
    memory_limit: MemoryLimit = 4.0,
    retry: Retry = False,
    pages: Pages = False,
    dry_run: DryRun = False,
    trust_models: TrustModels = False,
    as_json: AsJson = False,
) -> None:
    """Fly many scenarios, each alone in its process, and put all figures into one table.

    The folder gets RUN.mcap and RUN.json for each run, summary.csv and index.html. Exit status 0:
    all flown, every limit kept. 1: a run has a finding, or the batch was stopped. 2: bad input,
    nothing was written.
    """
    from ..batch import RunLimits, check_results, fly_batch, missing, open_store, plan
    from ..run import StopRequest

    _check_metric(sort)
    if pages:
        check_plotly()
    runs = plan(paths, settings or (), trust_models=trust_models, checking=_tell)
    results = open_store(output)
    check_results(results)
    todo = missing(runs, results, retry=retry)
    say(plan_text(runs, todo))
    if dry_run:
        return
    with (
        _flyer(cluster, jobs or len(os.sched_getaffinity(0))) as fly,
        StopRequest() as stop,
        batch_progress(todo) as tell,
    ):
        limits = RunLimits(time_limit, memory_limit)
        outcomes = fly_batch(
            runs, results, fly, limits, retry=retry, tell=tell, stop=lambda: stop.requested
        )
    if pages and not stop.requested:
        write_reviews(outcomes, results)
    table = write_table(outcomes, results, sort)
    typer.echo(
        table_json(table, results)
        if as_json
        else table_text(table, swept_settings(outcomes), sort, top, results)
    )
    end(outcomes, stopped=stop.requested)


def _tell(file: Path, runs: int) -> None:
    """To check thousands takes many seconds, in which nothing else is said."""
    say(f"checking {runs} runs of {file}")


@contextmanager
def _flyer(address: str | None, jobs: int) -> "Iterator[Fly]":
    from ..batch import fly_here, on_cluster

    if address is None:
        yield lambda orders, stop: fly_here(orders, jobs, stop)
    else:
        with on_cluster(address, jobs) as fly:
            yield fly


def _check_metric(name: str) -> None:
    from ..batch import METRIC_COLUMNS

    if name not in METRIC_COLUMNS:
        raise InputError(f"--sort {name}: no such metric; {_meant(name, list(METRIC_COLUMNS))}")


def _meant(word: str, names: Sequence[str]) -> str:
    """Names that begin with the word, then those that contain it.

    Only without any the nearest in its letters.
    """
    from ..scenario.mistakes import nearest

    part = re.sub(r"[\s-]+", "_", word.strip().lower())
    found = sorted(
        (name for name in names if part and part in name),
        key=lambda name: not name.startswith(part),
    )
    more = f" and {len(found) - _SHOWN_NAMES} more" if len(found) > _SHOWN_NAMES else ""
    return (
        f"did you mean {', '.join(found[:_SHOWN_NAMES])}{more}?" if found else nearest(word, names)
    )
