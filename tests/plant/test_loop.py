"""Sensors, observer and correction, each alone."""

from random import Random

import numpy as np
import pytest

from atlas_cueing.plant.attitude_loop import correction_rate
from atlas_cueing.plant.attitude_observer import AttitudeObserver
from atlas_cueing.plant.drive_command import hermite, integral, slope, value
from atlas_cueing.plant.sensors import AbsoluteFix, PlantGyro
from atlas_cueing.plant.wheel_correction import WheelCorrection
from atlas_cueing.rotation import IDENTITY, Quat, exp, geodesic, multiply

H = 1.0 / 120.0
SPEED, ACCELERATION, JERK = 10.0, 40.0, 500.0


def turning(k: int) -> Quat:
    """An orientation that turns about a moving axis."""
    t = k * H
    return multiply(exp((0.3 * t, 0.0, 0.0)), exp((0.0, 0.8 * t, 0.2 * np.sin(t))))


@pytest.mark.parametrize("latency", [0.0, 0.05, 0.25])
def test_late_fixes_and_a_bias_are_borne(latency: float) -> None:
    """Fixes without noise: the error of the start and the bias are gone, however late they come."""
    random = Random(1)
    gyro, fix = PlantGyro(0.01, 0.0, random), AbsoluteFix(10.0, 0.0, latency, random)
    observer = AttitudeObserver(exp((0.1, -0.05, 0.2)), 0.15, 0.011, 0.1, latency + 0.1)
    for k in range(1, 120 * 30):
        observer.turn(k * H, gyro.rate(turning(k - 1), turning(k), H), H)
        fix.look(k * H, turning(k))
        for taken, seen in fix.arrived(k * H):
            observer.take_fix(taken, seen)
    assert geodesic(observer.q_WS, turning(k)) < 1e-4
    assert observer.bias_S == pytest.approx([0.01 / np.sqrt(3.0)] * 3, abs=1e-4)


def test_a_fix_is_not_taken_twice() -> None:
    """Three fixes are on their way when the first is taken: they must know of its pull."""
    fix = AbsoluteFix(10.0, 0.0, 0.25, Random(1))
    gyro, observer = (
        PlantGyro(0.0, 0.0, Random(1)),
        AttitudeObserver(exp((0.3, 0, 0)), 0.8, 0, 1, 1),
    )
    largest = 0.0
    for k in range(1, 480):
        observer.turn(k * H, gyro.rate(turning(k - 1), turning(k), H), H)
        fix.look(k * H, turning(k))
        for taken, seen in fix.arrived(k * H):
            observer.take_fix(taken, seen)
        largest = max(largest, geodesic(observer.q_WS, turning(k)))
    assert largest < 0.301
    assert geodesic(observer.q_WS, turning(k)) < 1e-6


def test_a_fix_without_its_time_would_be_wrong() -> None:
    """What the test above would miss: taken as of now, a late fix is off by the turn since."""
    random = Random(1)
    fix, observer = AbsoluteFix(10.0, 0.0, 0.25, random), AttitudeObserver(IDENTITY, 1, 0, 1, 1)
    for k in range(1, 240):
        observer.q_WS = turning(k)
        observer.turn(k * H, (0.0, 0.0, 0.0), H)
        fix.look(k * H, turning(k))
        for _, seen in fix.arrived(k * H):
            observer.take_fix(k * H, seen)
            assert geodesic(observer.q_WS, turning(k)) > 0.05


def test_a_fix_older_than_the_memory_is_dropped() -> None:
    observer = AttitudeObserver(IDENTITY, 0.5, 0.1, 0.1, 0.2)
    for k in range(1, 100):
        observer.turn(k * H, (0.1, 0.0, 0.0), H)
    before = observer.q_WS
    observer.take_fix(10 * H, exp((0.0, 1.0, 0.0)))
    assert observer.q_WS == before
    observer.take_fix(98 * H, exp((0.0, 1.0, 0.0)))
    assert observer.q_WS != before


