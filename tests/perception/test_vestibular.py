"""The organs' models against the oracle's frequency responses, and scipy in time."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import signal
from scipy.integrate import odeint

from atlas_cueing.perception.vestibular import CANALS, OTOLITHS, Organ, Sensing

ROWS = json.loads((Path(__file__).parent.parent / "oracles" / "vestibular.json").read_text())[
    "rows"
]
POLYNOMIALS = {
    "canal": ([5.73 * 80.0, 0.0, 0.0], np.polymul([5.73, 1.0], [80.0, 1.0])),
    "otolith": (np.multiply(0.4, [10.0, 1.0]), np.polymul([5.0, 1.0], [0.016, 1.0])),
}
ORGANS = {"canal": CANALS, "otolith": OTOLITHS}
both = pytest.mark.parametrize("name", ["canal", "otolith"])


def test_the_oracle_has_twelve_frequencies() -> None:
    assert [row["omega_rad_s"] for row in ROWS] == [
        0.1,
        0.158,
        0.251,
        0.398,
        0.631,
        1,
        1.585,
        2.512,
        3.981,
        6.31,
        10,
        15.849,
    ]


@both
@pytest.mark.parametrize("row", ROWS, ids=lambda row: str(row["omega_rad_s"]))
def test_frequency_response_of_the_oracle(row: dict[str, Any], name: str) -> None:
    response = ORGANS[name].response(row["omega_rad_s"])
    assert np.abs(response) == pytest.approx(row[f"{name}_gain"], rel=1e-6)
    assert np.degrees(np.angle(response)) == pytest.approx(row[f"{name}_phase_deg"], abs=1e-6)


@both
def test_frequency_response_of_the_published_polynomials(name: str) -> None:
    frequencies = np.geomspace(1e-3, 1e3, 61)
    expected = signal.freqs(*POLYNOMIALS[name], frequencies)[1]
    np.testing.assert_allclose(ORGANS[name].response(frequencies), expected, rtol=1e-9)


@both
@pytest.mark.parametrize("row", ROWS[4:], ids=lambda row: str(row["omega_rad_s"]))
def test_a_sine_in_time_has_the_oracles_gain_and_phase(row: dict[str, Any], name: str) -> None:
    """Fitted together with the transients of both poles.

    A sine that is straight between ticks is smaller by sinc^2(w dt / 2) = 1 - (w dt)^2 / 12 for all
    but the direct part.
    """
    w, dt = row["omega_rad_s"], 0.001
    t = np.arange(0.0, 60.0, dt)
    sensed = ORGANS[name].sense(np.sin(w * t), dt)
    transients = [np.exp(-t / lag) for _, lag in ORGANS[name].lags]
    fit = np.linalg.lstsq(
        np.column_stack([np.sin(w * t), np.cos(w * t), *transients]), sensed, rcond=None
    )[0]
    found, direct = complex(fit[0], fit[1]), ORGANS[name].direct
    response = direct + (found - direct) / (1.0 - (w * dt) ** 2 / 12.0)
    assert np.abs(response) == pytest.approx(row[f"{name}_gain"], rel=1e-6)
    assert np.degrees(np.angle(response)) == pytest.approx(row[f"{name}_phase_deg"], abs=1e-4)


@both
@pytest.mark.parametrize("count", [1, 2, 31, 32, 33, 64, 1000])
@pytest.mark.parametrize("dt", [0.001, 0.02, 1.0])
def test_against_scipys_simulation(name: str, count: int, dt: float) -> None:
    """`lsim` holds the input straight between ticks too.

    It starts at rest, so it is given the departure from the start.
    """
    u = 3.0 + np.cumsum(np.random.default_rng(count).normal(size=count))
    system = signal.lti(*POLYNOMIALS[name])
    still = {"canal": 0.0, "otolith": 0.4}[name] * u[0]
    departure = (
        signal.lsim(system, u - u[0], np.arange(count) * dt)[1] if count > 1 else np.zeros(1)
    )
    np.testing.assert_allclose(
        ORGANS[name].sense(u, dt), still + departure, atol=1e-9 * np.max(np.abs(u))
    )


@pytest.mark.parametrize("name", ["canal", "otolith"])
def test_against_an_integrator_of_the_differential_equation(name: str) -> None:
    """x' = A x + B u in controllable form, by odeint on the continuous input."""
    a, b, c, d = signal.tf2ss(*POLYNOMIALS[name])
    t = np.arange(0.0, 20.0, 0.002)
    x = odeint(
        lambda x, s: a @ x + b[:, 0] * np.sin(1.7 * s), np.zeros(2), t, rtol=1e-10, atol=1e-12
    )
    expected = x @ c[0] + d[0, 0] * np.sin(1.7 * t)
    np.testing.assert_allclose(ORGANS[name].sense(np.sin(1.7 * t), 0.002), expected, atol=2e-6)


