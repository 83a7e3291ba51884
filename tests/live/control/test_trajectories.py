"""Trajectories by themselves: where they lead, and that their rates are derivatives."""

from collections.abc import Callable
from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from atlas_cueing.live.control.trajectories import (
    CALM_ACCELERATION,
    CALM_RATE,
    CALM_SPEED,
    EngageTrajectory,
    FollowTrajectory,
    HoldTrajectory,
    ParkTrajectory,
    Trajectory,
    calm_time,
    smoothstep,
)
from atlas_cueing.rotation import IDENTITY, ZERO, Quat, Vec3, exp, geodesic, multiply, norm, scale
from atlas_cueing.signals import Cue, Motion

Array = NDArray[np.float64]

DT = 2e-3
FEW = settings(
    max_examples=8, phases=[Phase.explicit, Phase.reuse, Phase.generate]
)  # each is a whole course; shrinking takes minutes
HOME = Cue(0.0, IDENTITY, ZERO, ZERO, ZERO, ZERO)
UPRIGHT = Motion(0.0, IDENTITY, ZERO, ZERO, ZERO, ZERO, ZERO, (0.0, 0.0))


def motion(q: Quat = IDENTITY, w: Vec3 = ZERO, p: Vec3 = ZERO, v: Vec3 = ZERO) -> Motion:
    return Motion(0.0, q, w, ZERO, p, v, ZERO, (0.0, 0.0))


def spinning(w: Vec3, q0: Quat = IDENTITY) -> Callable[[float], Cue]:
    """A cue that turns with a constant rate in W and swings on the stage."""

    def at(t: float) -> Cue:
        s, c = sin(2.0 * t), cos(2.0 * t)
        return Cue(
            t,
            multiply(exp(scale(t, w)), q0),
            w,
            (0.3 * s, 0.1, 0.2 * c),
            (0.6 * c, 0.0, -0.4 * s),
            (-1.2 * s, 0.0, -0.8 * c),
        )

    return at


def resting(_: float) -> Cue:
    return HOME


def drive(
    course: Trajectory, seconds: float, cue: Callable[[float], Cue] = resting, dt: float = DT
) -> list[Cue]:
    return [course.step(cue(dt * (k + 1))) for k in range(round(seconds / dt))]


def columns(cues: list[Cue]) -> tuple[Array, Array, Array, Array, Array]:
    q, w, p, v, a = (
        np.array([getattr(c, name) for c in cues])
        for name in ("q_WS", "w_WS_W", "p_WS_W", "v_WS_W", "a_WS_W")
    )
    return q, w, p, v, a


def check_derivatives(cues: list[Cue], dt: float = DT, size: float = 1.0) -> None:
    """Check central differences over two ticks: their error is dt^2 times a third derivative.

    That of the acceleration is dt / 2 times the jerk, which jumps at both ends of a smoothstep.
    """
    q, w, p, v, a = columns(cues)
    r = Rotation.from_quat(q, scalar_first=True)
    near = 60.0 * size * dt**2 + 1e-9
    np.testing.assert_allclose(
        (r[2:] * r[:-2].inv()).as_rotvec() / (2.0 * dt), w[1:-1], rtol=0.0, atol=near
    )
    np.testing.assert_allclose((p[2:] - p[:-2]) / (2.0 * dt), v[1:-1], rtol=0.0, atol=near)
    np.testing.assert_allclose(
        (v[2:] - v[:-2]) / (2.0 * dt), a[1:-1], rtol=0.0, atol=5.0 * size * dt
    )
    assert np.all(np.sum(q[1:] * q[:-1], axis=1) > 0.0), "the quaternion's sign jumps"
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1.0, atol=1e-12)


unit = st.tuples(*(st.floats(-1.0, 1.0),) * 4).filter(lambda q: np.hypot.reduce(q) > 0.1)
quaternions = unit.map(lambda q: tuple((np.array(q) / np.hypot.reduce(q)).tolist()))
rates = st.tuples(*(st.floats(-1.5, 1.5),) * 3)
places = st.tuples(*(st.floats(-0.7, 0.7),) * 3)


def test_smoothstep_and_its_derivatives() -> None:
    t = np.linspace(-0.2, 1.2, 1401)
    s, ds, dds = np.array([smoothstep(float(x)) for x in t]).T
    np.testing.assert_allclose(np.gradient(s, t)[1:-1], ds[1:-1], atol=1e-4)
    np.testing.assert_allclose(np.gradient(ds, t)[1:-1], dds[1:-1], atol=3e-2)
    assert np.all(np.diff(s) >= 0.0)
    for x, end in ((-0.1, 0.0), (0.0, 0.0), (1.0, 1.0), (1.1, 1.0)):
        assert smoothstep(x) == (end, 0.0, 0.0)
    assert smoothstep(1e-6) == pytest.approx((0.0, 0.0, 0.0), abs=1e-4)
    assert smoothstep(0.5)[0] == 0.5


