"""The course of W's up: its bounds, and that nothing is better."""

from dataclasses import replace
from math import degrees, pi, radians

import numpy as np
import pytest

from atlas_cueing.cueing import PreviewParameters
from atlas_cueing.cueing.preview import tilt_plan as up_module
from atlas_cueing.cueing.preview.spline import Spline
from atlas_cueing.cueing.preview.tilt_plan import Up, UpPlanner, sampled
from atlas_cueing.errors import InputError
from atlas_cueing.signals import STANDARD_GRAVITY

G = STANDARD_GRAVITY
DT, SECONDS = 0.02, 20.0
TIME = np.arange(round(SECONDS / DT) + 1) * DT
SLOW = PreviewParameters()


def about_x(angle: np.ndarray, size: float = G) -> np.ndarray:
    return size * np.stack([np.zeros_like(angle), np.sin(angle), np.cos(angle)], axis=1)


def planned(f_A: np.ndarray, parameters: PreviewParameters = SLOW) -> Up:
    spline = Spline(len(f_A), DT, parameters.planning_rate)
    return sampled(spline, UpPlanner(spline, parameters).plan(f_A))


def cost(
    direction: np.ndarray, rate: np.ndarray, f_A: np.ndarray, parameters: PreviewParameters = SLOW
) -> float:
    force = np.mean(np.sum((f_A - G * direction) ** 2, axis=1)) / parameters.force_unit**2
    return float(force + np.mean(np.sum(rate**2, axis=1)) / parameters.rate_unit**2)


def swinging(parameters: PreviewParameters = SLOW) -> tuple[np.ndarray, Up]:
    f_A = about_x(
        radians(12.0) * np.sin(0.8 * TIME) + radians(30.0) * np.clip((TIME - 9.0) / 3.0, 0.0, 1.0)
    )
    return f_A, planned(f_A, parameters)


def check(up: Up, parameters: PreviewParameters = SLOW) -> None:
    assert np.allclose(np.linalg.norm(up.direction, axis=1), 1.0)
    # no turn about the force
    assert np.allclose(np.sum(up.direction * up.rate, axis=1), 0.0, atol=1e-9)
    assert np.max(np.linalg.norm(up.rate, axis=1)) <= parameters.rate
    change = np.diff(up.rate, axis=0) / DT
    assert (
        np.max(np.linalg.norm(change, axis=1))
        <= parameters.acceleration * 1.01 + parameters.rate**2
    )


def test_a_force_that_stays_needs_no_turn() -> None:
    up = planned(about_x(np.full_like(TIME, 0.3)))
    assert np.allclose(up.direction, about_x(np.full_like(TIME, 0.3), 1.0), atol=1e-5)
    assert np.max(np.abs(up.rate)) < 1e-5


def test_bounds_are_kept_and_used() -> None:
    _, up = swinging()
    check(up)
    assert np.max(np.linalg.norm(up.rate, axis=1)) > 0.98 * SLOW.rate


def test_the_rate_is_that_of_the_direction() -> None:
    _, up = swinging()
    assert np.allclose(
        np.cross(up.direction, up.rate)[1:-1],
        np.gradient(up.direction, DT, axis=0)[1:-1],
        atol=5e-4,
    )


def test_it_is_at_rest_when_the_flight_begins() -> None:
    _, up = swinging()
    assert np.allclose(up.rate[0], 0.0, atol=1e-9)


def test_a_fast_enough_turn_is_the_force_s_own() -> None:
    """With rates as good as free, the direction is the force's."""
    f_A, up = swinging(PreviewParameters(rate=pi, smoothing=0.1, rate_unit=100.0))
    off = np.degrees(np.arccos(np.clip(np.sum(up.direction * f_A, axis=1) / G, -1.0, 1.0)))
    assert np.max(off) < 0.6  # corners of the force, which a spline rounds
    assert np.mean(off) < 0.03


def test_no_neighbour_is_better() -> None:
    """Any other course, kept inside the bounds by mixing it with the plan, costs more."""
    f_A, up = swinging()
    best, random = cost(up.direction, up.rate, f_A), np.random.default_rng(1)
    spline = Spline(len(f_A), DT, SLOW.planning_rate)
    planner = UpPlanner(spline, SLOW)
    for _ in range(5):
        frequency, phase, size = (
            random.uniform(0.1, 1.0),
            random.uniform(0.0, 6.0),
            random.uniform(0.05, 0.4),
        )
        other = sampled(
            spline, planner.plan(f_A + about_x(size * np.sin(frequency * TIME + phase)))
        )
        check(other)
        assert cost(other.direction, other.rate, f_A) > best
    followed = planned(f_A, replace(SLOW, rate_unit=10.0))
    assert cost(followed.direction, followed.rate, f_A) > best


def test_the_plan_begins_before_the_force_does() -> None:
    """Half of a swing of 12 deg in a second is over before it happens.

    At 3 deg/s it takes 4 s.
    """
    over = radians(12.0)
    up = planned(about_x(over * np.clip(TIME - 9.5, 0.0, 1.0)))
    angle = np.arctan2(up.direction[:, 1], up.direction[:, 2])
    assert degrees(float(np.interp(10.0, TIME, angle))) == pytest.approx(6.0, abs=0.3)
    assert degrees(float(np.interp(9.4, TIME, angle))) > 3.0


@pytest.mark.parametrize("parameters", [SLOW, PreviewParameters(rate=pi, smoothing=0.1)])
@pytest.mark.parametrize("seconds", [0.04, 2.0])
def test_a_force_that_turns_over_is_followed_round_the_sphere(
    parameters: PreviewParameters, seconds: float
) -> None:
    """Straight over, where the way through the centre would be the shortest.

    No side is the better one.
    """
    f_A = np.zeros((len(TIME), 3))
    f_A[:, 2] = G * np.clip((10.0 - TIME) / seconds, -1.0, 1.0)
    up = planned(f_A, parameters)
    check(up, parameters)
    if parameters.rate == pi:
        assert up.direction[0, 2] > 0.99
        assert up.direction[-1, 2] < -0.99


def test_no_force_at_all_leaves_it_where_it_is() -> None:
    f_A = np.zeros((len(TIME), 3))
    f_A[:200, 2] = G
    f_A[-200:, 1] = G
    up = planned(f_A)
    check(up)


def test_without_any_force_it_rests_somewhere() -> None:
    up = planned(np.zeros((len(TIME), 3)))
    check(up)
    assert np.max(np.abs(up.rate)) < 1e-6


def test_pushed_for_too_long_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(up_module, "_PUSHES", 1)
    f_A = np.zeros((len(TIME), 3))
    f_A[:, 2] = G * np.sign(10.01 - TIME)
    with pytest.raises(InputError, match=r"found no plan .* align_rate_deg_s above 3"):
        planned(f_A)
