"""One page for a browser with all runs of a batch, in one file that needs nothing else."""

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import replace

from ..atomic_file import PAGE_BEGINS
from ..printable import html_text
from .column import Column
from .html_table import html_table, value_range
from .page_assets import SCRIPT, STYLE
from .picture import parameters, picture
from .table import NOT_FLOWN, Row

_OWN = {
    "vehicle.script": "vehicle",
    "vehicle.aircraft": "vehicle",
    "platform.preset": "platform",
    "cueing.method": "method",
}


def overview(
    table: Sequence[Row],
    settings: Sequence[str],
    metrics: Sequence[str],
    title: str,
    files: Collection[str],
) -> str:
    """The page: totals, a heat map of a sweep of two parameters, and tables of all runs.

    One table has the runs that flew to their end, the other the others with their reasons.

    settings: the swept keys, shown where they differ; metrics: names of the metrics shown, of which
    the first, by which `table` is sorted, is also in the heat map; files: names of the files beside
    the page. Every run links to its log, its result and, where there is one, its review (`<run
    id>.html`). Angles are in degrees and shares in percent; a head's tooltip is the name of its
    metric or key, and the metric's definition.
    """
    flown, failed = (
        [row for row in table if (row["result"] == "ok") == ok] for ok in (True, False)
    )
    parts = [
        f"<h1>{html_text(title)}</h1>",
        _totals(table),
        '<p>All figures: <a href="summary.csv">summary.csv</a></p>',
    ]
    parts += [_picture(table, parameters(table, settings), metrics[0])]
    parts += [_flown(flown, settings, metrics, files), _failed(failed, settings, files)]
    return (
        f'{PAGE_BEGINS}<html lang="en"><meta'
        f' charset="utf-8"><title>{html_text(title)}</title><style>{STYLE}</style>'
        f"{''.join(parts)}<script>{SCRIPT}</script></html>\n"
    )


def _totals(table: Sequence[Row]) -> str:
    counts = Counter(row["result"] for row in table)
    good, left = counts["ok"], counts[NOT_FLOWN]
    failed, violations = len(table) - good - left, sum(row.get("violations", 0) for row in table)
    flight = sum(row.get("duration_s", 0.0) for row in table)
    shown = [("runs", str(len(table)), ""), ("ok", str(good), "good" if good else "")]
    shown += [("failed", str(failed), "bad" if failed else "")]
    shown += [("not flown", str(left), "bad")] if left else []
    shown += [
        ("violations", str(violations), "bad" if violations else ""),
        ("of flight", _length(flight), ""),
    ]
    boxes = (
        f'<div class="{mood}"><b>{value}</b><span>{name}</span></div>'
        for name, value, mood in shown
    )
    return f'<div class="totals">{"".join(boxes)}</div>'


def _length(time: float) -> str:
    """A time in s as hours, minutes or seconds, so that the number is small."""
    if time >= 3600.0:
        return f"{time / 3600.0:.1f} h"
    return f"{time / 60.0:.1f} min" if time >= 60.0 else f"{time:.1f} s"


def _picture(table: Sequence[Row], varied: list[str], metric: str) -> str:
    """The heat map of a sweep of two keys; names are easier to read beside it than below it."""
    if len(varied) != 2:
        return ""
    names = {key: {row[key] for row in table if isinstance(row.get(key), str)} for key in varied}
    x, y = sorted(varied, key=lambda key: len(names[key]))
    return picture(table, x, y, metric)


def _flown(
    rows: Sequence[Row], settings: Sequence[str], metrics: Sequence[str], files: Collection[str]
) -> str:
    """The table of the runs that flew to their end."""
    if not rows:
        return ""
    keys, same = _columns(rows, settings)
    counted = ["violations"] if any(row.get("violations") for row in rows) else []
    lengths = {Column.of_metric("duration_s").cell(row.get("duration_s")) for row in rows}
    counted += ["duration_s"] if len(lengths) > 1 else []
    shown = dict.fromkeys([*metrics, *counted])
    heads = {
        "run": Column.of_field("run"),
        **_key_heads(keys),
        **{name: Column.of_metric(name) for name in shown},
    }
    scales = {name: value_range(rows, name) for name in metrics}
    table = html_table(rows, heads, files, scales, sorted_by=metrics[0])
    note = (
        f"{same}Sorted by {heads[metrics[0]].words}; a click on a head sorts by that column. The"
        " least of a figure is bold."
    )
    return f"<h2>Flown to the end</h2><p>{html_text(note)}</p>{table}"


def _failed(rows: Sequence[Row], settings: Sequence[str], files: Collection[str]) -> str:
    """The table of the runs that did not, with their reasons, equal ones together."""
    if not rows:
        return ""
    keys, same = _columns(rows, settings)
    heads = {
        "run": Column.of_field("run"),
        **_key_heads(keys),
        "result": Column.of_field("result"),
        "reason": Column.of_field("reason"),
    }
    ordered = sorted(
        rows,
        key=lambda row: (
            row["result"] == NOT_FLOWN,
            str(row["result"]),
            str(row.get("reason", "")),
        ),
    )
    counts = Counter(str(row["result"]).replace("_", " ") for row in ordered)
    results = ", ".join(f"{count} {result}" for result, count in counts.items())
    table = html_table(ordered, heads, files)
    return f"<h2>Not flown to the end: {html_text(results)}</h2><p>{html_text(same)}</p>{table}"


def _columns(rows: Sequence[Row], settings: Sequence[str]) -> tuple[list[str], str]:
    """Choose the keys that are shown, beside scenario and method.

    Gives the keys in which the runs differ, and a sentence about the others.
    """
    wanted = list(
        dict.fromkeys([*(_OWN.get(key, key) for key in settings), "vehicle", "method", "platform"])
    )
    differ = parameters(rows, wanted)
    same = [
        f"{Column.of_key(key).words} {rows[0][key]}"
        for key in wanted
        if key not in differ and rows[0].get(key, "") != ""
    ]
    sentence = f"{'Same in all: ' if len(rows) > 1 else ''}{', '.join(same)}. " if same else ""
    return [key for key in differ if key != "method" or "cueing.method" in settings], sentence


def _key_heads(keys: Sequence[str]) -> dict[str, Column]:
    """Columns with short heads; the whole key where two heads would be the same."""
    short = {key: Column.of_key(key) for key in keys}
    often = Counter(head.words for head in short.values())
    return {
        key: head if often[head.words] == 1 else replace(head, words=key)
        for key, head in short.items()
    }
