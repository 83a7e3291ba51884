"""Loads, double rows and closed forms against numbers of 50 digits that another program made."""

from math import acos, cos, degrees, radians, sqrt
from typing import Any

import numpy as np
import pytest

from atlas_cueing.loads import LoadModel, WheelContact, platform_loads, reserve
from atlas_cueing.loads.normal_forces import bilateral_forces
from atlas_cueing.loads.reserve import static_torques, wheel_space_inertia
from atlas_cueing.wheels import Geometry, OmniWheel, RollerRows, row_contact, row_corrections, tilt

from .models import Platform, model_of, of_kind, point_mass, ring, state_of

NAME = "name"


def close(value: Any, expected: Any) -> None:
    expected = np.asarray(expected, dtype=np.float64)
    scale = max(float(np.abs(expected).max(initial=0.0)), 1e-3)
    np.testing.assert_allclose(value, expected, rtol=1e-10, atol=1e-10 * scale)


@pytest.mark.parametrize("case", of_kind("loads"), ids=lambda case: case[NAME])
def test_loads(case: dict[str, Any]) -> None:
    model, expect = model_of(case), case["expect"]
    loads = platform_loads(Platform(model), **state_of(case))
    close(model.body.mass, expect["mass_kg"])
    close(model.body.com_S, expect["com_m"])
    close(model.body.inertia_S, expect["inertia_about_centre_kg_m2"])
    close(loads.moment, expect["moment_n_m"])
    close(loads.force, expect["force_n"])
    close(loads.drive, expect["drive_force_n"])
    close(loads.speed, expect["wheel_speed_rad_s"])
    close(loads.acceleration, expect["wheel_acceleration_rad_s2"])
    close(loads.torque, expect["wheel_torque_n_m"])
    close(loads.power, expect["wheel_power_w"])
    close(loads.power.sum(), expect["power_w"])
    assert bool(loads.all_in_contact) is expect["all_in_contact"]
    close(model.sphere_from_wheels, expect["sphere_from_wheels"])
    close(wheel_space_inertia(model, state_of(case)["q_WS"]), expect["wheel_space_inertia_kg_m2"])
    close(np.linalg.cond(model.B), expect["condition_number"])
    if expect["static_torque_n_m"] is not None:
        close(static_torques(model, state_of(case)["q_WS"][None])[0], expect["static_torque_n_m"])
    if expect.get("vertical_preload_needed_n") is not None:
        close(loads.preload_needed, expect["vertical_preload_needed_n"])


@pytest.mark.parametrize("case", of_kind("loads"), ids=lambda case: case[NAME])
def test_normal_forces(case: dict[str, Any]) -> None:
    model, expect = model_of(case), case["expect"]
    loads = platform_loads(Platform(model), **state_of(case))
    need = loads.force - loads.drive @ model.V - model.preload_W
    normals = bilateral_forces(model, need[None])[0]
    close(normals, [*expect["normal_force_n"], *expect["support_force_n"]])
    if expect["all_in_contact"]:
        close(np.concatenate([loads.normal, loads.support]), normals)
        close(loads.traction_use, expect["traction_use"])


@pytest.mark.parametrize("case", of_kind("dual_row"), ids=lambda case: case[NAME])
def test_double_rows(case: dict[str, Any]) -> None:
    wheels = case["geometry"]["wheel"]
    first, second, third = (
        OmniWheel.along(tuple(w["contact"]), tuple(w["drive"]), w["radius_m"]) for w in wheels
    )
    radius = case["geometry"]["sphere_radius_m"]
    geometry = Geometry("x", radius, (first, second, third))
    rows = [RollerRows(w["row_offset_m"], w["roller_profile_radius_m"], 8) for w in wheels]
    expect = case["expect"]
    close([tilt(radius, each) for each in rows], expect["tilt_rad"])
    corrections = row_corrections(geometry, rows)
    assert len(corrections) == len(expect["combinations"]) == 8
    J = np.array(geometry.sphere_from_wheels)
    for sides, correction in corrections.items():
        asked = expect["combinations"][",".join(f"{side:+d}" for side in sides)]
        close(correction, asked["correction"])
        close(correction @ J, asked["sphere_from_wheels"])
        touching = [
            row_contact(radius, wheel, each, side)
            for wheel, each, side in zip(geometry.wheels, rows, sides, strict=True)
        ]
        close([wheel.contact for wheel in touching], asked["contacts"])
        close([wheel.radius for wheel in touching], expect["contact_wheel_radius_m"])


@pytest.mark.parametrize("case", of_kind("lift_off"), ids=lambda case: f"{case['elevation_deg']:g}")
def test_lift_off(case: dict[str, Any]) -> None:
    wheels = ring(3, radians(case["elevation_deg"]))
    found = reserve(LoadModel("x", 1.45, point_mass(), wheels)).lift_off
    close(found.worst, case["expect"]["acceleration_m_s2"])


@pytest.mark.parametrize(
    "case", of_kind("isotropic_skew"), ids=lambda case: f"{case['elevation_deg']:g}"
)
def test_isotropic_skew(case: dict[str, Any]) -> None:
    """cos(theta) cos(psi) = 1/sqrt 3 makes the rows orthogonal."""
    elevation = radians(case["elevation_deg"])
    skew = acos(min(1.0, 1.0 / (sqrt(3.0) * cos(elevation))))
    assert degrees(skew) == pytest.approx(case["expect"]["skew_deg"], rel=1e-10, abs=1e-5)
    wheels: tuple[WheelContact, ...] = ring(3, elevation, skew)
    assert np.linalg.cond(LoadModel("x", 1.0, point_mass(), wheels).B) == pytest.approx(
        1.0, abs=1e-7
    )
