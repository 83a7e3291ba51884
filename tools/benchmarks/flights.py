"""The flights that are measured."""

from dataclasses import replace
from pathlib import Path

from atlas_cueing.scenario import Scenario, load_scenario

STAGED = "c1722"
# JSBSim's own, and how much of a flight's length is flown: the flying boat goes at 960 Hz, where
# the others go at 120 or so. f16_test fails after 127 s, so shorter flights of it are whole.
SCRIPTS = {STAGED: 1.0, "f16_test": 1.0, "ah1s_flight_test": 1.0, "Short_S23_1": 0.125}

_SCRIPT = """
name = "{name}"
duration_s = {duration}
[vehicle]
script = "{name}"
[platform]
preset = "atlas-2.9m"
"""

# A lasting motion without end: all axes busy, at any rate and for any time, and no aircraft that
# falls down.
_SIGNAL = """
name = "signal"
duration_s = {duration}
[vehicle]
source = "signal"
rate_hz = {rate}
[[vehicle.signal]]
axis = "roll_rate"
shape = "sine"
amplitude_deg_s = 10.0
frequency_rad_s = 0.7
time_s = 1.0
duration_s = {duration}
ramp_s = 1.0
[[vehicle.signal]]
axis = "force_y"
shape = "sine"
amplitude_m_s2 = 0.5
frequency_rad_s = 2.0
time_s = 1.0
duration_s = {duration}
ramp_s = 1.0
[platform]
preset = "atlas-2.9m"
"""

_SWEEP = """
[sweep]
cueing.force_gain = [{gains}]
"""


def script_file(folder: Path, name: str, duration: float, more: str = "") -> Path:
    """A scenario file that flies `duration` s of one of JSBSim's scripts."""
    file = folder / f"{name}_{duration:g}.toml"
    file.write_text(_SCRIPT.format(name=name, duration=duration) + more)
    return file


def signal_file(folder: Path, rate: float, duration: float) -> Path:
    """A scenario file that flies `duration` s of signals at `rate` Hz."""
    file = folder / f"signal_{rate:g}_{duration:g}.toml"
    file.write_text(_SIGNAL.format(rate=rate, duration=duration))
    return file


def sweep_file(folder: Path, runs: int, duration: float) -> Path:
    """A batch of so many runs of the same length."""
    gains = ", ".join(f"{0.4 + 0.01 * run:.2f}" for run in range(runs))
    return script_file(folder, STAGED, duration, _SWEEP.format(gains=gains))


def script_scenario(
    folder: Path, name: str, duration: float, method: str = "blend", *, loads: bool = True
) -> Scenario:
    """The same, loaded; without `loads` on a platform without masses."""
    scenario = load_scenario(script_file(folder, name, duration), [f"cueing.method={method}"])
    if loads:
        return scenario
    return replace(scenario, platform=scenario.platform.model_copy(update={"part": None}))