def test_fixes_come_at_their_rate_and_as_late_as_told() -> None:
    fix = AbsoluteFix(10.0, 0.01, 0.05, Random(2))
    came = []
    for k in range(1, 1201):
        fix.look(k * H, IDENTITY)
        came += [(k * H, taken, q) for taken, q in fix.arrived(k * H)]
    assert len(came) == 99  # in ten seconds; the last is on its way
    assert all(0.05 - 1e-9 <= now - taken < 0.05 + H for now, taken, _ in came)
    off = [geodesic(q, IDENTITY) for _, _, q in came]
    assert np.sqrt(np.mean(np.square(off))) == pytest.approx(0.01 * np.sqrt(3.0), rel=0.2)


def test_the_gyro_sees_its_turn_bias_and_noise() -> None:
    gyro = PlantGyro(0.0, 0.002, Random(3))
    start, end = exp((0.3, 0.1, 0.0)), multiply(exp((0.3, 0.1, 0.0)), exp((0.01, 0.0, -0.02)))
    rates = np.array([gyro.rate(start, end, H) for _ in range(2000)])
    assert rates.mean(axis=0) == pytest.approx([1.2, 0.0, -2.4], abs=0.003)
    assert rates.std(axis=0) == pytest.approx([0.002 / np.sqrt(H)] * 3, rel=0.1)
    assert PlantGyro(0.3, 0.0, Random(3)).rate(start, start, H) == pytest.approx([0.3 / 3**0.5] * 3)


def test_cubics_meet_both_ends() -> None:
    c = hermite(1.0, 2.0, -3.0, 0.5, 0.2)
    assert (value(c, 0.0), slope(c, 0.0)) == (1.0, 2.0)
    assert (value(c, 0.2), slope(c, 0.2)) == pytest.approx((-3.0, 0.5))
    fine = np.linspace(0.0, 0.2, 20001)
    assert integral(c, 0.2) == pytest.approx(np.trapezoid([value(c, t) for t in fine], fine))


def schedule(rng: np.random.Generator, ticks: int) -> np.ndarray:
    """Speed and acceleration (n, 2) that keep the limits, near which they often are."""
    rows, speed, a, aim = [(0.0, 0.0)], 0.0, 0.0, ACCELERATION
    for _ in range(ticks):
        if rng.random() < 0.03:
            aim = float(rng.choice((-1.0, 1.0))) * ACCELERATION
        # brake so as to stand at the limit, with the jerk there is
        room = 0.995 * SPEED - np.sign(aim) * speed
        if room < max(np.sign(aim) * a, 0.0) ** 2 / (2.0 * JERK) + abs(a) * 2.0 * H:
            aim = 0.0
        new = float(np.clip(aim, a - JERK * H, a + JERK * H))
        speed, a = speed + 0.5 * H * (a + new), new
        rows.append((speed, a))
    return np.array(rows)


@pytest.mark.parametrize("seed", range(4))
def test_schedule_and_correction_keep_the_limits(seed: int) -> None:
    """Whatever is wanted, their sum keeps speed, acceleration and jerk by its differences."""
    rng = np.random.default_rng(seed)
    rows, correction = schedule(rng, 6000), WheelCorrection(SPEED, ACCELERATION, JERK)
    assert np.abs(rows[:, 0]).max() <= SPEED
    assert np.abs(rows[:, 0]).max() > 0.9 * SPEED
    wanted, added = 0.0, [(0.0, 0.0, 0.0)]
    for k in range(len(rows) - 1):
        if rng.random() < 0.02:
            wanted = float(rng.normal() * 4.0)
        correction.step(wanted, (rows[k, 0], rows[k, 1], rows[k + 1, 1]), H)
        added.append((correction.angle, correction.speed, correction.acceleration))
    angle, speed, acceleration = np.array(added).T
    total, rate = rows[:, 0] + speed, rows[:, 1] + acceleration
    assert np.abs(total).max() <= SPEED * (1 + 1e-9)
    assert np.abs(rate).max() <= ACCELERATION * (1 + 1e-9)
    assert np.abs(np.diff(rate)).max() <= JERK * H * (1 + 1e-9)
    assert np.diff(total) / H == pytest.approx(0.5 * (rate[1:] + rate[:-1]), abs=1e-9)
    trapezoid = 0.5 * H * (speed[1:] + speed[:-1])
    curved = H * H * (acceleration[:-1] - acceleration[1:]) / 12.0
    assert np.diff(angle) == pytest.approx(trapezoid + curved, abs=1e-12)
    assert np.abs(speed).max() > 1.0  # there was room for some of it


