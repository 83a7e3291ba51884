"""The stage: onsets inside the travel for any demand, a return below the threshold.

The rider's head is taken into account.
"""

from dataclasses import replace
from math import sin

import numpy as np
import pytest

from atlas_cueing.cueing import StageParameters
from atlas_cueing.cueing.stage.high_pass import HighPass
from atlas_cueing.cueing.stage.mpc import MpcAxis
from atlas_cueing.cueing.stage.stage_cueing import StageCueing
from atlas_cueing.rotation import IDENTITY, ZERO, Vec3, conjugate, exp, flip, rotate, scale
from atlas_cueing.signals import STANDARD_GRAVITY, StageLimits

LIMITS = StageLimits((1.0, 1.0, 0.75), (1.5, 1.5, 1.2), (6.0, 6.0, 5.0), (60.0, 60.0, 50.0))
HUGE = StageLimits((1e6,) * 3, (1e6,) * 3, (1e6,) * 3, (1e9,) * 3)
DTS = [1.0 / 1000.0, 1.0 / 120.0, 1.0 / 20.0]
ONSET = StageParameters(onset=(2.0, 2.0, 2.0), planner="onset")
PLANNERS = pytest.mark.parametrize("planned", [ONSET, StageParameters()], ids=["onset", "horizon"])


@PLANNERS
def test_no_more_than_the_parameters_travel_is_used_on_each_axis(planned: StageParameters) -> None:
    """The travel is used up to its share, axis by axis.

    The platform's own counts where it is smaller.
    """
    parameters = replace(planned, travel=(0.2, 9.0, 0.4))
    cueing, most = StageCueing(0.01, parameters, LIMITS, ZERO), np.zeros(3)
    cueing.step(IDENTITY, ZERO, (0.0, 0.0, -STANDARD_GRAVITY))
    for i in range(6000):
        side = 1e9 if i // 300 % 2 else -1e9
        most = np.maximum(most, np.abs(cueing.step(IDENTITY, ZERO, (side, side, side))[0]))
    assert np.all(most <= (0.2, 1.0, 0.4))
    assert np.all(most > (0.08, 0.3, 0.15))


@PLANNERS
@pytest.mark.parametrize("dt", DTS)
def test_random_demands_of_any_size_stay_inside(planned: StageParameters, dt: float) -> None:
    random = np.random.default_rng(1)
    cueing = StageCueing(dt, planned, LIMITS, (0.3, 0.1, 0.5))
    for _ in range(3000):
        f, w = random.standard_normal((2, 3)) * 10.0 ** random.uniform(-2.0, 12.0)
        p, v, a = cueing.step(IDENTITY, tuple(w.tolist()), tuple(f.tolist()))
        for state, limit in zip(
            (p, v, a), (LIMITS.travel, LIMITS.speed, LIMITS.acceleration), strict=True
        ):
            assert np.all(np.abs(state) <= limit)


@PLANNERS
def test_position_velocity_and_acceleration_are_one_motion(planned: StageParameters) -> None:
    dt = 1e-3
    cueing = StageCueing(dt, planned, LIMITS, ZERO)
    forces = ((sin(2.0 * i * dt), 0.5 * sin(5.0 * i * dt), -STANDARD_GRAVITY) for i in range(4000))
    path = [cueing.step(IDENTITY, ZERO, f) for f in forces]
    p, v, a = np.moveaxis(np.array(path), 1, 0)
    assert np.max(np.abs(a)) > 0.1
    assert np.max(np.abs(np.diff(p, axis=0) / dt - 0.5 * (v[1:] + v[:-1]))) < 1e-5
    assert np.max(np.abs(np.diff(v, axis=0) / dt - 0.5 * (a[1:] + a[:-1]))) < 2e-3


@PLANNERS
def test_what_is_there_at_the_start_is_no_onset(planned: StageParameters) -> None:
    cueing = StageCueing(0.01, planned, LIMITS, ZERO)
    for _ in range(200):
        assert cueing.step(IDENTITY, ZERO, (2.0, 1.0, -12.0)) == (ZERO, ZERO, ZERO)


