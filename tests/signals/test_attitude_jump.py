"""Jumps are what the body rates do not explain."""

from itertools import pairwise

import pytest
from cueing.vehicles import LEVEL, spinning

from atlas_cueing.rotation import IDENTITY, Vec3, exp, from_euler, multiply, scale
from atlas_cueing.signals import VehicleState, attitude_jump


@pytest.mark.parametrize("w", [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (1.0, -2.0, 0.5)])
def test_a_vehicle_that_turns_as_it_says_does_not_jump(w: Vec3) -> None:
    states = list(spinning(from_euler(1.0, 0.3, -0.2), w, 1.0 / 120.0, 100))
    assert max(attitude_jump(a, b) for a, b in pairwise(states)) < 1e-7


@pytest.mark.parametrize("size", [1e-3, 0.1, 3.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_jump_has_its_size_whatever_the_quaternion_s_sign(size: float, sign: float) -> None:
    w, dt = (0.5, 0.2, -0.4), 0.01
    turned = multiply(exp(scale(dt, w)), exp((0.0, size, 0.0)))
    now = VehicleState(dt, tuple(sign * x for x in turned), w, LEVEL)
    assert attitude_jump(VehicleState(0.0, IDENTITY, w, LEVEL), now) == pytest.approx(
        size, abs=2e-3 * size + 1e-9
    )


def test_rates_are_taken_by_the_trapezoid() -> None:
    before = VehicleState(1.0, IDENTITY, (0.0, 0.0, 0.0), LEVEL)
    now = VehicleState(1.1, exp((0.05, 0.0, 0.0)), (1.0, 0.0, 0.0), LEVEL)
    assert attitude_jump(before, now) == pytest.approx(0.0, abs=1e-7)
    assert attitude_jump(
        before, VehicleState(1.1, IDENTITY, (1.0, 0.0, 0.0), LEVEL)
    ) == pytest.approx(0.05)
