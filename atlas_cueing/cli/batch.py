"""`atlas-cueing batch`: thousands of runs, on one machine or many."""

import os
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import InputError, LogError, MissingExtraError
from ..printable import printable
from .batch_progress import batch_progress, spoken
from .text import TRUST_MODELS, say

if TYPE_CHECKING:
    from ..batch import Fly, Outcome, PlannedRun, ResultStore

EPILOG = """
Examples:

  atlas-cueing batch scenarios -o results

  atlas-cueing batch scenarios/jsbsim_collection.toml -o collection --jobs 2 --sort force_rms_m_s2

The same command again flies only what is missing. On many machines, or to try it here, with the extra cluster: a
scheduler, workers on every machine, then the batch, to a folder that all of them see:

  export DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES=1

  dask scheduler --host 127.0.0.1 --port 8786 --dashboard-address 127.0.0.1:8787

  dask worker tcp://127.0.0.1:8786 --host 127.0.0.1 --dashboard-address 127.0.0.1:0 --nworkers 8 --nthreads 1

  atlas-cueing batch sweep.toml -o /shared/sweep --cluster tcp://127.0.0.1:8786

Or to a URL that fsspec has a driver for, which every worker uploads its finished runs to. No lock keeps a second batch out:

  atlas-cueing batch sweep.toml -o file:///shared/sweep

  atlas-cueing batch sweep.toml -o s3://bucket/sweep --cluster tcp://127.0.0.1:8786    (with s3fs installed)

Whoever reaches a scheduler or worker can run any program there: use addresses of a private network only, in place of each
127.0.0.1 above; without --dashboard-address both answer the whole world over HTTP.

A file with a [sweep] table stands for many runs:

  [sweep]

  cueing.method = ["blend", "force"]

  vehicle.script = "c172*"

  draws = 10

  cueing.align_rate_deg_s = { low = 0.5, high = 10.0 }
"""  # noqa: E501 - commands to copy

SORTED_BY = "direction_rms_rad"
_SHOWN_NAMES = 5  # metrics that a wrong --sort is answered with
_SHOWN_FINDINGS = 20  # lines on stderr; the table has all


def batch_command(
    paths: Annotated[
        list[Path],
        typer.Argument(help="Scenario files, sweeps, and folders of them.", metavar="PATH..."),
    ],
    output: Annotated[
        str,
        typer.Option(
            "-o",
            "--output",
            metavar="FOLDER|URL",
            help="Where logs, records and table go; URL: file://, s3://...",
        ),
    ],
    jobs: Annotated[
        int | None,
        typer.Option(min=1, max=1024, help="Runs at a time; by default one for each core."),
    ] = None,
    cluster: Annotated[
        str | None,
        typer.Option(
            metavar="tcp://HOST:PORT", help="Fly on a dask cluster; 'local' starts one here."
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="KEY=VALUE", help="Set any key in all scenarios; repeatable."
        ),
    ] = None,
    sort: Annotated[
        str, typer.Option(metavar="METRIC", help="What the table is sorted by.")
    ] = SORTED_BY,
    top: Annotated[int, typer.Option(min=0, help="Rows of the table that are printed.")] = 20,
    time_limit: Annotated[
        float, typer.Option("--time-limit", min=0.1, help="Wall time for one run, s.")
    ] = 1800.0,
    memory_limit: Annotated[
        float, typer.Option("--memory-limit", min=0.5, help="Address space for one run, GB.")
    ] = 4.0,
    retry: Annotated[
        bool, typer.Option("--retry", help="Fly again what crashed or went over a limit.")
    ] = False,
    pages: Annotated[
        bool,
        typer.Option(
            "--pages", help="Write the review of each run for a browser; MBs and seconds each."
        ),
    ] = False,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Check everything, show the plan, fly nothing.")
    ] = False,
    trust_models: Annotated[bool, typer.Option("--trust-models", help=TRUST_MODELS)] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
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
        _check_plotly()
    runs = plan(paths, settings or (), trust_models=trust_models, checking=_tell)
    results = open_store(output)
    check_results(results)
    todo = missing(runs, results, retry=retry)
    say(_plan_text(runs, todo))
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
        _write_pages(outcomes, results)
    table = _write(outcomes, results, sort)
    typer.echo(
        _json(table, results) if as_json else _text(table, _settings(outcomes), sort, top, results)
    )
    _end(outcomes, stopped=stop.requested)


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


def _plan_text(runs: "Sequence[PlannedRun]", todo: "Sequence[PlannedRun]") -> str:
    known = sum(run.duration or 0.0 for run in todo)
    unknown = sum(run.duration is None for run in todo)
    more = f", and {unknown} of unknown length" if unknown else ""
    return (
        f"{_runs(len(runs))}, {len(runs) - len(todo)} of them done already; to fly: {spoken(known)}"
        f" of flight at most{more}"
    )


def _write(
    outcomes: "Sequence[Outcome]", results: "ResultStore", sort: str
) -> list[Mapping[str, Any]]:
    """Table and overview, also of a batch that was stopped; gives the table."""
    from ..batch import csv_of, ordered, overview, rows
    from ..batch.store import INDEX, SUMMARY

    table = ordered(rows(outcomes), sort)
    results.write(SUMMARY, csv_of(table).encode(errors="replace"))
    page = overview(table, _settings(outcomes), _shown(sort), results.title, results.names())
    results.write(INDEX, page.encode(errors="replace"))
    return table


