"""`atlas-cueing live`: the pipeline against the clock."""

from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from ..errors import InputError
from .options import AsJson, Force, NewLog, ScenarioFile, Settings, TrustModels

if TYPE_CHECKING:
    from ..scenario import Scenario

EPILOG = """
Examples:

  atlas-cueing live scenarios/t37_spin.toml --view

  atlas-cueing live scenarios/f16_rolls.toml --rate 1000 --priority --duration 60 --json

  atlas-cueing live scenarios/live/flightgear.toml --setpoints 127.0.0.1:5600 --foxglove 8765

  atlas-cueing live scenarios/f16_rolls.toml --setpoints 127.0.0.1:5600 --from f16_rolls.mcap
  atlas-cueing live scenarios/live/packets.toml --listen 192.168.1.2 --set vehicle.key_file=key

Ctrl-C, SIGTERM or a terminal that hangs up parks the platform and finishes the log; a second one
stops it at once. This is not a safety device: emergency stop and the monitoring of speed and
position belong to hardware.
"""


Rate: TypeAlias = Annotated[
    float, typer.Option("--rate", help="Ticks a second, 100 to 1000.", metavar="HZ")
]
Duration: TypeAlias = Annotated[
    float | None,
    typer.Option(
        "--duration",
        help="Park after so many seconds; by default when the flight is over.",
        metavar="S",
        min=0.0,
    ),
]
Lead: TypeAlias = Annotated[
    float,
    typer.Option(
        "--lead",
        help="Send set points so much ahead of a tick's end; it bears such lateness. 2 to 80.",
        metavar="MS",
    ),
]
View: TypeAlias = Annotated[
    bool, typer.Option("--view", help="Serve a 3D view with buttons on the loopback (extra: live).")
]
Port: TypeAlias = Annotated[
    int,
    typer.Option(
        "--port", help="Port of the view; 0 for any free one.", metavar="PORT", min=0, max=65535
    ),
]
Wait: TypeAlias = Annotated[
    bool, typer.Option("--wait", help="Stay parked until 'engage' is pressed in the view.")
]
SetPoints: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--setpoints", help="Send set points to a drive controller by UDP.", metavar="HOST:PORT"
    ),
]
KeyFile: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "--key",
        help="File with a shared key for set points; needed beyond the loopback.",
        metavar="FILE",
    ),
]
DriveStatus: TypeAlias = Annotated[
    bool,
    typer.Option(
        "--no-drive-status",
        help="The receiver of set points tells nothing: it is not asked, and not watched.",
    ),
]
DriveTimeout: TypeAlias = Annotated[
    float,
    typer.Option(
        "--drive-timeout",
        help="Stop when the drives are silent for so long while they move. 30 to 1000.",
        metavar="MS",
    ),
]
PoseFile: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "--pose",
        help="File with the platform's last pose, with --setpoints; by default"
        " $XDG_STATE_HOME/atlas_cueing/pose.json.",
        metavar="FILE",
    ),
]
From: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--from",
        help="Where the platform stands: home, a file with a pose, or the log of the last run.",
        metavar="home|POSE|LOG",
    ),
]
Foxglove: TypeAlias = Annotated[
    int | None,
    typer.Option(
        "--foxglove",
        help="Serve Foxglove at this port of the loopback (extra: foxglove).",
        metavar="PORT",
        min=0,
        max=65535,
    ),
]
Listen: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--listen",
        help="Take packets of other machines, too, that come to this address; 0.0.0.0 for all.",
        metavar="ADDRESS",
    ),
]
Priority: TypeAlias = Annotated[
    bool,
    typer.Option(
        "--priority",
        help="Ask for real-time priority, locked memory and a core; report what is refused.",
    ),
]


def live_command(
    scenario: ScenarioFile,
    output: NewLog = None,
    rate: Rate = 500.0,
    duration: Duration = None,
    view: View = False,
    port: Port = 8080,
    wait: Wait = False,
    setpoints: SetPoints = None,
    key: KeyFile = None,
    lead: Lead = 8.0,
    no_drive_status: DriveStatus = False,
    drive_timeout: DriveTimeout = 50.0,
    pose: PoseFile = None,
    from_: From = None,
    foxglove: Foxglove = None,
    listen: Listen = None,
    priority: Priority = False,
    settings: Settings = None,
    trust_models: TrustModels = False,
    as_json: AsJson = False,
    force: Force = False,
) -> None:
    """Fly a scenario in real time: set points to the drives, a log, a view.

    It engages by itself after a second of good input, blends to the cue, and parks when the flight
    is over. With --view it can be held, parked and engaged by buttons, and a fault waits for a
    reset; without, a fault ends the run, but one with --setpoints does not leave anybody: it goes
    slowly home when lateness was all, and else stands there until it is asked to end. Commands come
    on stdin, too, and by `atlas-cueing operate`: engage, hold, park, reset, stop, state.

    Exit status 0: flown and parked, every limit kept. 1: a fault, or the vehicle or its input
    failed; the log is complete. 2: bad input, nothing was written.
    """
    from ..live import LiveOptions, LiveSession
    from ..run import StopRequest, check_output
    from ..scenario import load_scenario
    from .live_extras import drives, followers, start
    from .summary import end, run_summary
    from .text import one_json

    if wait and not view:
        raise InputError("--wait needs --view, where 'engage' can be pressed")
    loaded = load_scenario(scenario, settings or (), trust_models=trust_models)
    inputs = [scenario, *loaded.inputs(), *([key] if key else [])]
    log = output or Path(f"{loaded.name}.mcap")
    log = check_output(log, inputs=inputs, force=force, fresh=True)
    stands, pose_file = start(setpoints, pose, from_, loaded)
    options = LiveOptions(
        rate,
        _duration(duration, loaded),
        attended=view,
        engage=not wait,
        priority=priority,
        lead=1e-3 * lead,
        drive_timeout=1e-3 * drive_timeout,
        listen=listen,
        pose=stands,
        pose_file=pose_file,
    )
    session = LiveSession(loaded, log, options)
    tell = not as_json or setpoints is not None  # somebody may sit in it
    with StopRequest(interrupt=False) as stop:
        with (
            followers(session, loaded, port if view else None, foxglove, tell=tell),
            drives(setpoints, key, loaded, listen=not no_drive_status) as (senders, feedback),
        ):
            result = session.run(senders, lambda: stop.count, feedback)
        typer.echo(one_json(result.to_json()) if as_json else run_summary(result))
    end(result)


def _duration(asked: float | None, loaded: "Scenario") -> float:
    """Return the duration of the run, s: by the option, or else by the scenario.

    The scenario's holds only for a source without an end of its own.
    """
    if asked is not None:
        return asked
    endless = bool(loaded.live_flight.live_only) and not loaded.live_flight.ends_itself
    return loaded.file.duration_s if endless and loaded.file.duration_s is not None else inf
