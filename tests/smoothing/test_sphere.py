"""Rotation in wheel space: onto the cue the shorter way, without overshoot or chatter."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.signals import Cue
from atlas_cueing.smoothing.axis import Step

from .between import Between
from .cues import UPRIGHT, Array, cue, smooth, turning, wild
from .flights import Flight, check, fly, wheel_turns
from .platforms import EQUILATERAL, ORTHOGONAL, PLATFORMS, UNEQUAL, Platform

ZERO = np.zeros(3)
DTS = [1.0 / 1000.0, 1.0 / 120.0, 1.0 / 20.0]
AXIS = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])


def standing(turn: Array) -> Cue:
    """At rest, turned by this rotation vector."""
    return cue(0.0, np.roll(Rotation.from_rotvec(turn).as_quat(), 1), ZERO, ZERO, ZERO, ZERO)


def rotation(q: Array) -> Rotation:
    return Rotation.from_quat(np.roll(np.asarray(q), -1, axis=-1))


def left(flight: Flight, cues: list[Cue]) -> Array:
    """Rotation vectors from the sphere to its cues, in W."""
    return (rotation(np.array([c.q_WS for c in cues])) * rotation(flight.q).inv()).as_rotvec()


@pytest.mark.parametrize("dt", DTS[1:])
@pytest.mark.parametrize("platform", [EQUILATERAL, UNEQUAL])
@pytest.mark.parametrize("degrees", [10.0, 90.0, 179.9, 180.0])
def test_a_step_is_caught_up_exactly_and_without_overshoot(
    platform: Platform, degrees: float, dt: float
) -> None:
    seconds = 8.0 if platform is EQUILATERAL else 18.0
    cues = [UPRIGHT] + [standing(np.radians(degrees) * AXIS)] * int(seconds / dt)
    flight = fly(platform, dt, cues)
    check(platform, flight)
    rest = left(flight, cues)[1:]
    assert np.linalg.norm(rest[-1]) < 1e-9
    along = rest @ AXIS * np.sign(rest[0] @ AXIS)
    assert np.degrees(-along.min()) < 0.01, "overshoot"
    way = np.linalg.norm(np.diff(flight.q, axis=0), axis=1).sum() * 2.0
    assert way == pytest.approx(np.radians(degrees), rel=0.03), (
        "by the shorter way, and nearly straight"
    )
    assert np.all(flight.limited[-1] == 0.0)
    assert flight.limited[1, 0] == 1.0


@pytest.mark.parametrize("dt", DTS)
def test_after_a_spell_beyond_the_limits_it_comes_back_to_the_cue(dt: float) -> None:
    """Two seconds of a turn at three times what the wheels can do, then an easy one for ever."""
    t = np.arange(0.0, 12.0, dt)
    angle = np.where(t < 2.0, 10.0 * t, 20.0 + 0.3 * (t - 2.0))
    rate = np.where(t < 2.0, 10.0, 0.3)
    q = np.roll(Rotation.from_rotvec(angle[:, None] * AXIS).as_quat(), 1, axis=1)
    cues = [cue(*row, ZERO, ZERO, ZERO) for row in zip(t, q, rate[:, None] * AXIS, strict=True)]
    flight = fly(EQUILATERAL, dt, cues)
    shares = check(EQUILATERAL, flight)
    assert shares["wheel speed"].max() > 0.98, "the spell should saturate the wheels"
    assert np.linalg.norm(left(flight, cues)[-1]) < 1e-6
    assert np.mean(flight.limited[(t > 0.5) & (t < 2.0), 0]) == 1.0
    assert flight.limited[-1, 0] == 0.0


def test_on_the_way_to_a_turning_cue_the_wheels_are_where_they_are_asked_to_be() -> None:
    """40 deg about x behind a cue that turns about z: the way to go turns with it."""
    dt, w = 1.0 / 500.0, np.array([0.0, 0.0, 2.0])
    t = dt * np.arange(1500)
    behind = Rotation.from_rotvec(np.radians([40.0, 0.0, 0.0]))
    q = np.roll((Rotation.from_rotvec(t[:, None] * w) * behind).as_quat(), 1, axis=1)
    cues = [UPRIGHT, *(cue(s, each, w, ZERO, ZERO, ZERO) for s, each in zip(t, q, strict=True))]
    flight = fly(EQUILATERAL, dt, cues)
    check(EQUILATERAL, flight)
    to_go = left(flight, cues)
    degrees = np.degrees(np.linalg.norm(to_go, axis=1))
    missing = np.linalg.norm(w + 4.0 * to_go - flight.w, axis=1)[(degrees > 0.5) & (degrees < 3.0)]
    assert len(missing) > 200
    assert np.max(missing) < 2e-3


@pytest.mark.parametrize("dt", DTS)
@pytest.mark.parametrize("size", [0.3, 1.0, 1.8])
def test_a_feasible_cue_passes_without_lag_and_without_chatter(size: float, dt: float) -> None:
    cues = smooth(dt, int(10.0 / dt), np.random.default_rng(3), rate=size, travel=0.5)
    flight = fly(EQUILATERAL, dt, cues)
    check(EQUILATERAL, flight)
    asked = {
        name: np.array([getattr(c, name) for c in cues]) for name in ("w_WS_W", "p_WS_W", "v_WS_W")
    }
    assert np.max(np.linalg.norm(asked["w_WS_W"], axis=1)) > 0.5 * size, "the cue should move"
    assert np.degrees(np.max(np.linalg.norm(left(flight, cues), axis=1))) < 0.1
    assert np.max(np.abs(flight.p - asked["p_WS_W"])) < 1e-3

    def added(mine: Array, theirs: Array) -> float:
        return float(np.sqrt(np.mean(np.sum((np.diff(mine - theirs, axis=0) / dt) ** 2, axis=1))))

    assert np.degrees(added(flight.w, asked["w_WS_W"])) < 0.2
    assert added(flight.v, asked["v_WS_W"]) < 0.02
    # and the acceleration it reports is the one it makes, up to half a tick of jerk
    made, mean = np.diff(flight.w, axis=0) / dt, 0.5 * (flight.alpha[1:] + flight.alpha[:-1])
    assert np.max(np.abs(made - mean)) < 0.01 + 2.0 * dt
    assert not np.any(flight.limited)


@pytest.mark.parametrize("dt", DTS[1:])
def test_wandering_past_half_a_turn_does_not_turn_the_catch_up_round(dt: float) -> None:
    """The cue flickers to and fro over the far side.

    The sphere keeps to the way round that it has begun.
    """
    cues = [UPRIGHT] + [standing((np.pi + 0.02 * (-1.0) ** i) * AXIS) for i in range(int(8.0 / dt))]
    flight = fly(EQUILATERAL, dt, cues)
    check(EQUILATERAL, flight)
    start = flight.w[: int(1.0 / dt)] @ AXIS
    assert np.all(start > -1e-6) or np.all(start < 1e-6), "turned round on its way"
    steady = fly(EQUILATERAL, dt, [UPRIGHT] + [standing((np.pi - 0.02) * AXIS)] * len(cues))
    soon = int(0.1 / dt)
    assert np.linalg.norm(flight.w[soon]) > 0.8 * np.linalg.norm(steady.w[soon]), (
        "torn between two ways round"
    )
    assert np.linalg.norm(left(flight, cues)[-1]) < 0.1


@pytest.mark.parametrize("bad", ["nan", "inf", "no unit", "absurd rate"])
@pytest.mark.parametrize("dt", DTS)
def test_a_bad_cue_stops_it_smoothly_and_a_good_one_starts_it_again(bad: str, dt: float) -> None:
    cues = smooth(dt, int(5.0 / dt), np.random.default_rng(4), rate=1.5)
    good = cues[-1]
    q, w = np.array(good.q_WS), np.array(good.w_WS_W)
    spoilt = {
        "nan": (q * np.nan, w),
        "inf": (q, w + np.inf),
        "no unit": (1.1 * q, w),
        "absurd rate": (q, 1e4 + w),
    }
    broken = cue(good.time, *spoilt[bad], ZERO, ZERO, ZERO)
    still = cue(good.time, q, ZERO, ZERO, ZERO, ZERO)
    n, seconds = len(cues), 2.0
    everything = cues + [broken] * int(seconds / dt) + [still] * int(8.0 / dt)
    flight = fly(EQUILATERAL, dt, everything)
    check(EQUILATERAL, flight)
    stopped = n + int(seconds / dt) - 1
    assert np.linalg.norm(flight.w[n - 1]) > 0.3, "it should be turning when the cue breaks"
    assert np.linalg.norm(flight.w[stopped]) < 1e-12
    assert np.all(flight.limited[n : stopped + 1, 0] == 1.0)
    assert (rotation(still.q_WS) * rotation(flight.q[-1]).inv()).magnitude() < 1e-6


@pytest.mark.parametrize("platform", PLATFORMS.values(), ids=PLATFORMS.keys())
def test_the_orientation_is_the_integral_of_the_wheels(platform: Platform) -> None:
    """Ten seconds of any input end within rounding, through J and Eq. 20 by scipy.

    Each tick's turn is exact in axis.
    """
    dt = 1.0 / 500.0
    flight = fly(platform, dt, wild(dt, 5000, np.random.default_rng(9)))
    J = np.linalg.inv(platform.wheels_from_sphere)
    speed, acceleration = (
        flight.w @ platform.wheels_from_sphere.T,
        flight.alpha @ platform.wheels_from_sphere.T,
    )
    # turn of each wheel from its speed and acceleration alone: trapezoid with end correction
    turn = 0.5 * dt * (speed[1:] + speed[:-1]) - dt**2 / 12.0 * np.diff(acceleration, axis=0)
    q = rotation(flight.q[0])
    for omega, w0, w1 in zip(turn @ J.T, *zip(*pairwise(flight.w), strict=True), strict=True):
        q = Rotation.from_rotvec(omega + dt**2 / 12.0 * np.cross(w1, w0)) * q
    assert np.degrees((q * rotation(flight.q[-1]).inv()).magnitude()) < 0.01
    assert np.max(np.abs(wheel_turns(platform, flight) - turn)) < 1e-5


@pytest.mark.parametrize("dt", DTS)
def test_wheel_limits_hold_between_ticks(dt: float) -> None:
    smoothing, platform = ORTHOGONAL.smoothing(dt), ORTHOGONAL
    wheels = [Between(axis) for axis in smoothing._sphere.axes]
    paths, motion = [], np.zeros((3, 3))
    for asked in wild(dt, 1500, np.random.default_rng(12)):
        smoothing.step(asked)
        before, motion = motion, np.transpose(smoothing.wheel_motion())
        turned = zip(wheels, before.tolist(), motion.tolist(), strict=True)
        paths.append(
            [
                wheel.path(v, a, Step(angle - start, speed, acceleration, False))
                for wheel, (start, v, a), (angle, speed, acceleration) in turned
            ]
        )
    path = np.array(paths)
    most = np.max(np.abs(path), axis=(0, 2))
    assert np.all(most[:, 1] <= np.array(platform.wheels.speed) * (1.0 + 1e-9))
    assert np.all(most[:, 2] <= np.array(platform.wheels.acceleration) * (1.0 + 1e-9))
    assert np.all(most[:, 1] > 0.9 * np.array(platform.wheels.speed)) or dt < 0.002


def test_turning_for_hundreds_of_turns_loses_nothing() -> None:
    """The quaternion stays a unit one, where an angle would have grown to 4500 rad."""
    dt = 1.0 / 20.0
    t = dt * np.arange(30_000)
    spin = np.full((1, 3), 0.0)
    q, w = turning(t, np.array([0.0, 0.0, 3.0]), spin, spin, spin)
    cues = [cue(*row, ZERO, ZERO, ZERO) for row in zip(t, q, w, strict=True)]
    flight = fly(EQUILATERAL, dt, cues)
    check(EQUILATERAL, flight)
    assert t[-1] * 3.0 / (2.0 * np.pi) > 700.0
    assert np.max(np.linalg.norm(left(flight, cues)[200:], axis=1)) < 1e-6


@pytest.mark.parametrize(("dt", "within"), [(1.0 / 1000.0, 0.01), (1.0 / 240.0, 0.01)])
@pytest.mark.parametrize("platform", PLATFORMS.values(), ids=PLATFORMS.keys())
def test_a_small_error_decays_with_a_time_constant_of_a_quarter_second(
    platform: Platform, dt: float, within: float
) -> None:
    """The error is exp(-4 t) from the first tick on, |e|'' = 4^2 |e|.

    Speed and acceleration asked for are those of one motion.

    With the acceleration the other way round, or left out, each tick would cover another way than
    the speed at its end tells.
    """
    size = 1e-4 * dt
    cues = [UPRIGHT] + [standing(size * AXIS)] * int(1.5 / dt)
    flight = fly(platform, dt, cues)
    check(platform, flight)
    rest = left(flight, cues)[1:] @ AXIS
    settled = slice(int(0.1 / dt), int(1.0 / dt))
    decay = np.polyfit(dt * np.arange(len(rest))[settled], np.log(rest[settled] / size), 1)[0]
    assert decay == pytest.approx(-4.0, rel=within)
    speed, braking = flight.w[1:] @ AXIS, flight.alpha[1:] @ AXIS
    assert speed[settled] == pytest.approx(4.0 * rest[settled], rel=2.5 * 4.0 * dt)
    assert braking[settled] == pytest.approx(-16.0 * rest[settled], rel=5.0 * 4.0 * dt)
