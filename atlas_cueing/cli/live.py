"""`atlas-cueing live`: the pipeline against the clock."""

from math import inf, radians
from typing import TYPE_CHECKING, NamedTuple

from ..errors import InputError
from .live_options import (
    DriveStatus,
    DriveTimeout,
    DriveTolerance,
    Duration,
    Feedback,
    Foxglove,
    From,
    KeyFile,
    Lead,
    Listen,
    Plant,
    PoseFile,
    Priority,
    Rate,
    SetPoints,
    View,
    Wait,
)
from .options import AsJson, Force, NewLog, Port, ScenarioFile, Settings, TrustModels

if TYPE_CHECKING:
    from ..scenario import Scenario

EPILOG = """
Examples:

  atlas-cueing live scenarios/t37_spin.toml --view

  atlas-cueing live scenarios/f16_rolls.toml --rate 1000 --priority --duration 60 --json

  atlas-cueing live scenarios/live/flightgear.toml --setpoints 127.0.0.1:5600 --foxglove 8765

  atlas-cueing live scenarios/f16_rolls.toml --setpoints 127.0.0.1:5600 --from f16_rolls.mcap

  atlas-cueing live scenarios/f16_rolls.toml --plant --feedback fix

  atlas-cueing live scenarios/live/packets.toml --listen 192.168.1.2 --set vehicle.key_file=key

Ctrl-C, SIGTERM or a terminal that hangs up parks the platform and finishes the log; a second one
stops it at once. This is not a safety device: emergency stop and the monitoring of speed and
position belong to hardware.
"""


class _Watch(NamedTuple):
    """By default: how long drives may be silent, and how far a wheel may be off its command."""

    timeout_ms: float
    tolerance_deg: float


# a plant's servos lag, and its process may be held up by the machine (assumed)
_REAL, _PLANT = _Watch(50.0, 0.1), _Watch(300.0, 10.0)


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
    drive_timeout: DriveTimeout = None,
    drive_tolerance: DriveTolerance = None,
    feedback: Feedback = "none",
    plant: Plant = False,
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
    from ..live import LiveOptions
    from .live_plant import check_feedback
    from .live_ride import DriveLink, Pages, fly, open_scenario

    if wait and not view:
        raise InputError("--wait needs --view, where 'engage' can be pressed")
    link = DriveLink(setpoints, key, not no_drive_status, pose, from_, plant)
    check_feedback(feedback, link)
    loaded, log = open_scenario(scenario, output, settings, key, trust_models, force)
    watch = _PLANT if plant else _REAL
    options = LiveOptions(
        *(rate, _duration(duration, loaded), view, not wait, priority),
        lead=1e-3 * lead,
        drive_timeout=1e-3 * (drive_timeout or watch.timeout_ms),
        drive_tolerance=radians(drive_tolerance or watch.tolerance_deg),
        feedback=feedback,
        occupied=not plant,
        listen=listen,
    )
    pages = Pages(port if view else None, foxglove)
    fly(loaded, log, options, link, pages, as_json=as_json)


def _duration(asked: float | None, loaded: "Scenario") -> float:
    """Return the duration of the run, s: by the option, or else by the scenario.

    The scenario's holds only for a source without an end of its own.
    """
    if asked is not None:
        return asked
    endless = bool(loaded.live_flight.live_only) and not loaded.live_flight.ends_itself
    return loaded.file.duration_s if endless and loaded.file.duration_s is not None else inf
