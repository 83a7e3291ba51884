from dataclasses import replace
from itertools import pairwise
from math import inf, nan, pi, radians

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad, solve_ivp
from scipy.signal import chirp
from scipy.spatial.transform import Rotation

from atlas_cueing.errors import InputError, VehicleError
from atlas_cueing.rotation import geodesic, norm, to_euler
from atlas_cueing.signals import STANDARD_GRAVITY, Vehicle, VehicleState
from atlas_cueing.vehicles import Bounds, LimitedDuration, Signal, SignalFlight, SignalVehicle
from atlas_cueing.vehicles.signal_shapes import FORCE_AXES, RATE_AXES, SHAPES, SignalAxis
from atlas_cueing.vehicles.signal_vehicle import MIN_STEPS_PER_PERIOD

from . import flying

SINE = Signal("pitch_rate", "sine", 0.2, time=0.5, duration=8.0, ramp=1.0, frequency=3.0)
SWEEP = Signal(
    "pitch_rate", "sweep", 0.2, time=0.5, duration=8.0, ramp=1.0, frequency=0.5, end_frequency=12.0
)
STEP = Signal("pitch_rate", "step", 0.2, time=0.5, duration=8.0, ramp=1.0)
DOUBLET = Signal("pitch_rate", "doublet", 0.2, time=0.5, duration=8.0, ramp=1.0)
EACH = pytest.mark.parametrize("signal", [SINE, SWEEP, STEP, DOUBLET], ids=SHAPES)


def sampled(signal: Signal, dt: float, end: float = 10.0) -> NDArray[np.float64]:
    return np.array([signal.value(n * dt) for n in range(round(end / dt) + 1)])


def vehicle(
    *signals: Signal, rate_hz: float = 120.0, duration: float | None = None, follows: bool = True
) -> LimitedDuration:
    flight = SignalFlight(signals, rate_hz, follows)
    return LimitedDuration(flight.vehicle(), duration or flight.length() or 0.0)


def fly(vehicle: Vehicle) -> list[VehicleState]:
    return flying.fly(vehicle, 100.0)


@EACH
def test_nothing_jumps(signal: Signal) -> None:
    """Two continuous derivatives: the second difference settles when the step is halved.

    At a kink it would double.
    """
    coarse, fine = (np.abs(np.diff(sampled(signal, dt), 2)).max() / dt**2 for dt in (2e-3, 1e-3))
    assert fine == pytest.approx(coarse, rel=0.05)
    third = [np.abs(np.diff(sampled(signal, dt), 3)).max() / dt**3 for dt in (2e-3, 1e-3)]
    assert third[1] < 1.2 * third[0]


@EACH
def test_nothing_before_and_after(signal: Signal) -> None:
    values = sampled(signal, 0.01)
    assert not values[:51].any()
    assert not values[850:].any()
    assert np.abs(values).max() == pytest.approx(0.2, rel=0.02)


def test_shapes() -> None:
    s = np.arange(1.5, 7.5, 0.01) - 0.5  # between the ramps
    middle = np.array([SINE.value(0.5 + t) for t in s])
    np.testing.assert_allclose(middle, 0.2 * np.sin(3.0 * s), atol=1e-15)
    swept = np.array([SWEEP.value(0.5 + t) for t in s])
    oracle = chirp(s, f0=0.5 / (2 * pi), t1=8.0, f1=12.0 / (2 * pi), method="logarithmic", phi=-90)
    np.testing.assert_allclose(swept, 0.2 * oracle, atol=1e-12)
    assert [STEP.value(t) for t in (1.0, 4.0)] == [pytest.approx(0.1), 0.2]
    assert [DOUBLET.value(t) for t in (1.0, 3.0, 6.0)] == [pytest.approx(0.1), 0.2, -0.2]


def test_a_sweep_between_equal_frequencies_is_a_sine() -> None:
    nearly = replace(SWEEP, frequency=3.0, end_frequency=3.0 * (1.0 + 1e-7))
    for t in (1.0, 3.3, 7.9):
        assert replace(SWEEP, frequency=3.0, end_frequency=3.0).value(t) == SINE.value(t)
        assert nearly.value(t) == pytest.approx(SINE.value(t), abs=1e-6)


def test_areas() -> None:
    assert quad(STEP.value, 0.0, 10.0, points=[0.5, 1.5, 7.5, 8.5])[0] == pytest.approx(
        0.2 * (8.0 - 1.0)
    )
    assert quad(DOUBLET.value, 0.0, 10.0, points=[0.5, 4.5, 8.5], limit=200)[0] == pytest.approx(
        0.0, abs=1e-9
    )


