"""`atlas-cueing live`: the pipeline against the clock."""

from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import InputError
from .text import TRUST_MODELS

if TYPE_CHECKING:
    from ..scenario import Scenario

EPILOG = """
Examples:

  atlas-cueing live scenarios/t37_spin.toml --view

  atlas-cueing live scenarios/f16_rolls.toml --rate 1000 --priority --duration 60 --json

  atlas-cueing live scenarios/live/flightgear.toml --setpoints 127.0.0.1:5600 --foxglove 8765

Ctrl-C or SIGTERM parks the platform and finishes the log; a second one stops it at once. This program is not a safety device:
emergency stop and the monitoring of speed and position belong to hardware.
"""


def live(
    scenario: Annotated[Path, typer.Argument(help="Scenario file (TOML).", metavar="SCENARIO")],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Log to write; by default ./NAME.mcap with the scenario's name.")
    ] = None,
    rate: Annotated[float, typer.Option("--rate", help="Ticks a second, 100 to 1000.", metavar="HZ")] = 500.0,
    duration: Annotated[
        float | None,
        typer.Option("--duration", help="Park after so many seconds; by default when the flight is over.", min=0.0),
    ] = None,
    view: Annotated[bool, typer.Option("--view", help="Serve a 3D view with buttons on the loopback (extra: live).")] = False,
    port: Annotated[int, typer.Option("--port", help="Port of the view; 0 for any free one.", min=0, max=65535)] = 8080,
    wait: Annotated[bool, typer.Option("--wait", help="Stay parked until 'engage' is pressed in the view.")] = False,
    setpoints: Annotated[
        str | None, typer.Option("--setpoints", help="Send set points to a drive controller by UDP.", metavar="HOST:PORT")
    ] = None,
    key: Annotated[
        Path | None, typer.Option("--key", help="File with a shared key for set points; needed beyond the loopback.")
    ] = None,
    foxglove: Annotated[
        int | None,
        typer.Option("--foxglove", help="Serve Foxglove at this port of the loopback (extra: foxglove).", metavar="PORT"),
    ] = None,
    priority: Annotated[
        bool, typer.Option("--priority", help="Ask for real-time priority, locked memory and a core; tell what is refused.")
    ] = False,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Set any key of the scenario or its platform; repeatable."),
    ] = None,
    trust_models: Annotated[bool, typer.Option("--trust-models", help=TRUST_MODELS)] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace an existing log.")] = False,
) -> None:
    """Fly a scenario in real time: set points to the drives, a log, a view.

    It engages by itself after a second of good input, blends to the cue, and parks when the flight is over. With --view it can
    be held, parked and engaged by buttons, and a fault waits for a reset; without, a fault ends the run.

    Exit status 0: flown and parked, every limit kept. 1: a fault, or the vehicle or its input failed; the log is complete. 2:
    bad input, nothing was written.
    """
    from ..batch import check_output
    from ..live.ending import ending
    from ..live.session import LiveOptions, LiveSession
    from ..scenario import load_scenario
    from .live_extras import drives, followers
    from .summary import live_summary
    from .text import one_json

    if wait and not view:
        raise InputError("--wait needs --view, where 'engage' can be pressed")
    loaded = load_scenario(scenario, settings or (), trust_models=trust_models)
    log = output or Path(f"{loaded.name}.mcap")
    check_output(log, force=force, fresh=True)
    options = LiveOptions(
        rate=rate,
        duration=_duration(duration, loaded),
        attended=view,
        engage=not wait,
        priority=priority,
        announce=not as_json,
    )
    session = LiveSession(loaded, log, options)
    with ending() as signals:
        with followers(session, loaded, port if view else None, foxglove), drives(setpoints, key) as sender:
            result = session.run(sender, signals.asked)
        typer.echo(one_json(result.to_json()) if as_json else live_summary(result))
    if not result.clean:
        for finding in ([f"{result.result}: {result.reason}"] if result.reason else []) + list(result.evaluation.violations):
            typer.echo(finding, err=True)
        raise typer.Exit(1)


def _duration(asked: float | None, loaded: "Scenario") -> float:
    """As asked, or by the scenario where nothing else tells the end of the flight: a vehicle that owns its time ends itself."""
    if asked is not None:
        return asked
    endless = loaded.file.vehicle.source == "flightgear"
    return loaded.file.duration_s if endless and loaded.file.duration_s is not None else inf
