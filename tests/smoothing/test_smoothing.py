"""For any input every limit holds by finite differences and all is finite.

|q| = 1, and the sign of q is continuous.
"""

from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.errors import PlanningError
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.signals import Cue, StageLimits, WheelLimits

from .cues import BAD, UPRIGHT, cue, smooth, wild
from .flights import check, fly
from .platforms import EQUILATERAL, PLATFORMS, Platform, equilateral_rows

NAMES = [field.name for field in fields(Cue)]
TICKS = [1.0 / 1000.0, 1.0 / 500.0, 1.0 / 120.0, 1.0 / 60.0, 1.0 / 20.0]


def test_a_hundred_thousand_random_ticks() -> None:
    """Three platforms, five tick lengths, every kind of cue.

    The limits are also reached, so that the test could fail.
    """
    ticks, worst = 0, {}
    for seed in range(68):
        random = np.random.default_rng(seed)
        dt = TICKS[seed % len(TICKS)]
        for platform in PLATFORMS.values():
            flight = fly(platform, dt, wild(dt, 500, random))
            ticks += len(flight.time)
            for name, share in check(platform, flight).items():
                worst[name] = max(worst.get(name, 0.0), share.max())
    assert ticks >= 100_000
    reached = {name: share for name, share in worst.items() if "fit" not in name}
    assert len(reached) == 7
    assert min(reached.values()) > 0.99, reached
    assert min(worst.values()) > 0.3, worst


number = st.floats() | st.sampled_from(BAD)
unit = st.tuples(*(st.floats(-1.0, 1.0),) * 4).filter(lambda q: np.hypot.reduce(q) > 0.1)
quaternions = unit.map(lambda q: tuple((np.array(q) / np.hypot.reduce(q)).tolist())) | st.tuples(
    *(number,) * 4
)
vectors = st.tuples(*(st.floats(-5.0, 5.0),) * 3) | st.tuples(*(number,) * 3)
cues = st.builds(Cue, number, quaternions, vectors, vectors, vectors, vectors)
positive = st.floats(0.5, 20.0)
triples = st.tuples(positive, positive, positive)


@st.composite
def platforms(draw: st.DrawFn) -> Platform:
    """Any limits for each wheel and axis, whether or not they can be reached.

    Seconds to reach the speed, tenths of a second to reach the acceleration, or not at all.
    """
    wheels = np.array([draw(triples) for _ in range(3)]) * [[3.0], [5.0], [20.0]]
    stage = np.array([draw(triples) for _ in range(3)]) * [[1.0], [1.0], [5.0]]
    layout = draw(st.sampled_from(["equilateral", "orthogonal"]))
    return Platform(
        equilateral_rows() if layout == "equilateral" else np.diag([9.67] * 3),
        WheelLimits(*(tuple(row.tolist()) for row in wheels)),
        StageLimits(draw(triples), *(tuple(row.tolist()) for row in stage)),
    )


@settings(max_examples=40, deadline=None)
@given(
    platforms(),
    st.sampled_from(TICKS),
    st.lists(st.tuples(cues, st.integers(1, 40)), min_size=1, max_size=25),
)
def test_any_cues_on_any_platform(
    platform: Platform, dt: float, spells: list[tuple[Cue, int]]
) -> None:
    check(platform, fly(platform, dt, [UPRIGHT, *(c for asked, n in spells for c in [asked] * n)]))


