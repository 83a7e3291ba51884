"""The whole plan: inside its limits, consistent, and better than causal methods."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from atlas_cueing.cueing import (
    AttitudeParameters,
    BlendParameters,
    MethodParameters,
    StageParameters,
    build_cueing,
)
from atlas_cueing.cueing.preview.motion_plan import _product
from atlas_cueing.errors import InputError
from atlas_cueing.rotation import ZERO, Vec3, from_euler
from atlas_cueing.signals import Cue, VehicleState, felt

from ..vehicles import level_turn, manoeuvring, standing
from .flights import (
    DEFAULT,
    DT,
    FAST,
    HEAD,
    LIMITS,
    QUICK,
    G,
    Planned,
    cost,
    flying,
    planned,
    rolling,
    tilting,
)


def check(found: Planned) -> None:
    """Limits, rest at both ends, and each column the derivative of the one before."""
    for values, limit in (
        (found.p, LIMITS.travel),
        (found.v, LIMITS.speed),
        (found.a, LIMITS.acceleration),
    ):
        assert np.all(np.abs(values) <= np.array(limit))
    assert np.all(np.abs(np.diff(found.a, axis=0)) <= np.array(LIMITS.jerk) * DT)
    assert np.allclose(
        [found.p[0], found.v[0], found.a[0], found.v[-1], found.a[-1]], 0.0, atol=1e-6
    )
    assert np.allclose(
        np.diff(found.p, axis=0), 0.5 * DT * (found.v[1:] + found.v[:-1]), atol=DT**3 * 60.0
    )
    assert np.allclose(
        np.diff(found.v, axis=0), 0.5 * DT * (found.a[1:] + found.a[:-1]), atol=DT**2 * 60.0
    )
    assert np.allclose(np.linalg.norm(found.q, axis=1), 1.0)
    assert np.all(np.sum(found.q[1:] * found.q[:-1], axis=1) > 0.0)


def turned_away(found: Planned) -> float:
    """Largest angle between the orientation and the integral of the rate, by the trapezoid in W."""
    q = Rotation.from_quat(np.roll(found.q[0], -1))
    steps = Rotation.from_rotvec(0.5 * DT * (found.w[1:] + found.w[:-1]))
    worst = 0.0
    for i, step in enumerate(steps, start=1):
        q = step * q
        worst = max(
            worst, float((q.inv() * Rotation.from_quat(np.roll(found.q[i], -1))).magnitude())
        )
    return worst


def lived(method: MethodParameters, states: list[VehicleState], head: Vec3 = ZERO) -> float:
    """What the flight costs by a method that knows only the past."""
    cueing = build_cueing(method, StageParameters(), LIMITS, head, DT)
    cues: list[Cue] = [cueing.step(state) for state in states]
    w = np.array([cue.w_WS_W for cue in cues])
    f, rate = felt(
        [cue.q_WS for cue in cues],
        w,
        np.gradient(w, DT, axis=0),
        [cue.a_WS_W for cue in cues],
        head,
    )
    return cost(f - [state.f_B for state in states], rate - [state.w_NB_B for state in states])


FLIGHTS = {
    "tilting": tilting(),
    "rolling": rolling(),
    "manoeuvring": list(manoeuvring(DT, 14.0)),
    "turn": list(level_turn(0.5, 60.0, DT, 601)),
    "free fall": flying(10.0, lambda t: (0.0, 0.0, -G if abs(t - 5.0) > 2.0 else 0.0)),
}


@pytest.mark.parametrize("name", FLIGHTS)
@pytest.mark.parametrize("head", [ZERO, HEAD], ids=["centre", "head"])
def test_it_keeps_its_limits_and_beats_those_who_do_not_know_the_future(
    name: str, head: Vec3
) -> None:
    states = FLIGHTS[name]
    found = planned(states, QUICK, head=head)
    check(found)
    extra = np.linalg.norm(found.rate_error, axis=1)
    assert np.max(extra) <= QUICK.rate
    assert turned_away(found) < 2e-3
    for method in (BlendParameters(), AttitudeParameters()):
        assert cost(found.force_error, found.rate_error) < lived(method, states, head)


def test_as_fast_as_method_force_it_follows_the_force() -> None:
    """Rolls with the force along the seat: the cabin stands still.

    A rate of 3 deg/s would turn it over.
    """
    slow, fast = planned(rolling(), replace(QUICK)), planned(rolling(), FAST)
    check(fast)
    assert cost(fast.force_error, fast.rate_error) < cost(slow.force_error, slow.rate_error)


@given(
    forces=st.lists(st.tuples(*[st.floats(-60.0, 60.0)] * 3), min_size=2, max_size=6),
    rates=st.lists(st.tuples(*[st.floats(-4.0, 4.0)] * 3), min_size=6, max_size=6),
)
@settings(max_examples=8, deadline=None)
def test_any_flight_gets_a_plan_inside_its_limits(forces: list[Vec3], rates: list[Vec3]) -> None:
    """Forces and rates that jump, through zero too, or a clear error."""
    states = [
        VehicleState(
            i * DT, (1.0, 0.0, 0.0, 0.0), rates[i // 40 % 6], forces[i // 40 % len(forces)]
        )
        for i in range(240)
    ]
    found = planned(states, QUICK)
    check(found)
    assert np.max(np.linalg.norm(found.rate_error, axis=1)) <= QUICK.rate


@pytest.mark.parametrize("count", [1, 2, 3, 7])
def test_short_flights(count: int) -> None:
    found = planned(list(standing(from_euler(0.4, 0.2, 0.3), (0.5, 0.0, -G), DT, count)))
    assert len(found.cues) == count


def test_at_rest_it_asks_for_nothing() -> None:
    found = planned(list(standing(from_euler(1.0, 0.0, 0.0), (0.0, 0.0, -G), DT, 300)))
    assert np.allclose(np.abs(found.q[:, 0]), 1.0)
    assert np.allclose([found.w, found.p, found.v, found.a], 0.0, atol=1e-5)


def test_the_cabin_begins_with_the_vehicle_s_heading_as_its_own() -> None:
    """And turned to the first force as `blend` is."""
    states = list(
        standing(from_euler(2.0, 0.3, 0.0), (G * np.sin(0.3), 0.0, -G * np.cos(0.3)), DT, 100)
    )
    found = planned(states)
    expected = build_cueing(BlendParameters(), StageParameters(), LIMITS, ZERO, DT).step(states[0])
    assert found.cues[0].q_WS == pytest.approx(expected.q_WS, abs=1e-6)


def test_a_jump_of_the_attitude_is_not_chased() -> None:
    """A trim in mid-run: rates and forces are what the plan goes by."""
    states = list(standing(from_euler(0.0, 0.0, 0.0), (0.0, 0.0, -G), DT, 300))
    jumped = states[:150] + [
        replace(state, q_NB=from_euler(1.0, 0.5, -2.0)) for state in states[150:]
    ]
    assert [cue.q_WS for cue in planned(jumped).cues] == [cue.q_WS for cue in planned(states).cues]


def test_the_same_flight_gets_the_same_plan_to_the_last_bit() -> None:
    assert (
        planned(FLIGHTS["manoeuvring"], QUICK).cues == planned(FLIGHTS["manoeuvring"], QUICK).cues
    )


@pytest.mark.parametrize("bad", [float("inf"), float("nan"), -1e7, 1e308])
def test_forces_that_nothing_has_get_no_plan(bad: float) -> None:
    with pytest.raises(InputError, match=r"no plan .* at 0\.5 s force"):
        planned(flying(1.0, lambda t: (0.0, 0.0, -G if t < 0.49 else bad)))
    with pytest.raises(InputError, match=r"no plan .* at 0\.5 s force"):
        planned(
            flying(1.0, lambda _: (0.0, 0.0, -G), lambda t: (0.0, 0.0, 0.0 if t < 0.49 else bad))
        )


def test_the_head_is_where_the_force_is_felt() -> None:
    """Spinning up about the vertical accelerates a head off the axis.

    The stage takes it back.
    """

    def spin(t: float) -> Vec3:
        return (0.0, 0.0, 0.3 * t)

    states = flying(6.0, lambda _: (0.0, 0.0, -G), spin)
    centre, off = planned(states, QUICK), planned(states, QUICK, head=(0.8, 0.0, 0.0))
    assert np.max(np.abs(centre.p)) < 1e-4
    assert np.max(np.abs(off.p)) > 0.02
    assert radians(0.1) < np.max(np.linalg.norm(off.rate_error, axis=1)) <= QUICK.rate
    assert DEFAULT.rate == QUICK.rate


def test_products_are_compositions() -> None:
    p, q = (Rotation.random(20, rng=np.random.default_rng(seed)) for seed in (1, 2))
    rows = _product(p.as_quat(scalar_first=True), q.as_quat(scalar_first=True))
    found = Rotation.from_quat(rows, scalar_first=True)
    assert np.max((found.inv() * (p * q)).magnitude()) < 1e-14
