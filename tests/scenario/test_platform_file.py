"""The presets say what was published, and mark the rest.

A platform file is checked in every key.
"""

import json
import re
import tomllib
from math import pi
from pathlib import Path
from typing import Any
from unicodedata import normalize

import numpy as np
import pytest
from pydantic import ValidationError

from atlas_cueing.scenario import Platform, load_platform, presets
from atlas_cueing.scenario.reading import read_toml
from atlas_cueing.scenario.wheel_tables import WheelTable
from atlas_cueing.wheels import OmniWheel, Wheels, headroom

ORACLES = json.loads((Path(__file__).parents[1] / "oracles" / "kinematics.json").read_text())
NAMES = [
    "atlas-1.5m",
    "atlas-2.9m",
    "atlas-2.9m-halo",
    "atlas-orthogonal",
    "atlas-skewed",
    "atlas-tabletop",
]


def test_names() -> None:
    assert list(presets()) == NAMES
    assert [load_platform(name).name for name in NAMES] == NAMES


@pytest.mark.parametrize("name", [name for name in NAMES if name != "atlas-skewed"])
def test_geometry_is_the_papers(name: str) -> None:
    paper = "4.1, orthogonal" if name == "atlas-orthogonal" else "4.2, equilateral, elevation 40"
    case = next(case for case in ORACLES if paper in case["name"])
    geometry = load_platform(name).geometry()
    np.testing.assert_allclose(geometry.induced_rows, case["induced_rows"], atol=1e-15)
    scale = geometry.sphere_radius / geometry.wheels[0].radius
    np.testing.assert_allclose(
        geometry.wheels_from_sphere, scale * np.array(case["induced_rows"]), rtol=1e-12
    )
    assert Wheels(geometry).sphere_from_wheels


def test_skewed_drives_are_orthogonal_at_30_deg() -> None:
    """cos(theta) cos(psi) = 1/sqrt 3, the square of each row's vertical part being a third."""
    geometry = load_platform("atlas-skewed").geometry()
    assert [wheel.contact[2] for wheel in geometry.wheels] == pytest.approx([-0.5] * 3, abs=1e-14)
    rows = np.array(geometry.induced_rows)
    np.testing.assert_allclose(rows @ rows.T, np.eye(3), atol=1e-14)


def test_published_masses_and_passive_wheels() -> None:
    sphere = load_platform("atlas-1.5m").part
    assert sphere is not None
    assert [part.mass_kg for part in sphere] == [50.0]
    halo = load_platform("atlas-2.9m-halo")
    assert halo.support is not None
    assert halo.preload is not None
    assert len(halo.support) == len(halo.preload) == 12
    assert all(each.contact[2] < 0.0 for each in halo.support)
    assert all(each.contact[2] > 0.0 for each in halo.preload)
    assert sum(each.force_n for each in halo.preload) == 9000.0


def test_published_diameters() -> None:
    assert 2.0 * load_platform("atlas-2.9m").sphere.radius_m == pytest.approx(
        9.5 * 0.3048, abs=0.01
    )
    assert 2.0 * load_platform("atlas-1.5m").sphere.radius_m == 1.5


@pytest.mark.parametrize("name", NAMES)
def test_every_number_is_published_or_marked_as_assumed(name: str) -> None:
    published = r"(radius_m|mass_kg).*# published|drive|contact(?!.*# assumed)"
    lines = [
        line for line in presets()[name].read_text().splitlines() if re.match(r"\w+ = [\d\[]", line)
    ]
    assert len(lines) >= 1 + 9 + 7 + 1 + 3 + 6  # sphere, wheels, limits, rider, part, drive
    for line in lines:
        assert re.match(published, line) or re.search(r"# assumed: .{10}", line), line


@pytest.mark.parametrize("name", NAMES)
def test_limits_fit_each_other(name: str) -> None:
    """The sphere turns at half a turn a second or more.

    The stage can brake from full speed within its travel.
    """
    platform = load_platform(name)
    assert headroom(platform.geometry(), platform.wheel_limit_values()).worst_rate > pi
    limits = platform.stage_limit_values()
    for travel, v, a, j in zip(
        limits.travel, limits.speed, limits.acceleration, limits.jerk, strict=True
    ):
        assert 0.5 * v * (v / a + a / j) < 0.5 * travel


def good() -> dict:
    return read_toml(presets()["atlas-2.9m"])


def test_numbers_arrive() -> None:
    data = good()
    data["wheel_limits"] = {"speed_rad_s": [1, 2, 3], "acceleration_rad_s2": 4, "jerk_rad_s3": 5.5}
    data["rider"] = {"head_m": [0.1, 0, 0.5]}
    data["wheel"][1]["radius_m"] = 0.25
    platform = Platform.model_validate(data)
    limits = platform.wheel_limit_values()
    assert (limits.speed, limits.acceleration, limits.jerk) == (
        (1.0, 2.0, 3.0),
        (4.0, 4.0, 4.0),
        (5.5, 5.5, 5.5),
    )
    stage = platform.stage_limit_values()
    assert (stage.travel, stage.speed) == ((1.0, 1.0, 0.75), (1.5, 1.5, 1.2))
    assert (stage.acceleration, stage.jerk) == ((6.0, 6.0, 5.0), (60.0, 60.0, 50.0))
    assert platform.head_S == (0.1, 0.0, 0.5)
    assert [wheel.radius for wheel in platform.geometry().wheels] == [0.15, 0.25, 0.15]
    assert platform.geometry().sphere_radius == 1.45


