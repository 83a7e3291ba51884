"""Figures of a layout against `platform_loads` and closed forms, and the search for the best."""

from dataclasses import replace
from math import acos, cos, degrees, radians, sqrt
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing import platform_loads
from atlas_cueing.batch import open_store
from atlas_cueing.design import Problem, Ridden, layout_of, search_front, with_layout
from atlas_cueing.design.layout_search import Mixture, solve
from atlas_cueing.design.measure import measure, measure_fully
from atlas_cueing.design.spread import Crew, Kept, spread
from atlas_cueing.loads.balance import required_wrench
from atlas_cueing.scenario import load_platform

ATLAS = load_platform("atlas-2.9m")
START = layout_of(ATLAS)


def ride(n: int, seed: int = 5) -> tuple[dict[str, np.ndarray], Ridden]:
    rng = np.random.default_rng(seed)
    q = rng.normal(size=(n, 4))
    states = {
        "q_WS": q / np.linalg.norm(q, axis=1, keepdims=True),
        "w_WS_W": rng.normal(size=(n, 3)),
        "alpha_WS_W": rng.normal(size=(n, 3)) * 2.0,
        "a_WS_W": rng.normal(size=(n, 3)),
    }
    M, F = required_wrench(ATLAS.load_model(), *states.values())
    return states, Ridden(M, F, states["w_WS_W"], states["alpha_WS_W"])


def test_figures_are_those_of_the_loads() -> None:
    states, ridden = ride(400)
    layout = replace(START, elevation=28.0, skew=35.0, azimuth=20.0)
    found = measure_fully(ATLAS, layout, ridden)
    loads = platform_loads(with_layout(ATLAS, layout), **states)
    assert found
    needed = loads.preload_needed.max()
    gain = 1.0 / 3.0 / np.sin(radians(28.0))
    expected = {
        "preload_needed_n": needed,
        "wheel_load_max_n": loads.normal.max() + needed * gain,
        "torque_max_n_m": np.abs(loads.torque).max(),
        "torque_rms_n_m": np.sqrt((loads.torque**2).mean(axis=0)).max(),
        "power_peak_w": loads.power.sum(axis=1).max(),
        "wheel_speed_max_rad_s": np.abs(loads.speed).max(),
        "motor_speed_max_rad_s": 10.0 * np.abs(loads.speed).max(),
    }
    for name, value in expected.items():
        assert found.figures[name] == pytest.approx(value, rel=1e-12), name


@pytest.mark.parametrize(("radius", "gear"), [(0.1, 10.0), (0.25, 10.0), (0.15, 25.0), (0.1, 4.0)])
def test_radius_and_gear_are_those_of_the_loads(radius: float, gear: float) -> None:
    from atlas_cueing.scenario.load_tables import DriveTable

    motor = DriveTable(gear=10.0, motor_inertia_kg_m2=0.02, efficiency=0.9, coulomb_n_m=5.0)
    platform = ATLAS.model_copy(update={"drive": motor})
    states, ridden = ride(300)
    layout = replace(START, radius=radius, gear=gear)
    found = measure_fully(platform, layout, ridden)
    wheels = [each.model_copy(update={"radius_m": radius}) for each in ATLAS.wheel]
    geared = {"wheel": tuple(wheels), "drive": motor.model_copy(update={"gear": gear})}
    loads = platform_loads(platform.model_copy(update=geared), **states)
    assert found
    torque, speed = np.abs(loads.torque).max(), np.abs(loads.speed).max()
    assert found.figures["torque_max_n_m"] == pytest.approx(torque, rel=1e-12)
    assert found.figures["motor_torque_max_n_m"] == pytest.approx(torque / gear / 0.9, rel=1e-12)
    assert found.figures["motor_speed_max_rad_s"] == pytest.approx(gear * speed, rel=1e-12)


