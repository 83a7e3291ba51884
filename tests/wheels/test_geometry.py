"""The kinematics against the oracle, the paper's closed forms and other derivations."""

from math import asin, cos, degrees, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from atlas_cueing.errors import InputError, SlipConditionError
from atlas_cueing.rotation import cross, dot, norm, scale, subtract
from atlas_cueing.wheels import LARGEST_CONDITION_NUMBER, TANGENT_TOLERANCE, Geometry, OmniWheel

from .geometries import REGULAR, SINGULAR, equilateral, geometries, geometry_of, vector


def test_the_oracle_has_both_kinds() -> None:
    assert len(REGULAR) == 6
    assert len(SINGULAR) == 2


@pytest.mark.parametrize("case", REGULAR, ids=lambda case: case["name"])
def test_oracle(case: dict) -> None:
    geometry = geometry_of(case)
    for name in ("induced_rows", "wheels_from_sphere", "sphere_from_wheels"):
        np.testing.assert_allclose(
            getattr(geometry, name), case[name], rtol=1e-12, atol=1e-12, err_msg=name
        )
    assert geometry.determinant == pytest.approx(case["det_induced"], abs=1e-12)
    assert geometry.condition_number == pytest.approx(case["cond_induced"], rel=1e-12)
    assert geometry.slip_free


@pytest.mark.parametrize("case", SINGULAR, ids=lambda case: case["name"])
def test_singular_geometry_is_refused_with_its_numbers(case: dict) -> None:
    geometry = geometry_of(case)
    assert not geometry.slip_free
    assert abs(geometry.determinant - case["det_induced"]) < 1e-12
    np.testing.assert_allclose(
        geometry.wheels_from_sphere, case["wheels_from_sphere"], rtol=1e-12, atol=1e-12
    )
    with pytest.raises(SlipConditionError, match="kinematic slip condition") as refusal:
        _ = geometry.sphere_from_wheels
    assert refusal.value.condition_number > LARGEST_CONDITION_NUMBER
    assert f"{geometry.determinant:.3g}" in str(refusal.value)


@pytest.mark.parametrize(
    "elevation_deg", [1.0, 20.0, 40.0, degrees(asin(sqrt(2.0 / 3.0))), 70.0, 89.0]
)
def test_closed_forms_of_section_4_2(elevation_deg: float) -> None:
    theta = radians(elevation_deg)
    geometry = equilateral(theta)
    assert geometry.determinant == pytest.approx(
        1.5 * sqrt(3.0) * cos(theta) * sin(theta) ** 2, rel=1e-12
    )
    expected = sqrt(2.0) / tan(theta)
    assert geometry.condition_number == pytest.approx(max(expected, 1.0 / expected), rel=1e-9)
    k = 0.08 / (3.0 * 0.75)
    csc, sec = 1.0 / sin(theta), 1.0 / cos(theta)
    # Eq. 27
    J = [[-2.0 * csc, csc, csc], [0.0, sqrt(3.0) * csc, -sqrt(3.0) * csc], [-sec, -sec, -sec]]
    np.testing.assert_allclose(geometry.sphere_from_wheels, k * np.array(J), rtol=1e-12, atol=1e-13)


@given(geometries())
def test_the_two_maps_are_inverse(geometry: Geometry) -> None:
    product = np.array(geometry.sphere_from_wheels) @ np.array(geometry.wheels_from_sphere)
    np.testing.assert_allclose(product, np.eye(3), atol=1e-9)


@given(geometries(), vector)
def test_contact_points_move_as_the_wheels_do(
    geometry: Geometry, w_W: tuple[float, float, float]
) -> None:
    """The sphere's surface velocity Omega x R along the drive is r omega (Eq. 4 and 9)."""
    speeds = np.array(geometry.wheels_from_sphere) @ np.array(w_W)
    for wheel, speed in zip(geometry.wheels, speeds, strict=True):
        surface = cross(w_W, scale(geometry.sphere_radius, wheel.contact))
        assert dot(surface, wheel.drive) == pytest.approx(wheel.radius * speed, rel=1e-9, abs=1e-12)


@given(geometries())
def test_numpy_agrees(geometry: Geometry) -> None:
    rows = np.array([np.cross(wheel.contact, wheel.drive) for wheel in geometry.wheels])
    assert geometry.determinant == pytest.approx(np.linalg.det(rows), rel=1e-9, abs=1e-12)
    J = (
        np.linalg.inv(rows)
        @ np.diag([wheel.radius for wheel in geometry.wheels])
        / geometry.sphere_radius
    )
    np.testing.assert_allclose(geometry.sphere_from_wheels, J, rtol=1e-8, atol=1e-10)


@given(vector, vector, st.floats(0.0, 0.9 * TANGENT_TOLERANCE))
def test_directions_become_unit_and_tangent(
    contact: tuple[float, float, float], other: tuple[float, float, float], off: float
) -> None:
    tangent = cross(contact, other)
    assume(norm(tangent) > 0.05)
    nearly = subtract(scale(1.0 / norm(tangent), tangent), scale(-off / norm(contact), contact))
    wheel = OmniWheel.along(contact, scale(7.0, nearly), 0.1)
    assert norm(wheel.contact) == pytest.approx(1.0, abs=1e-14)
    assert norm(wheel.drive) == pytest.approx(1.0, abs=1e-14)
    assert abs(dot(wheel.contact, wheel.drive)) < 1e-15
    assert dot(wheel.drive, tangent) == pytest.approx(norm(tangent), rel=1e-5)


def test_a_drive_off_the_tangent_plane_is_refused() -> None:
    with pytest.raises(InputError, match=r"0 <= \|contact . drive\| <= 0.001"):
        OmniWheel.along((1.0, 0.0, 0.0), (2.0 * TANGENT_TOLERANCE, 1.0, 0.0), 0.1)


@pytest.mark.parametrize(
    "bad", [(0.0, 0.0, 0.0), (float("inf"), 0.0, 0.0), (float("nan"), 1.0, 0.0)]
)
def test_a_direction_without_length_is_refused(bad: tuple[float, float, float]) -> None:
    with pytest.raises(InputError, match=r"contact .* has no direction"):
        OmniWheel.along(bad, (0.0, 1.0, 0.0), 0.1)
    with pytest.raises(InputError, match=r"drive .* has no direction"):
        OmniWheel.along((0.0, 1.0, 0.0), bad, 0.1)
