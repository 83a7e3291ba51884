"""Keys of a platform for its loads: optional, checked, and nothing where they are not."""

import copy
from math import cos, radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
from pydantic import ValidationError

from atlas_cueing.errors import InputError, ScenarioError
from atlas_cueing.loads import Preload, Support
from atlas_cueing.scenario import Platform, load_platform, presets
from atlas_cueing.scenario.reading import read_toml

KINEMATIC = ("name", "sphere", "wheel", "wheel_limits", "stage_limits", "rider")


def good() -> dict[str, Any]:
    return copy.deepcopy(read_toml(presets()["atlas-2.9m"]))


def kinematics_only() -> dict[str, Any]:
    data = {key: value for key, value in good().items() if key in KINEMATIC}
    for wheel in data["wheel"]:
        for key in ("inertia_kg_m2", "friction"):
            del wheel[key]
    return data


def test_without_the_keys_nothing_is_there() -> None:
    platform = Platform.model_validate(kinematics_only())
    assert not platform.has_loads
    assert set(platform.model_dump(exclude_none=True)) == set(KINEMATIC)
    assert set(platform.model_dump(exclude_none=True)["wheel"][0]) == {
        "contact",
        "drive",
        "radius_m",
    }
    with pytest.raises(InputError, match="has no masses; give it"):
        platform.load_model()


def test_numbers_arrive() -> None:
    data = good()
    data["wheel"][1] |= {"friction": 0.7, "inertia_kg_m2": 0.3, "load_limit_n": 9e3}
    for wheel in data["wheel"]:
        wheel["stiffness_n_m"] = 1e6
    data["drive"] |= {"torque_rms_n_m": 200.0}
    data["drive"] |= {"motor_inertia_kg_m2": 0.002, "viscous_n_m_s": 0.1, "coulomb_n_m": 2.0}
    data["preload"] = [{"contact": [0, 0, 2], "force_n": 100}]
    data["support"] = [{"contact": [0, -3, 0], "stiffness_n_m": 5e5, "preload_n": 7}]
    data["traction"] = {"margin": 1.5, "report": "finding"}
    model = Platform.model_validate(data).load_model()
    assert model.body.mass == 490.0
    np.testing.assert_allclose(model.body.com_S, [0.0, 0.0, -17.5 / 490.0])
    assert model.friction.tolist() == [0.5, 0.7, 0.5]
    assert model.wheel_inertia == pytest.approx([0.7, 0.5, 0.7])  # 10^2 x 0.002 of the motor
    assert model.viscous.tolist() == [0.1] * 3
    assert model.coulomb.tolist() == [2.0] * 3
    assert model.wheels[1].load_limit == 9e3
    assert model.preloads == (Preload((0.0, 0.0, 1.0), 100.0),)
    assert model.supports == (Support((0.0, -1.0, 0.0), 5e5, 7.0),)
    assert (model.traction_margin, model.traction_finding) == (1.5, True)
    drive = model.drive
    assert (drive.torque, drive.torque_rms, drive.gear, drive.efficiency) == (
        600.0,
        200.0,
        10.0,
        0.9,
    )


def test_a_mecanum_wheel_drives_along_its_rollers() -> None:
    data = kinematics_only()
    for wheel in data["wheel"]:
        wheel["roller_deg"] = 45.0
    radii = [wheel.radius for wheel in Platform.model_validate(data).geometry().wheels]
    assert radii == pytest.approx([0.15 * cos(radians(45.0))] * 3)


@pytest.mark.parametrize(
    ("path", "bad", "message"),
    [
        (("part", 0, "mass_kg"), 0, "0 < value"),
        (("part", 0, "inertia_kg_m2"), [1.0, 1.0, 2.1], "belongs to no rigid body"),
        (("part", 0, "inertia_kg_m2"), [1.0, 1.0, 1.0, 2.0, 0.0, 0.0], "belongs to no rigid body"),
        (("part", 0, "inertia_kg_m2"), [1.0, 1.0], "a list of three"),
        (("part", 0, "inertia_kg_m2"), [1e300] * 3, "elements within"),
        (("part", 0, "com_m"), [0, 0, 1.5], r"\|com_m\| <= 1.45"),
        (("part", 0, "name"), "a\nb", "printable"),
        (("part",), [], "1 to 100 tables"),
        (("wheel", 1, "friction"), None, "have to be wheel.1.friction"),
        (("wheel", 1, "friction"), 0, "0.001 <= value"),
        (("wheel", 1, "roller_deg"), 90, "value <= 80"),
        (("wheel", 1, "row_offset_m"), 0.02, "all or none of row_offset_m"),
        (
            ("support",),
            [{"contact": [0, 0, 1], "stiffness_n_m": 5}],
            "have to be wheel.0.stiffness_n_m",
        ),
        (("support",), [{"contact": [0, 0, 0], "stiffness_n_m": 5}], "has no direction"),
        (("preload",), [{"contact": [0, 0, 0], "force_n": 5}], "has no direction"),
        (("preload",), [{"contact": [0, 0, 1], "force_n": -5}], "0 <= value"),
        (("drive", "efficiency"), 1.5, "value <= 1"),
        (("drive", "regeneration"), 1, "bool"),
        (("traction", "report"), "loud", "remark"),
        (("traction", "margin"), 0.5, "1 <= value"),
    ],
)
def test_refused(path: tuple[str | int, ...], bad: object, message: str) -> None:
    data: Any = good()
    table = data
    for key in path[:-1]:
        table = table[key]
    table[path[-1]] = bad
    with pytest.raises(ValidationError, match=message):
        Platform.model_validate(data)


def test_rows_of_rollers_beside_the_sphere_are_refused() -> None:
    data = good()
    rows = {"roller_profile_radius_m": 0.03, "rollers_per_row": 8}
    for wheel in data["wheel"]:
        wheel |= {"row_offset_m": 1.4, **rows}
    Platform.model_validate(data)
    data["wheel"][1]["row_offset_m"] = 1.45
    with pytest.raises(ValidationError, match=r"less than sphere\.radius_m = 1\.45"):
        Platform.model_validate(data)


def test_contacts_that_cannot_carry() -> None:
    """Wheels on the equator hold no weight; their rows turn the sphere well enough."""
    data = good()
    for wheel, azimuth in zip(data["wheel"], (0.0, 2.0944, 4.1888), strict=True):
        u = [float(np.cos(azimuth)), float(np.sin(azimuth)), 0.0]
        wheel["contact"], wheel["drive"] = u, [-0.5 * u[1], 0.5 * u[0], 0.8]
    with pytest.raises(
        ValidationError, match="contacts of wheels and supports are not independent"
    ):
        Platform.model_validate(data)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"name": "shell"}, "part: two parts are called 'shell', allowed: a name of its own each"),
        ({"com_m": [9.0, 0.0, 0.0]}, "part: allowed: every com_m within the sphere"),
        ({"mass": 1.0}, "part.1.mass = 1.0: unknown key"),
    ],
)
def test_a_wrong_part_is_told_without_the_whole_table(
    tmp_path: Path, change: dict[str, Any], told: str
) -> None:
    data = good()
    data["part"][1] |= change
    (tmp_path / "p.toml").write_text(tomli_w.dumps(data))
    with pytest.raises(ScenarioError) as caught:
        load_platform(str(tmp_path / "p.toml"))
    assert told in str(caught.value)
    assert "{" not in str(caught.value)
