"""What `batch` prints: the plan, the first rows of the table, counts, and what was found."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import typer

from ..printable import printable
from .batch_progress import spoken
from .text import aligned, one_json, say

if TYPE_CHECKING:
    from ..batch import Outcome, PlannedRun, ResultStore

_SHOWN_FINDINGS = 20  # lines on stderr; the table has all


def plan_text(runs: "Sequence[PlannedRun]", todo: "Sequence[PlannedRun]") -> str:
    """Say how many runs there are, how many are done, and how long the others fly at most."""
    known = sum(run.duration or 0.0 for run in todo)
    unknown = sum(run.duration is None for run in todo)
    more = f", and {unknown} of unknown length" if unknown else ""
    return (
        f"{_runs(len(runs))}, {len(runs) - len(todo)} of them done already; to fly: {spoken(known)}"
        f" of flight at most{more}"
    )


def _runs(count: int) -> str:
    return f"{count} run" if count == 1 else f"{count} runs"


def swept_settings(outcomes: "Sequence[Outcome]") -> list[str]:
    """Keys that the sweeps of these runs set."""
    return list(dict.fromkeys(key for outcome in outcomes for key in outcome.run.settings))


def shown_metrics(table: Sequence[Mapping[str, Any]], sort: str) -> list[str]:
    """Names of the metrics in the table that any run has, the one by which it is sorted first."""
    from ..evaluation import Shown, shown

    names = [metric.name for metric in shown(Shown.BATCH)]
    had = {name for row in table for name in row}
    return list(dict.fromkeys([sort, *(name for name in names if name in had)]))


def table_json(table: Sequence[Mapping[str, Any]], results: "ResultStore") -> str:
    """The whole table as one JSON object."""
    counts = Counter(row["result"] for row in table)
    return one_json(
        {"folder": results.where(), "runs": len(table), "results": dict(counts), "table": table}
    )


def table_text(
    table: Sequence[Mapping[str, Any]],
    settings: Sequence[str],
    sort: str,
    top: int,
    results: "ResultStore",
) -> str:
    """The first rows, counts, and where everything is."""
    from ..batch import METRIC_COLUMNS

    swept = [key for key in settings if len({repr(row.get(key)) for row in table}) > 1]
    metrics = [METRIC_COLUMNS[name] for name in shown_metrics(table, sort)[:4]]
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


def end(outcomes: "Sequence[Outcome]", *, stopped: bool) -> None:
    """Say what was found; raises Exit(1) if anything was."""
    findings = [line for outcome in outcomes for line in _findings(outcome)]
    for line in findings[:_SHOWN_FINDINGS]:
        say(line)
    if len(findings) > _SHOWN_FINDINGS:
        say(f"and {len(findings) - _SHOWN_FINDINGS} more; summary.csv has all")
    left = sum(outcome.result is None or not outcome.result.final for outcome in outcomes)
    if left:
        again = f"not done; the same command flies {'it' if left == 1 else 'them'}"
        say(f"{'stopped: ' if stopped else ''}{_runs(left)} {again}")
    if findings or left:
        raise typer.Exit(1)


def _findings(outcome: "Outcome") -> list[str]:
    result = outcome.result
    if result is None or result.clean:
        return []
    failed = [f"{result.id}: {result.result}: {result.reason}"] if result.result != "ok" else []
    return failed + [f"{result.id}: {violation}" for violation in result.evaluation.violations]
