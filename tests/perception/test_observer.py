"""The observer against its block diagram integrated apart, and against what people report."""

from collections.abc import Callable
from math import atan2, cos, degrees, pi, radians, sin, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from atlas_cueing.perception import Observer
from atlas_cueing.rotation import Vec3, angle_between, flip, norm

G = 9.80665
LEVEL: Vec3 = (0.0, 0.0, G)
Motion = Callable[[float], tuple[Vec3, Vec3]]
"""Specific force (m/s^2) and angular rate (rad/s) by time, FLU."""


def perceived(motion: Motion, dt: float, seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """Up and rate (n, 3) at every tick, the first included."""
    observer = Observer(dt, *motion(0.0))
    rows = [(observer.up, observer.rate)]
    for i in range(1, round(seconds / dt) + 1):
        observer.step(*motion(i * dt))
        rows.append((observer.up, observer.rate))
    up, rate = zip(*rows, strict=True)
    return np.array(up), np.array(rate)


def block_diagram(motion: Motion, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Merfeld's loop as it is drawn, in units of g and with the gravito-inertial force.

    Canals 5.73 s and 80 s in a chain, their copy without adaptation, and the delay-free loops
    closed by linear algebra instead of by hand.
    """
    k_w, k_fw, k_f, k_a, tau, adaptation = 3.0, 2.0, 2.0, -2.0, 5.73, 80.0

    def loop(t: float, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        felt, w = (np.array(part) for part in motion(t))
        slow, slower, copy, down = x[:3], x[3:6], x[6:9], x[9:] / np.linalg.norm(x[9:])
        gif = -felt / G
        high = w - slow
        canals = high - slower
        # a = k_a (gif - (down - a)), as three equations
        a = np.linalg.solve((1.0 - k_a) * np.eye(3), k_a * (gif - down))
        expected = down - a
        normal = np.cross(gif, expected)
        size = np.linalg.norm(normal)
        error = normal / size * atan2(size, gif @ expected) if size > 0.0 else np.zeros(3)
        # w_hat = k_w (canals - (w_hat - copy)) + k_fw error
        w_hat = np.linalg.solve((1.0 + k_w) * np.eye(3), k_w * (canals + copy) + k_fw * error)
        rate = w_hat * (k_w + 1.0) / k_w
        change = np.concatenate(
            [
                high / tau,
                canals / adaptation,
                (w_hat - copy) / tau,
                np.cross(down, rate + k_f * error),
            ]
        )
        return change, rate, -down

    f0, w0 = (np.array(part) for part in motion(0.0))
    start = np.concatenate([w0, np.zeros(6), -f0 / np.linalg.norm(f0)])
    found = solve_ivp(
        lambda t, x: loop(t, x)[0],
        (0.0, time[-1]),
        start,
        t_eval=time,
        rtol=1e-8,
        atol=1e-10,
        max_step=0.05,
    )
    _, rate, up = zip(*(loop(t, x) for t, x in zip(time, found.y.T, strict=True)), strict=True)
    return np.array(up), np.array(rate)


def tumbling(t: float) -> tuple[Vec3, Vec3]:
    """Turns about all axes and a force that is not theirs."""
    force = (4.0 * sin(0.9 * t), -3.0 * sin(0.5 * t), 8.0 + 5.0 * cos(1.3 * t))
    return force, (0.8 * sin(1.1 * t), 0.5 * cos(0.7 * t), -0.6 * sin(0.4 * t))


def test_it_is_the_block_diagram() -> None:
    dt = 1.0 / 120.0
    up, rate = perceived(tumbling, dt, 30.0)
    other_up, other_rate = block_diagram(tumbling, dt * np.arange(len(up)))
    np.testing.assert_allclose(up, other_up, atol=2e-4)
    np.testing.assert_allclose(rate, other_rate, atol=2e-4)


def test_its_error_is_of_second_order() -> None:
    exact = perceived(tumbling, 0.0005, 12.0)[0][-1]
    coarse, fine = (
        norm(tuple(perceived(tumbling, dt, 12.0)[0][-1] - exact)) for dt in (0.04, 0.02)
    )
    assert 3.0 < coarse / fine < 5.5


def test_a_lasting_turn_about_the_vertical_fades_with_the_velocity_storage() -> None:
    """Partial fractions of 4 T s A s / ((4 T s + 1)(A s + 1)) on a step; 63 % is gone in 16 s."""
    dt, w = 0.01, radians(60.0)
    _, rate = perceived(lambda t: (LEVEL, (0.0, 0.0, w if t > 0.0 else 0.0)), dt, 120.0)
    store, adaptation = 4.0 * 5.73, 80.0
    t = dt * np.arange(len(rate)) - 0.5 * dt
    theory = (adaptation * np.exp(-t / store) - store * np.exp(-t / adaptation)) / (
        adaptation - store
    )
    np.testing.assert_allclose(rate[2:, 2], w * theory[2:], atol=1e-4 * w)
    assert abs(t[np.argmax(rate[2:, 2] < w / np.e) + 2] - 16.0) < 0.5


def test_and_its_end_is_felt_as_a_turn_the_other_way() -> None:
    def stopped(t: float) -> tuple[Vec3, Vec3]:
        return LEVEL, (0.0, 0.0, 1.0 if 0.0 < t < 90.0 else 0.0)

    rate = perceived(stopped, 0.02, 91.0)[1]
    assert rate[-1, 2] < -0.9


def tilting(t: float) -> tuple[Vec3, Vec3]:
    """Rolled to 30 deg within 2 s and held."""
    angle, end = radians(30.0), 2.0
    rolled = angle * 0.5 * (1.0 - cos(pi * min(t, end) / end))
    rate = angle * 0.5 * pi / end * sin(pi * t / end) if t < end else 0.0
    return (0.0, G * sin(rolled), G * cos(rolled)), (rate, 0.0, 0.0)


def test_a_tilt_is_perceived_as_it_is() -> None:
    up, rate = perceived(tilting, 0.01, 60.0)
    roll = np.degrees(np.arctan2(up[:, 1], up[:, 2]))
    true = np.array([degrees(atan2(*tilting(0.01 * i)[0][1:])) for i in range(len(roll))])
    assert np.max(np.abs(roll - true)) < 2.0
    assert roll[-1] == pytest.approx(30.0, abs=0.05)
    assert abs(rate[-1, 0]) < radians(0.1)


def test_a_lasting_acceleration_becomes_a_tilt() -> None:
    """The somatogravic illusion: 0.36 g forward, taken for 20 deg nose up."""
    push = (G * sin(radians(20.0)), 0.0, G * cos(radians(20.0)))
    up, _ = perceived(lambda t: (push if t > 0.0 else LEVEL, (0.0, 0.0, 0.0)), 0.01, 60.0)
    pitch = np.degrees(np.arctan2(up[:, 0], up[:, 2]))
    assert pitch[10] < 3.0
    assert 8.0 < pitch[100] < 15.0
    assert pitch[-1] == pytest.approx(20.0, abs=0.1)
    assert np.all(np.diff(pitch) > -1e-3)


def test_on_a_centrifuge_the_tilt_takes_its_time() -> None:
    """250 deg/s within 19 s, force then at 45 deg: the canals hold the tilt back.

    Merfeld et al., Journal of Vestibular Research 11 (2001) saw it lag the force by many seconds.
    """
    fast, ramp = radians(250.0), 19.0

    def spun(t: float) -> tuple[Vec3, Vec3]:
        w = fast * min(t / ramp, 1.0)
        return (0.0, G * (w / fast) ** 2, G), (0.0, 0.0, w)

    up, _ = perceived(spun, 0.02, 200.0)
    off = [degrees(angle_between(tuple(row), (0.0, 1.0, 1.0))) for row in up[::50]]
    assert off[19] > 35.0
    assert off[30] > 30.0
    assert 10.0 < max(off[60:120]) < 20.0
    assert off[-1] < 5.0


@pytest.mark.parametrize(
    ("radius", "frequency", "expected"), [(0.0, 0.45, 10.5), (1.22, 0.45, 11.0)]
)
def test_the_swing_that_the_gains_were_found_on(
    radius: float, frequency: float, expected: float
) -> None:
    """Rader, Oman & Merfeld 2009, table 4: what their model gave: peak tilt, 27 of 28 deg/s.

    The ears `radius` below the axis of a swing of 10 deg, whose sideways force is gravity's and
    the swing's: at 1.22 m they cancel. Ours gives 10.0 and 9.6 deg, 28.3 and 27.8 deg/s. It is not
    our integration: `block_diagram` gives the same to 0.002 deg. Nor is it only how peaks are read:
    with the larger radius our tilt falls where theirs rises (it is 11.1 deg with the swing's force
    of the other sign, which would not cancel gravity's). This is not explained, so the tolerance
    says no more than that both are near the true 10 deg and 28.3 deg/s.
    """
    swing, w = radians(10.0), 2.0 * pi * frequency

    def swinging(t: float) -> tuple[Vec3, Vec3]:
        ease = min(t / 10.0, 1.0)
        roll, rate = ease * swing * sin(w * t), ease * swing * w * cos(w * t)
        change = -ease * swing * w * w * sin(w * t)
        side = G * sin(roll) + radius * change
        return (0.0, side, G * cos(roll) + radius * rate * rate), (rate, 0.0, 0.0)

    up, rate = perceived(swinging, 0.005, 60.0)
    last = slice(-round(10.0 / 0.005), None)
    assert np.degrees(np.max(np.arctan2(up[last, 1], up[last, 2]))) == pytest.approx(
        expected, abs=1.5
    )
    assert degrees(np.max(rate[last, 0])) == pytest.approx(27.0, abs=1.5)


def test_front_right_down_is_the_same_head() -> None:
    one, other = Observer(0.01, *tumbling(0.0)), Observer(0.01, *map(flip, tumbling(0.0)))
    for i in range(1, 1000):
        f, w = tumbling(0.01 * i)
        one.step(f, w)
        other.step(flip(f), flip(w))
    assert flip(other.up) == pytest.approx(one.up, abs=1e-12)
    assert flip(other.rate) == pytest.approx(one.rate, abs=1e-12)


def test_no_force_has_no_direction() -> None:
    """Up stays, turned by the head's own turn; a force that is hardly there hardly counts."""
    for force in ((0.0, 0.0, 0.0), (1e-3, 0.0, 0.0), (5e-324, 0.0, 0.0), (1e-170, 0.0, 0.0)):
        observer = Observer(0.01, LEVEL, (0.0, 0.0, 0.0))
        for _ in range(200):
            observer.step(force, (0.0, 0.0, 0.0))
        assert angle_between(observer.up, LEVEL) < 3e-3


def test_a_head_upside_down_finds_up_again() -> None:
    observer = Observer(0.01, LEVEL, (0.0, 0.0, 0.0))
    for _ in range(6000):
        observer.step((1e-6, 0.0, -G), (0.0, 0.0, 0.0))
    assert angle_between(observer.up, (0.0, 0.0, -1.0)) < 1e-2


part = st.floats(-500.0, 500.0) | st.sampled_from([0.0, -0.0, 5e-324, 1e-12])
vectors = st.tuples(part, part, part)


@given(
    st.lists(st.tuples(vectors, vectors), min_size=2, max_size=60),
    st.sampled_from([1e-3, 1.0 / 120.0, 0.05]),
)
def test_whatever_comes_up_is_a_direction(inputs: list[tuple[Vec3, Vec3]], dt: float) -> None:
    observer = Observer(dt, *inputs[0])
    most = 4.0 * sqrt(3.0) * 2.0 * 500.0 + 8.0 * pi * 2.0
    for f, w in inputs[1:]:
        observer.step(f, w)
        assert norm(observer.up) == pytest.approx(1.0, abs=1e-12)
        assert norm(observer.rate) < most


def test_a_seat_that_is_used_to_its_turn_feels_none() -> None:
    observer = Observer(0.01, LEVEL, (0.0, 0.0, 2.0))
    for _ in range(100):
        observer.step(LEVEL, (0.0, 0.0, 2.0))
    assert observer.rate == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
