"""Method `classical` against Reid & Nahon's transfer functions and its limits.

The former are simulated by scipy.
"""

from math import asin, inf, pi, radians, sin, tanh

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.cueing import CLASSICAL_STAGE, ClassicalParameters, StageParameters
from atlas_cueing.cueing.classical import ClassicalRotation, TiltAngle
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    conjugate,
    flip,
    norm,
    rotate,
)
from atlas_cueing.signals import VehicleState

from .classical_rides import FREE, G, about, angles_of, level, ride, still
from .vehicles import manoeuvring


def test_the_set_is_that_of_tu_delft() -> None:
    chosen = ClassicalParameters()
    assert (chosen.rotation_gain, chosen.tilt_gain) == ((0.6, 0.6, 0.6), (0.6, 0.6, 0.5))
    assert (chosen.high_pass, chosen.tilt_low_pass) == ((1.0, 0.8, 1.0), 2.0)
    assert chosen.tilt_rate == radians(3.0)
    assert chosen.angle_limit == radians(25.0)
    assert CLASSICAL_STAGE.force_gain == (0.6, 0.6, 0.5)
    assert (CLASSICAL_STAGE.onset, CLASSICAL_STAGE.recentre) == ((0.8, 1.0, 1.0), (0.0, 0.0, 0.2))
    assert max(CLASSICAL_STAGE.travel) <= 0.6
    assert CLASSICAL_STAGE.bandwidth == StageParameters().bandwidth


@pytest.mark.parametrize("limit", [radians(25.0), radians(1e6), inf])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_every_angle_returns_to_nothing_for_a_constant_rate(axis: int, limit: float) -> None:
    """At the start it is washed out already.

    From a rate that sets in later it takes some ten seconds.
    """
    parameters = ClassicalParameters(angle_limit=limit)
    _, at_once, w = ride(parameters, lambda _: about(axis, 0.3), level, 5.0, 0.01)
    assert np.max(np.abs(at_once)) < 1e-9
    assert np.max(np.abs(w)) < 1e-9
    _, later, w = ride(parameters, lambda t: about(axis, 0.3 * float(t > 1.0)), level, 25.0, 0.01)
    assert np.max(np.abs(later[:, axis])) == pytest.approx(
        0.18 / (np.e * (1.0, 0.8, 1.0)[axis]), rel=0.05
    )  # of t exp(-w t), at its peak; the limit takes some of it off
    assert np.max(np.abs(later[-1])) < 1e-6
    assert np.max(np.abs(w[-1])) < 1e-6


@pytest.mark.parametrize("f", [0.5, 2.0, -4.0, 9.0])
def test_a_lasting_forward_force_pitches_up_and_is_felt_forward(f: float) -> None:
    """asin(0.6 f / g): the rider leans back, and feels 0.6 f where the vehicle's would feel f."""
    method = ClassicalRotation(0.02, FREE)
    for i in range(3000):
        q_WS, w = method.step(
            VehicleState(i * 0.02, IDENTITY, ZERO, (0.0 if i < 50 else f, 0.0, -G))
        )
    assert angles_of(q_WS) == pytest.approx((0.0, asin(0.6 * f / G), 0.0), abs=1e-9)
    assert flip(rotate(conjugate(q_WS), (0.0, 0.0, G)))[0] == pytest.approx(0.6 * f)
    assert norm(w) < 1e-9


@pytest.mark.parametrize("f", [0.5, -2.0, 6.0])
def test_a_lasting_force_to_the_right_rolls_left_and_is_felt_to_the_right(f: float) -> None:
    method = ClassicalRotation(0.02, FREE)
    for i in range(3000):
        q_WS, _ = method.step(
            VehicleState(i * 0.02, IDENTITY, ZERO, (0.0, 0.0 if i < 50 else f, -G))
        )
    assert angles_of(q_WS) == pytest.approx((-asin(0.6 * f / G), 0.0, 0.0), abs=1e-9)
    assert flip(rotate(conjugate(q_WS), (0.0, 0.0, G)))[1] == pytest.approx(0.6 * f)


def test_it_begins_in_the_tilt_of_the_first_force_at_rest() -> None:
    method = ClassicalRotation(0.01, FREE)
    for i in range(300):
        q_WS, w = method.step(VehicleState(i * 0.01, IDENTITY, ZERO, (2.0, -3.0, -9.0)))
        assert angles_of(q_WS) == pytest.approx((asin(1.8 / G), asin(1.2 / G), 0.0))
        assert norm(w) < 1e-12


