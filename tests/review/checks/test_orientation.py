"""Orientation checks on a motion known in closed form.

Body and base rates and the order of turns all matter in it.
"""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.review import RecordedRun
from atlas_cueing.review.checks.orientation import check_orientation, tick_error, unexplained
from atlas_cueing.review.own_rotations import turned, turned_back

from ..runs import coning, with_flight


def left(run: RecordedRun) -> float:
    return float(np.abs(unexplained(run, run.flight.motion_w_W, run.flight.motion_alpha_W)).max())


@pytest.mark.parametrize("dt", [0.001, 0.01, 0.05])
def test_a_true_motion_is_explained(dt: float) -> None:
    run = coning(401, dt)
    assert check_orientation(run) == []
    assert left(run) < tick_error(run).min()


def test_what_is_left_is_of_fifth_order() -> None:
    """A cone is smooth, so halving the step takes what is left down by 32.

    Without the commutator it would be 8.
    """
    assert left(coning(101, 0.1)) / left(coning(201, 0.05)) == pytest.approx(32.0, rel=0.1)


def test_body_rates_are_not_base_rates() -> None:
    run = coning()
    body = replace(
        run.flight, motion_w_W=turned_back(run.flight.motion_q_WS, run.flight.motion_w_W)
    )
    found, *_ = check_orientation(with_flight(run, body))
    assert found.check == "orientation is not the integral of Omega"


def test_wheels_that_creep_are_found_by_their_sum_alone() -> None:
    """Each tick is within its own bound; after five thousand the sum is not."""
    run = coning(6001, 0.01)
    creep = 0.3 * tick_error(run).min() / 0.01  # rad/s
    extra = turned(run.flight.motion_q_WS, np.array([creep, 0.0, 0.0])) @ run.wheels_from_sphere().T
    wheels = run.flight.wheel_speed + extra
    (found,) = check_orientation(with_flight(run, replace(run.flight, wheel_speed=wheels)))
    assert found.check == "orientation is not the integral of the wheels"
    fair = run.flight.wheel_speed + 0.1 * extra
    assert check_orientation(with_flight(run, replace(run.flight, wheel_speed=fair))) == []


def test_drift_is_told_as_an_angle() -> None:
    """1 mrad/s about the cabin's own x: 6 mrad after 6 s, however the cabin has turned."""
    run = coning()
    extra = turned(run.flight.motion_q_WS, np.array([1e-3, 0.0, 0.0])) @ run.wheels_from_sphere().T
    (found,) = check_orientation(
        with_flight(run, replace(run.flight, wheel_speed=run.flight.wheel_speed + extra))
    )
    size = float(found.text.split("drift = ")[1].split()[0])
    assert found.time is not None
    assert size == pytest.approx(1e-3 * found.time, rel=1e-3)


def test_half_a_turn_either_way_is_no_flip() -> None:
    run = coning(2000, 0.01)
    assert np.min(run.flight.motion_q_WS[:, 0]) < -0.3
    assert check_orientation(run) == []


def test_one_tick_has_no_integral() -> None:
    run = coning(1)
    assert check_orientation(run) == []
