"""A committee of laws: with one that knows, the cabin goes there; with a stranger, it does not."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from atlas_cueing.cueing import AttitudeParameters, BlendParameters, StillParameters
from atlas_cueing.cueing.committee.committee import COMMITTEE, Committee, CommitteeParameters
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    angle_between,
    conjugate,
    exp,
    flip,
    multiply,
    norm,
    rotate,
    subtract,
)
from atlas_cueing.signals import VehicleState

from ..vehicles import LEVEL, manoeuvring, spinning, up_in_cabin

DT = 0.02


class Turned:
    """A law that stands turned, whatever the vehicle does."""

    def __init__(self, turn: Vec3) -> None:
        self._q_WS = exp(turn)

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:  # noqa: ARG002 - as every law
        return self._q_WS, ZERO


def free(dt: float, seconds: float) -> list[VehicleState]:
    """A vehicle that turns about a point at rest: its force is gravity, the attitude is right."""
    flight = manoeuvring(dt, seconds)
    return [
        VehicleState(v.time, v.q_NB, v.w_NB_B, rotate(conjugate(v.q_NB), LEVEL)) for v in flight
    ]


@pytest.mark.parametrize("judge", ["observer", "organs"])
def test_a_member_that_is_right_draws_the_cabin_to_it(judge: str) -> None:
    """Though a wrong one was trusted at the start."""
    parameters = replace(COMMITTEE, loss=replace(COMMITTEE.loss, judge=judge))
    laws = [StillParameters().rotation(DT), AttitudeParameters().rotation(DT)]
    committee, off, rates = Committee(DT, laws, parameters), [], []
    for vehicle in free(DT, 60.0):
        q_WS, w_W = committee.step(vehicle)
        off.append(angle_between(up_in_cabin(q_WS), flip(vehicle.f_B)))
        rates.append(norm(subtract(rotate(conjugate(q_WS), w_W), flip(vehicle.w_NB_B))))
    assert max(off) > radians(15.0)
    assert committee.shares[1] > 0.98
    assert max(off[-500:]) < radians(2.0)
    assert max(rates[-500:]) < radians(3.0)


def test_a_law_alone_is_followed_exactly() -> None:
    alone = AttitudeParameters().rotation(DT)
    committee = Committee(DT, [AttitudeParameters().rotation(DT)], COMMITTEE)
    for vehicle in free(DT, 20.0):
        q_WS, w = committee.step(vehicle)
        p_WS, v = alone.step(vehicle)
        assert angle_between(up_in_cabin(q_WS), up_in_cabin(p_WS)) < radians(0.05)
        assert rotate(conjugate(q_WS), w) == pytest.approx(rotate(conjugate(p_WS), v), abs=1e-3)


def test_a_member_that_comes_twice_changes_nothing_but_its_prior() -> None:
    """Its share is that of both, and with both trusted from the start all is as with one."""
    start = CommitteeParameters(weights=replace(COMMITTEE.weights, start=0.0, contrast=0.0))
    one = Committee(DT, [law(0.2), law(-0.1), law(-0.1)], start)
    both = Committee(DT, [law(0.2), law(-0.1), law(-0.1), law(0.2), law(-0.1), law(-0.1)], start)
    for vehicle in free(DT, 5.0):
        q_WS, w = one.step(vehicle)
        p_WS, v = both.step(vehicle)
        assert q_WS == pytest.approx(p_WS, abs=1e-12)
        assert w == pytest.approx(v, abs=1e-12)
    assert sum(one.shares) == pytest.approx(1.0)


def law(roll: float) -> Turned:
    return Turned((roll, 0.0, 0.0))


def test_members_that_point_apart_are_met_in_the_middle() -> None:
    still = replace(COMMITTEE, weights=replace(COMMITTEE.weights, contrast=0.0))
    committee = Committee(DT, [law(0.3), law(-0.3)], still)
    for i in range(2000):
        q_WS, w = committee.step(VehicleState(i * DT, IDENTITY, ZERO, LEVEL))
    assert angle_between(up_in_cabin(q_WS), (0.0, 0.0, 1.0)) < 1e-3
    assert norm(w) < 1e-3


def test_members_that_are_opposed_leave_the_cabin_where_it_is() -> None:
    still = replace(COMMITTEE, weights=replace(COMMITTEE.weights, contrast=0.0))
    committee = Committee(DT, [law(np.pi / 2), law(-np.pi / 2)], still)
    for i in range(2000):
        q_WS, w = committee.step(VehicleState(i * DT, IDENTITY, ZERO, LEVEL))
    assert q_WS == pytest.approx(IDENTITY, abs=1e-6)
    assert w == pytest.approx(ZERO, abs=1e-6)


def test_the_heading_of_a_member_does_not_count() -> None:
    """Only ups and rates are averaged, in the cabin's own axes."""
    ways = []
    for yaw in (0.0, 2.0):
        members = [law(0.1), Turned((0.0, 0.0, yaw))]
        committee = Committee(DT, members, replace(COMMITTEE))
        flight = spinning(multiply(exp((0.1, 0.0, 0.0)), IDENTITY), (0.2, 0.1, 0.0), DT, 500)
        ways.append([committee.step(vehicle) for vehicle in flight])
    for (q_WS, w), (p_WS, v) in zip(*ways, strict=True):
        assert q_WS == pytest.approx(p_WS, abs=1e-12)
        assert w == pytest.approx(v, abs=1e-12)


def test_blend_alone_is_followed_where_it_has_to_turn() -> None:
    alone = BlendParameters().rotation(DT)
    committee = Committee(DT, [BlendParameters().rotation(DT)], COMMITTEE)
    for vehicle in manoeuvring(DT, 30.0, push=2.0):
        q_WS = committee.step(vehicle)[0]
        p_WS = alone.step(vehicle)[0]
    assert angle_between(up_in_cabin(q_WS), up_in_cabin(p_WS)) < radians(0.2)
