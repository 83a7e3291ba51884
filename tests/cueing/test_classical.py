"""Method `classical` against Reid & Nahon's transfer functions and its limits.

The former are simulated by scipy.
"""

from collections.abc import Callable
from math import asin, inf, pi, radians, sin, tanh

import numpy as np
import pytest
from scipy.signal import lsim, lti
from scipy.spatial.transform import Rotation

from atlas_cueing.cueing import CLASSICAL_STAGE, ClassicalParameters, StageParameters, build_cueing
from atlas_cueing.cueing.classical import ClassicalRotation, TiltAngle, WashoutAngle
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    conjugate,
    flip,
    flip_rotation,
    norm,
    rotate,
    to_euler,
)
from atlas_cueing.rotations import Array
from atlas_cueing.signals import STANDARD_GRAVITY, StageLimits, VehicleState

from .vehicles import LEVEL, manoeuvring

Input = Callable[[float], Vec3]
Ride = tuple[Array, Array, Array]

G, DT = STANDARD_GRAVITY, 1.0 / 500.0
FREE = ClassicalParameters(angle_limit=inf)
HUGE = StageLimits((1e6,) * 3, (1e6,) * 3, (1e6,) * 3, (1e9,) * 3)


def washout(omega: float) -> lti:
    """Angle over rate: the high-pass s^2 / (s + w)^2 behind an integrator."""
    return lti([1.0, 0.0], [1.0, 2.0 * omega, omega**2])


def low_pass(omega: float) -> lti:
    return lti([omega**2], [1.0, 2.0 * omega, omega**2])


def response(system: lti, signal: Array, t: Array) -> Array:
    return np.asarray(lsim(system, signal, t)[1])


def ride(
    parameters: ClassicalParameters, rates: Input, forces: Input, seconds: float, dt: float = DT
) -> Ride:
    """Time, angles (roll, pitch, yaw) and w_WS_W for rates and forces over time."""
    method, t, angles, w = (
        ClassicalRotation(dt, parameters),
        dt * np.arange(int(seconds / dt)),
        [],
        [],
    )
    for now in t.tolist():
        q_WS, rate = method.step(VehicleState(now, IDENTITY, rates(now), forces(now)))
        angles.append(angles_of(q_WS))
        w.append(rate)
    return t, np.unwrap(np.array(angles), axis=0), np.array(w)


def angles_of(q_WS: Quat) -> Vec3:
    """Roll, pitch and yaw, FRD."""
    psi, theta, phi = to_euler(flip_rotation(q_WS))
    return phi, theta, psi


def about(axis: int, rate: float) -> Vec3:
    """A rate about one axis alone."""
    w = [0.0, 0.0, 0.0]
    w[axis] = rate
    return w[0], w[1], w[2]


def still(_: float) -> Vec3:
    return ZERO


def level(_: float) -> Vec3:
    return LEVEL


@pytest.mark.parametrize(("axis", "gain", "omega"), [(0, 0.6, 1.0), (1, 0.6, 0.8), (2, 0.6, 1.0)])
def test_each_rotation_channel_is_its_transfer_function(
    axis: int, gain: float, omega: float
) -> None:
    """TU Delft: gain 0.6; 1.0, 0.8, 1.0 rad/s, critically damped.

    One axis at a time the angle is exact at any size.
    """
    t, angles, _ = ride(FREE, lambda t: about(axis, 0.4 * sin(1.3 * t)), level, 20.0)
    truth = response(washout(omega), gain * 0.4 * np.sin(1.3 * t), t)
    assert np.max(np.abs(truth)) > 0.08
    assert np.max(np.abs(angles[:, axis] - truth)) < 2e-4
    assert np.max(np.abs(np.delete(angles, axis, axis=1))) < 1e-9


@pytest.mark.parametrize(("axis", "force", "angle", "sign"), [(0, 0, 1, 1.0), (1, 1, 0, -1.0)])
def test_each_tilt_channel_is_its_transfer_function(
    axis: int, force: int, angle: int, sign: float
) -> None:
    """The sine of the angle is 0.6 f behind 4 / (s + 2)^2 over g, below 3 deg/s."""

    def push(t: float) -> Vec3:
        f = [0.0, 0.0, -G]
        f[force] = 1.5 * sin(0.3 * t)
        return (f[0], f[1], f[2])

    t, angles, _ = ride(FREE, still, push, 25.0)
    truth = sign * np.arcsin(response(low_pass(2.0), 0.6 * 1.5 * np.sin(0.3 * t), t) / G)
    assert np.max(np.abs(truth)) > 0.08
    assert np.max(np.abs(angles[:, angle] - truth)) < 1e-4
    assert np.max(np.abs(angles[:, 1 - angle])) < 1e-9
    assert axis == force


