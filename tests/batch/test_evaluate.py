from pathlib import Path

from atlas_cueing.batch.run import run_scenario
from atlas_cueing.scenario import evaluate, load_platform

from .conftest import Load


def test_the_log_alone_gives_the_figures_of_the_run(load: Load, tmp_path: Path) -> None:
    scenario = load()
    result = run_scenario(scenario, tmp_path / "log.mcap")
    again = evaluate(result.log, scenario.platform)
    assert again == result.evaluation
    assert again.violations == ()
    assert 0.0 < again.limit_use["wheel_speed_logged"] < 1.0


def test_a_weaker_platform_would_have_been_violated(load: Load, tmp_path: Path) -> None:
    """The same log against a tenth of the limits: the check can fail."""
    log = run_scenario(load(), tmp_path / "log.mcap").log
    weaker = load("platform.wheel_limits.jerk_rad_s3=0.001", "platform.stage_limits.travel_m=0.00001").platform
    found = evaluate(log, weaker).violations
    assert any(line.startswith("wheel_jerk_difference") for line in found)
    assert any(line.startswith("stage_travel_logged") for line in found)


def test_the_wheels_of_another_platform_do_not_fit(load: Load, tmp_path: Path) -> None:
    log = run_scenario(load("vehicle.script=c172_elevator_doublet", "duration_s=5"), tmp_path / "log.mcap").log
    right, wrong = (evaluate(log, load_platform(name)).metrics for name in ("atlas-2.9m", "atlas-orthogonal"))
    assert right["wheel_speed_mismatch_max_rad_s"] < 1e-12
    assert wrong["wheel_speed_mismatch_max_rad_s"] > 0.01
    assert wrong["orientation_drift_max_rad"] > 10.0 * right["orientation_drift_max_rad"]


def test_a_log_that_cannot_be_read_is_a_finding(load: Load, tmp_path: Path) -> None:
    (tmp_path / "log.mcap").write_bytes(b"no log")
    evaluation = evaluate(tmp_path / "log.mcap", load().platform)
    assert len(evaluation.violations) == 1
    assert evaluation.violations[0].startswith("not evaluated: ")
    assert evaluation.metrics == {}
