"""Flights of scenarios, by the vehicle table."""

from math import radians
from pathlib import Path

import pytest

from atlas_cueing.errors import ScenarioError
from atlas_cueing.scenario import load_scenario, load_variants
from atlas_cueing.vehicles import (
    AircraftFlight,
    Flight,
    InitialConditions,
    ScriptFlight,
    TimedInput,
    own_scripts,
)
from atlas_cueing.vehicles.jsbsim.user_models import within

from .conftest import Refused
from .flights import FLIGHTGEAR
from .texts import AIRCRAFT, INITIAL, SCRIPT, USER_SCRIPT


def load(folder: Path, text: str) -> Flight:
    path = folder / "s.toml"
    path.write_text(text)
    return load_scenario(path, trust_models=True).flight


def test_own_script(tmp_path: Path) -> None:
    assert load(tmp_path, SCRIPT) == ScriptFlight(own_scripts()["c1722"])
    faster = SCRIPT.replace('"c1722"', '"c1722"\nrate_hz = 240').replace("duration_s = 0.5", "")
    assert load(tmp_path, faster) == ScriptFlight(own_scripts()["c1722"], 240.0)


def test_aircraft_in_si(tmp_path: Path) -> None:
    initial = InitialConditions(
        altitude=1200.0,
        airspeed=50.0,
        heading=radians(90),
        pitch=radians(2.5),
        roll=radians(-10),
        latitude=radians(45),
        longitude=radians(-75),
        engines_running=False,
        trim=False,
    )
    inputs = (
        TimedInput(0.1, "fcs/elevator-cmd-norm", -0.2, 0.0),
        TimedInput(0.2, "fcs/aileron-cmd-norm", 1.0, 0.25),
    )
    assert load(tmp_path, AIRCRAFT) == AircraftFlight("c172x", initial, inputs, 60.0)


def test_defaults_are_those_of_the_vehicle(tmp_path: Path) -> None:
    kept = ("altitude_m", "airspeed_m_s")
    lines = [
        line
        for line in AIRCRAFT.splitlines()
        if not line.endswith(("false",)) and ("_deg" not in line or line.startswith(kept))
    ]
    flight = load(tmp_path, "\n".join(lines))
    assert isinstance(flight, AircraftFlight)
    assert flight.initial == InitialConditions(altitude=1200.0, airspeed=50.0)


def test_script_beside_the_scenario(tmp_path: Path) -> None:
    (tmp_path / "scripts").mkdir()
    script = tmp_path / "scripts" / "mine.xml"
    script.write_text(USER_SCRIPT.format(initial="reset00"))
    assert load(tmp_path, SCRIPT.replace("c1722", "scripts/mine.xml")) == ScriptFlight(
        script, None, tmp_path
    )


def test_own_name_wins_over_a_file(tmp_path: Path) -> None:
    (tmp_path / "c1722").write_text(USER_SCRIPT)
    assert load(tmp_path, SCRIPT) == ScriptFlight(own_scripts()["c1722"])
    assert load(tmp_path, SCRIPT.replace("c1722", "./c1722")) == ScriptFlight(
        tmp_path / "c1722", None, tmp_path
    )


def test_a_script_outside_the_folder_is_refused(tmp_path: Path, refused: Refused) -> None:
    outside = tmp_path / "outside.xml"
    outside.write_text(USER_SCRIPT)
    inside = tmp_path / "in"
    inside.mkdir()
    (inside / "link.xml").symlink_to(outside)
    (inside / "round.xml").symlink_to(inside / "round.xml")
    (inside / "good.xml").write_text(INITIAL)
    assert within(inside, "good.xml") == inside / "good.xml"
    for name in (
        "../outside.xml",
        str(outside),
        "link.xml",
        "round.xml",
        "",
        ".",
        "missing.xml",
        "a\0b",
        "x" * 5000,
    ):
        assert within(inside, name) is None
    assert "in the scenario's folder" in refused(SCRIPT.replace("c1722", "../x.xml"))[0]


