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


def test_loads_for_people(command: Command) -> None:
    ended = command("platform", "atlas-2.9m", "--loads")
    assert (ended.status, ended.err) == (0, "")
    assert "remark: stage_limits.acceleration_m_s2 along x: 6 is allowed" in ended.out
    assert "wheel_space_inertia_kg_m2" in ended.out


def test_loads_for_programs(command: Command) -> None:
    table = json.loads(command("platform", "atlas-2.9m", "--loads", "--json").out)
    assert table["rest_normal_force_n"] == pytest.approx([2491.8850475578415] * 3)
    assert table["lift_off_acceleration_horizontal_m_s2"] == pytest.approx(5.843555184407005)
    assert table["preload_gain"] == pytest.approx([0.5185749] * 3)
    assert table["sphere_acceleration_by_torque_about_worst_axis_rad_s2"] > 10.0
    assert table["stage_travel_m"] == [1.0, 1.0, 0.75]
    assert len(table["broken_promises"]) == 4


def test_the_sphere_of_the_slip_studies(command: Command) -> None:
    """50 kg at 40 deg and mu 0.5: from 3.87 rad/s2 about the worst axis a wheel slips."""
    table = json.loads(command("platform", "atlas-1.5m", "--loads", "--json").out)
    by_traction = "sphere_acceleration_by_traction_about_worst_axis_rad_s2"
    assert table[by_traction] == pytest.approx(3.87, abs=0.005)
    assert table["sphere_acceleration_by_traction_about_axes_rad_s2"][2] == pytest.approx(
        11.68711036881401
    )


def test_promises_are_findings_where_the_platform_says_so(command: Command, tmp_path: Path) -> None:
    text = presets()["atlas-2.9m"].read_text()
    (tmp_path / "mine.toml").write_text(text.replace('report = "remark"', 'report = "finding"'))
    ended = command("platform", "mine.toml", "--loads")
    assert ended.status == 1
    assert ended.err.count("\n") == 4
    assert "mine.toml: stage_limits.acceleration_m_s2 along x" in ended.err
    assert command("platform", "mine.toml").status == 0


def test_loads_without_masses(command: Command, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(platform_file(CASES[0]))
    ended = command("platform", "mine.toml", "--loads")
    assert (ended.status, ended.out) == (2, "")
    assert "has no masses; give it [[part]] tables" in ended.err


def test_double_rows(command: Command) -> None:
    table = json.loads(command("platform", "atlas-tabletop", "--json").out)
    assert np.degrees(table["row_tilt_rad"]) == pytest.approx([2.218] * 3, abs=1e-3)
    assert table["row_largest_correction"] == pytest.approx(0.055, abs=5e-4)
    assert table["row_mean_correction"] == pytest.approx(1.5e-3, abs=5e-5)
    assert 0.040 < table["row_ripple_rms"] < 0.049
    assert 0.2 < np.degrees(table["row_drift_mean_rad_per_turn"]) < 2.7
    assert "row_tilt_rad" not in json.loads(command("platform", "atlas-2.9m", "--json").out)


def four_wheels(speed: object) -> str:
    """Wheels at 40 deg on four sides, drives turned out of the horizontal."""
    tables = ""
    for k in range(4):
        a = np.pi * k / 2.0
        u = [float(0.77 * np.cos(a)), float(0.77 * np.sin(a)), -0.64]
        along = np.array([np.sin(a), -np.cos(a), 0.0])
        v = (along + np.cross(u, along)).tolist()
        tables += f"[[wheel]]\ncontact = {u}\ndrive = {v}\nradius_m = 0.15\nfriction = 0.5\n"
    rest = presets()["atlas-2.9m"].read_text().split("[wheel_limits]")[1]
    limits = f"[wheel_limits]\nspeed_rad_s = {speed}\n" + rest.split("\n", 2)[2]
    return f'name = "four"\n[sphere]\nradius_m = 1.45\n{tables}\n{limits}'


@pytest.mark.parametrize("speed", [31.0, [31.0, 31.0, 31.0, 30.0]])
def test_four_wheels(command: Command, tmp_path: Path, speed: object) -> None:
    (tmp_path / "four.toml").write_text(four_wheels(speed))
    table = json.loads(command("platform", "four.toml", "--loads", "--json").out)
    inverse, J = np.array(table["wheels_from_sphere"]), np.array(table["sphere_from_wheels"])
    assert inverse.shape == (4, 3)
    np.testing.assert_allclose(J @ inverse, np.eye(3), atol=1e-12)
    weight = np.sum(table["rest_normal_force_n"]) * 0.64 / np.hypot(0.77, 0.64)
    assert weight == pytest.approx(490.0 * 9.80665)
    assert len(table["wheel_space_inertia_kg_m2"]) == len(table["preload_gain"]) == 4
    assert command("platform", "four.toml", "--loads").status == 0


def test_four_wheels_do_not_fly(command: Command, tmp_path: Path) -> None:
    (tmp_path / "four.toml").write_text(four_wheels(31.0))
    (tmp_path / "s.toml").write_text(
        'name = "s"\nduration_s = 1.0\n[vehicle]\nscript = "c1722"\n'
        '[platform]\nfile = "four.toml"\n'
    )
    ended = command("run", "s.toml")
    assert (ended.status, ended.out) == (2, "")
    assert "platform 'four' has 4 wheels, allowed in a run: 3" in ended.err
    assert not (tmp_path / "s.mcap").exists()


def test_limits_of_other_wheels(command: Command, tmp_path: Path) -> None:
    (tmp_path / "four.toml").write_text(four_wheels([31.0, 31.0, 30.0]))
    ended = command("platform", "four.toml")
    assert (ended.status, ended.out) == (2, "")
    assert "wheel_limits" in ended.err
    assert "a list of 4: one for each wheel" in ended.err