@PLANNERS
@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (1.0, 0.5, -2.0), (np.pi, 0.0, 0.0)])
def test_gravity_is_no_demand_at_any_attitude(planned: StageParameters, turn: Vec3) -> None:
    """A cabin at rest whose rider should feel just what he feels at rest."""
    q = exp(turn)
    cueing = StageCueing(0.01, planned, LIMITS, ZERO)
    cueing.step(IDENTITY, ZERO, (0.0, 0.0, -STANDARD_GRAVITY))
    for _ in range(100):
        p, v, a = cueing.step(q, ZERO, flip(rotate(conjugate(q), (0.0, 0.0, STANDARD_GRAVITY))))
    assert np.max(np.abs([p, v, a])) < 1e-13


def test_the_demand_is_in_base_axes_with_its_gain() -> None:
    """Cabin turned a quarter left: a push forward in the cabin is one along W's y."""
    q = exp((0.0, 0.0, 0.5 * np.pi))
    peaks = []
    for gain in ((1.0, 1.0, 1.0), (1.0, 0.5, 1.0), (1.0, 0.0, 1.0)):
        cueing = StageCueing(0.01, replace(ONSET, force_gain=gain), HUGE, ZERO)
        cueing.step(q, ZERO, (0.0, 0.0, -STANDARD_GRAVITY))
        a = np.array([cueing.step(q, ZERO, (0.5, 0.0, -STANDARD_GRAVITY))[2] for _ in range(50)])
        assert np.max(np.abs(a[:, [0, 2]])) < 1e-12
        peaks.append(a[:, 1].max())
    assert peaks == pytest.approx([peaks[0], 0.5 * peaks[0], 0.0])
    assert peaks[0] > 0.3


@PLANNERS
@pytest.mark.parametrize("head", [(0.4, -0.2, 0.7), (0.0, 0.0, 1.0)])
def test_the_head_s_own_acceleration_is_subtracted(planned: StageParameters, head: Vec3) -> None:
    """The stage stays when the force is what the turning makes.

    That is from second differences of the head's path.
    """
    dt, n = 1e-3, 3000
    t = dt * np.arange(n)
    angle, rate = 0.8 * t + 0.2 * np.sin(3.0 * t), 0.8 + 0.6 * np.cos(3.0 * t)
    axis = (0.6, 0.0, 0.8)
    q = [exp(scale(float(x), axis)) for x in angle]
    r = np.array([rotate(each, head) for each in q])
    made = np.gradient(np.gradient(r, dt, axis=0), dt, axis=0)
    both = []
    for subtracting in (head, ZERO):
        cueing, moved = StageCueing(dt, planned, HUGE, subtracting), []
        for i in range(2, n - 2):
            force_W = (made[i] + [0.0, 0.0, STANDARD_GRAVITY]).tolist()
            f_B = flip(rotate(conjugate(q[i]), tuple(force_W)))
            moved.append(cueing.step(q[i], scale(float(rate[i]), axis), f_B)[2])
        both.append(np.max(np.abs(moved[20:])))
    assert np.max(np.abs(made)) > 0.4
    assert both[0] < 0.02
    assert both[1] > 20.0 * both[0]


def test_each_axis_has_its_planner_and_its_limits() -> None:
    for planned, kind in ((ONSET, HighPass), (StageParameters(), MpcAxis)):
        assert all(
            isinstance(axis, kind) for axis in StageCueing(0.01, planned, LIMITS, ZERO)._axes
        )
    bounds = [
        axis.problem.bound[-2]
        for axis in StageCueing(0.01, StageParameters(travel=(0.5, 2.0, 2.0)), LIMITS, ZERO)._axes
    ]
    assert bounds == pytest.approx([0.999 * x for x in (0.5, 1.0, 0.75)])


@pytest.mark.parametrize("dt", DTS)
def test_no_more_axes_plan_in_one_tick_than_there_have_to(
    dt: float,
) -> None:
    """At 1000 Hz the three are never in one tick, and each plans 50 times a second."""
    plans: list[list[int]] = [[], [], []]
    cueing = StageCueing(dt, StageParameters(), LIMITS, ZERO)
    ticks = int(1.0 / dt)
    for tick in range(ticks):
        flown = [axis._flown for axis in cueing._axes]
        cueing.step(IDENTITY, ZERO, (1.0, 1.0, -STANDARD_GRAVITY))
        for axis, before, made in zip(cueing._axes, flown, plans, strict=True):
            if axis._flown is not before:
                made.append(tick)
    assert all(len(made) >= 50 or len(made) == ticks for made in plans)
    if dt < 1.0 / 150.0:
        assert len({tick for made in plans for tick in made}) == sum(map(len, plans))
