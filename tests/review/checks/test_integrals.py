"""The bounds hold for every motion of bounded jerk, and some motion reaches them."""

import numpy as np
import pytest

from atlas_cueing.review.checks.integrals import TURN, mean_step, speed_error, turn, turn_error

FINE = 20_000  # steps within one tick


def flown(jerk: np.ndarray, h: float, a0: float, v0: float) -> tuple[float, float, float]:
    """Exact acceleration, speed and distance after a tick whose jerk has equal pieces."""
    a, v, x, dt = a0, v0, 0.0, h / len(jerk)
    for j in jerk:
        x += v * dt + a * dt**2 / 2 + j * dt**3 / 6
        v += a * dt + j * dt**2 / 2
        a += j * dt
    return a, v, x


def errors(jerk: np.ndarray, h: float, a0: float, v0: float) -> tuple[float, float, float, float]:
    """Error of the speed and its bound, error of the way and its bound, for a jerk limit of 1."""
    a1, v1, x1 = flown(jerk, h, a0, v0)
    step, a, v = np.array([h]), np.array([[a0], [a1]]), np.array([[v0], [v1]])
    speed = abs(v1 - v0 - mean_step(a, step)[0, 0])
    way = abs(x1 - turn(v, a, step)[0, 0])
    return speed, speed_error(a, step, [1.0])[0, 0], way, turn_error(step, [1.0])[0, 0]


@pytest.mark.parametrize("seed", range(20))
def test_any_jerk_keeps_the_bounds(seed: int) -> None:
    rng = np.random.default_rng(seed)
    h, a0, v0 = rng.uniform(0.001, 0.1), rng.normal(), rng.normal()
    jerk = np.where(rng.random(rng.integers(1, 30)) < 0.5, 1.0, -1.0) * rng.choice([1.0, 0.3])
    speed, speed_bound, way, way_bound = errors(jerk, h, a0, v0)
    assert speed <= speed_bound + 1e-15
    assert way <= way_bound + 1e-15


def test_the_worst_jerk_reaches_them() -> None:
    """Full jerk one way for half a tick and back is worst for the speed.

    For the way it changes where t (1 - t) = 1/6.
    """
    middle = np.where(np.arange(FINE) < FINE // 2, 1.0, -1.0)
    speed, speed_bound, _, _ = errors(middle, 0.1, 0.0, 0.0)
    assert speed == pytest.approx(speed_bound, rel=1e-9)
    t = (np.arange(FINE) + 0.5) / FINE
    _, _, way, way_bound = errors(np.where(t * (1 - t) < 1 / 6, -1.0, 1.0), 0.1, 0.0, 0.0)
    assert way == pytest.approx(way_bound, rel=1e-3)
    assert pytest.approx(0.0321, abs=1e-4) == TURN


def test_constant_jerk_leaves_no_error() -> None:
    speed, _, way, _ = errors(np.array([0.7]), 0.1, 0.4, -0.2)
    assert speed == pytest.approx(0.7 * 0.0, abs=1e-12)
    assert way == pytest.approx(0.0, abs=1e-15)
