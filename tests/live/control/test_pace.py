"""How long a move home takes: within every limit of the platform, and calm.

What a move needs is found by sampling the polynomial 10 t^3 - 15 t^4 + 6 t^5, not by its peaks.
"""

import numpy as np
import pytest

from atlas_cueing.live.control.certified_axis import six_axes
from atlas_cueing.live.control.pace import Pace
from atlas_cueing.rotation import Mat3
from atlas_cueing.signals import StageLimits, WheelLimits

TURNS = ((2.0, 0.0, 0.0), (0.0, -1.0, 0.5), (0.0, 0.0, 0.0))  # rad
WAYS = ((0.0, 0.0, 0.0), (0.4, 0.0, -0.3))  # m
J_INVERSE: Mat3 = ((3.0, 0.0, 0.0), (0.0, 2.0, 1.0), (0.0, 0.0, 4.0))
HUGE = 1e6


def wheels(speed: float, acceleration: float, jerk: float) -> WheelLimits:
    return WheelLimits((speed,) * 3, (acceleration,) * 3, (jerk,) * 3)


def stage(speed: float, acceleration: float, jerk: float) -> StageLimits:
    return StageLimits((1.0,) * 3, (speed,) * 3, (acceleration,) * 3, (jerk,) * 3)


def peaks(distance: float, duration: float) -> list[float]:
    """Largest speed, acceleration and jerk of the move, by the polynomial's derivatives."""
    p = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
    t = np.linspace(0.0, 1.0, 2001)
    return [distance * np.abs(p.deriv(n)(t)).max() / duration**n for n in (1, 2, 3)]


@pytest.mark.parametrize("of", ["wheels", "stage"])
@pytest.mark.parametrize(
    "limits", [(0.8, HUGE, HUGE), (HUGE, 0.5, HUGE), (HUGE, HUGE, 0.4), (0.8, 0.5, 0.4)]
)
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("way", WAYS)
def test_a_move_takes_a_third_of_any_limit_at_most(
    of: str, limits: tuple[float, float, float], turn: tuple[float, ...], way: tuple[float, ...]
) -> None:
    """And no longer than that where nothing else asks for it."""
    fast = (HUGE, HUGE, HUGE)
    axes = six_axes(
        1e-3,
        wheels(*(limits if of == "wheels" else fast)),
        stage(*(limits if of == "stage" else fast)),
    )
    duration = Pace(J_INVERSE, axes).parking_time(turn, way, slowly=False)  # type: ignore[arg-type]
    distances = np.array(J_INVERSE) @ turn if of == "wheels" else np.array(way)
    distance = float(np.abs(distances).max())
    used = [peak / limit for peak, limit in zip(peaks(distance, duration), limits, strict=True)]
    assert max(used) <= 1.0 / 3.0
    if distance > 0.0:
        assert max(used) >= 0.25


@pytest.mark.parametrize("slowly", [False, True])
def test_on_a_fast_platform_it_is_calm(slowly: bool) -> None:
    """60 deg/s, half of that after a fault; a second at least for no way at all."""
    axes = six_axes(1e-3, wheels(HUGE, HUGE, HUGE), stage(HUGE, HUGE, HUGE))
    pace = Pace(J_INVERSE, axes)
    duration = pace.parking_time((2.0, 0.0, 0.0), (0.0, 0.0, 0.0), slowly)
    rate, _, _ = peaks(2.0, duration)
    assert rate == pytest.approx(np.radians(30.0 if slowly else 60.0), rel=1e-6)
    assert pace.parking_time((1e-4, 0.0, 0.0), (0.0, 0.0, 0.0), slowly) == 1.0
