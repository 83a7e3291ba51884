"""`atlas-cueing review`: a log judged by its own numbers."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from ..errors import InputError, LogError
from .options import AsJson, Figure, Port
from .text import FIGURES

if TYPE_CHECKING:
    from ..recording import Log
    from ..review import Review

EPILOG = (
    """
Examples:

  atlas-cueing review f16_rolls.mcap

  atlas-cueing review f16_rolls.mcap --html f16_rolls.html --replay f16_rolls_3d.html

  atlas-cueing review f16_rolls.mcap --figure f16_rolls.pdf

  atlas-cueing review f16_rolls.mcap --view

  atlas-cueing review f16_rolls.mcap --json
"""
    + FIGURES
)

_SHOWN = 20  # findings printed; --json has all


Html: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "--html", metavar="FILE", help="Write plots of everything into one file for a browser."
    ),
]
Replay: TypeAlias = Annotated[
    Path | None,
    typer.Option("--replay", metavar="FILE", help="Write a 3D replay into one file for a browser."),
]
View: TypeAlias = Annotated[
    bool,
    typer.Option("--view", help="Show the flight in a browser until Ctrl-C, with a play bar."),
]


def review_command(
    log: Annotated[Path, typer.Argument(help="Log (MCAP) of atlas-cueing.", metavar="LOG")],
    html: Html = None,
    replay: Replay = None,
    figure: Figure = None,
    view: View = False,
    port: Port = 8080,
    as_json: AsJson = False,
    force: Annotated[
        bool, typer.Option("--force", help="Replace pages and figures of earlier reviews.")
    ] = False,
) -> None:
    """Judge a log by its own numbers.

    Looked at are every limit, wheels against motion, orientation, felt force, time, and the states
    of the run. A flight alone, as one that was imported, is judged by whether it can be flown.

    Exit status 0: nothing was found. 1: a finding, or the log is damaged or not one of ours. 2: bad
    usage.
    """
    from ..review import is_flight_alone, judge, open_log, run_of
    from .open_page import check_figure, check_pages
    from .text import one_json

    html, replay = check_pages([html, replay], inputs=[log], force=force)
    figure = check_figure(figure, inputs=[log], pages=[html, replay], force=force)
    with _told_what_to_do(log, as_json):
        opened = open_log(log)
        alone = is_flight_alone(opened)
        found = None if alone else judge(run_of(opened))
    if found is None:
        _end_flight(opened, as_json, pages=bool(html or replay or view or figure))
        return
    _write(found, html, replay, figure)
    typer.echo(one_json(found.to_json()) if as_json else review_summary(found))
    if view:
        _play(found, port)
    if not found.clean:
        raise typer.Exit(1)


@contextmanager
def _told_what_to_do(log: Path, as_json: bool) -> Iterator[None]:
    """Add to the error of a log that cannot be read what may help; print it as JSON, too."""
    from ..review import advice
    from .text import one_json

    try:
        yield
    except LogError as error:
        if as_json:
            told = {"verdict": "unreadable", "result": "", "reason": str(error), "log": str(log)}
            typer.echo(one_json(told))
        todo = advice(log)
        raise LogError(f"{error}; {todo}" if todo else str(error)) from error


def _write(found: "Review", html: Path | None, replay: Path | None, figure: Path | None) -> None:
    """Write what was asked for, each with what draws it."""
    if html:
        from ..review.report import write_page

        write_page(found, html)
    if replay:
        from ..viewer import write_replay

        write_replay(found.run.platform, found.run.flight, replay)
    if figure:
        from ..review.figures import write_ride_figure

        write_ride_figure(found.run, figure)


def _play(found: "Review", port: int) -> None:
    from ..viewer import play

    log = found.run.log
    title = log.metadata.get("scenario", "") or log.path.stem
    play(found.run.platform, found.run.flight, _say_address, port=port, title=title)


def _end_flight(log: "Log", as_json: bool, *, pages: bool) -> None:
    """Print the review of a flight that nobody has cued, which has no pages."""
    from ..review import review_flight
    from .text import aligned, one_json

    if pages:
        raise InputError(
            f"log {log.path}: holds a flight alone, which has no page; cue it first: atlas-cueing"
            f" recue {log.path} --set platform.preset=NAME -o NEW.mcap"
        )
    found = review_flight(log)
    typer.echo(one_json(found.to_json()) if as_json else "\n".join(aligned(found.rows(), "")))
    if not found.clean:
        raise typer.Exit(1)


def _say_address(url: str) -> None:
    from .text import say

    say(f"view: {url} (end with Ctrl-C)")


def review_summary(found: "Review") -> str:
    """The text printed for a review: verdict, run, headline metrics, notes and findings."""
    from ..evaluation import Shown, shown
    from .text import aligned

    metadata = found.run.log.metadata
    head = [
        ("verdict", found.verdict),
        ("result", f"{metadata.get('result', '')}  {metadata.get('reason', '')}".rstrip()),
        ("log", str(found.run.log.path)),
        (
            "scenario",
            (
                f"{metadata.get('scenario', '')}, {metadata.get('method', '')} on"
                f" {metadata.get('platform', '')}"
            ),
        ),
        (
            "flight",
            (
                f"{found.duration:.2f} s, {len(found.run.flight.time)} ticks, step"
                f" {1e3 * found.run.step:.4f} ms"
            ),
        ),
    ]
    headlines = [
        (metric.line, metric.unit.text(found.metrics[metric.name]))
        for metric in shown(Shown.HEADLINE)
        if metric.name in found.metrics
    ]
    notes = [("note", note) for note in found.notes]
    findings = [("finding", str(finding)) for finding in found.findings[:_SHOWN]]
    lines = aligned([*head, *headlines, *notes, *findings], "")
    left = len(found.findings) - _SHOWN
    return "\n".join([*lines, *([f"and {left} more findings; --json has all"] if left > 0 else [])])
