"""Test signals in a scenario file."""

from math import radians
from pathlib import Path

import pytest

from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import load_scenario
from atlas_cueing.vehicles import Flight, Signal, SignalFlight

from .conftest import Refused
from .texts import SCRIPT, SIGNALS


def load(folder: Path, text: str) -> Flight:
    path = folder / "s.toml"
    path.write_text(text)
    return load_scenario(path).flight


def test_signals_in_si(tmp_path: Path) -> None:
    sweep = Signal("roll_rate", "sweep", radians(90), 0.5, 2.0, 0.5, 0.5, 5.0)
    step = Signal("force_y", "step", -2.0, 0.0, 1.0)
    assert load(tmp_path, SIGNALS) == SignalFlight((sweep, step), 50.0, False)
    plain = SIGNALS.replace("rate_hz = 50\n", "").replace("force_follows_attitude = false\n", "")
    assert load(tmp_path, f"duration_s = 9\n{plain}") == SignalFlight((sweep, step), None, True)


def test_signals_fly_and_their_log_flies_again(tmp_path: Path) -> None:
    """The batch run knows the source.

    What it attaches to the log is a scenario of the same flight.
    """
    (tmp_path / "s.toml").write_text(SIGNALS)
    scenario = load_scenario(tmp_path / "s.toml", ["vehicle.signal.0.amplitude_deg_s=45"])
    result = run_scenario(scenario, tmp_path / "log.mcap")
    assert (result.result, result.ticks, result.evaluation.violations) == ("ok", 126, ())
    again = tmp_path / "again"
    again.mkdir()
    for name, content in scenario.attachments().items():
        (again / name).write_bytes(content)
    assert load_scenario(again / "scenario.toml").flight == scenario.flight
    assert isinstance(scenario.flight, SignalFlight)
    assert scenario.flight.signals[0].amplitude == radians(45)


def test_other_sources_attach_no_keys_of_signals(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT)
    text = load_scenario(tmp_path / "s.toml").scenario_toml()
    assert "signal" not in text
    assert "force_follows_attitude" not in text


@pytest.mark.parametrize(
    ("text", "mistakes"),
    [
        (
            SIGNALS.replace('"signal"', '"jsbsim"').replace("[[", 'script = "c1722"\n[[', 1),
            ["signal", "force_follows_attitude"],
        ),
        (
            SIGNALS.replace("[[", 'script = "c1722"\naircraft = "f16"\n[[', 1),
            ["script", "aircraft"],
        ),
        (
            SIGNALS.replace(
                "[platform]", "[[vehicle.input]]\ntime_s = 1\nproperty = 'a'\nvalue = 1\n[platform]"
            ),
            ["input"],
        ),
    ],
    ids=["not signals", "jsbsim", "inputs"],
)
def test_sources_do_not_mix(refused: Refused, text: str, mistakes: list[str]) -> None:
    allowed = "only with source = 'signal'" if "jsbsim" in text else "not with source = 'signal'"
    assert refused(text) == [f"bad.toml: vehicle.{key}: {allowed}" for key in mistakes]


def test_no_signal_at_all(refused: Refused) -> None:
    nothing = SIGNALS.split("[[")[0] + '[platform]\npreset = "atlas-2.9m"'
    missing = "bad.toml: vehicle.signal: missing, at least one [[vehicle.signal]]"
    assert refused(nothing) == [missing]
    assert refused(nothing.replace("rate_hz", "signal = []\nrate_hz")) == [missing]
    table = SIGNALS.split("[[vehicle.signal]]")
    assert refused(f"{table[0]}[vehicle.signal]{table[1]}{table[2][-34:]}") == [
        "bad.toml: vehicle.signal: allowed: tables, written [[vehicle.signal]]"
    ]


@pytest.mark.parametrize(
    ("old", "new", "mistake"),
    [
        (
            '"roll_rate"',
            '"roll"',
            (
                "axis = 'roll': allowed: 'roll_rate', 'pitch_rate', 'yaw_rate', 'force_x',"
                " 'force_y', 'force_z'"
            ),
        ),
        ('"sweep"', '"square"', "shape = 'square': allowed: 'sine', 'sweep', 'step', 'doublet'"),
        ('"sweep"', '"sine"', "end_frequency_rad_s: not with shape = 'sine'"),
        ("frequency_rad_s = 0.5\n", "", "frequency_rad_s: missing, needed with shape = 'sweep'"),
        ("amplitude_deg_s = 90\n", "", "amplitude_deg_s: missing, needed with axis = 'roll_rate'"),
        (
            "amplitude_deg_s = 90",
            "amplitude_deg_s = 2501",
            "amplitude_deg_s = 2501: allowed: a number, -2500 <= value <= 2500",
        ),
        (
            "amplitude_deg_s = 90",
            "amplitude_deg_s = nan",
            "amplitude_deg_s = nan: allowed: a number, -2500 <= value <= 2500",
        ),
        (
            "rad_s = 0.5",
            "rad_s = 0",
            "frequency_rad_s = 0: allowed: a number, 0.001 <= value <= 1000",
        ),
        ("duration_s = 2.0\n", "", "duration_s: missing"),
        ("ramp_s = 0.5", "ramp_s = 0", "ramp_s = 0: allowed: a number, 0 < value <= 86400"),
        (
            "ramp_s = 0.5",
            "ramp = 0.5",
            (
                "ramp = 0.5: unknown key; did you mean 'ramp_s'? allowed: amplitude_deg_s,"
                " amplitude_m_s2, axis, "
            ),
        ),
    ],
)
def test_each_key_of_a_signal_is_checked(
    refused: Refused, old: str, new: str, mistake: str
) -> None:
    (told,) = refused(SIGNALS.replace(old, new, 1))
    assert told.startswith(f"bad.toml: vehicle.signal.0.{mistake}")


def test_ramps_must_fit(refused: Refused) -> None:
    assert refused(SIGNALS.replace("ramp_s = 0.5", "ramp_s = 1.5")) == [
        "bad.toml: vehicle.signal.0: signal on roll_rate: the ramps of a sweep of 2 s must fit into"
        " it: ramp = 1.5 s, allowed: 0 < ramp <= 1"
    ]


def test_all_mistakes_of_all_signals_at_once(refused: Refused) -> None:
    wrong = (
        SIGNALS.replace("_rate", "_speed")
        .replace("amplitude_m_s2", "amplitude_deg_s")
        .replace("duration_s = 1.0", "duration_s = -1.0")
        .replace("follows_attitude = false", "follows_attitude = 0")
    )
    assert [
        line.removeprefix("bad.toml: vehicle.").split(" ")[0].rstrip(":") for line in refused(wrong)
    ] == [
        "force_follows_attitude",
        "signal.0.axis",
        "signal.1.duration_s",
        "signal.1.amplitude_deg_s",
        "signal.1.amplitude_m_s2",
    ]


def test_nonsense_in_place_of_signals(refused: Refused) -> None:
    """What is no table, or no list, is a mistake and no traceback."""
    for nonsense in ("1", '"x"', "[1, 2]", "{axis = 1}"):
        text = SIGNALS.split("[[")[0] + f"signal = {nonsense}\n[platform]\npreset = 'atlas-2.9m'"
        assert all("vehicle.signal" in line for line in refused(text))
