import json
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.scenario import presets

from .conftest import Command

CASES = json.loads((Path(__file__).parents[1] / "oracles" / "kinematics.json").read_text())


def platform_file(case: dict) -> str:
    wheels = zip(case["contact"], case["drive"], case["wheel_radius_m"], strict=True)
    tables = [
        f"[[wheel]]\ncontact = {contact}\ndrive = {drive}\nradius_m = {radius}"
        for contact, drive, radius in wheels
    ]
    limits = presets()["atlas-2.9m"].read_text().split("[wheel_limits]")[1].split("[[part]]")[0]
    return (
        f'name = "mine"\n[sphere]\nradius_m = {case["sphere_radius_m"]}\n'
        + "\n".join(tables)
        + "\n[wheel_limits]"
        + limits
    )


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_oracle(command: Command, tmp_path: Path, case: dict) -> None:
    (tmp_path / "mine.toml").write_text(platform_file(case))
    ended = command("platform", "mine.toml", "--json")
    table = json.loads(ended.out)
    assert table["name"] == "mine"
    assert table["slip_free"] is case["slip_free"]
    assert table["determinant"] == pytest.approx(case["det_induced"], abs=1e-12)
    np.testing.assert_allclose(table["induced_rows"], case["induced_rows"], atol=1e-12)
    np.testing.assert_allclose(
        table["wheels_from_sphere"], case["wheels_from_sphere"], rtol=1e-12, atol=1e-12
    )
    if case["slip_free"]:
        assert (ended.status, ended.err) == (0, "")
        assert table["condition_number"] == pytest.approx(case["cond_induced"], rel=1e-12)
        np.testing.assert_allclose(
            table["sphere_from_wheels"], case["sphere_from_wheels"], rtol=1e-12, atol=1e-12
        )
    else:
        assert ended.status == 1
        assert "kinematic slip condition" in ended.err
        assert table["sphere_from_wheels"] is None


@pytest.mark.parametrize("name", list(presets()))
def test_presets_for_people(command: Command, name: str) -> None:
    ended = command("platform", name)
    assert (ended.status, ended.err) == (0, "")
    assert "slip_free" in ended.out
    assert ended.out.count("\n  ") == 9
    assert "-0.000000" not in ended.out


def test_singular_for_people(command: Command, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(platform_file(CASES[-1]))
    ended = command("platform", "mine.toml")
    assert ended.status == 1
    assert "none: the geometry is singular" in ended.out


def test_headroom_of_the_full_scale_platform(command: Command) -> None:
    table = json.loads(command("platform", "atlas-2.9m", "--json").out)
    assert table["sphere_rate_about_worst_axis_rad_s"] == pytest.approx(0.15 / 1.45 * 31.0)
    assert min(table["sphere_rate_about_axes_rad_s"]) >= table["sphere_rate_about_worst_axis_rad_s"]
    assert table["sphere_acceleration_about_worst_axis_rad_s2"] == pytest.approx(0.15 / 1.45 * 60.0)


@pytest.mark.parametrize("bad", ["atlas-2.8m", "missing.toml", ".", "", "s.toml"])
def test_bad_input(command: Command, bad: str) -> None:
    ended = command("platform", bad)
    assert (ended.status, ended.out) == (2, "")
    assert ended.err.startswith("error: ")
    assert "Traceback" not in ended.err
