"""A table of runs for the overview: a row for each, with bars under its figures and links."""

from collections.abc import Collection, Mapping, Sequence
from math import isfinite
from urllib.parse import quote

from ..evaluation.units import is_number
from ..printable import html_text
from .column import Column
from .table import Row

_TEXTS = ("vehicle", "method", "platform", "result", "reason")
_MANY = 10  # columns; with more the letters are smaller


def html_table(
    rows: Sequence[Row],
    columns: Mapping[str, Column],
    files: Collection[str],
    scales: Mapping[str, tuple[float, float]] | None = None,
    sorted_by: str = "",
) -> str:
    """The table as HTML; `page_assets.SCRIPT` sorts it by a click on a head.

    rows: the runs, in the order shown; columns: by name; files: names of the files beside the page,
    to which a row links; scales: least and largest value of each column whose values get a bar;
    sorted_by: name of the column by which `rows` are sorted.
    """
    body = "\n".join(_line(row, columns, scales or {}, files) for row in rows)
    cells = "".join(_head(name, column, name == sorted_by) for name, column in columns.items())
    cells += '<th class="text"><span>links</span></th>'
    dense = ' class="dense"' if len(columns) > _MANY else ""
    return f"<table{dense}><thead><tr>{cells}</tr></thead><tbody>\n{body}\n</tbody></table>"


def value_range(rows: Sequence[Row], name: str) -> tuple[float, float]:
    """Least and largest of a column's finite numbers; zeros for none."""
    found = [row[name] for row in rows if is_number(row.get(name))]
    return min(found, default=0.0), max(found, default=0.0)


def _head(name: str, column: Column, is_sorted: bool) -> str:
    order = " aria-sort=ascending" if is_sorted else ""
    unit = f"<small>{html_text(column.unit)}</small>" if column.unit else ""
    words = f"<span>{html_text(column.words)}</span>{unit}"
    return f'<th class="{_kind(name)}" title="{html_text(column.tip)}"{order}>{words}</th>'


def _line(
    row: Row,
    columns: Mapping[str, Column],
    scales: Mapping[str, tuple[float, float]],
    files: Collection[str],
) -> str:
    bad = "" if row["result"] == "ok" and not row.get("violations") else ' class="bad"'
    cells = "".join(
        _run(row) if name == "run" else _cell(row, name, column, scales)
        for name, column in columns.items()
    )
    return f'<tr{bad}>{cells}<td class="text">{_links(row, files)}</td></tr>'


def _run(row: Row) -> str:
    """Scenario, method and the end of the id, whose beginning says the same."""
    name = html_text(f"{row['scenario']} · {row['method']}")
    run, end = html_text(row["run"]), html_text(str(row["run"]).rpartition("-")[2])
    return f'<td class="run" data-v="{name}" title="{run}">{name}<small>{end}</small></td>'


def _cell(row: Row, name: str, column: Column, scales: Mapping[str, tuple[float, float]]) -> str:
    value = row.get(name, "")
    known = not isinstance(value, float) or isfinite(value)
    kind, style = "figure" if name in scales else _kind(name), ""
    if name in scales and is_number(value):
        least, most = scales[name]
        style = (
            f' style="--part:{100.0 * value / most:.0f}%"'
            if 0.0 <= value <= most and most > 0.0
            else ""
        )
        kind += " least" if value == least < most else ""
    shown = html_text(column.cell(value)).replace("_", "_<wbr>")
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
    """The CSS class of a column; texts stand to the left."""
    return f"text {name}" if name in _TEXTS else name if name in ("run", "violations") else ""
