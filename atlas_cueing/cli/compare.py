"""`atlas-cueing compare`: several logs of one flight side by side."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..printable import printable
from .options import AsJson, Figure
from .text import FIGURES

if TYPE_CHECKING:
    from ..review import Comparison

EPILOG = (
    """
Examples:

  atlas-cueing compare blend.mcap attitude.mcap

  atlas-cueing compare blend.mcap attitude.mcap --html both.html

  atlas-cueing compare still.mcap hedge.mcap force.mcap --figure rides.pdf
"""
    + FIGURES
)

_LONGEST_NAME = 16  # characters of a column's head


def compare_command(
    logs: Annotated[
        list[Path], typer.Argument(help="Two or more logs (MCAP) of one flight.", metavar="LOG")
    ],
    html: Annotated[
        Path | None,
        typer.Option(
            "--html", metavar="FILE", help="Write overlaid plots into one file for a browser."
        ),
    ] = None,
    figure: Figure = None,
    different_flights: Annotated[
        bool,
        typer.Option(
            "--different-flights", help="Compare although the vehicle did not fly the same in all."
        ),
    ] = False,
    as_json: AsJson = False,
    force: Annotated[
        bool, typer.Option("--force", help="Replace page and figure of an earlier comparison.")
    ] = False,
) -> None:
    """Put several logs of one flight side by side.

    Exit status 0: all are clean. 1: one has a finding or cannot be read. 2: bad usage, or logs of
    different flights.
    """
    from ..review import compare_logs as compared
    from ..review import plant_notes
    from .open_page import check_figure, check_pages
    from .text import one_json, say

    logs = _each_once(logs)
    if html:
        (html,) = check_pages([html], inputs=logs, force=force)
    figure = check_figure(figure, inputs=logs, pages=[html], force=force)
    comparison = compared(logs, different_flights=different_flights)
    if html:
        from ..review.report import write_comparison

        write_comparison(comparison, html)
    if figure:
        from ..review.figures import write_comparison_figure

        write_comparison_figure(comparison, figure)
    typer.echo(one_json(comparison.to_json()) if as_json else comparison_table(comparison))
    for name, each in zip(comparison.names, comparison.reviews, strict=True):
        for note in plant_notes(each.run):
            say(f"{name}: {note}")
    if not comparison.clean:
        for name, each in zip(comparison.names, comparison.reviews, strict=True):
            for finding in each.findings:
                say(f"{name}: {finding}")
        raise typer.Exit(1)


def _each_once(logs: list[Path]) -> list[Path]:
    """The logs without those that are given again, as by `*.mcap still.mcap`; says which."""
    from .text import say

    found: dict[str, Path] = {}
    for log in logs:
        file = os.path.realpath(log)
        if file in found:
            also = f", also as {found[file]}" if found[file] != log else ""
            say(f"{log} is given twice{also}; it is compared once")
        found.setdefault(file, log)
    return list(found.values())


def comparison_table(comparison: "Comparison") -> str:
    """A table with a row for each metric and a column for each log, in units that people read."""
    names = map(printable, comparison.names)
    heads = [
        name if len(name) <= _LONGEST_NAME else f"{name[: _LONGEST_NAME - 2]}.." for name in names
    ]
    rows = [("", heads), ("verdict", [each.verdict for each in comparison.reviews])]
    for metric in comparison.metrics():
        values = [each.metrics.get(metric.name) for each in comparison.reviews]
        rows.append((metric.line, [metric.unit.text(value) for value in values]))
    width = max(len(title) for title, _ in rows)
    return "\n".join(
        f"{title:<{width}}" + "".join(f"  {cell:>{_LONGEST_NAME}}" for cell in cells)
        for title, cells in rows
    )