@pytest.mark.parametrize("where", ["file", "--set", "sweep"])
def test_an_aircraft_named_by_a_number_needs_no_quotes(tmp_path: Path, where: str) -> None:
    in_file = AIRCRAFT.replace('"c172x"', "737") if where == "file" else AIRCRAFT
    sweep = "[sweep]\nvehicle.aircraft = [737]" if where == "sweep" else ""
    (tmp_path / "s.toml").write_text(
        in_file.split("[[")[0] + '[platform]\npreset = "atlas-1.5m"\n' + sweep
    )
    (variant,) = load_variants(
        tmp_path / "s.toml", ["vehicle.aircraft=737"] if where == "--set" else []
    )
    assert variant.scenario.file.vehicle.aircraft == "737"
    assert 'aircraft = "737"' in variant.scenario.scenario_toml()


@pytest.mark.parametrize("bad", ["738", "true", "737.0", "[737]", "-737"])
def test_a_number_that_names_no_aircraft_is_refused(refused: Refused, bad: str) -> None:
    (line,) = refused(
        AIRCRAFT.split("[[")[0] + '[platform]\npreset = "atlas-1.5m"', f"vehicle.aircraft={bad}"
    )
    assert line.startswith(
        f"--set: vehicle.aircraft = {bad}: allowed: one of JSBSim's own aircraft, or one in"
        " aircraft/NAME"
    )


def test_properties_that_cannot_be_set_are_told_with_all_other_mistakes(refused: Refused) -> None:
    text = AIRCRAFT.replace("altitude_m = 1200", "altitude_m = nan").replace(
        "fcs/elevator-cmd-norm", "fcs/elevatr-cmd-norm"
    )
    lines = refused(text, "vehicle.input.1.property=velocities/p-rad_sec")
    assert lines == [
        "bad.toml: vehicle.initial.altitude_m = nan: allowed: a number, -500 <= value <= 1e+07",
        (
            "bad.toml: vehicle.input.0.property = 'fcs/elevatr-cmd-norm': "
            "unknown JSBSim property 'fcs/elevatr-cmd-norm'; did you mean 'fcs/elevator-cmd-norm'?"
        ),
        (
            "--set: vehicle.input.1.property = 'velocities/p-rad_sec': "
            "JSBSim property 'velocities/p-rad_sec' can be read but not set"
        ),
    ]


@pytest.mark.parametrize(
    ("name", "why"),
    [
        (
            "atmosphere/updownburst/number-of-cells",
            "must not be set: it takes memory and time without bound",
        ),
        ("simulation/write-state-file", "must not be set: it writes a file"),
        ("simulation/dt", "can be read but not set"),
    ],
)
def test_properties_that_harm_are_refused_by_name(refused: Refused, name: str, why: str) -> None:
    (line,) = refused(AIRCRAFT.replace("fcs/elevator-cmd-norm", name))
    assert line == f"bad.toml: vehicle.input.0.property = {name!r}: JSBSim property {name!r} {why}"


def test_an_aircraft_that_does_not_load_is_a_mistake_of_its_key(refused: Refused) -> None:
    (line,) = refused(AIRCRAFT.replace("c172x", "blank"))
    assert line.startswith("bad.toml: vehicle.aircraft = 'blank': ")
    assert "blank.xml: root element is <FDM_CONFIG>" in line


