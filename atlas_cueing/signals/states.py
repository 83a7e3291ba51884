"""What is known at one tick, stage by stage.

All fields are floats or tuples of floats, SI and rad, with the frame in the name: `q_WS` turns S-vectors into W-vectors,
`w_WS_W` is the angular velocity of S in W expressed in W (the paper's Omega). `Cue` is what is asked and `Motion` what is
allowed: only smoothing makes a Motion, and wheels take nothing else.
"""

from dataclasses import dataclass

from ..rotation import Quat, Vec3


@dataclass(frozen=True, slots=True)
class VehicleState:
    """Vehicle at `time` (s): attitude, body rates (rad/s, FRD) and specific force at the pilot's eye (m/s^2, FRD).

    The force is scaled by standard gravity over local gravity, so that a vehicle at rest shows (0, 0, -9.80665) anywhere.
    """

    time: float
    q_NB: Quat
    w_NB_B: Vec3
    f_B: Vec3


@dataclass(frozen=True, slots=True)
class Cue:
    """Motion asked of the platform at `time`: sphere orientation and rate, stage position, velocity and acceleration (W)."""

    time: float
    q_WS: Quat
    w_WS_W: Vec3
    p_WS_W: Vec3
    v_WS_W: Vec3
    a_WS_W: Vec3


@dataclass(frozen=True, slots=True)
class Motion:
    """Motion allowed at `time`, inside every limit; `limited` is (wheels, stage), 1.0 where the cue was not reached."""

    time: float
    q_WS: Quat
    w_WS_W: Vec3
    alpha_WS_W: Vec3
    p_WS_W: Vec3
    v_WS_W: Vec3
    a_WS_W: Vec3
    limited: tuple[float, float]


@dataclass(frozen=True, slots=True)
class WheelSpeeds:
    """Speed (rad/s) and acceleration (rad/s^2) of each wheel at `time`."""

    time: float
    speed: Vec3
    acceleration: Vec3


@dataclass(frozen=True, slots=True)
class Tick:
    """Everything about one tick."""

    vehicle: VehicleState
    cue: Cue
    motion: Motion
    wheels: WheelSpeeds


@dataclass(frozen=True, slots=True)
class Timing:
    """How one tick of the real-time loop went; all in s but the last two.

    time: as in the other parts of the tick.
    elapsed: real time from the start of the loop to the tick's deadline.
    lateness: from the deadline to the beginning of the tick.
    cost: from there to the set point being sent.
    input_age: of the newest good sample of the vehicle.
    missed: deadlines missed up to now.
    state: place in `topics.LIVE_STATES`.
    """

    time: float
    elapsed: float
    lateness: float
    cost: float
    input_age: float
    missed: float
    state: float
