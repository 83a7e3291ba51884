"""The pinned figures: how every bundled scenario begins.

`tools/update_references` writes them, `test_references` compares.
"""

import json
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory

from flight_sets import CONSTANTS, UNSEEN

from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import load_scenario

SCENARIOS = Path(__file__).parents[2] / "scenarios"
REFERENCES = Path(__file__).with_name("figures.json")
# s of each flight: every scenario is flown on every check, so that must be cheap. Of the flights
# to compare methods by, which are many, less: what they begin with is like what the others do.
LONGEST, SHORTER = 12.0, 3.0

# What a change of vehicle, cueing, smoothing or wheels cannot hide from; other metrics may come and
# go.
PINNED = (
    "ticks",
    "force_rms_m_s2",
    "force_max_m_s2",
    "direction_rms_rad",
    "rate_rms_rad_s",
    "attitude_rms_rad",
    "turns_roll",
    "turns_pitch",
    "turns_yaw",
    "wheels_limited_share",
    "stage_limited_share",
    "cue_lag_rms_rad",
    "wheel_speed_max_rad_s",
    "wheel_acceleration_max_rad_s2",
    "stage_travel_max_m",
    "stage_speed_max_m_s",
    "stage_acceleration_max_m_s2",
)

# Relative, or absolute in SI for figures below 1. Runs repeat to the last bit on one machine;
# another C library rounds otherwise in the last bit, which a flight of seconds lets grow to 1e-9,
# and shares of ticks to one tick in a thousand. A change of a thousandth is far below what a rider
# could feel and far above both.
TOLERANCE = 1e-3


def names() -> list[str]:
    """Every bundled scenario that is one run; a sweep stands for many."""
    return sorted(
        path.stem
        for path in SCENARIOS.glob("*.toml")
        if "sweep" not in tomllib.loads(path.read_text())
    )


def pinned() -> dict[str, dict[str, float]]:
    """The references: figures by scenario."""
    table: dict[str, dict[str, float]] = json.loads(REFERENCES.read_text())
    return table


def flown(name: str) -> dict[str, float]:
    """The same figures, flown now."""
    scenario = load_scenario(SCENARIOS / f"{name}.toml")
    longest = SHORTER if name in (*CONSTANTS, *UNSEEN) else LONGEST
    duration = min(longest, scenario.file.duration_s or longest)
    scenario = load_scenario(SCENARIOS / f"{name}.toml", [f"duration_s={duration}"])
    with TemporaryDirectory() as folder:
        result = run_scenario(scenario, Path(folder) / "log.mcap")
    return {figure: result.evaluation.metrics[figure] for figure in PINNED}


def differences(
    was: dict[str, float], now: dict[str, float]
) -> dict[str, tuple[float | None, float | None]]:
    """Figures that differ by more than the tolerance, or that only one has: (was, now)."""
    return {
        figure: (was.get(figure), now.get(figure))
        for figure in dict.fromkeys([*was, *now])
        if figure not in was
        or figure not in now
        or not abs(now[figure] - was[figure]) <= TOLERANCE * max(1.0, abs(was[figure]))
    }
