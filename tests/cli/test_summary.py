from dataclasses import replace
from math import inf, pi
from pathlib import Path

from short_scenario import Load

from atlas_cueing.cli.summary import kinematics, platform_summary, run_summary
from atlas_cueing.run import Evaluation, RunResult, run_scenario
from atlas_cueing.scenario import load_platform

RESULT = RunResult(
    "vehicle_failed",
    "it fell",
    Path("x.mcap"),
    1200,
    10.0,
    0.5,
    Evaluation(
        {
            "force_rms_m_s2": 0.123456789,
            "force_max_m_s2": inf,
            "direction_rms_rad": pi / 180.0,
            "cue_lag_max_rad": pi / 1800.0,
            "cue_lag_max_m": 0.002,
            "wheels_limited_share": 0.25,
            "stage_limited_share": 0.0,
            "turns_roll": 3.5,
            "turns_pitch": -1.0,
            "turns_yaw": 0.0,
        },
        {
            "wheel_speed_logged": 0.25,
            "wheel_jerk_difference": 0.5,
            "wheel_jerk_second_difference": 1.0,
        },
        ("too fast",),
    ),
)


def test_run() -> None:
    assert run_summary(RESULT).splitlines() == [
        "result      vehicle_failed  it fell",
        "log         x.mcap",
        "flight      10.00 s, 1200 ticks, flown at 20.0 times real time",
        "violations  1",
        "rider less pilot              rms       p95       max",
        "specific force   m/s2       0.123         -       inf",
        "force direction  deg        1.000         -         -",
        "net turns       roll +3.50, pitch -1.00, yaw +0.00",
        "lag behind cue  at most 0.100 deg, 2.00 mm",
        "limited         wheels 25.00%, stage 0.00% of the time",
        "wheel speed  25.0000 % of its limit",
        "wheel jerk   100.0000 % of its limit",
    ]


def test_run_without_figures() -> None:
    nothing = RunResult("vehicle_failed", "no trim", Path("x.mcap"), 0, 0.0, 0.0, Evaluation())
    assert run_summary(nothing).splitlines()[0] == "result      vehicle_failed  no trim"
    assert len(run_summary(nothing).splitlines()) == 4


def test_platform() -> None:
    figures = kinematics(load_platform("atlas-orthogonal"))
    lines = platform_summary(figures).splitlines()
    assert lines[0].split() == ["name", "atlas-orthogonal"]
    assert ["determinant", "-1"] in [line.split() for line in lines]
    rows = [[float(x) for x in line.split()] for line in lines if line.startswith("  ")]
    assert rows[:3] == [[0, -1, 0], [0, 0, -1], [-1, 0, 0]]
    assert len(rows) == 9


def test_a_ride_that_never_ran_has_no_figures_of_a_rider(load: Load, tmp_path: Path) -> None:
    """Zeros of no samples would look like the best ride there is."""
    result = run_scenario(load("duration_s=0.2"), tmp_path / "log.mcap")
    whole = run_summary(result)
    assert "mismatch" in whole
    assert "rider less pilot" in whole
    metrics = {**dict.fromkeys(result.evaluation.metrics, 0.0), "ticks": 0.0}
    none = run_summary(replace(result, evaluation=replace(result.evaluation, metrics=metrics)))
    assert "figures      " in none
    assert "never came to running" in none
    assert not [word for word in ("mismatch", "rider less pilot", "net turns") if word in none]
    assert "wheel speed" in none
