"""What is known at one tick, stage by stage.

All fields are floats or tuples of floats, SI and rad, with the frame in the name: `q_WS` turns
S-vectors into W-vectors, `w_WS_W` is the angular velocity of S in W expressed in W (the paper's
Omega). `Cue` is what is asked and `Motion` what is allowed: only smoothing makes a Motion, and
wheels take nothing else.

These are made anew every tick, so each has a plain `__init__`: a frozen dataclass takes 2.5 times
as long, and 25 times where the code is compiled. `Final` keeps them as they are (for the type
checker, and at run time where compiled).
"""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from ..rotation import Quat, Vec3

if TYPE_CHECKING:
    from ..rotations import Array

Numbers: TypeAlias = "Sequence[float] | Array"
Reduced: TypeAlias = tuple[Any, tuple[Any, ...]]


def _four(q: Numbers) -> Quat:
    """Give a quaternion as a tuple of floats; of a model it is one already."""
    if isinstance(q, tuple) and len(q) == 4:
        return q
    w, x, y, z = q
    return (float(w), float(x), float(y), float(z))


def _three(v: Numbers) -> Vec3:
    """Give a vector as a tuple of floats."""
    if isinstance(v, tuple) and len(v) == 3:
        return v
    x, y, z = v
    return (float(x), float(y), float(z))


@dataclass(slots=True, init=False)
class VehicleState:
    """The vehicle at `time` (s).

    q_NB: attitude; w_NB_B: body rates, rad/s, FRD; f_B: specific force at the pilot's eye, m/s^2,
    FRD.

    The force is scaled by standard gravity over local gravity, so that a vehicle at rest shows
    (0, 0, -9.80665) anywhere. Vectors may be given as tuples, lists or arrays.

    Example:
        >>> from atlas_cueing import VehicleState
        >>> VehicleState(0.0, [1, 0, 0, 0], [0, 0, 0.1], [0, 0, -9.80665]).w_NB_B
        (0.0, 0.0, 0.1)

    """

    time: Final[float]
    q_NB: Final[Quat]
    w_NB_B: Final[Vec3]
    f_B: Final[Vec3]

    def __init__(self, time: float, q_NB: Numbers, w_NB_B: Numbers, f_B: Numbers) -> None:
        self.time = time
        self.q_NB = _four(q_NB)
        self.w_NB_B = _three(w_NB_B)
        self.f_B = _three(f_B)

    def __reduce__(self) -> Reduced:
        """Copy and pickle by the arguments: a compiled class has no other way."""
        return VehicleState, (self.time, self.q_NB, self.w_NB_B, self.f_B)


@dataclass(slots=True, init=False)
class Cue:
    """Motion asked of the platform at `time` (s).

    q_WS and w_WS_W: the sphere's orientation and rate; p_WS_W, v_WS_W, a_WS_W: position, velocity
    and acceleration of the stage.
    """

    time: Final[float]
    q_WS: Final[Quat]
    w_WS_W: Final[Vec3]
    p_WS_W: Final[Vec3]
    v_WS_W: Final[Vec3]
    a_WS_W: Final[Vec3]

    def __init__(
        self, time: float, q_WS: Quat, w_WS_W: Vec3, p_WS_W: Vec3, v_WS_W: Vec3, a_WS_W: Vec3
    ) -> None:
        self.time = time
        self.q_WS = q_WS
        self.w_WS_W = w_WS_W
        self.p_WS_W = p_WS_W
        self.v_WS_W = v_WS_W
        self.a_WS_W = a_WS_W

    def __reduce__(self) -> Reduced:
        """Copy and pickle by the arguments: a compiled class has no other way."""
        return Cue, (self.time, self.q_WS, self.w_WS_W, self.p_WS_W, self.v_WS_W, self.a_WS_W)


