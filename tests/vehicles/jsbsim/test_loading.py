from dataclasses import replace
from math import inf, nan
from pathlib import Path

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.vehicles import AircraftFlight, ScriptFlight, own_scripts
from atlas_cueing.vehicles.jsbsim.loading import load

from ..flying import CRUISE, cessna, event, write_script


def test_a_script_keeps_its_own_step_and_an_aircraft_gets_the_default() -> None:
    assert load(ScriptFlight(own_scripts()["c3104"])).get_delta_t() == 0.02
    assert load(cessna()).get_delta_t() == 1.0 / 120.0


def test_the_rate_overrides_the_step_of_both_and_holds_after_initialising() -> None:
    for fdm in (
        load(ScriptFlight(own_scripts()["c3104"], 240.0)),
        load(replace(cessna(), rate_hz=240.0)),
    ):
        assert fdm.get_delta_t() == 1.0 / 240.0
        fdm.run_ic()
        for _ in range(24):
            fdm.run()
        assert fdm.get_delta_t() == 1.0 / 240.0
        assert fdm.get_sim_time() == pytest.approx(0.1, abs=1e-12)


@pytest.mark.parametrize("rate", [0.0, -120.0, nan, inf, 9.9, 10_001.0])
def test_a_rate_out_of_bounds_is_refused(rate: float) -> None:
    with pytest.raises(InputError, match="allowed: 10 <= rate_hz <= 10000"):
        load(replace(cessna(), rate_hz=rate))
    with pytest.raises(InputError, match="allowed: 10 <= rate_hz <= 10000"):
        load(ScriptFlight(own_scripts()["c1722"], rate_hz=rate))


@pytest.mark.parametrize("dt", ["-0.01", "0", "nan", "1", "1e-9"])
def test_a_step_out_of_bounds_in_a_script_is_refused_before_it_kills_the_process(
    dt: str, tmp_path: Path
) -> None:
    script = write_script(tmp_path / "s.xml")
    script.write_text(script.read_text().replace('dt="0.01"', f'dt="{dt}"'))
    with pytest.raises(InputError, match=rf"s.xml: dt = {dt} s, allowed: 0.0001 <= dt <= 0.1"):
        load(ScriptFlight(script))


@pytest.mark.parametrize("end", ["1e12", "inf", "nan", "-1"])
def test_an_end_that_never_comes_is_refused(end: str, tmp_path: Path) -> None:
    script = write_script(tmp_path / "s.xml")
    script.write_text(script.read_text().replace('end="2"', f'end="{end}"'))
    with pytest.raises(InputError, match=rf"s\.xml: end = {end} s, allowed: 0 <= end <= 1e\+06"):
        load(ScriptFlight(script))


@pytest.mark.parametrize(
    "name", ["kml_output", "plotfile", "unitconversions", "737_cruise_steady_turn_simplex"]
)
def test_own_scripts_that_cannot_fly_are_refused(name: str) -> None:
    with pytest.raises(InputError, match=name):
        load(ScriptFlight(own_scripts()[name]))


def test_an_own_aircraft_that_cannot_fly_is_refused() -> None:
    with pytest.raises(InputError, match="root element is <FDM_CONFIG>"):
        load(AircraftFlight("blank", CRUISE))  # of an older format, which JSBSim refuses too


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ('end="2"', "", "end time"),
        ('dt="0.01"', 'dt="soon"', "soon"),
        ('initialize="reset01"', "", "Initialization file must be specified"),
        ('initialize="reset01"', 'initialize="nope"', "nope"),
        ("simulation/sim-time-sec ge 0.5", "a b c d", "Conditional test is invalid"),
    ],
)
def test_what_jsbsim_refuses_is_reported_in_its_words_and_of_the_original_file(
    old: str, new: str, complaint: str, tmp_path: Path
) -> None:
    script = write_script(tmp_path / "mine.xml", event("fcs/elevator-cmd-norm", "1"))
    assert old in script.read_text()
    script.write_text(script.read_text().replace(old, new))
    with pytest.raises(
        InputError, match=f"mine.xml: JSBSim cannot load it: .*{complaint}"
    ) as caught:
        load(ScriptFlight(script))
    assert "atlas_cueing_" not in str(caught.value), "the private copy is nobody's business"
    assert "\n" not in str(caught.value)


def test_a_misspelt_property_in_a_script_is_refused_with_the_nearest_name(tmp_path: Path) -> None:
    script = write_script(tmp_path / "s.xml", event("fcs/elevtor-cmd-norm", "1"))
    with pytest.raises(
        InputError, match="'fcs/elevtor-cmd-norm'; did you mean 'fcs/elevator-cmd-norm'"
    ):
        load(ScriptFlight(script))


@pytest.mark.parametrize(
    "name",
    ["../..", "..", "[[[", "simulation/output/[[[", "", "a//b", "fcs/../fcs/elevator-cmd-norm"],
)
def test_a_script_sets_no_property_by_a_name_that_is_none(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"unknown JSBSim property|JSBSim cannot load it"):
        load(ScriptFlight(write_script(tmp_path / "s.xml", event(name, "1"))))


def test_properties_of_outputs_left_out_may_still_be_set(tmp_path: Path) -> None:
    assert "simulation/output/" in own_scripts()["c1723"].read_text()
    fdm = load(
        ScriptFlight(write_script(tmp_path / "s.xml", event("simulation/output/log_rate_hz", "5")))
    )
    fdm.run_ic()
    assert sum(fdm.run() for _ in range(100)) == 100
    assert fdm["simulation/output/log_rate_hz"] == 5.0


def test_a_misspelt_aircraft_is_refused_with_the_nearest_name() -> None:
    with pytest.raises(InputError, match="no aircraft 'c127x' in JSBSim; did you mean 'c172x'"):
        load(AircraftFlight("c127x", CRUISE))
    with pytest.raises(InputError, match=r"no aircraft '\.\./x' in JSBSim"):
        load(AircraftFlight("../x", CRUISE))


def test_the_private_folder_is_gone_after_loading(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    load(cessna())
    with pytest.raises(InputError):
        load(AircraftFlight("nope", CRUISE))
    assert list(tmp_path.iterdir()) == []


def test_own_scripts_load_but_for_these() -> None:
    """Three are no scripts, and one sets a property that its aircraft does not have."""
    refused = set()
    for name, script in own_scripts().items():
        try:
            load(ScriptFlight(script))
        except InputError:
            refused.add(name)
    assert refused == {
        "kml_output",
        "plotfile",
        "unitconversions",
        "737_cruise_steady_turn_simplex",
    }
