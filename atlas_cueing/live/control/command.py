"""The command to the drives: what the control puts out in every tick."""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from ...rotation import ZERO, Vec3
from ...signals import Motion, Tick
from ...signals.states import Reduced


@dataclass(slots=True, init=False)
class Command:
    """Motion that the drives shall have at `time` (s).

    Each wheel has a speed (rad/s) and an acceleration (rad/s^2). The stage's position (m), velocity
    (m/s) and acceleration (m/s^2) are those of the sphere's centre in W. The angles of the
    wheels (rad) go on for ever, from zero at the start of the run: speed and acceleration are their
    derivatives.
    """

    time: Final[float]
    wheel_speed: Final[Vec3]
    wheel_acceleration: Final[Vec3]
    p_WS_W: Final[Vec3]
    v_WS_W: Final[Vec3]
    a_WS_W: Final[Vec3]
    wheel_angle: Final[Vec3]

    def __init__(
        self,
        time: float,
        wheel_speed: Vec3,
        wheel_acceleration: Vec3,
        p_WS_W: Vec3,
        v_WS_W: Vec3,
        a_WS_W: Vec3,
        wheel_angle: Vec3,
    ) -> None:
        self.time = time
        self.wheel_speed = wheel_speed
        self.wheel_acceleration = wheel_acceleration
        self.p_WS_W = p_WS_W
        self.v_WS_W = v_WS_W
        self.a_WS_W = a_WS_W
        self.wheel_angle = wheel_angle

    def __reduce__(self) -> Reduced:
        """Copy and pickle by the arguments: a compiled class has no other way."""
        stage = self.p_WS_W, self.v_WS_W, self.a_WS_W
        wheels = self.wheel_speed, self.wheel_acceleration
        return Command, (self.time, *wheels, *stage, self.wheel_angle)


def is_still(command: Command) -> bool:
    """Return whether all numbers of a command that are zero at a standstill are so exactly."""
    w1, w2, w3 = command.wheel_speed
    b1, b2, b3 = command.wheel_acceleration
    vx, vy, vz = command.v_WS_W
    ax, ay, az = command.a_WS_W
    turns = w1 or w2 or w3 or b1 or b2 or b3
    return not (turns or vx or vy or vz or ax or ay or az)


def command_of(tick: Tick, wheel_angle: Vec3) -> Command:
    """Return the command that carries out the motion of a tick, with the wheels' angles (rad)."""
    m, wheels = tick.motion, tick.wheels
    return Command(
        m.time, wheels.speed, wheels.acceleration, m.p_WS_W, m.v_WS_W, m.a_WS_W, wheel_angle
    )


def standstill(motion: Motion, wheel_angle: Vec3) -> Command:
    """Return the command to stand still at the position of `motion` and these angles (rad)."""
    return Command(motion.time, ZERO, ZERO, motion.p_WS_W, ZERO, ZERO, wheel_angle)


def command_from(time: float, axes: Sequence[Vec3]) -> Command:
    """Return the command of six axes, wheels 1 to 3 and the stage's x, y, z.

    Each is (position, speed, acceleration) at `time` (s).
    """
    (q1, w1, b1), (q2, w2, b2), (q3, w3, b3), (px, vx, ax), (py, vy, ay), (pz, vz, az) = axes
    speed, acceleration, p, v, a = (
        (w1, w2, w3),
        (b1, b2, b3),
        (px, py, pz),
        (vx, vy, vz),
        (ax, ay, az),
    )
    return Command(time, speed, acceleration, p, v, a, (q1, q2, q3))


def axes_of(command: Command) -> list[Vec3]:
    """Return position, speed and acceleration of the six axes, as `command_from` takes them."""
    q1, q2, q3 = command.wheel_angle
    w1, w2, w3 = command.wheel_speed
    b1, b2, b3 = command.wheel_acceleration
    px, py, pz = command.p_WS_W
    vx, vy, vz = command.v_WS_W
    ax, ay, az = command.a_WS_W
    wheels = (q1, w1, b1), (q2, w2, b2), (q3, w3, b3)
    return [*wheels, (px, vx, ax), (py, vy, ay), (pz, vz, az)]
