"""The files that `batch` writes beside its logs: table, overview, and reviews."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from ..errors import LogError, MissingExtraError
from .batch_summary import shown_metrics, swept_settings
from .text import say

if TYPE_CHECKING:
    from ..batch import Outcome, ResultStore


def write_table(
    outcomes: "Sequence[Outcome]", results: "ResultStore", sort: str
) -> list[Mapping[str, Any]]:
    """Table and overview, also of a batch that was stopped; gives the table."""
    from ..batch import csv_of, ordered, overview, rows
    from ..batch.store import INDEX, SUMMARY

    table = ordered(rows(outcomes), sort)
    results.write(SUMMARY, csv_of(table).encode(errors="replace"))
    page = overview(
        table, swept_settings(outcomes), shown_metrics(table, sort), results.title, results.names()
    )
    results.write(INDEX, page.encode(errors="replace"))
    return table


def write_reviews(outcomes: "Sequence[Outcome]", results: "ResultStore") -> None:
    """The review of each complete log that has none yet, beside it."""
    from ..review import review_log
    from ..review.report import write_page

    there = results.names()
    for result in (outcome.result for outcome in outcomes if outcome.result):
        log = str(result.log or "")
        if not log.endswith(".mcap") or f"{result.id}.html" in there:
            continue
        with TemporaryDirectory(prefix="atlas_cueing_") as scratch:
            page = Path(scratch) / "page.html"
            try:
                write_page(review_log(results.fetch(log, Path(scratch))), page)
            except LogError as error:
                say(f"{result.id}: no review: {error}")
            else:
                results.write(f"{result.id}.html", page.read_bytes())


def check_plotly() -> None:
    """Raise MissingExtraError where reviews cannot be drawn."""
    from importlib.util import find_spec

    if find_spec("plotly") is None:
        raise MissingExtraError("--pages", "plotly", "report")