@pytest.mark.parametrize("name", ["atlas-tabletop"])
def test_rows_of_rollers_the_search_is_no_worse_than_a_grid(name: str) -> None:
    from atlas_cueing.wheels import row_corrections

    platform = load_platform(name)
    start = layout_of(platform)
    rows = [wheel.rows for wheel in platform.wheel if wheel.rows]

    def worst(elevation: float, skew: float) -> float:
        built = with_layout(platform, replace(start, elevation=elevation, skew=skew))
        corrections = row_corrections(built.geometry(), rows).values()
        return max(float(np.linalg.norm(each - np.eye(3), 2)) for each in corrections)

    best = min(worst(e, k) for e in np.arange(22.0, 60.0, 4.0) for k in np.arange(0.0, 70.0, 4.0))
    _, ridden = ride(5)
    ranges = {"elevation": (20.0, 60.0), "skew": (0.0, 70.0)}
    problem = Problem(platform, start, ranges, ("row_largest_correction",), ridden, (0.0,), (1.0,))
    found = solve(problem, Mixture((1.0,), 3))
    assert found
    assert worst(*found) <= best
    assert found == pytest.approx([35.3, 45.0], abs=0.5)


def test_with_the_preload_of_the_margin_no_wheel_uses_more_than_that() -> None:
    from atlas_cueing.scenario.load_tables import PreloadTable

    states, ridden = ride(300)
    found = measure_fully(ATLAS, START, ridden)
    assert found
    force = found.figures["preload_with_margin_n"]
    assert force > found.figures["preload_needed_n"]
    pressed = PreloadTable(contact=(0.0, 0.0, 1.0), force_n=force)
    loads = platform_loads(ATLAS.model_copy(update={"preload": (pressed,)}), **states)
    assert loads.traction_use.max() == pytest.approx(1.0 / 1.25, rel=1e-9)


def test_at_its_worst_ticks_a_layout_is_as_bad_as_at_all() -> None:
    _, ridden = ride(500)
    everywhere = measure(ATLAS, START, ridden)
    assert everywhere
    assert len(everywhere.worst) < 25
    there = measure(ATLAS, START, ridden.at(everywhere.worst))
    assert there
    assert there.figures == pytest.approx(everywhere.figures, rel=1e-12)


def test_wheels_that_meet_cannot_be_built() -> None:
    _, ridden = ride(3)
    assert measure(ATLAS, replace(START, elevation=88.0), ridden) is None


@pytest.mark.parametrize("elevation", [25.0, 45.0])
def test_the_isotropic_family_is_found(elevation: float) -> None:
    _, ridden = ride(20)
    problem = Problem(
        ATLAS,
        replace(START, elevation=elevation),
        {"skew": (5.0, 70.0)},
        ("condition_number",),
        ridden,
        (1.0,),
        (5.0,),
    )
    found = solve(problem, Mixture((1.0,), 3))
    assert found
    expected = degrees(acos(1.0 / sqrt(3.0) / cos(radians(elevation))))
    assert found[0] == pytest.approx(expected, abs=1e-3)


def front_of(folder: Path, crew: Crew, count: list[str]) -> list[dict]:
    _, ridden = ride(200)
    ranges = {"elevation": (20.0, 50.0), "skew": (-60.0, 60.0)}
    goals = ("preload_needed_n", "torque_max_n_m")
    problem = Problem(ATLAS, START, ranges, goals, ridden)
    store = open_store(str(folder))
    with store.opened():
        front = search_front(
            problem,
            ridden,
            [],
            searches=3,
            seed=1,
            crew=crew,
            kept=Kept(store),
            tell=lambda what, _: count.append(what),
        )
    assert front.rated[front.chosen].on_front
    assert front.gap < 5e-3
    return [row.to_json() for row in front.rated]


def test_one_process_two_and_what_was_kept_give_the_same(tmp_path: Path) -> None:
    alone = front_of(tmp_path / "one", Crew(None), [])
    with spread(2, None) as crew:
        assert front_of(tmp_path / "two", crew, []) == alone
    parts = {path: path.stat().st_mtime_ns for path in (tmp_path / "one").glob("part-*.json")}
    assert parts

    def nobody(*_: object) -> None:
        raise AssertionError("worked out again")

    assert front_of(tmp_path / "one", Crew(nobody), []) == alone
    assert {path: path.stat().st_mtime_ns for path in parts} == parts
    assert min(row["preload_needed_n"] for row in alone) < alone[0]["preload_needed_n"]
