"""Each channel of the classical washout is its transfer function."""

from math import pi, sin

import numpy as np
import pytest
from scipy.signal import lsim, lti

from atlas_cueing.cueing import CLASSICAL_STAGE, ClassicalParameters, build_cueing
from atlas_cueing.cueing.classical import WashoutAngle
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Vec3,
)
from atlas_cueing.rotations import Array
from atlas_cueing.signals import StageLimits, VehicleState

from .classical_rides import FREE, G, about, level, ride, still

HUGE = StageLimits((1e6,) * 3, (1e6,) * 3, (1e6,) * 3, (1e9,) * 3)


def washout(omega: float) -> lti:
    """Angle over rate: the high-pass s^2 / (s + w)^2 behind an integrator."""
    return lti([1.0, 0.0], [1.0, 2.0 * omega, omega**2])


def low_pass(omega: float) -> lti:
    return lti([omega**2], [1.0, 2.0 * omega, omega**2])


def response(system: lti, signal: Array, t: Array) -> Array:
    return np.asarray(lsim(system, signal, t)[1])


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
