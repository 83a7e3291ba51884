"""Friction and contacts against closed forms."""

import json
from math import cos, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from atlas_cueing.plant.build_plant import PlantConstants, Start, build_plant
from atlas_cueing.plant.drive_command import DriveCommand
from atlas_cueing.plant.passive_contacts import PassiveContact, PassiveContacts
from atlas_cueing.plant.rolling_contact import Friction, RollingContact
from atlas_cueing.plant.sphere_on_wheels import OMEGA, WORK, SphereOnWheels, W, Z
from atlas_cueing.scenario import Platform, load_platform
from atlas_cueing.wheels import row_contact

CASES = json.loads((Path(__file__).parents[1] / "oracles" / "loads.json").read_text())["cases"]
STILL = ((0.0, 0.0, 0.0, 0.0),) * 3
AT_REST = DriveCommand(STILL, STILL, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def of_kind(kind: str) -> list[Any]:
    found = [pytest.param(case, id=str(k)) for k, case in enumerate(CASES) if case["kind"] == kind]
    assert found
    return found


@pytest.mark.parametrize("case", of_kind("creep"))
def test_creep(case: dict[str, Any]) -> None:
    """A contact that slips by what the oracle says transmits the oracle's share, in the end."""
    friction = Friction(case["mu"], 1.0, 0.05, 600.0, 0.5, case["creep_stiffness"])
    contact = RollingContact((0, 0, -1), (1, 0, 0), 0.2, 1.0, 1e6, 0.0, friction)
    z, slip, omega, h = 0.0, case["expect"]["slip_m_s"], case["rolling_speed_m_s"] / 0.2, 1e-4
    for _ in range(20_000):
        rate = contact.bristle_rate(z, slip, omega)
        z += h * rate
    assert contact.transmitted(z, rate) == pytest.approx(case["phi"], rel=0.005)


@pytest.mark.parametrize("case", of_kind("slide_to_rest"))
def test_slide_to_rest(case: dict[str, Any]) -> None:
    """Wheels too heavy to turn: the sphere slides to rest as Coulomb says."""
    sphere = build_plant(shell(case)).at(
        Start((1, 0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0))
    )
    sphere.state[W + 2] = case["rate_rad_s"]
    rates, h = [], 1e-3
    while abs(sphere.rate_W()[2]) > 1e-3 * case["rate_rad_s"] and len(rates) < 2000:
        sphere.advance(AT_REST, h, 5)
        rates.append(sphere.rate_W()[2])
    middle = [k for k, w in enumerate(rates) if 0.2 < w / case["rate_rad_s"] < 0.8]
    fitted = -np.polyfit(h * np.array(middle), np.array(rates)[middle], 1)[0]
    assert fitted == pytest.approx(case["expect"]["deceleration_rad_s2"], rel=0.005)
    assert h * len(rates) == pytest.approx(case["expect"]["time_s"], rel=0.01)
    assert sphere.state[WORK + 2] == pytest.approx(case["expect"]["dissipated_j"], rel=0.005)


def test_a_free_body_keeps_energy_and_momentum() -> None:
    """Lifted off all contacts, it falls, and turns about no principal axis."""
    plant = build_plant(load_platform("atlas-2.9m"))
    sphere = plant.at(Start((1, 0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    sphere.state[7:13] = 0.0, 0.0, 20.0, 0.1, 0.2, 9.0
    sphere.state[W : W + 3] = 2.0, 1.0, 0.5
    sphere.state[Z : Z + 3] = sphere.state[OMEGA : OMEGA + 3] = 0.0, 0.0, 0.0
    sphere.state[13:16] = 0.0, 0.0, 0.0
    energy, momentum = sphere.energy((0, 0, 0)), angular_momentum(plant, sphere)
    for _ in range(100):
        sphere.advance(AT_REST, 0.01, 10)
    assert sphere.energy((0, 0, 0)) == pytest.approx(energy, rel=1e-10)
    assert angular_momentum(plant, sphere) == pytest.approx(momentum, rel=1e-9)
    assert abs(sphere.state[W] - 2.0) > 1e-3  # it did tumble


def test_supports_together_are_what_they_are_one_by_one() -> None:
    """The short way, for when all of them touch, gives the same; and one that opened is out."""
    rng = np.random.default_rng(3)
    supports = []
    for u in rng.normal(size=(5, 3)):
        x, y, z = (u / np.linalg.norm(u)).tolist()
        supports.append(PassiveContact((x, y, z), 1e5, 300.0, 500.0))
    both = PassiveContacts(supports, (0.0, 0.0, -100.0))
    d, rate = (1e-3, -5e-4, 2e-4), (0.01, 0.02, -0.01)
    slow = both.force(d, rate)
    both.tune((0.0, 0.0, 0.0))
    assert both.force(d, rate)[0] == pytest.approx(slow[0], rel=1e-12)
    assert both.force(d, rate)[1] == pytest.approx(slow[1], rel=1e-12)
    far = (0.02, 0.0, 0.0)
    expected = np.array([0.0, 0.0, -100.0])
    for s in supports:
        n = 500.0 + 1e5 * s.contact[0] * 0.02
        expected -= max(n, 0.0) * np.array(s.contact)
    assert min(s.contact[0] for s in supports) < -0.25  # one opens
    assert both.force(far, (0.0, 0.0, 0.0))[0] == pytest.approx(expected.tolist())


def test_rows_of_rollers_are_where_the_wheels_have_them() -> None:
    platform = load_platform("atlas-tabletop")
    wheels, geometry = build_plant(platform).wheels, platform.geometry()
    for wheel, other, file in zip(wheels, geometry.wheels, platform.wheel, strict=True):
        assert file.rows is not None
        for row, side in zip(wheel.rows, (1, -1), strict=True):
            expected = row_contact(geometry.sphere_radius, other, file.rows, side)
            assert row.u == pytest.approx(expected.contact)
            assert row.radius == pytest.approx(expected.radius)
            assert row.lever == pytest.approx(geometry.sphere_radius * np.array(expected.induced))
        quarter = 0.25 * wheel.pitch
        assert wheel.pitch == pytest.approx(2.0 * np.pi / file.rows.rollers)
        assert wheel.touching(quarter) is wheel.rows[0]
        assert wheel.touching(3.0 * quarter) is wheel.rows[1]
        assert wheel.touching(-quarter) is wheel.rows[1]


def angular_momentum(plant: PlantConstants, sphere: SphereOnWheels) -> list[float]:
    """About the centre of mass, W."""
    w, x, y, z = sphere.orientation()
    R = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    found: list[float] = (R @ np.array(plant.body.inertia_S) @ sphere.state[W : W + 3]).tolist()
    return found


def shell(case: dict[str, Any]) -> Platform:
    """A thin shell on three wheels that are too heavy to turn."""
    R, theta = case["sphere_radius_m"], radians(case["elevation_deg"])
    moment = 2.0 / 3.0 * case["mass_kg"] * R * R
    wheels = []
    for azimuth in (0.0, radians(120.0), radians(240.0)):
        contact = [cos(theta) * cos(azimuth), cos(theta) * sin(azimuth), -sin(theta)]
        drive = [-sin(azimuth), cos(azimuth), 0.0]
        wheels.append(
            {
                "contact": contact,
                "drive": drive,
                "radius_m": R / 10.0,
                "friction": case["mu"],
                "inertia_kg_m2": 1e5,
            }
        )
    data = {
        "name": "shell",
        "sphere": {"radius_m": R},
        "wheel": wheels,
        "wheel_limits": dict.fromkeys(("speed_rad_s", "acceleration_rad_s2", "jerk_rad_s3"), 100.0),
        "stage_limits": dict.fromkeys(
            ("travel_m", "speed_m_s", "acceleration_m_s2", "jerk_m_s3"), 1.0
        ),
        "part": [{"mass_kg": case["mass_kg"], "inertia_kg_m2": [moment] * 3}],
        "plant": {"bristle_stiffness_1_m": 6000.0},
    }
    return Platform.model_validate(data)
