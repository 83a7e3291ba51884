"""Rotation and stage side by side, what every method promises, and what a user may choose."""

from dataclasses import FrozenInstanceError
from itertools import pairwise
from math import e, inf, pi, radians
from math import exp as power

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from atlas_cueing.cueing import METHODS as DECLARED
from atlas_cueing.cueing import (
    AttitudeParameters,
    BlendParameters,
    ClassicalParameters,
    Cueing,
    ForceParameters,
    PerceptualParameters,
    PlanParameters,
    RotationParameters,
    SlowTurnParameters,
    StageParameters,
    build_cueing,
)
from atlas_cueing.rotation import IDENTITY, ZERO, Quat, Vec3, exp, from_euler
from atlas_cueing.signals import Cue, StageLimits, VehicleState

from .vehicles import LEVEL, manoeuvring, standing, wild

LIMITS = StageLimits((1.0, 1.0, 0.75), (1.5, 1.5, 1.2), (6.0, 6.0, 5.0), (60.0, 60.0, 50.0))
METHODS = [
    defaults
    for method in DECLARED.values()
    if not isinstance(defaults := method.defaults, PlanParameters)
]
FOUR = (AttitudeParameters(), BlendParameters(), ForceParameters(), ClassicalParameters())
NO_LIMIT = ClassicalParameters(angle_limit=inf)
Sequence = list[tuple[Quat, Vec3, Vec3]]


def name(method: RotationParameters) -> str:
    return type(method).__name__.removesuffix("Parameters").lower()


def make(method: RotationParameters, dt: float) -> Cueing:
    return build_cueing(method, StageParameters(), LIMITS, (0.1, 0.0, 0.6), dt)


def ask(method: RotationParameters, sequence: Sequence, dt: float) -> list[Cue]:
    """Each state held for two ticks, so that both jumps and standing are in it."""
    cueing = make(method, dt)
    states = [state for state in sequence for _ in range(2)]
    return [cueing.step(VehicleState(i * dt, *state)) for i, state in enumerate(states)]


def check(cue: Cue) -> None:
    numbers = [*cue.q_WS, *cue.w_WS_W, *cue.p_WS_W, *cue.v_WS_W, *cue.a_WS_W]
    assert np.all(np.isfinite(numbers)), cue
    assert sum(x * x for x in cue.q_WS) == pytest.approx(1.0, abs=1e-9)
    for state, limit in (
        (cue.p_WS_W, LIMITS.travel),
        (cue.v_WS_W, LIMITS.speed),
        (cue.a_WS_W, LIMITS.acceleration),
    ):
        assert np.all(np.abs(state) <= limit)


@pytest.mark.parametrize("method", [*METHODS, NO_LIMIT], ids=name)
@given(sequence=wild(490.0, 50.0), dt=st.sampled_from([1e-3, 1.0 / 120.0]))
def test_any_believable_states_give_a_cue_whose_sign_does_not_jump(
    method: RotationParameters, sequence: Sequence, dt: float
) -> None:
    """50 g and 50 rad/s, and an attitude that has nothing to do with either."""
    cues = ask(method, sequence, dt)
    for cue in cues:
        check(cue)
    for before, now in pairwise(cues):
        assert np.dot(before.q_WS, now.q_WS) > -1e-9


@pytest.mark.parametrize("method", [*METHODS, NO_LIMIT], ids=name)
@given(sequence=wild(1e30, 1e30))
def test_absurd_states_give_a_finite_cue(method: RotationParameters, sequence: Sequence) -> None:
    for cue in ask(method, sequence, 0.01):
        check(cue)


@pytest.mark.parametrize("method", METHODS, ids=name)
@pytest.mark.parametrize("huge", [1e160, 1e308])
def test_any_finite_force_gives_a_finite_cue(method: RotationParameters, huge: float) -> None:
    """A recorded log may hold anything that is a number."""
    for f_B in ((huge, 0.0, 0.0), (huge, -huge, huge), (0.0, 0.0, huge)):
        for cue in ask(
            method, [(IDENTITY, ZERO, LEVEL), (IDENTITY, ZERO, f_B), (IDENTITY, ZERO, LEVEL)], 0.01
        ):
            check(cue)


def turned_away(method: RotationParameters, dt: float, push: float = 1.0) -> float:
    """Largest angle in ten seconds from the integral of the rate, by the trapezoid in W."""
    cueing = build_cueing(method, StageParameters(), LIMITS, ZERO, dt)
    cues = [cueing.step(vehicle) for vehicle in manoeuvring(dt, 10.0, push)]
    q, worst = Rotation.from_quat(np.roll(cues[0].q_WS, -1)), 0.0
    for i, (before, now) in enumerate(pairwise(cues)):
        assert np.dot(before.q_WS, now.q_WS) > 0.9
        q = Rotation.from_rotvec(0.5 * dt * np.add(before.w_WS_W, now.w_WS_W)) * q
        if i % 10 == 0:
            worst = max(
                worst, float((q.inv() * Rotation.from_quat(np.roll(now.q_WS, -1))).magnitude())
            )
    return worst


@pytest.mark.parametrize(
    "method",
    [*FOUR[:3], PerceptualParameters(), ClassicalParameters(tilt_gain=ZERO)],
    ids=name,
)
def test_the_orientation_is_the_integral_of_the_rate_to_second_order(
    method: RotationParameters,
) -> None:
    """Half the tick, a quarter of the difference.

    Whoever feeds the rate forward gets the orientation.
    """
    coarse, fine = turned_away(method, 1.0 / 50.0), turned_away(method, 1.0 / 100.0)
    assert coarse < 2e-3
    assert coarse / fine > 3.0


