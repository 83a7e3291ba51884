"""Each of the guard's checks just inside and just outside its bound, for every axis, both ways."""

from collections.abc import Callable
from math import sqrt

import pytest

from .guard_states import AXES, ROUNDING, State, alone, coast, guard_at, limits, stop_distance

DT = 0.01
# how near to a bound, as a share of its size: the guard's room for rounding is a hundred times as
# much
NEAR = 1e-8

Pair = tuple[State, State]  # before and after
# what is refused; the pair at a share of the bound; how near
Case = tuple[str, Callable[[int, float], Pair], float]


def speed(axis: int, share: float) -> Pair:
    v = share * ROUNDING * limits(axis)[0]
    return (-DT * v, v, 0.0), (0.0, v, 0.0)


def acceleration(axis: int, share: float) -> Pair:
    _, most, jerk, _ = limits(axis)
    a = share * ROUNDING * most
    before = (0.0, -0.5 * a * a / jerk, a)
    return before, coast(before, 0.0, DT)


def jerk(axis: int, share: float) -> Pair:
    """From braking to less braking."""
    before = (0.0, 0.1, -0.2)
    return before, coast(before, share * ROUNDING * limits(axis)[2], DT)


def speed_by_acceleration(axis: int, share: float) -> Pair:
    _, a, j, _ = limits(axis)
    v0, gain = -0.5 * a * a / j - a * DT, share * ROUNDING * a * DT
    return (0.0, v0, a), (DT * (v0 + 0.5 * gain), v0 + gain, a)


def speed_by_jerk(axis: int, share: float) -> Pair:
    """Without any acceleration at either end."""
    gain = share * 0.25 * ROUNDING**2 * limits(axis)[2] * DT**2
    return (0.0, 0.1, 0.0), (DT * (0.1 + 0.5 * gain), 0.1 + gain, 0.0)


def speed_by_jerk_while_it_changes(axis: int, share: float) -> Pair:
    """Half the jerk is used for the acceleration.

    A quarter of the tick backwards, three quarters forwards.
    """
    reach = ROUNDING**2 * limits(axis)[2]
    before = (0.0, 0.1, -0.1)
    p, v, a = coast(coast(before, share * reach, 0.75 * DT), -share * reach, 0.25 * DT)
    return before, (p, v, a)


def speed_at_standstill(axis: int, share: float) -> Pair:
    """Speeding up with half of the acceleration."""
    v_max, a_max, j, _ = limits(axis)
    a = 0.5 * a_max
    before = coast((0.0, share * ROUNDING * v_max - 0.5 * a * a / (ROUNDING * j), a), 0.0, -DT)
    return before, coast(before, 0.0, DT)


WHEEL_CASES: list[Case] = [
    ("speed", speed, NEAR),
    ("acceleration", acceleration, NEAR),
    ("acceleration by the jerk", jerk, NEAR),
    ("speed by the acceleration", speed_by_acceleration, NEAR),
    ("speed by the jerk", speed_by_jerk, NEAR),
    ("speed by the jerk", speed_by_jerk_while_it_changes, NEAR),
    ("speed on the way to standstill", speed_at_standstill, NEAR),
]


def rail_end(axis: int) -> float:
    _, a, _, travel = limits(axis)
    return ROUNDING * travel - a * DT**2 / 8.0


def position(axis: int, share: float) -> Pair:
    p = share * rail_end(axis)
    return (p, 0.0, 0.0), (p, 0.0, 0.0)


def position_by_speed(axis: int, share: float) -> Pair:
    v = limits(axis)[0]
    return (0.0, v, 0.0), (share * ROUNDING * v * DT, v, 0.0)


def position_after_the_old_speed(axis: int, share: float) -> Pair:
    _, a, j, _ = limits(axis)
    v0 = -0.5 * a * a / j - a * DT
    return (0.0, v0, a), (DT * v0 + share * ROUNDING * 0.5 * a * DT**2, v0 + a * DT, a)


