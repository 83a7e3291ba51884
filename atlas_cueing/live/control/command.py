"""The command to the drives: what the control puts out in every tick."""

# mypyc: runs every tick

from dataclasses import dataclass

from ...rotation import ZERO, Vec3
from ...signals import Motion, Tick


@dataclass(frozen=True, slots=True)
class Command:
    """Motion that the drives shall have at `time` (s).

    Each wheel has a speed (rad/s) and an acceleration (rad/s^2). The stage's position (m), velocity
    (m/s) and acceleration (m/s^2) are those of the sphere's centre in W.
    """

    time: float
    wheel_speed: Vec3
    wheel_acceleration: Vec3
    p_WS_W: Vec3
    v_WS_W: Vec3
    a_WS_W: Vec3


def command_of(tick: Tick) -> Command:
    """Return the command that carries out the motion of a tick."""
    m, wheels = tick.motion, tick.wheels
    return Command(m.time, wheels.speed, wheels.acceleration, m.p_WS_W, m.v_WS_W, m.a_WS_W)


def standstill(motion: Motion) -> Command:
    """Return the command to stand still at the position of `motion`."""
    return Command(motion.time, ZERO, ZERO, motion.p_WS_W, ZERO, ZERO)
