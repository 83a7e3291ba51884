"""A motion that lags and does not say so."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.review.checks.limited_flags import ANGLE, DISTANCE, check_limited_flags
from atlas_cueing.review.own_rotations import from_vector, product

from ..runs import coning, with_flight


def lagging(
    angle: float, distance: float, limited: tuple[float, float], axis: int = 1
) -> list[tuple[str, float | None]]:
    """The run whose cue is ahead from 2 s to 3 s."""
    run = coning()
    rows = (run.flight.time >= 2.0) & (run.flight.time < 3.0)
    ahead = np.zeros((len(rows), 3))
    ahead[rows, axis] = 1.0
    flight = replace(
        run.flight,
        cue_q_WS=product(from_vector(angle * ahead), run.flight.cue_q_WS),
        cue_p_W=run.flight.cue_p_W + distance * ahead,
        limited=np.where(rows[:, None], np.array(limited), 0.0),
    )
    return [
        (finding.place, finding.time) for finding in check_limited_flags(with_flight(run, flight))
    ]


def test_a_run_that_keeps_up() -> None:
    assert check_limited_flags(coning()) == []


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_lag_that_is_not_told(sign: float, axis: int) -> None:
    place = f"/motion p{'xyz'[axis]}_m"
    assert lagging(1.01 * ANGLE * sign, 0.0, (0.0, 0.0), axis)[0][0] == "/motion q_ws"
    assert lagging(0.0, 1.01 * DISTANCE * sign, (0.0, 0.0), axis)[0][0] == place
    assert lagging(0.99 * ANGLE * sign, 0.99 * DISTANCE * sign, (0.0, 0.0), axis) == []


def test_each_flag_answers_for_its_own_part() -> None:
    assert lagging(0.1, 0.1, (1.0, 1.0)) == []
    assert [place for place, _ in lagging(0.1, 0.1, (0.0, 1.0))] == ["/motion q_ws"]
    assert [place for place, _ in lagging(0.1, 0.1, (1.0, 0.0))] == ["/motion py_m"]


def test_the_place_in_time() -> None:
    (_, time), *_ = lagging(0.1, 0.0, (0.0, 0.0))
    assert time is not None
    assert 2.0 <= time < 3.0