def position_before_the_new_speed(axis: int, share: float) -> Pair:
    _, a, j, _ = limits(axis)
    v0 = -0.5 * a * a / j - a * DT
    return (0.0, v0, a), (DT * (v0 + a * DT) - share * ROUNDING * 0.5 * a * DT**2, v0 + a * DT, a)


def furthest(axis: int, first: float, middle: float) -> Pair:
    """Where the full jerk leads, with its sign changed for a share of the tick after a first one.

    0 stays where it was.
    """
    reach = ROUNDING**2 * limits(axis)[2]
    before = (0.02, 0.15, -0.3)
    after = coast(before, reach, first * DT)
    after = coast(after, -reach, middle * DT)
    return before, coast(after, reach, (1.0 - first - middle) * DT)


def position_by_jerk(first: float, middle: float) -> Callable[[int, float], Pair]:
    def pair(axis: int, share: float) -> Pair:
        before, (p, v, a) = furthest(axis, first, middle)
        return before, (p + (share - 1.0) * limits(axis)[2] * DT**3, v, a)

    return pair


def standstill(axis: int, share: float) -> Pair:
    """From half the speed."""
    v_max, a, j, _ = limits(axis)
    v = 0.5 * v_max
    p = share * rail_end(axis) - stop_distance(v, ROUNDING * a, ROUNDING * j)
    return (p - DT * v, v, 0.0), (p, v, 0.0)


def standstill_from_creeping(axis: int, share: float) -> Pair:
    """So slow that the stop never comes to its full deceleration."""
    _, a, j, _ = limits(axis)
    v = 0.1 * a * a / j
    p = share * rail_end(axis) - stop_distance(v, ROUNDING * a, ROUNDING * j)
    return (p - DT * v, v, 0.0), (p, v, 0.0)


def turning_point(axis: int, share: float) -> Pair:
    """Away from the rail, with an acceleration that is about to turn it round too far to stop."""
    _, a_max, j, _ = limits(axis)
    a, j = -0.9 * a_max, ROUNDING * j
    v = 0.3 * a * a / j
    t = (-a - sqrt(a * a - 2.0 * j * v)) / j
    p = share * rail_end(axis) - coast((0.0, v, a), j, t)[0]
    return coast((p, v, a), 0.0, -DT), (p, v, a)


RAIL_CASES: list[Case] = [
    ("position", position, NEAR),
    ("position by the speed", position_by_speed, NEAR),
    ("position by the acceleration", position_after_the_old_speed, NEAR),
    ("position by the acceleration", position_before_the_new_speed, NEAR),
    *(
        ("position by the jerk", position_by_jerk(*where), NEAR)
        for where in ((0.2, 0.5), (0.5, 0.1), (0.1, 0.6), (0.6, 0.3))
    ),
    ("standstill", standstill, NEAR),
    ("standstill", standstill_from_creeping, NEAR),
    ("turning point", turning_point, NEAR),
]

CASES = [(axis, *case) for axis in range(6) for case in WHEEL_CASES] + [
    (axis, *case) for axis in (3, 4, 5) for case in RAIL_CASES
]


def mirrored(state: State, sign: float) -> State:
    p, v, a = state
    return sign * p, sign * v, sign * a


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("axis", "what", "pair", "near"), CASES, ids=lambda x: getattr(x, "__name__", str(x))
)
def test_a_bound(
    axis: int, what: str, pair: Callable[[int, float], Pair], near: float, sign: float
) -> None:
    for share in (1.0 - near, 1.0 + near):
        before, after = (
            alone(axis, mirrored(state, sign), t)
            for state, t in zip(pair(axis, share), (5.0, 5.0 + DT), strict=True)
        )
        guard = guard_at(DT, before)
        given = guard.check(after)
        if share < 1.0:
            assert given is after, guard.reason
            assert (guard.reason, guard.stopping) == ("", False)
        else:
            assert given is not after
            assert (
                guard.reason.partition(", allowed: ")[0].rpartition(" ")[0]
                == f"{AXES[axis]} {what}"
            ), guard.reason
            assert guard.reason.endswith(f"at {after.time} s")
            assert guard.stopping
