"""What a cabin's rider would miss, against the mismatch of `evaluation`."""

from math import degrees, radians, sqrt

import numpy as np
import pytest

from atlas_cueing.cueing.committee.loss import LOSS, LossParameters, observer_loss, organs_loss
from atlas_cueing.evaluation.mismatch import FORCE_JND, RATE_JND
from atlas_cueing.perception import Observer
from atlas_cueing.rotation import Vec3, add, exp, rotate, scale

G = 9.80665
UP: Vec3 = (0.0, 0.0, 1.0)
TILTED = rotate(exp((0.3, -0.2, 0.0)), UP)


def test_it_is_the_square_of_the_legs_of_the_mismatch() -> None:
    """Direction: |f_r - f_p|^2 less (|f_r| - |f_p|)^2, with |f_r| = g."""
    f, felt = (3.0, -8.0, 15.0), (0.02, 0.05, -0.01)
    size = np.linalg.norm(f)
    direction = np.sum((G * np.array(TILTED) - f) ** 2) - (G - size) ** 2
    rate = np.sum(np.square(felt))
    units = LossParameters(FORCE_JND, RATE_JND)
    expected = direction / FORCE_JND**2 + rate / RATE_JND**2
    assert organs_loss(units, TILTED, felt, f, 1.5) == pytest.approx(expected, rel=1e-12)


def test_a_false_turn_counts_three_times() -> None:
    assert pytest.approx(RATE_JND / sqrt(3.0), rel=1e-4) == LOSS.rate_unit
    assert LOSS.force_unit == FORCE_JND
    assert degrees(LOSS.tilt_unit) == 1.0


def test_a_force_without_direction_is_no_loss() -> None:
    for force in ((0.0, 0.0, 0.0), (0.0, 0.0, -1.5), (5e-324, 0.0, 0.0)):
        assert organs_loss(LOSS, TILTED, (0.0, 0.0, 0.0), force, 1.5) == 0.0
    assert organs_loss(LOSS, TILTED, (0.0, 0.0, 0.0), (0.0, 0.0, 3.0), 1.5) > 1.0


def test_between_hold_and_twice_it_the_direction_fades_in() -> None:
    """At half way by half: x^2 (3 - 2 x) of x = 1/2."""
    half = organs_loss(LOSS, TILTED, (0.0, 0.0, 0.0), (0.0, 0.0, 2.25), 1.5)
    whole = organs_loss(LOSS, TILTED, (0.0, 0.0, 0.0), (0.0, 0.0, 2.25), 1.0)
    assert half == pytest.approx(0.5 * whole, rel=1e-12)


def test_two_heads_that_perceive_the_same_lose_nothing() -> None:
    rider, pilot = (Observer(0.01, (0.0, 0.0, G), (0.0, 0.0, 0.0)) for _ in range(2))
    for _ in range(100):
        rider.step((1.0, 0.0, G), (0.1, 0.2, 0.0))
        pilot.step((1.0, 0.0, G), (0.1, 0.2, 0.0))
    assert observer_loss(LOSS, rider, pilot) == 0.0


def test_a_degree_of_tilt_and_a_unit_of_turn_count_one_each() -> None:
    pilot = Observer(0.01, (0.0, 0.0, G), (0.0, 0.0, 0.0))
    rider = Observer(0.01, scale(G, rotate(exp((radians(1.0), 0.0, 0.0)), UP)), (0.0, 0.0, 0.0))
    assert observer_loss(LOSS, rider, pilot) == pytest.approx(1.0, rel=1e-9)
    rider.rate = add(pilot.rate, (0.0, LOSS.rate_unit, 0.0))
    assert observer_loss(LOSS, rider, pilot) == pytest.approx(2.0, rel=1e-9)
