from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from atlas_cueing.cueing import METHODS
from atlas_cueing.errors import ScenarioError
from atlas_cueing.scenario import load_scenario
from atlas_cueing.scenario.mistakes import FileNamer, dotted, mistakes_of, nearest, shown
from atlas_cueing.scenario.platform_file import Platform, presets
from atlas_cueing.scenario.reading import read_toml

from .conftest import Refused
from .texts import AIRCRAFT, SCRIPT

KNOWN = ", ".join(sorted([*METHODS, "FILE.py:CLASS"]))

EVERYTHING_WRONG = """
nam = "g"
duration_s = -1
[vehicle]
script = "c172_elevator_doublt"
rate_hz = 5
[platform]
preset = "atlas-2.8m"
[cueing]
method = "attitude"
align_rate_deg_s = 2
force_gain = [1, "half", 0.5]
rotation_gain = "a"
stage = 3
[recording]
chunk_ticks = 0.5
skip = ["/tf", "/wheels"]
colour = "red"
"""


def test_all_mistakes_at_once_in_the_order_of_the_file(refused: Refused) -> None:
    lines = refused(EVERYTHING_WRONG)
    assert [line.removeprefix("bad.toml: ").split(": ")[0] for line in lines] == [
        "nam = 'g'",
        "duration_s = -1",
        "vehicle.script = 'c172_elevator_doublt'",
        "vehicle.rate_hz = 5",
        "platform.preset = 'atlas-2.8m'",
        "cueing.align_rate_deg_s = 2",
        "cueing.force_gain.1 = 'half'",
        "cueing.rotation_gain = 'a'",
        "cueing.stage = 3",
        "recording.chunk_ticks = 0.5",
        "recording.skip.1 = '/wheels'",
        "recording.colour = 'red'",
        "name",
    ]


def test_each_says_what_is_allowed(refused: Refused) -> None:
    allowed = {
        line.split(": ")[1].split(" = ")[0]: line.split(": ", 2)[2]
        for line in refused(EVERYTHING_WRONG)
    }
    assert allowed["nam"].startswith(
        "unknown key; did you mean 'name'? allowed: cueing, description, duration_s, name,"
    )
    assert allowed["vehicle.script"].endswith("did you mean 'c172_elevator_doublet'?")
    assert "did you mean 'atlas-2.9m'?" in allowed["platform.preset"]
    # a key of another method: those of this one are listed
    assert "return_rate_deg_s" in allowed["cueing.align_rate_deg_s"]
    assert "hold_force_m_s2" not in allowed["cueing.align_rate_deg_s"]
    assert allowed["cueing.rotation_gain"] == "allowed: a number, 0 <= value <= 10"
    assert allowed["cueing.stage"] == "allowed: a table"
    assert allowed["name"] == "missing"


def test_an_unknown_method_lists_the_known_ones(refused: Refused) -> None:
    text = AIRCRAFT.replace('"attitude"', '"atitude"')
    assert refused(text) == [
        "bad.toml: cueing.method = 'atitude': did you mean 'attitude'? allowed: " + KNOWN
    ]
    assert refused(AIRCRAFT.replace('"attitude"', "3")) == [
        "bad.toml: cueing.method = 3: allowed: " + KNOWN
    ]
    assert refused(AIRCRAFT.split("[cueing]")[0].replace("name =", "cueing = 3\nname =")) == [
        "bad.toml: cueing = 3: allowed: a table"
    ]


def test_unknown_keys_deep_in_lists_know_their_neighbours(refused: Refused) -> None:
    (line,) = refused(AIRCRAFT.replace("ramp_s", "ramp"))
    assert line.startswith(
        "bad.toml: vehicle.input.1.ramp = 0.25: unknown key; did you mean 'ramp_s'?"
    )


def test_a_number_that_stands_for_three_is_reported_once(refused: Refused) -> None:
    assert refused(AIRCRAFT.replace("[1, 0.5, 1]", "-1")) == [
        "bad.toml: cueing.rotation_gain = -1: allowed: a number, 0 <= value <= 10"
    ]


def test_file_of_a_key() -> None:
    name_file = FileNamer("file.toml", [("wheel", 0, "drive"), ("name",)])
    assert name_file(("name",)) == "--set"
    assert name_file(("wheel", 0, "drive", 2)) == "--set"
    assert name_file(("wheel", 0)) == "--set"  # a mistake of the whole table may come from it
    assert name_file(("wheel", 1)) == "file.toml"


def test_platform_mistakes() -> None:
    data = read_toml(presets()["atlas-2.9m"])
    data["wheel"][1] = {"contact": [0, 0, 1], "drive": [0, 1, 1], "radius_m": 0.1}
    data["wheel"][2]["radius"] = 0.1
    try:
        Platform.model_validate(data)
    except ValidationError as error:
        mistakes = mistakes_of(error, Platform, data, FileNamer("p.toml"))
    assert mistakes[0].key == "wheel.1"
    assert mistakes[0].value == ""
    assert mistakes[0].allowed.startswith(
        "drive must be tangent to the sphere: |contact . drive| = 0.707 of unit vectors, allowed: "
    )
    assert mistakes[1].key == "wheel.2.radius"
    assert "did you mean 'radius_m'?" in mistakes[1].allowed
    assert len(mistakes) == 2


def test_nearest() -> None:
    assert (
        nearest("blnd", ["attitude", "blend"]) == "did you mean 'blend'? allowed: attitude, blend"
    )
    assert nearest("xyz", ["b", "a"]) == "allowed: a, b"
    many = [f"name{i}" for i in range(50)]
    assert nearest("name7x", many) == "did you mean 'name7'?"


def test_values_as_shown() -> None:
    assert shown(None) == shown({"a": 1}) == ""
    assert shown(True) == "true"
    assert shown([1, "a"]) == "[1, 'a']"
    assert len(shown("x" * 1000)) < 70
    assert shown(16**5000) == "an integer of thousands of digits"


@given(st.lists(st.one_of(st.text(min_size=1), st.integers(0, 9)), min_size=1, max_size=4))
def test_dotted(key: list[str | int]) -> None:
    text = dotted(tuple(key))
    assert text.isprintable()
    if all(str(part).isprintable() for part in key):
        assert text == ".".join(map(str, key))


def test_a_key_of_other_methods_is_told(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT)
    with pytest.raises(ScenarioError) as error:
        load_scenario(tmp_path / "s.toml", ["cueing.method=still", "cueing.rotation_gain=0.5"])
    (line,) = str(error.value).splitlines()
    assert line.endswith(
        "it is a key of attitude, blend, force, perceptual, hedge, classical, and not of still"
    )
    with pytest.raises(ScenarioError, match=r"did you mean 'floor'\?$"):
        load_scenario(tmp_path / "s.toml", ["cueing.flor=1"])