def test_directions_are_normalised() -> None:
    data = good()
    data["wheel"][0]["contact"] = [0.766, 0.0, -0.643]  # as typed in three digits
    data["wheel"][0]["drive"] = [0, -2, 0]
    wheel = Platform.model_validate(data).geometry().wheels[0]
    assert wheel.drive == (0.0, -1.0, 0.0)
    assert np.linalg.norm(wheel.contact) == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize(
    ("table", "key", "bad", "message"),
    [
        ("sphere", "radius_m", 0, "0.001 <= value <= 100"),
        ("wheel_limits", "speed_rad_s", [1, 2], "a number, or a list of three"),
        ("wheel_limits", "jerk_rad_s3", -1, "1e-06 <= value"),
        ("stage_limits", "travel_m", float("inf"), "1e-06 <= value"),
        ("rider", "head_m", [0, 0, 1.5], r"\|head_m\| <= 1.45"),
        ("wheel_limits", "jerk_rad_s3", 1e-248, "1e-06 <= value"),  # its squares would be 0
        ("rider", "head_m", 0.5, "a list of three"),
    ],
)
def test_refused(table: str, key: str, bad: object, message: str) -> None:
    data = good()
    data.setdefault(table, {})[key] = bad
    with pytest.raises(ValidationError, match=message):
        Platform.model_validate(data)


BAD_NAMES = [
    "",
    "a/b",
    "../x",
    ".hidden",
    "a b",
    "x" * 101,
    "é" * 101,
    "日" * 67,
    3,
    "a\x1b[2J",
    "a\nb",
    "a\0",
]
INVISIBLE = [
    "a\u202eb",
    "a\u200bb",
    "\u0301a",
    "a\u00adb",
    "a\ufeff",
    "½",
    "a\ue000",
    "😀",
    "a\u2028b",
    "a<b",
    "a\u0378",
]


@pytest.mark.parametrize("name", BAD_NAMES + INVISIBLE)
def test_names_that_are_no_file_names(name: object) -> None:
    told = r"letters and digits of any alphabet, .* at most 100 characters and 200 bytes"
    with pytest.raises(ValidationError, match=told):
        Platform.model_validate(good() | {"name": name})


@pytest.mark.parametrize(
    "name",
    ["atlas-2.9m", "Größe", "платформа", "球体", "प्लेटफ़ॉर्म", "منصة", "x" * 100, "é" * 100],
)
def test_names_of_letters_of_any_alphabet(name: str) -> None:
    assert Platform.model_validate(good() | {"name": name}).name == normalize("NFC", name)


def test_names_that_look_the_same_are_the_same() -> None:
    assert Platform.model_validate(good() | {"name": "Gro\u0308\u00dfe"}).name == "Gr\u00f6\u00dfe"


@pytest.mark.parametrize(("zero", "radius"), [(0.0, 0.117), (-0.0, 0.118)])
def test_a_wheel_is_the_same_whichever_zero_came_first(zero: float, radius: float) -> None:
    """They are equal, and different bits, which would go into the logs."""
    table = WheelTable(contact=(0.6, zero, -0.8), drive=(zero, 1.0, zero), radius_m=radius)
    assert repr(table.wheel()) == repr(OmniWheel.along((0.6, 0.0, -0.8), (0.0, 1.0, 0.0), radius))


def test_two_wheels_are_not_enough() -> None:
    data = good()
    data["wheel"].pop()
    with pytest.raises(ValidationError, match="three"):
        Platform.model_validate(data)


UNUSED = {
    f"drive.{key}"
    for key in ("torque_rms_n_m", "motor_inertia_kg_m2", "viscous_n_m_s", "coulomb_n_m")
} | {"traction.keep"}  # a preset's motions stay as they are


@pytest.mark.parametrize("name", NAMES)
def test_a_preset_shows_every_key_there_is(name: str) -> None:
    """Whoever copies one finds what may be changed, the place of the rider's head with it."""

    def keys(table: dict[str, Any]) -> set[str]:
        inner = {
            f"{key}.{deeper}"
            for key, value in table.items()
            if isinstance(value, dict)
            for deeper in keys(value)
        }
        return {*table, *inner}

    written = tomllib.loads(presets()[name].read_text())
    optional = {"preload", "support", "plant"}  # tables that a platform may do without
    assert keys(written) | optional == keys(load_platform(name).model_dump()) - UNUSED | optional
