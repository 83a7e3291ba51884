"""Every source of a scenario keeps what `Flight` promises."""

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

import numpy as np
import pytest

import atlas_cueing.scenario
from atlas_cueing.errors import InputError
from atlas_cueing.recording import write_vehicle_log
from atlas_cueing.scenario import load_scenario
from atlas_cueing.scenario.source_table import SourceTable
from atlas_cueing.scenario.vehicle_table import DEFAULT_SOURCE, SOURCES

from .flights import FLIGHTGEAR, RECORDING, RIGID_BODY, TRACK
from .texts import AIRCRAFT, SCRIPT, SIGNALS

PACKETS = FLIGHTGEAR.replace('"flightgear"', '"packets"')
EXAMPLES = {
    "jsbsim": (SCRIPT, AIRCRAFT),
    "signal": (SIGNALS,),
    "flightgear": (FLIGHTGEAR,),
    "packets": (PACKETS, PACKETS.replace('"packets"', '"packets"\nkey_file = "key"')),
    "recording": (RECORDING,),
    "rigid_body": (RIGID_BODY,),
    "track": (TRACK,),
}


def below(table: type[SourceTable]) -> set[type[SourceTable]]:
    return {table}.union(*map(below, table.__subclasses__()))


def test_every_table_of_a_source_is_in_the_one_list() -> None:
    for module in iter_modules(atlas_cueing.scenario.__path__):
        import_module(f"atlas_cueing.scenario.{module.name}")  # one that nobody imports counts too
    assert set(SOURCES.values()) == below(SourceTable) - {SourceTable}
    assert all(name == table.model_fields["source"].default for name, table in SOURCES.items())
    assert DEFAULT_SOURCE in SOURCES
    assert EXAMPLES.keys() == SOURCES.keys(), "a source without an example is not tested below"


def flown(folder: Path) -> None:
    """The log that RECORDING plays."""
    rows = np.zeros((3, 11))
    rows[:, 0], rows[:, 1], rows[:, -1] = 0.1 * np.arange(3), 1.0, -9.80665
    (folder / "logs").mkdir()
    (folder / "logs/flown.mcap").write_bytes(write_vehicle_log(rows, {}, {}))


@pytest.mark.parametrize("text", [text for texts in EXAMPLES.values() for text in texts])
def test_a_flight_answers_before_it_flies(tmp_path: Path, text: str) -> None:
    flown(tmp_path)
    (tmp_path / "s.toml").write_text(text)
    scenario = load_scenario(tmp_path / "s.toml")
    flight = scenario.live_flight
    assert flight.name
    assert scenario.file.vehicle.flown
    assert isinstance(flight.ends_itself, bool)
    assert flight.files().keys().isdisjoint(flight.large_files())
    assert set(flight.large_files().values()) <= set(scenario.inputs())
    if flight.live_only:
        with pytest.raises(InputError, match=f"^{flight.live_only[:20]}"):
            _ = scenario.flight
    else:
        length = flight.length()
        assert length is None or length > 0.0
        assert flight.step() == flight.vehicle().dt