@dataclass(slots=True, init=False)
class Motion:
    """Motion allowed at `time`, inside every limit.

    `limited` is (wheels, stage), 1.0 where the cue was not reached.
    """

    time: Final[float]
    q_WS: Final[Quat]
    w_WS_W: Final[Vec3]
    alpha_WS_W: Final[Vec3]
    p_WS_W: Final[Vec3]
    v_WS_W: Final[Vec3]
    a_WS_W: Final[Vec3]
    limited: Final[tuple[float, float]]

    def __init__(
        self,
        time: float,
        q_WS: Quat,
        w_WS_W: Vec3,
        alpha_WS_W: Vec3,
        p_WS_W: Vec3,
        v_WS_W: Vec3,
        a_WS_W: Vec3,
        limited: tuple[float, float],
    ) -> None:
        self.time = time
        self.q_WS = q_WS
        self.w_WS_W = w_WS_W
        self.alpha_WS_W = alpha_WS_W
        self.p_WS_W = p_WS_W
        self.v_WS_W = v_WS_W
        self.a_WS_W = a_WS_W
        self.limited = limited

    def __reduce__(self) -> Reduced:
        """Copy and pickle by the arguments: a compiled class has no other way."""
        return Motion, (
            self.time,
            self.q_WS,
            self.w_WS_W,
            self.alpha_WS_W,
            self.p_WS_W,
            self.v_WS_W,
            self.a_WS_W,
            self.limited,
        )


@dataclass(slots=True, init=False)
class WheelSpeeds:
    """Speed (rad/s) and acceleration (rad/s^2) of each wheel at `time`."""

    time: Final[float]
    speed: Final[Vec3]
    acceleration: Final[Vec3]

    def __init__(self, time: float, speed: Vec3, acceleration: Vec3) -> None:
        self.time = time
        self.speed = speed
        self.acceleration = acceleration

    def __reduce__(self) -> Reduced:
        """Copy and pickle by the arguments: a compiled class has no other way."""
        return WheelSpeeds, (self.time, self.speed, self.acceleration)


@dataclass(slots=True, init=False)
class Tick:
    """Everything about one tick."""

    vehicle: Final[VehicleState]
    cue: Final[Cue]
    motion: Final[Motion]
    wheels: Final[WheelSpeeds]

    def __init__(
        self, vehicle: VehicleState, cue: Cue, motion: Motion, wheels: WheelSpeeds
    ) -> None:
        self.vehicle = vehicle
        self.cue = cue
        self.motion = motion
        self.wheels = wheels

    def __reduce__(self) -> Reduced:
        """Copy and pickle by the arguments: a compiled class has no other way."""
        return Tick, (self.vehicle, self.cue, self.motion, self.wheels)


@dataclass(slots=True, init=False)
class Timing:
    """How one tick of the real-time loop went; all in s but the last four.

    time: as in the other parts of the tick.
    elapsed: real time from the start of the loop to the tick's deadline.
    lateness: from the deadline to the beginning of the tick.
    cost: from there to the set point being sent.
    input_age: of the newest good sample of the vehicle.
    missed: deadlines missed up to now.
    state: place in `topics.LIVE_STATES`.
    wheel_difference, stage_difference: largest difference up to now between a commanded wheel angle
        (rad) or position of the stage (m) and the last that was sent.
    """

    time: Final[float]
    elapsed: Final[float]
    lateness: Final[float]
    cost: Final[float]
    input_age: Final[float]
    missed: Final[float]
    state: Final[float]
    wheel_difference: Final[float]
    stage_difference: Final[float]

    def __init__(
        self,
        time: float,
        elapsed: float,
        lateness: float,
        cost: float,
        input_age: float,
        missed: float,
        state: float,
        wheel_difference: float = 0.0,
        stage_difference: float = 0.0,
    ) -> None:
        self.time = time
        self.elapsed = elapsed
        self.lateness = lateness
        self.cost = cost
        self.input_age = input_age
        self.missed = missed
        self.state = state
        self.wheel_difference = wheel_difference
        self.stage_difference = stage_difference

    def __reduce__(self) -> Reduced:
        """Copy and pickle by the arguments: a compiled class has no other way."""
        return Timing, (
            self.time,
            self.elapsed,
            self.lateness,
            self.cost,
            self.input_age,
            self.missed,
            self.state,
            self.wheel_difference,
            self.stage_difference,
        )
