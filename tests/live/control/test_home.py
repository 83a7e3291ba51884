"""When a pose is home: there a run may begin without a word, and drives are believed to be."""

from math import cos, radians, sin

import pytest

from atlas_cueing.live.control.at_rest import is_at_home
from atlas_cueing.live.control.pose import Pose
from atlas_cueing.rotation import Quat, Vec3
from atlas_cueing.signals import Motion


def turned(degrees: float, axis: Vec3) -> Quat:
    half = 0.5 * radians(degrees)
    x, y, z = axis
    return (cos(half), sin(half) * x, sin(half) * y, sin(half) * z)


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)])
@pytest.mark.parametrize(("degrees", "home"), [(0.05, True), (0.06, False), (1.0, False)])
def test_upright_is_within_a_milliradian_about_any_axis(
    degrees: float, home: bool, axis: Vec3
) -> None:
    q_WS = turned(degrees, axis)
    for q in (q_WS, tuple(-x for x in q_WS)):
        assert Pose(q, (5.0, -7.0, 1.0)).is_home == home  # type: ignore[arg-type]


@pytest.mark.parametrize(("millimetres", "home"), [(0.9, True), (1.1, False), (-300.0, False)])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_the_centre_is_within_a_millimetre(millimetres: float, home: bool, axis: int) -> None:
    x, y, z = (1e-3 * millimetres * (k == axis) for k in range(3))
    assert Pose(p_WS_W=(x, y, z)).is_home == home
    rest = (0.0, 0.0, 0.0)
    motion = Motion(0.0, (1.0, 0.0, 0.0, 0.0), rest, rest, (x, y, z), rest, rest, (0.0, 0.0))
    assert is_at_home(motion) == home


def test_two_small_offsets_add_up() -> None:
    assert not Pose(p_WS_W=(8e-4, 8e-4, 0.0)).is_home
