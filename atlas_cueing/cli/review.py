"""`atlas-cueing review`: a log judged by its own numbers."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import InputError, LogError
from .options import AsJson, Port
from .text import FIGURES

if TYPE_CHECKING:
    from ..recording import Log
    from ..review import Review

EPILOG = (
    """
Examples:

  atlas-cueing review f16_rolls.mcap

  atlas-cueing review f16_rolls.mcap --html f16_rolls.html --replay f16_rolls_3d.html

  atlas-cueing review f16_rolls.mcap --view

  atlas-cueing review f16_rolls.mcap --json
"""
    + FIGURES
)

_SHOWN = 20  # findings printed; --json has all


def review_command(
    log: Annotated[Path, typer.Argument(help="Log (MCAP) of atlas-cueing.", metavar="LOG")],
    html: Annotated[
        Path | None,
        typer.Option(
            "--html", metavar="FILE", help="Write plots of everything into one file for a browser."
        ),
    ] = None,
    replay: Annotated[
        Path | None,
        typer.Option(
            "--replay", metavar="FILE", help="Write a 3D replay into one file for a browser."
        ),
    ] = None,
    view: Annotated[
        bool,
        typer.Option("--view", help="Show the flight in a browser until Ctrl-C, with a play bar."),
    ] = False,
    port: Port = 8080,
    as_json: AsJson = False,
    force: Annotated[
        bool, typer.Option("--force", help="Replace pages of earlier reviews.")
    ] = False,
) -> None:
    """Judge a log by its own numbers.

    Looked at are every limit, wheels against motion, orientation, felt force, time, and the states
    of the run. A flight alone, as one that was imported, is judged by whether it can be flown.

    Exit status 0: nothing was found. 1: a finding, or the log is damaged or not one of ours. 2: bad
        usage.
    """
    from ..review import advice, is_flight_alone, judge, open_log, run_of
    from .open_page import check_pages
    from .text import one_json

    if html or replay:
        html, replay = check_pages([html, replay], inputs=[log], force=force)
    try:
        opened = open_log(log)
        if is_flight_alone(opened):
            _end_flight(opened, as_json, pages=bool(html or replay or view))
            return
        found = judge(run_of(opened))
    except LogError as error:
        if as_json:
            typer.echo(
                one_json(
                    {"verdict": "unreadable", "result": "", "reason": str(error), "log": str(log)}
                )
            )
        todo = advice(log)
        raise LogError(f"{error}; {todo}" if todo else str(error)) from error
    if html:
        from ..review.report import write_page

        write_page(found, html)
    if replay:
        from ..viewer import write_replay

        write_replay(found.run.platform, found.run.flight, replay)
    typer.echo(one_json(found.to_json()) if as_json else review_summary(found))
    if view:
        from ..viewer import play

        title = found.run.log.metadata.get("scenario", "") or log.stem
        play(found.run.platform, found.run.flight, _say_address, port=port, title=title)
    if not found.clean:
        raise typer.Exit(1)


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
