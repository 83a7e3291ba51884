"""The table for people and the JSON for programs."""

from collections.abc import Mapping, Sequence
from os import getloadavg
from typing import Any

from rich.console import Console
from rich.table import Table

from atlas_cueing.cli.text import one_json

from .machine import described
from .rows import Row

_WIDTH = 170  # columns, where there is no terminal to ask
_COLOURS = {"met": "green", "short": "red"}
FOOT = (
    "Figures are medians of interleaved rounds. CPU is process_time, which others on the machine"
    " change less than wall time.\nStages and recording are CPU: means over whole flights, no clock"
    " between ticks; their median and p99.9 are wall times by\na clock around each tick. A tick of"
    " a run is what a long flight takes more than a short one, so start-up is not in it."
)


def print_table(
    rows: Sequence[Row],
    facts: Mapping[str, object],
    stolen: float | None,
    console: Console | None = None,
) -> None:
    """Print it, with what it was measured on."""
    console = console or Console(soft_wrap=False)
    if not console.is_terminal:
        console.width = _WIDTH
    table = Table()
    for head, justify in (
        ("what", "left"),
        ("measured", "right"),
        ("reference", "right"),
        ("ratio", "right"),
        ("asked", "right"),
    ):
        table.add_column(head, justify=justify)
    table.add_column("")
    table.add_column("note", ratio=1)
    for before, row in zip((None, *rows), rows, strict=False):
        if before and before.section != row.section:
            table.add_section()
        table.add_row(*_cells(row))
    console.print(f"code: {facts['code']}", highlight=False)
    console.print(table)
    console.print(FOOT, highlight=False)
    taken = "" if stolen is None else f", {stolen:.0%} of the processors taken away by the host"
    console.print(
        f"{described(facts)}\nmeanwhile: load average {getloadavg()[0]:.1f}{taken}", highlight=False
    )


def _cells(row: Row) -> list[str]:
    reference = (
        f"{row.reference} {_number(row.reference_value)}".strip()
        if row.reference_value is not None
        else ""
    )
    asked = row.asked.text(row.unit) if row.asked else ""
    verdict = f"[{_COLOURS[row.verdict]}]{row.verdict}[/]" if row.verdict else ""
    ratio = f"{row.ratio:.2f}" if row.ratio is not None else ""
    return [
        row.what,
        f"{_number(row.value)} {row.unit}",
        reference,
        ratio,
        asked,
        verdict,
        row.note,
    ]


def _number(value: float) -> str:
    """Three digits or so."""
    return f"{value:.0f}" if abs(value) >= 100.0 else f"{value:.3g}"


def to_json(
    rows: Sequence[Row], facts: Mapping[str, object], stolen: float | None, effort: Any
) -> str:
    """One object: facts, effort, every row with its samples."""
    return one_json(
        {**facts, "stolen_share": stolen, "effort": effort, "rows": [row.to_json() for row in rows]}
    )
