"""All runs of a batch on one page for a browser, without anything from elsewhere."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from math import isfinite
from typing import Any
from urllib.parse import quote

from ..atomic_file import PAGE_BEGINS
from ..printable import html_text
from .heading import Heading, length_of
from .page_assets import SCRIPT, STYLE
from .picture import parameters, picture
from .table import NOT_FLOWN, Row

_OWN = {
    "vehicle.script": "vehicle",
    "vehicle.aircraft": "vehicle",
    "platform.preset": "platform",
    "cueing.method": "method",
}
_TEXTS = ("vehicle", "method", "platform", "result", "reason")
_MANY = 10  # columns; with more the letters are smaller
_Heads = Mapping[str, Heading]


def overview(
    table: Sequence[Row],
    settings: Sequence[str],
    metrics: Sequence[str],
    title: str,
    files: Collection[str],
) -> str:
    """The page: totals, a picture for a sweep of two parameters, a row for each run of `table`, and why others failed.

    settings: the swept keys, shown where they differ; metrics: the figures shown, of which the
    first, that `table` is sorted by, is also in the picture; files: what there is beside the page.
    Every run links to its log, its record and, where there is one, its review (`<run id>.html`).
    Figures are in units for people; a head's tooltip is the name of its metric or key.
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
        ("of flight", length_of(flight), ""),
    ]
    boxes = (
        f'<div class="{mood}"><b>{value}</b><span>{name}</span></div>'
        for name, value, mood in shown
    )
    return f'<div class="totals">{"".join(boxes)}</div>'


def _picture(table: Sequence[Row], varied: list[str], metric: str) -> str:
    """Names are easier to read beside the picture than below it."""
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
    lengths = {Heading.of_metric("duration_s").text(row.get("duration_s")) for row in rows}
    counted += ["duration_s"] if len(lengths) > 1 else []
    shown = dict.fromkeys([*metrics, *counted])
    heads = {
        "run": Heading("run"),
        **_key_heads(keys),
        **{name: Heading.of_metric(name) for name in shown},
    }
    scales = {name: _range(rows, name) for name in metrics}
    body = "\n".join(_line(row, heads, scales, files) for row in rows)
    note = (
        f"{same}Sorted by {heads[metrics[0]].words}; a click on a head sorts by that column. The"
        " least of a figure is bold."
    )
    return (
        "<h2>Flown to the"
        f" end</h2><p>{html_text(note)}</p>{_table(heads, body, sorted_by=metrics[0])}"
    )


def _failed(rows: Sequence[Row], settings: Sequence[str], files: Collection[str]) -> str:
    """The table of those that did not, with their reasons, those of one kind together."""
    if not rows:
        return ""
    keys, same = _columns(rows, settings)
    heads = {
        "run": Heading("run"),
        **_key_heads(keys),
        "result": Heading("result"),
        "reason": Heading("reason"),
    }
    ordered = sorted(
        rows,
        key=lambda row: (
            row["result"] == NOT_FLOWN,
            str(row["result"]),
            str(row.get("reason", "")),
        ),
    )
    body = "\n".join(_line(row, heads, {}, files) for row in ordered)
    counts = Counter(str(row["result"]).replace("_", " ") for row in ordered)
    told = ", ".join(f"{count} {result}" for result, count in counts.items())
    return (
        "<h2>Not flown to the end:"
        f" {html_text(told)}</h2><p>{html_text(same)}</p>{_table(heads, body)}"
    )


def _columns(rows: Sequence[Row], settings: Sequence[str]) -> tuple[list[str], str]:
    """Columns that tell the runs apart beside scenario and method, and a sentence on what all of them share."""
    wanted = list(
        dict.fromkeys([*(_OWN.get(key, key) for key in settings), "vehicle", "method", "platform"])
    )
    differ = parameters(rows, wanted)
    same = [
        f"{Heading.of_key(key).words} {rows[0][key]}"
        for key in wanted
        if key not in differ and rows[0].get(key, "") != ""
    ]
    told = f"{'Same in all: ' if len(rows) > 1 else ''}{', '.join(same)}. " if same else ""
    return [key for key in differ if key != "method" or "cueing.method" in settings], told


def _key_heads(keys: Sequence[str]) -> dict[str, Heading]:
    """Short heads; the whole key where two would be the same."""
    short = {key: Heading.of_key(key) for key in keys}
    often = Counter(head.words for head in short.values())
    return {
        key: head if often[head.words] == 1 else Heading(key, head.unit)
        for key, head in short.items()
    }


def _range(rows: Sequence[Row], name: str) -> tuple[float, float]:
    """Least and largest of a column's numbers; zeros for none."""
    found = [row[name] for row in rows if _number(row.get(name))]
    return min(found, default=0.0), max(found, default=0.0)


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)


def _table(heads: _Heads, body: str, sorted_by: str = "") -> str:
    cells = "".join(
        f'<th class="{_kind(name)}"'
        f' title="{html_text(name)}"{" aria-sort=ascending" if name == sorted_by else ""}>'
        f"<span>{html_text(head.words)}</span>{f'<small>{html_text(head.unit)}</small>' if head.unit else ''}</th>"
        for name, head in heads.items()
    )
    dense = ' class="dense"' if len(heads) > _MANY else ""
    cells += '<th class="text"><span>links</span></th>'
    return f"<table{dense}><thead><tr>{cells}</tr></thead><tbody>\n{body}\n</tbody></table>"


def _line(
    row: Row, heads: _Heads, scales: Mapping[str, tuple[float, float]], files: Collection[str]
) -> str:
    bad = "" if row["result"] == "ok" and not row.get("violations") else ' class="bad"'
    cells = "".join(
        _run(row) if name == "run" else _cell(row, name, head, scales)
        for name, head in heads.items()
    )
    return f'<tr{bad}>{cells}<td class="text">{_links(row, files)}</td></tr>'


def _run(row: Row) -> str:
    """Scenario and method; of the id only its end, for the rest of it says the same."""
    name = html_text(f"{row['scenario']} · {row['method']}")
    run, end = html_text(row["run"]), html_text(str(row["run"]).rpartition("-")[2])
    return f'<td class="run" data-v="{name}" title="{run}">{name}<small>{end}</small></td>'


def _cell(row: Row, name: str, head: Heading, scales: Mapping[str, tuple[float, float]]) -> str:
    value = row.get(name, "")
    known = not isinstance(value, float) or isfinite(value)
    kind, style = "figure" if name in scales else _kind(name), ""
    if name in scales and _number(value):
        least, most = scales[name]
        style = (
            f' style="--part:{100.0 * value / most:.0f}%"'
            if 0.0 <= value <= most and most > 0.0
            else ""
        )
        kind += " least" if value == least < most else ""
    shown = html_text(head.text(value)).replace("_", "_<wbr>")
    return (
        f'<td class="{kind}" data-v="{html_text(str(value)) if known else ""}"{style}>{shown}</td>'
    )


def _links(row: Row, files: Collection[str]) -> str:
    named = {
        "review": f"{row['run']}.html",
        "log": row.get("log", ""),
        "record": f"{row['run']}.json",
    }
    return " ".join(
        f'<a href="{quote(file)}">{title}</a>' for title, file in named.items() if file in files
    )


def _kind(name: str) -> str:
    """Class of a column; names stand to the left."""
    return f"text {name}" if name in _TEXTS else name if name in ("run", "violations") else ""