@pytest.mark.parametrize("dt", [1e-4, 0.01, 1.0])
@pytest.mark.parametrize("value", [0.0, -9.80665, 1.0])
def test_nothing_starts_up_at_the_start(value: float, dt: float) -> None:
    steady = np.full(3000, value)
    np.testing.assert_allclose(CANALS.sense(steady, dt), 0.0, atol=1e-11)
    np.testing.assert_allclose(OTOLITHS.sense(steady, dt), 0.4 * value, atol=1e-11)


def test_canals_forget_a_steady_turn() -> None:
    """A step of rate is felt at once and forgotten, in closed form by partial fractions."""
    dt = 0.01
    u = np.concatenate([[0.0], np.ones(40_000)])
    # a ramp over one tick is a step at its middle, to second order
    t = np.arange(len(u)) * dt - 0.5 * dt
    expected = (80.0 * np.exp(-t / 5.73) - 5.73 * np.exp(-t / 80.0)) / (80.0 - 5.73)
    np.testing.assert_allclose(CANALS.sense(u, dt)[2:], expected[2:], atol=1e-5)


@given(arrays(np.float64, (2, 150), elements=st.floats(-10.0, 10.0)), st.floats(-3.0, 3.0))
def test_linear(pair: np.ndarray, gain: float) -> None:
    p, q = pair
    for organ in (CANALS, OTOLITHS):
        whole = organ.sense(p + gain * q, 0.01)
        np.testing.assert_allclose(
            whole, organ.sense(p, 0.01) + gain * organ.sense(q, 0.01), atol=1e-10
        )


@given(st.integers(0, 200))
def test_the_past_does_not_know_the_future(cut: int) -> None:
    u = np.sin(np.arange(400) * 0.1)
    other = u.copy()
    other[cut:] += 1.0
    for organ in (CANALS, OTOLITHS):
        np.testing.assert_allclose(
            organ.sense(u, 0.01)[max(cut, 1) - 1 : cut],
            organ.sense(other, 0.01)[max(cut, 1) - 1 : cut],
        )


def test_columns_of_a_table_are_sensed_like_arrays_of_their_own() -> None:
    table = np.random.default_rng(5).normal(size=(200, 7))
    np.testing.assert_array_equal(
        OTOLITHS.sense(table[:, 3], 0.01), OTOLITHS.sense(table[:, 3].copy(), 0.01)
    )


@given(
    st.lists(st.integers(0, 300), max_size=6).map(sorted), st.sampled_from([1e-3, 1.0 / 120.0, 0.1])
)
def test_a_signal_in_pieces_is_sensed_as_one(cuts: list[int], dt: float) -> None:
    u = 5.0 + np.cumsum(np.random.default_rng(len(cuts)).normal(size=300))
    for organ in (CANALS, OTOLITHS):
        sensing = Sensing(organ, dt)
        pieces = np.concatenate([sensing.sense(piece) for piece in np.split(u, cuts)])
        np.testing.assert_allclose(pieces, organ.sense(u, dt), rtol=0, atol=1e-12)


def test_no_ticks() -> None:
    assert CANALS.sense(np.empty(0), 0.01).shape == (0,)


def test_an_organ_of_one_lag() -> None:
    """1 / (2 s + 1) on a ramp from rest: t - 2 (1 - e^(-t / 2)), exactly."""
    t = np.arange(300) * 0.1
    lag = Organ(0.0, ((1.0, 2.0), (0.0, 1.0)))
    np.testing.assert_allclose(lag.sense(t, 0.1), t - 2.0 * (1.0 - np.exp(-t / 2.0)), atol=1e-12)
