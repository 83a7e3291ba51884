"""What follows from a sample and what does not."""

from dataclasses import replace
from itertools import pairwise
from math import radians

import pytest

from atlas_cueing.live.input.discontinuity import JUMP_FORCE, discontinuity
from atlas_cueing.rotation import exp, multiply
from atlas_cueing.signals import VehicleState

from ..motions import Motion

REST = VehicleState(0.0, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.80665))


@pytest.mark.parametrize("rate_hz", [10, 30, 120, 1000])
def test_a_lively_flight_follows(rate_hz: int) -> None:
    motion = Motion(4.0)
    samples = [motion.at(k / rate_hz) for k in range(4 * rate_hz)]
    for before, now in pairwise(samples):
        assert discontinuity(before, now) == ""


def test_an_attitude_that_the_rates_do_not_explain() -> None:
    now = replace(REST, time=1.0 / 120.0, q_NB=exp((0.0, radians(1.0), 0.0)))
    assert discontinuity(REST, now).startswith(
        "attitude jumped by 1 deg that the body rates do not explain"
    )
    assert discontinuity(REST, replace(now, q_NB=exp((0.0, radians(0.5), 0.0)))) == ""
    turning = [replace(state, w_NB_B=(0.0, radians(120.0), 0.0)) for state in (REST, now)]
    assert discontinuity(*turning) == ""


def test_a_reversed_turn_is_a_jump_and_a_sign_is_none() -> None:
    turning = replace(REST, w_NB_B=(2.0, 0.0, 0.0))
    forward, backward = (
        replace(turning, time=0.02, q_NB=exp((k * 0.04, 0.0, 0.0))) for k in (1, -1)
    )
    assert discontinuity(turning, forward) == ""
    assert discontinuity(turning, replace(forward, q_NB=tuple(-c for c in forward.q_NB))) == ""
    assert discontinuity(turning, backward) != ""


def test_jitter_of_the_time_is_granted_in_proportion_to_the_rate() -> None:
    turning = replace(REST, w_NB_B=(3.0, 0.0, 0.0))
    late = replace(turning, time=0.001, q_NB=exp((0.03, 0.0, 0.0)))  # 10 ms of turn in 1 ms
    assert discontinuity(turning, late) != ""
    assert discontinuity(turning, late, jitter=0.01) == ""
    assert discontinuity(REST, replace(late, w_NB_B=(0.0, 0.0, 0.0)), jitter=0.01) != ""


def test_a_long_gap_does_not_explain_everything() -> None:
    now = replace(REST, time=5.0, q_NB=multiply(REST.q_NB, exp((0.0, 0.0, radians(20.0)))))
    assert discontinuity(REST, now) != ""


def test_force() -> None:
    bump = replace(REST, time=0.01, f_B=(0.0, 0.0, -9.80665 - 0.99 * JUMP_FORCE))
    assert discontinuity(REST, bump) == ""
    crash = replace(bump, f_B=(0.0, JUMP_FORCE, 5.0))
    assert discontinuity(REST, crash).startswith("force jumped by")
