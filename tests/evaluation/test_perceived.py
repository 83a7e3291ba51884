"""The observers, in the limits that can be told by hand, and against the continuous ones."""

from math import isnan, radians

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from atlas_cueing.evaluation import DECLARED, Metrics, gathered
from atlas_cueing.evaluation.perceived import LARGEST, STEP, Perceived

from .flights import G, any_flight, column, still

TILT, TURN = "perceived_tilt_rms_rad", "perceived_turn_rms_rad_s"
N = 6000
UP = np.array([0.0, 0.0, -G])


def leaning(angle: float) -> np.ndarray:
    """Specific force of a head that leans to the side, FRD."""
    return G * np.array([0.0, np.sin(angle), -np.cos(angle)])


def test_a_lasting_lean_is_perceived_as_tilt_and_not_as_a_turn() -> None:
    figures = gathered(Perceived(), still(N, felt_f=leaning(radians(10.0))))
    assert figures[TILT] == pytest.approx(radians(10.0))
    assert figures[TURN] == pytest.approx(0.0, abs=1e-9)


def test_a_turn_about_up_is_perceived_as_a_turn_and_fades() -> None:
    """It begins after the start, for which the head is taken to be used to its rate."""
    short, long = (column(np.where(np.arange(n) > 100, 0.5, 0.0), 2) for n in (400, 12000))
    begun, lasting = (gathered(Perceived(), still(len(w), felt_w=w)) for w in (short, long))
    assert begun[TILT] == lasting[TILT] == pytest.approx(0.0, abs=1e-9)
    assert begun[TURN] == pytest.approx(0.5 * np.sqrt(0.75), rel=0.1)
    assert lasting[TURN] < 0.6 * begun[TURN]


def test_the_same_ride_is_perceived_the_same() -> None:
    flight = any_flight(2000, 3)
    same = still(2000, **{n: getattr(flight, n) for n in ("vehicle_f_B", "vehicle_w_B")})
    same = still(
        2000,
        vehicle_f_B=same.vehicle_f_B,
        vehicle_w_B=same.vehicle_w_B,
        felt_f=same.vehicle_f_B,
        felt_w=same.vehicle_w_B,
    )
    assert set(gathered(Perceived(), same).values()) == {0.0}


def test_rider_and_pilot_may_change_places() -> None:
    a = any_flight(1500, 4)
    b = still(
        1500,
        vehicle_f_B=a.felt_f,
        vehicle_w_B=a.felt_w,
        felt_f=a.vehicle_f_B,
        felt_w=a.vehicle_w_B,
    )
    assert gathered(Perceived(), a) == pytest.approx(gathered(Perceived(), b))


def continuous(t: np.ndarray, f: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Merfeld's observer as differential equations: down, model of the canals, real canals."""
    kw, kfw, kf, ka, long, short = 3.0, 2.0, 2.0, -2.0, 80.0, 5.73

    def signals(time: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        down, v, z_long, z_short = y.reshape(4, 3)
        force, rate = (np.array([np.interp(time, t, x) for x in s.T]) for s in (f, w))
        # w less what each lag holds of it, in partial fractions
        sensed = rate + (long * z_short - short * z_long) / (short - long)
        expected = (G * down + ka * force) / (1.0 - ka)
        axis = np.cross(-force, expected)
        size = np.linalg.norm(axis)
        e = axis * (np.arctan2(size, -force @ expected) / size if size else 0.0)
        return sensed + v + kfw / kw * e, e

    def slope(time: float, y: np.ndarray) -> np.ndarray:
        down, v, z_long, z_short = y.reshape(4, 3)
        turn, e = signals(time, y)
        rate = np.array([np.interp(time, t, x) for x in w.T])
        return np.concatenate(
            [
                -np.cross(turn + kf * e, down),
                (kw * turn / (1.0 + kw) - v) / short,
                (rate - z_long) / long,
                (rate - z_short) / short,
            ]
        )

    start = np.concatenate([-f[0] / np.linalg.norm(f[0]), np.zeros(3), w[0], w[0]])
    solved = solve_ivp(slope, (t[0], t[-1]), start, t_eval=t, rtol=1e-7, atol=1e-9, max_step=0.05)
    turns = np.array([signals(time, y)[0] for time, y in zip(t, solved.y.T, strict=True)])
    return -solved.y[:3].T, turns


@pytest.mark.parametrize("dt", [1.0 / 60.0, 1.0 / 240.0])
def test_steps_are_fine_enough(dt: float) -> None:
    """Against the differential equations, of a roll that a cabin makes without turning."""
    t = np.arange(0.0, 8.0, dt)
    roll = 0.6 * np.sin(0.8 * t) ** 2
    rate = column(np.gradient(roll, dt), 0)
    f = np.stack([0.5 * np.sin(t), np.sin(roll) * G, -np.cos(roll) * G], axis=1)
    flight = still(len(t), dt, vehicle_f_B=UP * np.ones((len(t), 1)), vehicle_w_B=rate, felt_f=f)
    (up_p, turn_p), (up_r, turn_r) = (
        continuous(t, a, b)
        for a, b in ((flight.vehicle_f_B, flight.vehicle_w_B), (flight.felt_f, flight.felt_w))
    )
    angle = np.arccos(np.clip(np.sum(up_p * up_r, axis=1), -1.0, 1.0))
    figures = gathered(Perceived(), flight)
    assert figures[TILT] == pytest.approx(np.sqrt(np.mean(angle**2)), rel=0.01)
    turn = np.sum((turn_p - turn_r) ** 2, axis=1)
    assert figures[TURN] == pytest.approx(np.sqrt(np.mean(turn)), rel=0.01)
    assert figures[TILT] > radians(5.0)


def test_faster_ticks_are_averaged() -> None:
    """Eight ticks a step, of which the means are what slower ticks have."""
    slow = any_flight(600, 5)
    names = ("vehicle_f_B", "vehicle_w_B", "felt_f", "felt_w")
    coarse = still(600, STEP, **{name: getattr(slow, name) for name in names})
    fine = still(4800, STEP / 8.0, **{name: np.repeat(getattr(slow, name), 8, 0) for name in names})
    assert gathered(Perceived(), fine) == pytest.approx(gathered(Perceived(), coarse), rel=1e-9)


@pytest.mark.parametrize("wild", [np.nan, np.inf, 2.0 * LARGEST, 1e300])
@pytest.mark.parametrize("name", ["felt_f", "vehicle_w_B"])
def test_what_is_beyond_all_perception_has_no_number(name: str, wild: float) -> None:
    flight = still(3000)
    getattr(flight, name)[1700, 1] = wild
    assert all(isnan(value) for value in gathered(Perceived(), flight).values())


@pytest.mark.parametrize("dt", [0.0, -0.01, np.nan, np.inf])
def test_a_run_whose_time_stands_has_no_number(dt: float) -> None:
    with np.errstate(invalid="ignore"):
        flight = still(40, 0.01, time=np.arange(40) * dt)
    assert all(isnan(value) for value in gathered(Perceived(), flight).values())


def test_every_figure_that_needs_it_has_a_meaning() -> None:
    texts = {name: metric.meaning for name, metric in DECLARED.items() if metric.meaning}
    assert set(texts) == {
        *("mismatch_ratio", "mismatch", "mismatch_magnitude", "mismatch_direction"),
        *("mismatch_rate", "mismatch_worst_10s", TILT, TURN),
    }
    assert set(gathered(Metrics(), still(3))) >= {TILT, TURN}
    assert all(text[0].islower() and text[-1] != "." for text in texts.values())
