from pathlib import Path

import pytest
from installed import PRESETS

from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import load_scenario

# Six seconds of an F-16 that begins to roll, with a rider whose head is off the centre: everything
# moves.
FLIGHT = """
name = "roll"
duration_s = 6.0
[vehicle]
aircraft = "f16"
rate_hz = 120
input = [
    { time_s = 1.0, property = "fcs/aileron-cmd-norm", value = 0.4, ramp_s = 0.3 },
    { time_s = 3.0, property = "fcs/elevator-cmd-norm", value = -0.2, ramp_s = 0.5 },
]
[vehicle.initial]
altitude_m = 3000.0
airspeed_m_s = 200.0
trim = true
[platform]
file = "platform.toml"
[cueing]
method = "blend"
"""
SCENARIOS = Path(__file__).parents[2] / "scenarios"


def fly(folder: Path, *settings: str, text: str = FLIGHT, name: str = "flight.mcap") -> Path:
    """A log of the flight, in `folder`."""
    (folder / "platform.toml").write_text((PRESETS / "atlas-2.9m.toml").read_text())
    (folder / "s.toml").write_text(text)
    result = run_scenario(
        load_scenario(folder / "s.toml", ("platform.rider.head_m=[0.1,0.05,0.3]", *settings)),
        folder / name,
    )
    assert result.result == "ok"
    return folder / name


@pytest.fixture(scope="session")
def flight(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A clean log; never written to."""
    return fly(tmp_path_factory.mktemp("flight"))
