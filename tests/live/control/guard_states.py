"""Commands for the guard, axis by axis, and an independent check of its output.

Axes 0 to 2 are the wheels, 3 to 5 the stage's x, y, z; a state is (p, v, a).
"""

from collections.abc import Iterable, Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.rotation import ZERO
from atlas_cueing.signals import StageLimits, WheelLimits

Array = NDArray[np.float64]
State = tuple[float, float, float]

AXES = ("wheel 1", "wheel 2", "wheel 3", "stage x", "stage y", "stage z")
ROUNDING = 1.0 + 5e-7  # the guard's room for rounding
REST: State = (0.0, 0.0, 0.0)
STANDING = Command(0.0, ZERO, ZERO, ZERO, ZERO, ZERO, ZERO)

# Every limit different.
WHEELS = WheelLimits((31.0, 20.0, 25.0), (60.0, 80.0, 50.0), (600.0, 700.0, 450.0))
STAGE = StageLimits((1.0, 0.8, 0.6), (1.5, 1.2, 0.9), (6.0, 5.0, 3.0), (60.0, 40.0, 45.0))


def limits(axis: int) -> tuple[float, float, float, float]:
    """Speed, acceleration, jerk and travel; a wheel's is infinite."""
    if axis < 3:
        return WHEELS.speed[axis], WHEELS.acceleration[axis], WHEELS.jerk[axis], np.inf
    k = axis - 3
    return STAGE.speed[k], STAGE.acceleration[k], STAGE.jerk[k], STAGE.travel[k]


def command(time: float, states: Sequence[State]) -> Command:
    p, v, a = (tuple(float(x) for x in column) for column in zip(*states, strict=True))
    return Command(time, v[:3], a[:3], p[3:], v[3:], a[3:], p[:3])  # type: ignore[arg-type]


def states(one: Command) -> list[State]:
    p, v, a = (
        (*one.wheel_angle, *one.p_WS_W),
        one.wheel_speed + one.v_WS_W,
        one.wheel_acceleration + one.a_WS_W,
    )
    return list(zip(p, v, a, strict=True))


def alone(axis: int, state: State, time: float) -> Command:
    """One axis in this state, all others at rest in the centre."""
    return command(time, [state if k == axis else REST for k in range(6)])


def guard_at(dt: float, before: Command) -> Guard:
    """A guard whose last output was `before`, whatever that is."""
    guard = Guard(dt, WHEELS, STAGE)
    guard._put_out(before)
    return guard


def coast(state: State, jerk: float, t: float) -> State:
    """After t seconds of constant jerk."""
    p, v, a = state
    return (
        p + v * t + a * t * t / 2.0 + jerk * t**3 / 6.0,
        v + a * t + jerk * t * t / 2.0,
        a + jerk * t,
    )


def stop_distance(v: float, a_max: float, j_max: float) -> float:
    """From speed v >= 0 without acceleration."""
    return v / 2.0 * (v / a_max + a_max / j_max) if v >= a_max**2 / j_max else v * sqrt(v / j_max)


def rows(outputs: Iterable[Command]) -> Array:
    """(n, 6, 3) of p, v, a."""
    return np.array([states(one) for one in outputs])


def excess(dt: float, outputs: Sequence[Command]) -> float:
    """Return the largest share used of any limit, less one.

    It is by the numbers and by their differences, the first output after standstill.
    """
    x = rows([outputs[0]] * 4 + list(outputs))
    speed, acceleration, jerk, travel = (
        np.array(each) for each in zip(*map(limits, range(6)), strict=True)
    )
    p, v, a = (x[:, :, k] for k in range(3))
    shares = [v / speed, a / acceleration, np.diff(v, axis=0) / dt / acceleration]
    shares += [np.diff(a, axis=0) / dt / jerk, np.diff(v, 2, axis=0) / dt**2 / jerk, p / travel]
    for order, limit in enumerate((speed, acceleration, jerk), 1):
        shares.append(np.diff(p, order, axis=0) / dt**order / limit)
    assert np.all(np.isfinite(x))
    assert np.all(np.diff([one.time for one in outputs]) > 0.0)
    return max(float(np.max(np.abs(share))) for share in shares) - 1.0