def test_a_tilt_whose_rate_jumps_is_the_integral_of_the_rate_to_first_order() -> None:
    """`classical` limits its tilt's rate, not the acceleration.

    Each jump of 3 deg/s is off by half a tick of it.
    """
    assert (
        turned_away(ClassicalParameters(rotation_gain=ZERO), 1.0 / 100.0, 3.0)
        < 0.5 * 0.01 * 2.0 * radians(3.0) * 2.0
    )


@pytest.mark.parametrize("method", METHODS, ids=name)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_both_signs_of_the_vehicle_s_quaternion_are_one_attitude(
    method: RotationParameters, sign: float
) -> None:
    """Also where the sign changes in mid-flight."""
    plain, flipping = make(method, 0.02), make(method, 0.02)
    for i, vehicle in enumerate(manoeuvring(0.02, 6.0)):
        q = tuple((sign if i % 7 else -sign) * x for x in vehicle.q_NB)
        one, other = (
            plain.step(vehicle),
            flipping.step(VehicleState(vehicle.time, q, vehicle.w_NB_B, vehicle.f_B)),
        )  # type: ignore[arg-type]
        assert abs(np.dot(one.q_WS, other.q_WS)) == pytest.approx(1.0, abs=1e-12)
        assert one.w_WS_W == pytest.approx(other.w_WS_W, abs=1e-6)


@pytest.mark.parametrize("method", METHODS, ids=name)
def test_a_vehicle_at_rest_asks_for_nothing(method: RotationParameters) -> None:
    cueing = build_cueing(method, StageParameters(), LIMITS, ZERO, 0.01)
    for vehicle in standing(from_euler(1.0, 0.0, 0.0), LEVEL, 0.01, 200, since=3.0):
        cue = cueing.step(vehicle)
        assert cue.time == vehicle.time
        assert np.abs(np.dot(cue.q_WS, IDENTITY)) == pytest.approx(1.0)
        assert np.allclose([cue.w_WS_W, cue.p_WS_W, cue.v_WS_W, cue.a_WS_W], 0.0, atol=1e-12)


def test_the_methods_differ_where_they_should() -> None:
    """Banked with the force along the seat: `attitude` banks, the others stand upright."""
    banked = VehicleState(0.0, exp((0.5, 0.0, 0.0)), ZERO, (0.0, 0.0, -11.0))
    turned = [
        build_cueing(m, StageParameters(), LIMITS, ZERO, 0.01).step(banked).q_WS for m in FOUR
    ]
    assert turned[0] == pytest.approx(exp((0.5, 0.0, 0.0)))
    for q_WS in turned[1:]:
        assert q_WS == pytest.approx(IDENTITY, abs=1e-12)


def test_they_turn_with_a_turn_as_they_should() -> None:
    """A second of roll, the force along the seat.

    All of it, all but the slow turn, nothing, and a washed-out part.
    """
    rolled = []
    for method in FOUR:
        cueing = build_cueing(method, StageParameters(), LIMITS, ZERO, 0.01)
        for i in range(101):
            cue = cueing.step(
                VehicleState(
                    0.01 * i, exp((0.002 * i, 0.0, 0.0)), (0.2 if i else 0.0, 0.0, 0.0), LEVEL
                )
            )
        rolled.append(float(Rotation.from_quat(np.roll(cue.q_WS, -1)).magnitude()))
    attitude, blend, force, classical = rolled
    assert attitude == pytest.approx(0.2, abs=0.002)
    assert 0.2 - radians(3.0) < blend < 0.2 - radians(1.0)
    assert force < 1e-9
    limit = radians(25.0)
    assert classical == pytest.approx(limit * np.tanh(0.12 * power(-1.0) / limit), rel=0.02)


def test_the_stage_knows_where_the_head_is() -> None:
    """Spinning up in place accelerates a head off the axis, unlike the vehicle."""
    moved = []
    for head in (ZERO, (0.5, 0.0, 0.0)):
        cueing = build_cueing(AttitudeParameters(), StageParameters(), LIMITS, head, 0.01)
        cue = [
            cueing.step(
                VehicleState(
                    0.01 * i, exp((0.0, 0.0, 0.5 * (0.01 * i) ** 2)), (0.0, 0.0, 0.01 * i), LEVEL
                )
            )
            for i in range(100)
        ][-1]
        moved.append(max(abs(x) for x in cue.p_WS_W))
    assert moved[0] < 1e-9
    assert moved[1] > 1e-3


def test_parameters_are_what_their_sources_say_and_do_not_change() -> None:
    turn = SlowTurnParameters()
    assert turn.rate == radians(3.0)
    assert (turn.time, turn.smoothing) == (2.0, 0.25)
    # per second: what the customary 3 deg/s sets in with
    assert 2.0 * turn.rate / (e * turn.smoothing) < radians(9.0)
    assert BlendParameters().turn == AttitudeParameters().turn == turn
    assert ForceParameters().turn.rate == pi
    stage = StageParameters()
    assert LIMITS.travel[0] * max(stage.recentre) ** 2 < 0.063
    with pytest.raises(FrozenInstanceError):
        turn.rate = 1.0  # type: ignore[misc]
