"""One live ride by the command's options: everything opened, flown, told, and closed."""

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from .live_extras import DriveLink as DriveLink
from .live_extras import Pages as Pages
from .live_extras import drives, followers, standing
from .live_plant import simulated
from .text import say

if TYPE_CHECKING:
    from ..live import LiveOptions
    from ..run import RunResult, StopRequest
    from ..scenario import Scenario


def open_scenario(
    scenario: Path,
    output: Path | None,
    settings: Sequence[str] | None,
    key: Path | None,
    trust_models: bool,
    force: bool,
) -> tuple["Scenario", Path]:
    """Return the scenario and the log to write, which is none of the files that are read."""
    from ..run import check_output
    from ..scenario import load_scenario

    loaded = load_scenario(scenario, settings or (), trust_models=trust_models)
    inputs = [scenario, *loaded.inputs(), *([key] if key else [])]
    log = output or Path(f"{loaded.name}.mcap")
    return loaded, check_output(log, inputs=inputs, force=force, fresh=True)


def fly(
    scenario: "Scenario",
    log: Path,
    options: "LiveOptions",
    link: DriveLink,
    pages: Pages,
    *,
    as_json: bool,
) -> None:
    """Fly, print the result, and end with its exit status, whatever signals come after the ride."""
    from ..run import StopRequest
    from .summary import end, run_summary
    from .text import one_json

    tell = not as_json or link.address is not None  # somebody may sit in it
    with StopRequest(interrupt=False) as stop:
        result = _flown(scenario, log, options, link, pages, stop, tell=tell)
        stop.finish()
        typer.echo(one_json(result.to_json()) if as_json else run_summary(result))
        end(result)


def _flown(
    scenario: "Scenario",
    log: Path,
    options: "LiveOptions",
    link: DriveLink,
    pages: Pages,
    stop: "StopRequest",
    *,
    tell: bool,
) -> "RunResult":
    """Open what may be refused, tell where everything is, and fly."""
    from ..live import LiveSession

    with ExitStack() as stack:
        pose, file = stack.enter_context(standing(link, scenario))
        link, with_plant = stack.enter_context(simulated(link, scenario, priority=options.priority))
        senders, feedback = stack.enter_context(drives(link, scenario))
        session = LiveSession(scenario, log, replace(options, pose=pose, pose_file=file))
        lines = stack.enter_context(followers(session, scenario, pages, tell=tell))
        if not pose.is_home:
            say(f"starts stopped, {pose}; a reset brings it slowly home")
        for line in lines:
            say(line)
        return with_plant(session.run(senders, lambda: stop.count, feedback))