def test_all_channels_together_are_the_sum_for_small_angles() -> None:
    """A frequency on each input, a thousandth in size: the rest is of second order."""
    k = 1e-3
    t, angles, _ = ride(
        FREE,
        lambda t: (k * sin(1.1 * t), k * sin(0.7 * t), k * sin(2.0 * t)),
        lambda t: (10.0 * k * sin(0.4 * t), 10.0 * k * sin(0.9 * t), -G),
        20.0,
    )
    tilts = [response(low_pass(2.0), 0.6 * 10.0 * k * np.sin(f * t), t) / G for f in (0.9, 0.4)]
    washed = [
        response(washout(o), 0.6 * k * np.sin(f * t), t)
        for o, f in ((1.0, 1.1), (0.8, 0.7), (1.0, 2.0))
    ]
    truth = np.stack([washed[0] - tilts[0], washed[1] + tilts[1], washed[2]], axis=1)
    assert np.min(np.max(np.abs(truth), axis=0)) > 2e-4
    assert np.max(np.abs(angles - truth)) < 4e-6


def test_the_stage_of_the_set_is_its_transfer_function() -> None:
    """0.6, 0.6, 0.5 of the force, 0.8, 1, 1 rad/s, 0.2 rad/s more on z.

    Behind the low-pass of the demand, which is ours.
    """
    dt, k = 1.0 / 500.0, 0.01
    cueing = build_cueing(ClassicalParameters(tilt_gain=ZERO), CLASSICAL_STAGE, HUGE, ZERO, dt)
    t, a = dt * np.arange(10_000), []
    for now in t.tolist():
        f = (k * sin(1.2 * now), -k * sin(0.8 * now), -G - k * sin(1.7 * now))
        a.append(cueing.step(VehicleState(now, IDENTITY, ZERO, f)).a_WS_W)
    for axis, (gain, omega, more, f) in enumerate(
        [(0.6, 0.8, 0.0, 1.2), (0.6, 1.0, 0.0, 0.8), (0.5, 1.0, 0.2, 1.7)]
    ):
        poles = np.polymul(np.polymul([1.0, omega], [1.0, omega]), [1.0 / (10.0 * pi), 1.0])
        high = lti(np.polymul([1.0, 0.0, 0.0], [1.0, 0.0]), np.polymul(poles, [1.0, more]))
        truth = response(high, gain * k * np.sin(f * t), t)
        found = np.array(a)[:, axis]
        assert np.max(np.abs(truth)) > 0.3 * gain * k
        assert np.max(np.abs(found - truth)) < 0.01 * gain * k, axis


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


@pytest.mark.parametrize("omega", [0.3, 1.0, 3.0])
def test_a_washed_out_angle_by_the_step_response(omega: float) -> None:
    """After a step of the rate: t exp(-w t), whose derivative is (1 - w t) exp(-w t)."""
    dt, channel = 1e-3, WashoutAngle(1e-3, omega)
    channel.step(0.0)
    for i in range(1, 5000):
        angle, rate = channel.step(1.0)
        t = i * dt
        assert angle == pytest.approx(t * np.exp(-omega * t), abs=1.1 * dt)
        assert rate == pytest.approx((1.0 - omega * t) * np.exp(-omega * t), abs=4.0 * omega * dt)


def test_a_tumbling_vehicle_is_finite_where_euler_rates_have_no_bound() -> None:
    method = ClassicalRotation(0.01, ClassicalParameters(angle_limit=inf))
    for i in range(3000):
        q_WS, w = method.step(
            VehicleState(
                0.01 * i, IDENTITY, (0.3, 8.0 * sin(0.2 * 0.01 * i), 2.0), (30.0, 0.0, 0.0)
            )
        )
        assert np.all(np.isfinite([*q_WS, *w]))
