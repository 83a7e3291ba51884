"""Whole flights on the plant, against the log's own motion."""

from math import degrees
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing import load_scenario, run_scenario
from atlas_cueing.errors import InputError
from atlas_cueing.plant import fly_plant, plant_figures, plant_table
from atlas_cueing.review import open_run
from atlas_cueing.review.recorded_run import RecordedRun
from atlas_cueing.scenario import Platform
from atlas_cueing.scenario.plant_table import PlantTable

SCENARIOS = Path(__file__).parents[2] / "scenarios"


def flown(folder: Path, scenario: str, *settings: str) -> RecordedRun:
    loaded = load_scenario(SCENARIOS / f"{scenario}.toml", settings)
    return open_run(run_scenario(loaded, folder / f"{scenario}.mcap").log)


@pytest.fixture(scope="module")
def rolls(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    return flown(tmp_path_factory.mktemp("rolls"), "f16_rolls", "cueing.method=blend")


@pytest.fixture(scope="module")
def short(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    settings = ("cueing.method=force", "duration_s=4", "platform.preset=atlas-2.9m-halo")
    return flown(tmp_path_factory.mktemp("short"), "f16_rolls", *settings)


def with_friction(platform: Platform, friction: float) -> Platform:
    wheels = tuple(wheel.model_copy(update={"friction": friction}) for wheel in platform.wheel)
    return platform.model_copy(update={"wheel": wheels})


def test_without_slip_the_sphere_does_what_the_log_says(rolls: RecordedRun) -> None:
    table = PlantTable(creep_stiffness=1e9)
    run = fly_plant(rolls.log, with_friction(rolls.platform, 50.0), "none", table)
    found = plant_figures(run, rolls.log)
    assert degrees(found["orientation_error_end_rad"]) < 0.02
    assert degrees(found["orientation_error_max_rad"]) < 0.2  # while the servos lag
    assert abs(found["friction_loss_j"]) < 0.1
    assert found["felt_rate_error_rms_rad_s"] < 0.01


def test_with_slip_only_a_fix_holds_it(rolls: RecordedRun) -> None:
    error, energy = {}, {}
    for feedback in ("none", "odometry", "fix"):
        found = plant_figures(fly_plant(rolls.log, rolls.platform, feedback), rolls.log)
        error[feedback] = np.degrees(
            [found["orientation_error_end_rad"], found["orientation_error_max_rad"]]
        )
        energy[feedback] = abs(found["energy_residual_j"]) / found["energy_throughput_j"]
    assert error["none"][0] > 0.5
    assert error["odometry"][0] == pytest.approx(error["none"][0], rel=0.05)
    assert error["fix"][0] < 0.1
    assert error["fix"][1] < 1.0
    assert max(energy.values()) < 1e-6


def test_half_the_step_shows_the_same(short: RecordedRun) -> None:
    found = [
        plant_figures(
            fly_plant(short.log, short.platform, "fix", PlantTable(step_s=step)), short.log
        )
        for step in (1e-3, 5e-4)  # the default, and half of it
    ]
    for name, value in found[0].items():
        if name != "energy_residual_j":
            assert value == pytest.approx(found[1][name], rel=2e-4, abs=1e-6), name


def test_the_residual_sees_slip(rolls: RecordedRun) -> None:
    """Without noise, gyro and encoders tell the slip of each wheel tick by tick (r rho = -s)."""
    table = PlantTable(gyro_bias_rad_s=0.0, gyro_noise_rad_sqrt_s=0.0)
    run = fly_plant(rolls.log, rolls.platform, "gyro", table)
    slip, residual = run.plant[:, 17:20], run.plant[:, 29:32]
    radius = rolls.platform.wheel[0].radius_m
    mean = 0.5 * (slip[1:] + slip[:-1])  # the residual is a mean over the tick
    assert np.abs(slip).max() > 0.02
    # d' of the centre, which no gyro sees, and the turn within a tick are what is left
    assert np.sqrt(np.mean((radius * residual[1:] + mean) ** 2)) < 0.15 * np.sqrt(np.mean(mean**2))


def test_rows_of_rollers_shake_and_energy_is_kept(tmp_path: Path) -> None:
    run = flown(tmp_path, "f16_rolls", "platform.preset=atlas-tabletop", "duration_s=6")
    done = fly_plant(run.log, run.platform, "fix")
    found = plant_figures(done, run.log)
    assert found["row_change_work_j"] != 0.0
    assert abs(found["energy_residual_j"]) < 1e-6 * found["energy_throughput_j"]


def test_a_platform_that_makes_no_plant_is_refused(short: RecordedRun) -> None:
    bare = short.platform.model_copy(update={"part": None})
    with pytest.raises(InputError, match="has no masses"):
        fly_plant(short.log, bare)
    light = tuple(w.model_copy(update={"inertia_kg_m2": None}) for w in short.platform.wheel)
    with pytest.raises(InputError, match=r"wheel\.0\.inertia_kg_m2 is not given"):
        fly_plant(short.log, short.platform.model_copy(update={"wheel": light}))
    with pytest.raises(InputError, match="allowed: none, odometry, gyro, fix"):
        fly_plant(short.log, short.platform, "optic")


def test_settings_go_on_top_of_the_platform(short: RecordedRun) -> None:
    own = short.platform.model_copy(update={"plant": PlantTable(fix_gain=0.3)})
    table = plant_table(own, ["platform.plant.fix_latency_s=0.05"])
    assert (table.fix_gain, table.fix_latency_s) == (0.3, 0.05)
    for bad in ("platform.plant.creep=3", "plant.seed=1", "platform.name=x"):
        with pytest.raises(InputError, match=r"allowed: platform\.plant\.KEY"):
            plant_table(own, [bad])
    with pytest.raises(InputError, match="fix_gain = 3, allowed: a number, 0 <= value <= 1"):
        plant_table(own, ["platform.plant.fix_gain=3"])
