"""Rotation and stage at once: better than one after the other, and inside the same bounds."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.cueing.preview.joint_plan import plan_jointly
from atlas_cueing.cueing.preview.spline import Spline
from atlas_cueing.cueing.preview.tilt_plan import UpPlanner, sampled

from .flights import DT, LIMITS, QUICK, G, cost, flying, planned

UPRIGHT = np.tile([1.0, 0.0, 0.0, 0.0], (401, 1))
LEVEL = np.tile([0.0, 0.0, G], (401, 1))
ONE_AFTER_THE_OTHER = replace(QUICK, rounds=0)


@pytest.mark.parametrize("frequency", [0.6, 1.5])
def test_both_at_once_are_better(frequency: float) -> None:
    """A force that rocks sideways, too slow for the travel and a bit fast for the cabin."""
    states = flying(12.0, lambda t: (0.0, 1.2 * float(np.sin(frequency * t)), -G))
    both, each = planned(states, QUICK), planned(states, ONE_AFTER_THE_OTHER)
    assert cost(both.force_error, both.rate_error) < 0.97 * cost(each.force_error, each.rate_error)


def test_a_level_force_needs_neither() -> None:
    spline = Spline(401, DT, 10.0)
    course = UpPlanner(spline, QUICK).plan(LEVEL)
    up, stage = plan_jointly(spline, course, UPRIGHT, LEVEL, QUICK, LIMITS)
    assert np.allclose(up, course, atol=1e-5)
    assert np.allclose(stage, 0.0, atol=1e-5)


def test_the_stage_pushes_along_its_own_axes_when_w_stands_askew_in_a() -> None:
    """A turned by a right angle about the vertical: what is forward in A is sideways in W."""
    spline = Spline(401, DT, 10.0)
    time = np.arange(401) * DT
    push = 0.3 * np.sin(np.pi * time / time[-1]) ** 3 * np.sin(5.0 * time)
    f_A = LEVEL + np.outer(push, [1.0, 0.0, 0.0])
    askew = np.tile([np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)], (401, 1))
    course = UpPlanner(spline, QUICK).plan(LEVEL)
    _, straight = plan_jointly(spline, course, UPRIGHT, f_A, QUICK, LIMITS)
    _, turned = plan_jointly(spline, course, askew, f_A, QUICK, LIMITS)
    assert np.max(np.abs(spline.curvature @ straight[:, 0])) > 0.1
    assert np.allclose(turned[:, 1], straight[:, 0], atol=1e-4)
    assert np.allclose(turned[:, 0], 0.0, atol=1e-4)


def test_bounds_are_those_of_each() -> None:
    spline = Spline(401, DT, 10.0)
    f_A = LEVEL + np.outer(3.0 * np.sign(np.sin(np.arange(401) * DT)), [1.0, 0.5, 0.2])
    course = UpPlanner(spline, QUICK).plan(f_A)
    up, stage = plan_jointly(spline, course, UPRIGHT, f_A, QUICK, LIMITS)
    assert np.max(np.linalg.norm(sampled(spline, up).rate, axis=1)) <= QUICK.rate
    for order, limit in enumerate((LIMITS.travel, LIMITS.speed, LIMITS.acceleration, LIMITS.jerk)):
        assert np.all(np.abs(spline.difference(order) @ stage) <= limit)