def _write_pages(outcomes: "Sequence[Outcome]", results: "ResultStore") -> None:
    """The review of each complete log that has none yet, beside it."""
    from ..review import review_log
    from ..review.report import write_page

    there = results.names()
    for record in (outcome.record for outcome in outcomes if outcome.record):
        log = str(record.log or "")
        if not log.endswith(".mcap") or f"{record.id}.html" in there:
            continue
        with TemporaryDirectory(prefix="atlas_cueing_") as scratch:
            page = Path(scratch) / "page.html"
            try:
                write_page(review_log(results.fetch(log, Path(scratch))), page)
            except LogError as error:
                say(f"{record.id}: no review: {error}")
            else:
                results.write(f"{record.id}.html", page.read_bytes())


def _check_plotly() -> None:
    from importlib.util import find_spec

    if find_spec("plotly") is None:
        raise MissingExtraError("--pages", "plotly", "report")


def _check_metric(name: str) -> None:
    from ..batch import METRIC_COLUMNS

    if name not in METRIC_COLUMNS:
        raise InputError(f"--sort {name}: no such metric; {_meant(name, list(METRIC_COLUMNS))}")


def _shown(sort: str) -> list[str]:
    """Names of the metrics in the table, the one by which it is sorted first."""
    from ..evaluation import Shown, shown

    return list(dict.fromkeys([sort, *(metric.name for metric in shown(Shown.BATCH))]))


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


def _runs(count: int) -> str:
    return f"{count} run" if count == 1 else f"{count} runs"


def _settings(outcomes: "Sequence[Outcome]") -> list[str]:
    return list(dict.fromkeys(key for outcome in outcomes for key in outcome.run.settings))


def _json(table: Sequence[Mapping[str, Any]], results: "ResultStore") -> str:
    from .text import one_json

    counts = Counter(row["result"] for row in table)
    return one_json(
        {"folder": results.where(), "runs": len(table), "results": dict(counts), "table": table}
    )


def _text(
    table: Sequence[Mapping[str, Any]],
    settings: Sequence[str],
    sort: str,
    top: int,
    results: "ResultStore",
) -> str:
    """The first rows, counts, and where everything is."""
    from ..batch import METRIC_COLUMNS
    from .text import aligned

    swept = [key for key in settings if len({repr(row.get(key)) for row in table}) > 1]
    metrics = [METRIC_COLUMNS[name] for name in _shown(sort)[:4]]
    heads = [
        "run",
        "result",
        *map(printable, swept),
        *(metric.line for metric in metrics),
    ]
    cells = [
        [
            row["run"],
            row["result"],
            *(_short(row.get(key)) for key in swept),
            *(metric.unit.text(row.get(metric.name)) for metric in metrics),
        ]
        for row in table[:top]
    ]
    widths = [max(map(len, column)) for column in zip(heads, *cells, strict=True)]
    lines = ["  ".join(_cells(line, widths)).rstrip() for line in (heads, *cells)]
    counts = Counter(row["result"] for row in table)
    flown = sum(row.get("duration_s", 0.0) for row in table)
    tail = [
        ("runs", ", ".join(f"{count} {result}" for result, count in counts.most_common())),
        ("violations", str(sum(row.get("violations", 0) for row in table))),
        ("flight", spoken(flown)),
        ("table", results.where("summary.csv")),
        ("overview", results.where("index.html")),
    ]
    return "\n".join([*(lines if top else []), *aligned(tail, "")])


def _cells(line: Sequence[str], widths: Sequence[int]) -> list[str]:
    """Run and result to the left, numbers to the right."""
    return [
        f"{text:<{width}}" if i < 2 else f"{text:>{width}}"
        for i, (text, width) in enumerate(zip(line, widths, strict=True))
    ]


def _short(value: Any) -> str:
    return (
        f"{value:.5g}"
        if isinstance(value, float)
        else "-"
        if value is None
        else printable(str(value))
    )


def _end(outcomes: "Sequence[Outcome]", *, stopped: bool) -> None:
    """Say what was found; raises Exit(1) if anything was."""
    findings = [line for outcome in outcomes for line in _findings(outcome)]
    for line in findings[:_SHOWN_FINDINGS]:
        say(line)
    if len(findings) > _SHOWN_FINDINGS:
        say(f"and {len(findings) - _SHOWN_FINDINGS} more; summary.csv has all")
    left = sum(outcome.record is None or not outcome.record.final for outcome in outcomes)
    if left:
        again = f"not done; the same command flies {'it' if left == 1 else 'them'}"
        say(f"{'stopped: ' if stopped else ''}{_runs(left)} {again}")
    if findings or left:
        raise typer.Exit(1)


def _findings(outcome: "Outcome") -> list[str]:
    record = outcome.record
    if record is None or record.clean:
        return []
    failed = [f"{record.id}: {record.result}: {record.reason}"] if record.result != "ok" else []
    return failed + [f"{record.id}: {violation}" for violation in record.evaluation.violations]