@pytest.mark.parametrize("dt", [1e-3, 1.0 / 120.0, 0.05])
@pytest.mark.parametrize("rate", [radians(3.0), 0.2])
def test_the_tilt_never_turns_faster_than_its_rate(rate: float, dt: float) -> None:
    """For forces beyond gravity, flipping: angle by finite differences, and the rate it states."""
    random, tilt = np.random.default_rng(4), TiltAngle(dt, ClassicalParameters(tilt_rate=rate))
    before, _ = tilt.step(3.0)
    most = 0.0
    for i in range(4000):
        if i % 200 == 0:
            force = float(random.standard_normal() * 10.0 ** random.uniform(-1.0, 9.0))
        angle, said = tilt.step(force)
        most = max(most, abs(said))
        assert abs(angle - before) <= rate * dt * (1.0 + 1e-9)
        assert abs(said) <= rate * (1.0 + 1e-9)
        assert abs(angle) <= 0.5 * pi
        before = angle
    assert most == pytest.approx(rate)


def test_the_cabin_s_own_rate_from_tilt_alone_stays_below_the_threshold() -> None:
    """Of the whole method, in one axis; two at once may add up to the root of two of it."""
    _, _, w = ride(
        ClassicalParameters(), still, lambda t: (8.0 * sin(2.0 * t), 0.0, -G), 10.0, 0.01
    )
    assert np.max(np.linalg.norm(w, axis=1)) <= radians(3.0) * (1.0 + 1e-9)
    assert np.max(np.linalg.norm(w, axis=1)) > radians(2.5)


@pytest.mark.parametrize("limit", [5.0, 25.0, 60.0])
def test_every_angle_keeps_its_limit_and_reaches_it_smoothly(limit: float) -> None:
    parameters = ClassicalParameters(angle_limit=radians(limit))
    random, method = np.random.default_rng(7), ClassicalRotation(0.02, parameters)
    reached = np.zeros(3)
    for i in range(4000):
        if i % 100 == 0:
            w, f = 3.0 * random.standard_normal(3), 20.0 * random.standard_normal(3)
        q_WS, _ = method.step(
            VehicleState(0.02 * i, IDENTITY, tuple(w.tolist()), tuple(f.tolist()))
        )
        reached = np.maximum(reached, np.abs(np.degrees(angles_of(q_WS))))
    assert np.all(reached <= limit * (1.0 + 1e-9))
    assert np.all(reached > 0.6 * limit)


def test_the_limit_is_a_hyperbolic_tangent_and_a_million_degrees_are_none() -> None:
    sustained = [
        angles_of(
            [m.step(VehicleState(0.1 * i, IDENTITY, ZERO, (8.0, 0.0, -G))) for i in range(20)][-1][
                0
            ]
        )[1]
        for m in (
            ClassicalRotation(0.1, ClassicalParameters(angle_limit=radians(x))) for x in (25.0, 1e6)
        )
    ]
    asked = asin(0.6 * 8.0 / G)
    assert sustained == pytest.approx(
        [radians(25.0) * tanh(asked / radians(25.0)), asked], abs=1e-6
    )
    parameters = (ClassicalParameters(angle_limit=x) for x in (radians(1e6), inf))
    limited, free = (
        ride(each, lambda t: about(0, 2.0 * sin(t)), level, 10.0, 0.02)[1] for each in parameters
    )
    assert np.max(np.abs(limited - free)) < 1e-6
    assert np.max(np.abs(free)) > 0.5


@pytest.mark.parametrize("limit", [radians(25.0), inf])
def test_the_rate_is_that_of_the_orientation(limit: float) -> None:
    """Finite differences of q_WS in the base frame, in a flight on all axes.

    The tilt's rate can follow its forces.
    """
    gaps = []
    for dt in (1.0 / 100.0, 1.0 / 400.0):
        method = ClassicalRotation(dt, ClassicalParameters(angle_limit=limit))
        cues = [method.step(vehicle) for vehicle in manoeuvring(dt, 10.0, push=0.2)]
        q = Rotation.from_quat(np.roll([c[0] for c in cues], -1, axis=1))
        w = np.array([c[1] for c in cues])
        made = (q[1:] * q[:-1].inv()).as_rotvec() / dt
        gaps.append(np.max(np.linalg.norm(made - 0.5 * (w[1:] + w[:-1]), axis=1)))
    assert np.max(np.linalg.norm(w, axis=1)) > 0.2
    assert gaps[0] < 0.02
    assert gaps[0] / gaps[1] > 3.0


def test_a_tumbling_vehicle_is_finite_where_euler_rates_have_no_bound() -> None:
    method = ClassicalRotation(0.01, ClassicalParameters(angle_limit=inf))
    for i in range(3000):
        q_WS, w = method.step(
            VehicleState(
                0.01 * i, IDENTITY, (0.3, 8.0 * sin(0.2 * 0.01 * i), 2.0), (30.0, 0.0, 0.0)
            )
        )
        assert np.all(np.isfinite([*q_WS, *w]))