@pytest.mark.parametrize("field", ["time", "q_WS", "w_WS_W", "p_WS_W", "v_WS_W", "a_WS_W"])
@pytest.mark.parametrize("bad", BAD)
def test_one_bad_number_at_a_time(field: str, bad: float) -> None:
    """In the midst of a good cue, for one tick and for many.

    Afterwards the good cue is met again.
    """
    dt = 1.0 / 60.0
    asked = smooth(dt, 900, np.random.default_rng(1))
    for at, length in ((240, 1), (300, 60)):
        for n in range(at, at + length):
            good = getattr(asked[n], field)
            spoilt = bad if field == "time" else (bad, *good[1:])
            asked[n] = Cue(**{name: getattr(asked[n], name) for name in NAMES} | {field: spoilt})
    flight = fly(EQUILATERAL, dt, asked)
    check(EQUILATERAL, flight)
    assert np.all(flight.limited[-1] == 0.0)
    np.testing.assert_allclose(flight.p[-1], asked[-1].p_WS_W, atol=1e-5)
    assert abs(np.dot(flight.q[-1], asked[-1].q_WS)) > 1.0 - 1e-9


def test_a_bad_stage_does_not_stop_the_sphere_nor_the_other_way_round() -> None:
    dt, nan = 1.0 / 120.0, np.full(3, np.nan)
    zero = np.zeros(3)
    half = np.array([0.5, 0.0, 0.0])
    turned = np.array([0.0, 1.0, 0.0, 0.0])
    for q, p in ((turned, nan), (np.full(4, np.nan), half)):
        flight = fly(EQUILATERAL, dt, [UPRIGHT] + [cue(0.0, q, zero, p, zero, zero)] * 1200)
        check(EQUILATERAL, flight)
        sphere_moved, stage_moved = (
            abs(flight.q[-1][1]) > 0.999999,
            abs(flight.p[-1][0] - 0.5) < 1e-6,
        )
        assert (sphere_moved, stage_moved) == (p is nan, p is half)
        assert tuple(flight.limited[-1]) == (float(p is half), float(p is nan))


def test_it_starts_at_rest_on_the_first_cue() -> None:
    first = Cue(5.0, (0.0, 0.6, 0.0, 0.8), (1.0, 0.0, 0.0), (0.3, 0.0, 0.0), ZERO, ZERO)
    smoothing = EQUILATERAL.smoothing(0.01)
    motion = smoothing.step(first)
    assert (motion.time, motion.q_WS) == (5.0, pytest.approx(first.q_WS))
    assert motion.p_WS_W == (0.3, 0.0, 0.0)
    assert motion.w_WS_W == motion.alpha_WS_W == motion.v_WS_W == motion.a_WS_W == ZERO
    times = [smoothing.step(first).time for _ in range(3)]
    assert times == pytest.approx([5.01, 5.02, 5.03])


@pytest.mark.parametrize(
    ("asked", "begun"), [(7.0, 1.0), (-7.0, -1.0), (np.nan, 0.0), (np.inf, 0.0)]
)
def test_it_starts_inside_the_travel(asked: float, begun: float) -> None:
    smoothing = EQUILATERAL.smoothing(0.01)
    travel = EQUILATERAL.stage.travel[1]
    motion = smoothing.step(Cue(0.0, IDENTITY, ZERO, (0.0, asked, 0.0), ZERO, ZERO))
    assert motion.p_WS_W == pytest.approx((0.0, begun * travel, 0.0), abs=1e-4)
    assert abs(motion.p_WS_W[1]) <= travel


@pytest.mark.parametrize("q", [(np.nan, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), (2.0, 0.0, 0.0, 0.0)])
def test_a_first_cue_that_is_no_orientation_is_refused(
    q: tuple[float, float, float, float],
) -> None:
    smoothing = EQUILATERAL.smoothing(0.01)
    with pytest.raises(PlanningError, match="first cue"):
        smoothing.step(Cue(0.0, q, ZERO, ZERO, ZERO, ZERO))
    assert smoothing.step(UPRIGHT).q_WS == IDENTITY


def test_it_is_deterministic() -> None:
    flights = [fly(EQUILATERAL, 0.01, wild(0.01, 600, np.random.default_rng(2))) for _ in range(2)]
    assert np.array_equal(flights[0].q, flights[1].q)
    assert np.array_equal(flights[0].p, flights[1].p)
