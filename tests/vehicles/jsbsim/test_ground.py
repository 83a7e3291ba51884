from dataclasses import replace
from pathlib import Path

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.rotation import norm
from atlas_cueing.vehicles import (
    AircraftFlight,
    InitialConditions,
    JsbsimVehicle,
    ScriptFlight,
    TimedInput,
)

from ..flying import cessna, event, fly, write_script

PARKED = InitialConditions(altitude=0.0, airspeed=0.0, engines_running=False)


@pytest.mark.parametrize(
    "aircraft", ["737", "c172x", "f16", "T37", "sgs126", "Submarine_Scout", "F450", "ZLT-NT"]
)
def test_a_start_in_the_ground_is_refused_and_the_height_that_is_told_is_none(
    aircraft: str,
) -> None:
    flight = AircraftFlight(aircraft, PARKED)
    with pytest.raises(
        InputError, match=r"initial.altitude_m = 0: .* m in the ground, with .*trim = true sets it"
    ) as caught:
        JsbsimVehicle(flight)
    above = float(str(caught.value).split("altitude_m >= ")[1].split()[0])
    assert 0.0 < above < 30.0
    JsbsimVehicle(replace(flight, initial=replace(PARKED, altitude=above)))


@pytest.mark.parametrize("aircraft", ["737", "c172x", "f16", "T37", "sgs126"])
def test_with_trim_it_stands_on_its_wheels(aircraft: str) -> None:
    states = fly(JsbsimVehicle(AircraftFlight(aircraft, replace(PARKED, trim=True))))
    assert [norm(state.f_B) / 9.80665 for state in states] == pytest.approx(
        [1.0] * len(states), abs=0.05
    )


def test_a_fast_start_in_the_ground_is_refused_too() -> None:
    for trim in (True, False):
        with pytest.raises(InputError, match=r"in the ground|no full trim"):
            JsbsimVehicle(cessna(initial=InitialConditions(altitude=0.3, airspeed=30.0, trim=trim)))


def test_wheels_that_an_input_lets_out_count() -> None:
    low = InitialConditions(altitude=1.0, airspeed=80.0)
    down, up = (
        TimedInput(0.0, name, value)
        for name, value in (("gear/gear-cmd-norm", 1.0), ("gear/gear-pos-norm", 0.0))
    )
    with pytest.raises(InputError, match="in the ground"):
        JsbsimVehicle(AircraftFlight("737", low, (down,)))
    JsbsimVehicle(AircraftFlight("737", replace(low, altitude=1.3), (up,)))


@pytest.mark.parametrize("aircraft", ["SGS", "minisgs", "ZLT-NT", "ball", "J246", "mk82"])
def test_what_cannot_stand_is_told_so_and_ends_no_process(aircraft: str) -> None:
    """JSBSim's trim on the ground ends the process where the gear has no three points apart."""
    with pytest.raises(
        InputError, match=rf"no ground trim of '{aircraft}' .*: (no three points|the force)"
    ):
        JsbsimVehicle(AircraftFlight(aircraft, replace(PARKED, trim=True)))


def test_no_input_trims_what_cannot_stand() -> None:
    trim = TimedInput(0.1, "simulation/do_simple_trim", 2.0)
    with pytest.raises(
        InputError, match=r"'simulation/do_simple_trim' must not be set: .*triangle"
    ):
        JsbsimVehicle(AircraftFlight("SGS", InitialConditions(500.0, 30.0), (trim,)))
    JsbsimVehicle(AircraftFlight("ball", InitialConditions(500.0, 30.0), (trim,)))


def test_no_script_trims_what_cannot_stand(tmp_path: Path) -> None:
    (tmp_path / "mine.xml").write_text(
        '<initialize name="x"><altitude unit="FT">4000</altitude></initialize>'
    )
    script = write_script(
        tmp_path / "s.xml",
        event("simulation/do_simple_trim", "2"),
        aircraft="SGS",
        initialize="mine",
    )
    assert fly(JsbsimVehicle(ScriptFlight(script)))[-1].time >= 2.0
