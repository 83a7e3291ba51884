"""The critically damped filter against a fine integration and its two bounds."""

from math import e, exp

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing.damping import CriticalDamping

number = st.floats(-10.0, 10.0)


@given(number, number, number, st.floats(0.1, 10.0), st.floats(0.001, 2.0))
def test_one_step_is_exact_however_it_is_cut(
    x: float, v: float, target: float, omega: float, dt: float
) -> None:
    whole = CriticalDamping(omega, dt).step(x, v, target)
    half = CriticalDamping(omega, 0.7 * dt).step(
        *CriticalDamping(omega, 0.3 * dt).step(x, v, target), target
    )
    assert half == (pytest.approx(whole[0], abs=1e-9), pytest.approx(whole[1], abs=1e-8))


def test_it_solves_its_equation() -> None:
    x, v, omega, h = 1.0, -2.0, 3.0, 1e-4
    for _ in range(10_000):  # midpoint rule
        xm, vm = x + 0.5 * h * v, v + 0.5 * h * (omega**2 * (0.5 - x) - 2.0 * omega * v)
        x, v = x + h * vm, v + h * (omega**2 * (0.5 - xm) - 2.0 * omega * vm)
    assert CriticalDamping(omega, 1.0).step(1.0, -2.0, 0.5) == (
        pytest.approx(x, abs=1e-6),
        pytest.approx(v, abs=1e-6),
    )


def test_from_rest_it_stays_in_the_hull_of_its_targets_and_below_its_rate() -> None:
    random, omega, dt = np.random.default_rng(2), 4.0, 0.01
    x, v, rates, damping = 0.0, 0.0, [], CriticalDamping(omega, dt)
    for i in range(20_000):
        if i % 25 == 0:
            target = float(random.choice([-1.0, 1.0, random.uniform(-1.0, 1.0)]))
        x, v = damping.step(x, v, target)
        rates.append(abs(v))
        assert abs(x) <= 1.0
    assert max(rates) <= 2.0 * omega / e
    assert CriticalDamping(omega, 1.0 / omega).step(-1.0, 0.0, 1.0)[1] == pytest.approx(
        2.0 * omega * exp(-1.0)
    )
