"""The source that a scenario asks for."""

import socket
from pathlib import Path
from time import monotonic

import pytest
from vehicles.packets import packet

from atlas_cueing.errors import InputError
from atlas_cueing.live.input.source import Source
from atlas_cueing.live.open_source import open_source
from atlas_cueing.recording import read_log
from atlas_cueing.rotation import geodesic
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import Scenario, load_scenario

SIGNAL = """
name = "roll"
[vehicle]
source = "signal"
[[vehicle.signal]]
axis = "roll_rate"
shape = "doublet"
amplitude_deg_s = 20
duration_s = 2.0
[platform]
preset = "atlas-2.9m"
"""
SCRIPT = 'name = "script"\n[vehicle]\nscript = "c1723"\n[platform]\npreset = "atlas-2.9m"\n'
RECORDING = (
    'name = "again"\n[vehicle]\nsource = "recording"\nlog = "roll.mcap"\n[platform]\npreset ='
    ' "atlas-2.9m"\n'
)
FLIGHTGEAR = (
    'name = "other"\n[vehicle]\nsource = "flightgear"\nport = {port}\n[platform]\npreset ='
    ' "atlas-2.9m"\n'
)


def load(folder: Path, text: str) -> Scenario:
    path = folder / "scenario.toml"
    path.write_text(text)
    return load_scenario(path)


@pytest.mark.parametrize("text", [SIGNAL, SCRIPT], ids=["signal", "jsbsim"])
def test_a_model_of_our_own(tmp_path: Path, text: str) -> None:
    source: Source = open_source(load(tmp_path, text))
    for k in range(50):
        reading = source.read(0.002 * k, advance=True)
        assert reading.vehicle is not None
        assert reading.vehicle.time == 0.002 * k
    source.pin()
    source.close()


def test_a_recording_is_what_was_flown(tmp_path: Path) -> None:
    run_scenario(load(tmp_path, SIGNAL), tmp_path / "roll.mcap")
    flown = read_log(tmp_path / "roll.mcap").vector("/vehicle", "q_nb")
    source = open_source(load(tmp_path, RECORDING))
    for k, q in enumerate(flown.tolist()[:-1]):
        reading = source.read(k / 120.0, advance=True)
        assert reading.vehicle is not None
        assert geodesic(reading.vehicle.q_NB, tuple(q)) < 1e-9
        assert not reading.over
    assert source.read(len(flown) / 120.0, advance=True).over


def test_a_recording_that_is_not_there_or_no_log(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"roll\.mcap: no such file"):
        open_source(load(tmp_path, RECORDING))
    (tmp_path / "roll.mcap").write_bytes(b"no log")
    with pytest.raises(InputError, match=r"roll\.mcap: the file is cut"):
        open_source(load(tmp_path, RECORDING))


def test_flightgear_over_loopback(tmp_path: Path) -> None:
    """Packets of a real socket, until the source has seen one."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    source = open_source(load(tmp_path, FLIGHTGEAR.format(port=port)))
    begun = monotonic()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as simulator:
        simulator.sendto(packet(euler=(0.0, 0.3, 0.0)), ("127.0.0.1", port))
        reading = source.read(monotonic() - begun, advance=True)
        assert reading.vehicle is not None
        assert reading.vehicle.q_NB[2] == pytest.approx(0.149438, abs=1e-6)
    with pytest.raises(InputError, match="cannot listen there"):
        open_source(load(tmp_path, FLIGHTGEAR.format(port=port)))
    source.close()
    open_source(load(tmp_path, FLIGHTGEAR.format(port=port))).close()