@settings(max_examples=30)
@given(st.floats(0.0, pi), st.floats(0.0, 2.0))
def test_a_calm_move_is_calm_and_no_calmer_than_need_be(angle: float, distance: float) -> None:
    duration = calm_time(angle, distance)
    if max(angle, distance) < 1e-6:
        return
    s = np.array([smoothstep(float(x)) for x in np.linspace(0.0, 1.0, 2001)])
    rate, speed = s[:, 1].max() / duration * angle, s[:, 1].max() / duration * distance
    acceleration = np.abs(s[:, 2]).max() / duration**2 * distance
    use = max(rate / CALM_RATE, speed / CALM_SPEED, acceleration / CALM_ACCELERATION)
    assert use == pytest.approx(1.0, abs=1e-4)


def test_follow_is_the_cue_and_stay_is_a_place() -> None:
    cue = spinning((0.1, 0.2, 0.3))(1.0)
    assert FollowTrajectory().step(cue) is cue
    still = HoldTrajectory(
        motion((0.6, 0.8, 0.0, 0.0), (1.0, 0.0, 0.0), (0.1, 0.2, 0.3), (1.0, 0.0, 0.0))
    )
    assert still.step(cue) == Cue(1.0, (0.6, 0.8, 0.0, 0.0), ZERO, (0.1, 0.2, 0.3), ZERO, ZERO)
    assert still.arrived
    assert FollowTrajectory().arrived


@FEW
@given(quaternions, places)
def test_home_by_the_shorter_way(q: Quat, p: Vec3) -> None:
    duration = max(1.0, calm_time(geodesic(q, IDENTITY), norm(p)))
    home = ParkTrajectory(motion(q, p=p), DT, duration)
    cues = drive(home, duration + 2 * DT)
    check_derivatives(cues)
    assert home.arrived
    assert geodesic(cues[-1].q_WS, IDENTITY) < 1e-7
    assert norm(cues[-1].p_WS_W) < 1e-12
    turn = Rotation.from_quat([cue.q_WS for cue in cues], scalar_first=True)
    way = np.sum((turn[1:] * turn[:-1].inv()).magnitude())
    assert way == pytest.approx(geodesic(q, IDENTITY), abs=1e-4)
    assert max(norm(cue.w_WS_W) for cue in cues) <= CALM_RATE * (1.0 + 1e-9)
    assert max(norm(cue.v_WS_W) for cue in cues) <= CALM_SPEED * (1.0 + 1e-9)


def test_home_has_not_arrived_before_its_time() -> None:
    home = ParkTrajectory(UPRIGHT, DT, 1.0)
    drive(home, 0.99)
    assert not home.arrived


@FEW
@given(
    quaternions, places, quaternions, st.tuples(*(st.floats(-0.4, 0.4),) * 3), st.floats(1.0, 4.0)
)
def test_a_blend_is_smooth_from_rest_to_a_spinning_cue(
    q: Quat, p: Vec3, q_cue: Quat, w: Vec3, duration: float
) -> None:
    """Also where the turn still left grows beyond half a turn on the way."""
    cue = spinning(w, q_cue)
    blend = EngageTrajectory(motion(q, p=p), cue(0.0), DT, duration)
    cues = drive(blend, duration + 5 * DT, cue)
    assert blend.arrived
    last = round(duration / DT) - 1
    check_derivatives(cues[:last], size=1.0 + 40.0 / duration**2)
    assert norm(cues[0].w_WS_W) < 1e-2
    assert norm(cues[0].v_WS_W) < 1e-2
    assert cues[-1] == cue(DT * len(cues))
    before = cues[last - 1]
    assert geodesic(before.q_WS, cue(DT * last).q_WS) < 1e-4
    np.testing.assert_allclose(before.w_WS_W, w, atol=2e-2)


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.6, 0.0, 0.8)])
def test_a_blend_over_half_a_turn_that_grows(axis: Vec3) -> None:
    """The cue runs away: half a turn becomes more, and the blend must not change its way round."""
    cue = spinning(scale(1.2, axis), exp(scale(pi - 0.1, axis)))
    check_derivatives(drive(EngageTrajectory(UPRIGHT, cue(0.0), DT, 4.0), 3.999, cue), size=5.0)


def test_a_blend_to_a_cue_that_rests_is_the_straight_way() -> None:
    cue = Cue(0.0, exp((0.0, 0.0, 1.0)), ZERO, (0.5, 0.0, 0.0), ZERO, ZERO)
    for k, at in enumerate(drive(EngageTrajectory(UPRIGHT, cue, DT, 2.0), 1.999, lambda _: cue), 1):
        s = smoothstep(k * DT / 2.0)[0]
        assert geodesic(at.q_WS, exp((0.0, 0.0, s))) < 1e-9
        assert at.p_WS_W == pytest.approx((0.5 * s, 0.0, 0.0), abs=1e-12)
