"""Sinusoids are fitted to answers, with what they leave."""

from math import degrees, isnan

import numpy as np
import pytest
from frequency_tool import tool

TIME = np.arange(7000) / 100.0 + 40.0


FITTED = 0.9  # rad/s


ROUNDING = 20.0  # times what least squares on any processor must be forgiven; up to 5 were seen


def answer_to(gain: float, phase: float, amplitude: float, noise: float = 0.0) -> np.ndarray:
    """A known answer that has an offset and drifts."""
    answer = gain * amplitude * np.sin(FITTED * TIME + np.radians(phase)) + 5.0 - 0.3 * TIME
    return answer + noise * np.random.default_rng(1).standard_normal(TIME.size)


def fitted(answer: np.ndarray, amplitude: float) -> tuple[float, float, float]:
    found: tuple[float, float, float] = tool.fit(TIME, answer, FITTED, amplitude)
    return found


def rounding(answer: np.ndarray, amplitude: float) -> float:
    """The gain that rounding alone can make.

    The fit is backward stable, so it is eps of the answer over the least singular value.

    (Golub and Van Loan, Matrix Computations, 5.3.) The answer is mostly offset and drift, which are
    far above a small gain.
    """
    columns = np.column_stack(
        [np.sin(FITTED * TIME), np.cos(FITTED * TIME), TIME**0, TIME - TIME.mean()]
    )
    least = np.linalg.svd(columns, compute_uv=False)[-1]
    return ROUNDING * float(np.finfo(float).eps * np.linalg.norm(answer) / least) / abs(amplitude)


@pytest.mark.parametrize(("gain", "phase"), [(1.0, 0.0), (0.3, -120.0), (2.5, 75.0), (1e-6, 170.0)])
@pytest.mark.parametrize("amplitude", [0.02, -0.5])
def test_fit(gain: float, phase: float, amplitude: float) -> None:
    answer = answer_to(gain, phase, amplitude)
    noise = rounding(answer, amplitude)
    assert noise < 1e-5 * gain, "the case shows something"
    assert fitted(answer, amplitude) == (
        pytest.approx(gain, abs=noise, rel=0.0),
        pytest.approx(phase, abs=degrees(noise / gain), rel=0.0),
        pytest.approx(0.0, abs=noise),
    )


def test_what_the_fit_leaves_is_told() -> None:
    gain, phase, residual = fitted(answer_to(1.0, 20.0, 0.5, noise=0.01), 0.5)
    assert (gain, phase) == pytest.approx((1.0, 20.0), rel=5e-3)
    assert residual == pytest.approx(0.01 * 2**0.5 / 0.5, rel=0.05)


def test_no_answer_has_no_phase() -> None:
    assert isnan(fitted(answer_to(0.0, 0.0, 0.5), 0.5)[1])
    assert isnan(fitted(answer_to(0.001, 0.0, 0.5, noise=0.01), 0.5)[1])
