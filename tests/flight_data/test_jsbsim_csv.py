"""A flight that JSBSim itself wrote as CSV, against the same flight flown directly."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.cueing import CAUSAL_METHODS
from atlas_cueing.flight_data import import_flight, load_map, write_flight
from atlas_cueing.recording import read_log
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import load_scenario

SECONDS = 12.0
DIRECT = f"""
name = "direct"
duration_s = {SECONDS}
[vehicle]
script = "c1723"
[platform]
preset = "atlas-2.9m"
"""
RECORDED = DIRECT.replace('script = "c1723"', 'source = "recording"\nlog = "flight.mcap"')
# JSBSim by itself: the script, its own output with units in the header, no line of ours
FLY = """
import os, jsbsim
fdm = jsbsim.FGFDMExec(None)
fdm.load_script("scripts/c1723.xml")
fdm.set_output_path(os.getcwd())
fdm.set_output_directive(os.path.abspath("output.xml"))
fdm.run_ic()
while fdm.get_sim_time() < {seconds}:
    fdm.run()
"""
OUTPUT = """<?xml version="1.0"?>
<output name="flight.csv" type="CSV" rate="120">
  <rates> ON </rates>
  <position> ON </position>
  <property> accelerations/a-pilot-x-ft_sec2 </property>
  <property> accelerations/a-pilot-y-ft_sec2 </property>
  <property> accelerations/a-pilot-z-ft_sec2 </property>
  <property> accelerations/gravity-ft_sec2 </property>
</output>
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("jsbsim")
    (folder / "output.xml").write_text(OUTPUT)
    subprocess.run(
        [sys.executable, "-c", FLY.format(seconds=SECONDS)],
        cwd=folder,
        env={**os.environ, "JSBSIM_DEBUG": "0"},
        capture_output=True,
        check=True,
    )
    (folder / "direct.toml").write_text(DIRECT)
    (folder / "recorded.toml").write_text(RECORDED)
    flight_map = load_map("jsbsim-csv", [f"gravity.m_s2={local_gravity(folder / 'flight.csv')}"])
    write_flight(
        folder / "flight.mcap", import_flight(folder / "flight.csv", flight_map), flight_map
    )
    return folder


def local_gravity(path: Path) -> float:
    """What a scale shows there, m/s^2: gravitation less the pull of the Earth's turn."""
    header, first, *_ = path.read_text().splitlines()
    at = dict(zip(header.split(","), first.split(","), strict=True))
    gravitation = 0.3048 * float(at["/fdm/jsbsim/accelerations/gravity-ft_sec2"])
    latitude = np.radians(float(at["Latitude (deg)"]))
    return float(gravitation - 7.292115e-5**2 * 6.378e6 * np.cos(latitude) ** 2)


def test_the_states_are_the_same(folder: Path) -> None:
    run_scenario(load_scenario(folder / "direct.toml"), folder / "direct.mcap")
    direct, imported = read_log(folder / "direct.mcap"), read_log(folder / "flight.mcap")
    assert imported.metadata["grid"] == "120 Hz, samples as they are"
    count = len(direct.column("/vehicle", "time_s"))
    for name, bound in (("w", 1e-6), ("f", 1e-3)):
        ours, theirs = direct.vector("/vehicle", name), imported.vector("/vehicle", name)[:count]
        assert np.abs(ours - theirs).max() < bound, name
    dot = np.sum(
        direct.vector("/vehicle", "q_nb") * imported.vector("/vehicle", "q_nb")[:count], axis=1
    )
    assert np.abs(np.abs(dot) - 1.0).max() < 1e-6


@pytest.mark.parametrize("method", CAUSAL_METHODS)
def test_mismatch_of_every_method_within_one_percent(folder: Path, method: str) -> None:
    found = []
    for name in ("direct", "recorded"):
        scenario = load_scenario(folder / f"{name}.toml", [f"cueing.method={method}"])
        result = run_scenario(scenario, folder / f"{name}_{method}.mcap")
        assert result.evaluation is not None
        found.append(result.evaluation.metrics["mismatch"])
    assert found[1] == pytest.approx(found[0], rel=0.01)