@EACH
@pytest.mark.parametrize("axis", RATE_AXES)
def test_the_attitude_is_the_integral_of_the_rate(signal: Signal, axis: SignalAxis) -> None:
    states = fly(vehicle(replace(signal, axis=axis)))
    index = RATE_AXES.index(axis)
    for state in states[:: len(states) // 7]:
        angle, _ = quad(
            signal.value,
            0.0,
            state.time,
            points=[p for p in (0.5, 1.5, 4.5, 7.5) if p < state.time],
            limit=400,
        )
        turned = Rotation.from_rotvec(angle * np.eye(3)[index]).as_quat(scalar_first=True)
        assert geodesic(state.q_NB, tuple(turned)) < 2e-8
        assert state.w_NB_B == tuple(
            signal.value(state.time) if i == index else 0.0 for i in range(3)
        )


def test_few_steps_a_period_are_enough() -> None:
    """The attitude is integrated finer than the steps.

    At eight of them it is still good to 1e-6 of the swing.
    """
    fast = replace(SINE, frequency=2.0 * pi * 10.0 / MIN_STEPS_PER_PERIOD, amplitude=1.0, time=0.0)
    for state in fly(vehicle(fast, rate_hz=10.0))[1::9]:
        angle, _ = quad(fast.value, 0.0, state.time, limit=400)
        assert to_euler(state.q_NB)[1] == pytest.approx(angle, abs=2e-6)


def three_axes() -> tuple[Signal, ...]:
    """Large turns about all axes at once."""
    return tuple(
        Signal(axis, "sine", amplitude, time=0.0, duration=10.0, ramp=1.0, frequency=frequency)
        for axis, amplitude, frequency in zip(
            RATE_AXES, (2.0, -1.0, 1.5), (2.0, 3.0, 5.0), strict=True
        )
    )


def integrated(signals: tuple[Signal, ...], time: float) -> Rotation:
    """q' = 1/2 q o w by another integrator, for matrices: R' = R [w x]."""

    def slope(t: float, flat: NDArray[np.float64]) -> NDArray[np.float64]:
        x, y, z = (sum(s.value(t) for s in signals if s.axis == axis) for axis in RATE_AXES)
        matrix: NDArray[np.float64] = flat.reshape(3, 3) @ np.array(
            [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
        )
        return matrix.ravel()

    solution = solve_ivp(
        slope,
        (0.0, time),
        np.eye(3).ravel(),
        method="DOP853",
        rtol=1e-11,
        atol=1e-11,
        max_step=0.05,
    )
    return Rotation.from_matrix(solution.y[:, -1].reshape(3, 3))


def test_three_axes_at_once() -> None:
    signals = three_axes()
    states = fly(vehicle(*signals, duration=6.0))
    for state in (states[240], states[-1]):
        oracle = tuple(integrated(signals, state.time).as_quat(scalar_first=True))
        assert geodesic(state.q_NB, oracle) < 1e-6
    assert max(norm(to_euler(state.q_NB)) for state in states) > 1.0


def test_signals_of_one_axis_add_up() -> None:
    both = fly(vehicle(SINE, replace(STEP, amplitude=0.1)))
    for state in both[::100]:
        assert state.w_NB_B[1] == pytest.approx(
            SINE.value(state.time) + 0.5 * STEP.value(state.time)
        )


@pytest.mark.parametrize("follows", [True, False])
def test_specific_force(follows: bool) -> None:
    """Gravity in body axes, or held, plus the signals."""
    pushes = [replace(SINE, axis=axis, amplitude=1.0 + i) for i, axis in enumerate(FORCE_AXES)]
    for state in fly(vehicle(*three_axes(), *pushes, follows=follows))[::50]:
        attitude = Rotation.from_quat(state.q_NB, scalar_first=True)
        gravity = (
            attitude.inv().apply([0.0, 0.0, -STANDARD_GRAVITY])
            if follows
            else np.array([0.0, 0.0, -STANDARD_GRAVITY])
        )
        asked = [push.value(state.time) for push in pushes]
        np.testing.assert_allclose(np.array(state.f_B) - gravity, asked, atol=1e-12)


def test_a_pitch_up_is_felt_forward() -> None:
    """The sign that people know: nose up, the seat pushes forward."""
    last = fly(vehicle(STEP))[-1]
    assert to_euler(last.q_NB)[1] == pytest.approx(1.4)
    assert last.f_B[0] == pytest.approx(STANDARD_GRAVITY * np.sin(1.4))


def test_it_begins_at_rest_and_ends_with_its_last_signal() -> None:
    late = replace(DOUBLET, axis="force_y", time=3.0)
    flown: Vehicle = vehicle(SINE, late, rate_hz=50.0)
    first = flown.state
    assert (first.time, first.q_NB, first.w_NB_B) == (0.0, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert first.f_B == (0.0, 0.0, -STANDARD_GRAVITY)
    states = fly(flown)
    assert [state.time for state in states] == [n * flown.dt for n in range(551)]
    assert flown.dt == 0.02
    assert not flown.advance()
    assert flown.state == states[-1]


def test_it_goes_on_after_its_signals_until_somebody_ends_it() -> None:
    flight = SignalFlight((STEP,))
    assert (flight.ends_itself, flight.length(), flight.step()) == (False, 8.5, 1.0 / 120.0)
    after = flying.fly(flight.vehicle(), 20.0)
    assert len(after) == 20 * 120 + 1
    assert {state.w_NB_B for state in after if state.time > 8.5} == {(0.0, 0.0, 0.0)}


def test_many_turns_keep_unit_and_sign() -> None:
    states = fly(vehicle(replace(STEP, axis="roll_rate", amplitude=6.0, duration=30.0)))
    for before, state in pairwise(states):
        assert abs(norm(state.q_NB[1:]) ** 2 + state.q_NB[0] ** 2 - 1.0) < 1e-14
        assert sum(a * b for a, b in zip(before.q_NB, state.q_NB, strict=True)) > 0.99
    roll = 6.0 * (30.0 - 1.0)
    assert (to_euler(states[-1].q_NB)[2] - roll + pi) % (2.0 * pi) == pytest.approx(pi, abs=1e-6)


def test_what_nobody_rides_in_ends_the_flight() -> None:
    flown = SignalVehicle(SignalFlight((STEP,), 100.0), Bounds(rate=0.1))
    with pytest.raises(VehicleError, match=r"body rate 0\.1\d* rad/s, allowed: 0 <= rate <= 0\.1"):
        fly(flown)
    assert 0.09 < flown.state.w_NB_B[1] <= 0.1
    assert flown.state.time == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"axis": "yaw"}, "signal on yaw: no such axis, allowed: roll_rate, pitch_rate"),
        ({"shape": "square"}, "no shape 'square', allowed: sine, sweep, step, doublet"),
        ({"amplitude": inf}, "amplitude = inf, allowed: finite"),
        ({"amplitude": nan}, "amplitude = nan, allowed: finite"),
        ({"time": -0.1}, "time = -0.1 s, allowed: finite, 0 <= time"),
        ({"duration": 0.0}, "duration = 0, allowed: finite, 0 < duration"),
        ({"duration": inf}, "duration = inf"),
        ({"ramp": 0.0}, "ramp = 0, allowed: finite, 0 < ramp"),
        (
            {"ramp": 4.1},
            r"the ramps of a sine of 8 s must fit into it: ramp = 4.1 s, allowed: 0 < ramp <= 4",
        ),
        (
            {"shape": "doublet", "ramp": 2.1},
            "of a doublet of 8 s must fit into it: ramp = 2.1 s, allowed: 0 < ramp <= 2",
        ),
        ({"frequency": 0.0}, "frequency = 0, allowed: finite, 0 < frequency"),
        ({"shape": "sweep"}, "end_frequency = 0, allowed: finite, 0 < end_frequency"),
        (
            {"frequency": 100.0},
            (
                r"frequency 100 rad/s at 120 Hz, allowed: 0 < frequency <= 94.2478 \(8 steps a"
                r" period\)"
            ),
        ),
        ({"shape": "sweep", "end_frequency": 100.0}, "frequency 100 rad/s at 120 Hz"),
    ],
)
def test_a_bad_signal_is_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        vehicle(replace(SINE, **change))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("flight", "message"),
    [
        (SignalFlight((SINE,), 9.0), "rate 9 Hz, allowed: 10 <= rate_hz <= 10000"),
        (SignalFlight((SINE,), nan), "rate nan Hz"),
    ],
)
def test_a_bad_flight_is_refused(flight: SignalFlight, message: str) -> None:
    with pytest.raises(InputError, match=message):
        SignalVehicle(flight)


def test_a_negative_amplitude_begins_the_other_way() -> None:
    down = replace(DOUBLET, amplitude=-radians(5.0))
    assert down.value(3.0) == -down.value(6.0) == -radians(5.0)