def test_every_aircraft_of_a_sweep_is_asked_for_the_inputs(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(
        AIRCRAFT.replace("fcs/aileron-cmd-norm", "ap/attitude_hold")
        + '[sweep]\nvehicle.aircraft = ["c172x", "ball"]'
    )
    with pytest.raises(
        ScenarioError, match=r"unknown JSBSim property 'ap/attitude_hold'"
    ) as caught:
        load_variants(tmp_path / "s.toml")
    assert [mistake.key for mistake in caught.value.mistakes] == ["vehicle.input.1.property"]
    assert load_variants(tmp_path / "s.toml", ["vehicle.aircraft=c172x"])


@pytest.mark.parametrize("source", ['"flightger"', '"FlightGear"', "3", "[]", '""'])
def test_a_wrong_source_is_told_alone(refused: Refused, source: str) -> None:
    """What does not go with another source follows from it, and is no mistake."""
    (line,) = refused(
        FLIGHTGEAR.replace('"flightgear"', f"{source}\nport = 5501\nlog = 'x'\nscript = 'c1722'")
    )
    assert line.startswith("bad.toml: vehicle.source = ")


def test_near_names_are_given(refused: Refused) -> None:
    assert refused(SCRIPT.replace("c1722", "c1723x"))[0].endswith("did you mean 'c1723'?")
    assert refused(AIRCRAFT.replace("c172x", "c172z"))[0].endswith("did you mean 'c172x'?")


@pytest.mark.parametrize(
    ("text", "mistakes"),
    [
        (SCRIPT.replace('script = "c1722"', ""), ["vehicle: exactly one of script and aircraft"]),
        (
            AIRCRAFT.replace("[vehicle]", '[vehicle]\nscript = "c1722"'),
            ["vehicle: exactly one of script and aircraft"],
        ),
        (
            AIRCRAFT.replace('aircraft = "c172x"', 'script = "c1722"'),
            [
                "vehicle.initial: not with script, which has its own",
                "vehicle.input: not with script, which has its own",
            ],
        ),
        (
            'name = "x"\n[platform]\npreset = "atlas-2.9m"\n[vehicle]\naircraft = "f16"',
            [
                "vehicle.initial: missing, an aircraft needs initial conditions",
                "duration_s: missing, an aircraft flight has no end of its own",
            ],
        ),
        (
            SCRIPT.replace("[vehicle]", '[vehicle]\nsource = "xplane"'),
            [
                "vehicle.source = 'xplane': allowed: 'jsbsim', 'signal', 'flightgear', 'packets',"
                " 'recording', 'rigid_body', 'track'"
            ],
        ),
        (
            AIRCRAFT.replace("[[vehicle.input]]", "[vehicle.input]", 1).split("[[")[0]
            + '[platform]\npreset = "atlas-1.5m"',
            ["vehicle.input: allowed: tables, written [[vehicle.input]]"],
        ),
        (
            SCRIPT.replace("[vehicle]", "[vehicle]\nrate_hz = 1001"),
            ["vehicle.rate_hz = 1001: allowed: a number, 10 <= value <= 1000"],
        ),
    ],
    ids=["none", "both", "initial", "bare", "unknown source", "one input", "rate"],
)
def test_refused(refused: Refused, text: str, mistakes: list[str]) -> None:
    assert refused(text) == [f"bad.toml: {mistake}" for mistake in mistakes]


@pytest.mark.parametrize(
    ("old", "new", "mistake"),
    [
        (
            "altitude_m = 1200",
            "altitude_m = nan",
            "vehicle.initial.altitude_m = nan: allowed: a number, -500 <= value <= 1e+07",
        ),
        (
            "airspeed_m_s = 50.0",
            "airspeed_m_s = -1",
            "vehicle.initial.airspeed_m_s = -1: allowed: a number, 0 <= value <= 20000",
        ),
        (
            "pitch_deg = 2.5",
            "pitch_deg = 91",
            "vehicle.initial.pitch_deg = 91: allowed: a number, -90 <= value <= 90",
        ),
        ("trim = false", 'trim = "no"', "vehicle.initial.trim = 'no': allowed: true or false"),
        ("airspeed_m_s = 50.0", "", "vehicle.initial.airspeed_m_s: missing"),
        (
            "ramp_s = 0.25",
            "ramp_s = -1",
            "vehicle.input.1.ramp_s = -1: allowed: a number, 0 <= value <= 86400",
        ),
        ("value = -0.2", "value = inf", "vehicle.input.0.value = inf: allowed: a finite number"),
        ('property = "fcs/aileron-cmd-norm"', "", "vehicle.input.1.property: missing"),
    ],
)
def test_each_number_is_checked(refused: Refused, old: str, new: str, mistake: str) -> None:
    assert refused(AIRCRAFT.replace(old, new, 1)) == [f"bad.toml: {mistake}"]