def test_a_correction_takes_up_what_is_wanted() -> None:
    correction = WheelCorrection(SPEED, ACCELERATION, JERK)
    for _ in range(120):
        correction.step(0.7, (0.0, 0.0, 0.0), H)
    assert correction.speed == pytest.approx(0.7, abs=1e-3)


def swung(share: float, gain: float, phase: int) -> np.ndarray:
    """Error (deg) of a loop beside a schedule that goes from limit to limit at its largest jerk.

    The wheel turns the sphere by a tenth of its own turn; the error begins at 1.4 deg.
    """
    speed, acceleration, jerk, ticks = 31.0, 60.0, 600.0, 48
    correction = WheelCorrection(speed, acceleration, jerk, share)
    place = (np.arange(1200) + phase) % ticks / ticks
    schedule = acceleration * (2.0 * np.abs(2.0 * place - 1.0) - 1.0)
    assert np.abs(np.diff(schedule)).max() / H == pytest.approx(jerk)
    error, w, errors = np.radians(1.4), 0.0, []
    for k in range(len(schedule) - 1):
        before = correction.speed
        rate = correction_rate((error, 0.0, 0.0), gain, 0.5, 0.1 * share * acceleration)
        correction.step(10.0 * rate[0], (w, schedule[k], schedule[k + 1]), H)
        w += 0.5 * H * (schedule[k] + schedule[k + 1])
        error -= 0.05 * H * (before + correction.speed)
        errors.append(np.degrees(error))
    return np.array(errors)


@pytest.mark.parametrize("share", [0.05, 0.1, 0.25, 1.0])
def test_a_schedule_at_its_jerk_limit_makes_no_swing(share: float) -> None:
    """It holds the correction's acceleration for up to a quarter of its period."""
    for phase in range(0, 48, 3):
        errors = swung(share, 4.0, phase)
        assert errors.min() > -0.4
        assert np.abs(errors[-200:]).max() < 0.01


def test_a_correction_can_stop_where_the_error_ends() -> None:
    """Along its way to rest the rate never falls faster than it may."""
    for gain, largest, acceleration in ((5.0, 0.5, 0.3), (1.0, 10.0, 2.0), (100.0, 10.0, 0.1)):
        errors = np.geomspace(1e-6, np.pi, 4000)
        rates = np.array(
            [correction_rate((0.0, x, 0.0), gain, largest, acceleration)[1] for x in errors]
        )
        falls = np.diff(rates) / np.diff(errors) * 0.5 * (rates[1:] + rates[:-1])
        assert falls.max() <= acceleration * 1.01
        assert rates.max() <= largest
        assert rates[0] == pytest.approx(gain * errors[0])
        assert np.diff(rates).min() > -1e-12
    assert correction_rate((0.0, 0.0, 0.0), 5.0, 0.5, 0.3) == (0.0, 0.0, 0.0)
    assert correction_rate((0.0, 0.0, 1.0), 0.0, 0.5, 0.3) == (0.0, 0.0, 0.0)


def test_first_fixes_find_the_bias_and_late_ones_do_not_shake() -> None:
    """Against gains that stay: as quick as high ones, in the end as calm as low ones."""

    def errors(bias: float, noise: float, gain: float, first: float) -> np.ndarray:
        random = Random(5)
        gyro, fix = PlantGyro(bias, 0.0, random), AbsoluteFix(10.0, noise, 0.02, random)
        observer = AttitudeObserver(IDENTITY, gain, gain**2 / 2.0, 0.1, 0.12, first)
        off = []
        for k in range(1, 120 * 40):
            observer.turn(k * H, gyro.rate(turning(k - 1), turning(k), H), H)
            fix.look(k * H, turning(k))
            for taken, seen in fix.arrived(k * H):
                observer.take_fix(taken, seen)
            off.append(np.degrees(geodesic(observer.q_WS, turning(k))))
        return np.array(off)

    bias, noise = 0.00122, 0.0019
    assert errors(bias, 0.0, 0.03, 0.2).max() < 0.5 * errors(bias, 0.0, 0.03, 0.0).max()
    late = [errors(0.0, noise, *gains)[120 * 20 :] for gains in ((0.03, 0.2), (0.2, 0.0))]
    assert np.mean(late[0] ** 2) < 0.3 * np.mean(late[1] ** 2)
