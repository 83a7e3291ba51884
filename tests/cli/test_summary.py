from math import inf
from pathlib import Path

from atlas_cueing.batch import RunResult
from atlas_cueing.batch.evaluate import Evaluation
from atlas_cueing.cli.summary import kinematics, platform_summary, run_summary
from atlas_cueing.scenario import load_platform

RESULT = RunResult(
    "vehicle_failed",
    "it fell",
    Path("x.mcap"),
    1200,
    10.0,
    0.5,
    Evaluation({"force_rms_m_s2": 0.123456789, "turns_roll": inf}, {"wheel_speed": 0.25}, ("too fast",)),
)


def test_run() -> None:
    assert run_summary(RESULT).splitlines() == [
        "result      vehicle_failed  it fell",
        "log         x.mcap",
        "ticks       1200",
        "duration    10.00 s, flown at 20.0 times real time",
        "violations  1",
        "metrics",
        "  force_rms_m_s2  0.123457",
        "  turns_roll      inf",
        "largest use of each limit",
        "  wheel_speed  25.0000 %",
    ]


def test_platform() -> None:
    figures = kinematics(load_platform("atlas-orthogonal"))
    lines = platform_summary(figures).splitlines()
    assert lines[0].split() == ["name", "atlas-orthogonal"]
    assert ["determinant", "-1"] in [line.split() for line in lines]
    rows = [[float(x) for x in line.split()] for line in lines if line.startswith("  ")]
    assert rows[:3] == [[0, -1, 0], [0, 0, -1], [-1, 0, 0]]
    assert len(rows) == 9
