from copy import deepcopy

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import ScenarioError
from atlas_cueing.scenario.overrides import apply_overrides, parse_overrides, with_own


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a=1", 1),
        ("a = 1.5 ", 1.5),
        ("a=-2e3", -2000.0),
        ("a=true", True),
        ("a=[1, 2]", [1, 2]),
        ('a="1"', "1"),
        ("a={b = 1}", {"b": 1}),
        ("a=blend", "blend"),
        ("a=atlas-1.5m", "atlas-1.5m"),
        ("a=../x.toml", "../x.toml"),
        ("a=1\nb=2", "1\nb=2"),
        ("a=b=c", "b=c"),
        ("a=", ""),
        ("a=" + "[" * 5000, "[" * 5000),
    ],
    ids=lambda text: str(text)[:20],
)
def test_values_are_toml_or_bare_strings(text: str, value: object) -> None:
    (parsed,) = parse_overrides([text]).values()
    assert parsed == value
    assert type(parsed) is type(value)


def test_keys() -> None:
    assert list(parse_overrides(["vehicle.input.0.value=1", "a_b-c.d=2"])) == [
        ("vehicle", "input", 0, "value"),
        ("a_b-c", "d"),
    ]


def test_the_last_of_equal_keys_counts() -> None:
    assert parse_overrides(["a=1", "b=2", "a=3"]) == {("b",): 2, ("a",): 3}


@pytest.mark.parametrize("text", ["", "a", "=1", "a..b=1", ".a=1", "a.=1"])
def test_no_key_no_value(text: str) -> None:
    with pytest.raises(ScenarioError, match="KEY=VALUE") as refusal:
        parse_overrides([text, "good=1", "bad"])
    assert len(refusal.value.mistakes) == 2


def applied(data: dict, *texts: str) -> list[str]:
    return [str(mistake) for mistake in apply_overrides(data, parse_overrides(texts))]


def test_tables_are_made_on_the_way() -> None:
    data: dict = {"a": {"b": 1}}
    assert applied(data, "a.c=2", "x.y.z=3", "a.b=4") == []
    assert data == {"a": {"b": 4, "c": 2}, "x": {"y": {"z": 3}}}


def test_items_of_lists() -> None:
    data: dict = {"wheel": [{"r": 1}, {"r": 2}], "v": [1, 2, 3]}
    assert applied(data, "wheel.1.r=5", "v.0=9") == []
    assert data == {"wheel": [{"r": 1}, {"r": 5}], "v": [9, 2, 3]}
    assert applied(data, "wheel.2.r=5") == [
        "--set: wheel.2.r = 5: allowed: wheel.N with 0 <= N <= 1"
    ]
    assert applied(data, "wheel.r=5") == ["--set: wheel.r = 5: allowed: wheel.N with 0 <= N <= 1"]


def test_keys_that_lead_nowhere() -> None:
    data: dict = {"name": "x"}
    assert applied(data, "name.y=1", "z=2") == ["--set: name.y = 1: name is not a table"]
    assert data == {"name": "x", "z": 2}


@pytest.mark.parametrize(
    ("before", "text", "after"),
    [
        ({"platform": {"file": "x"}}, "platform.preset=p", {"platform": {"preset": "p"}}),
        ({"platform": {"preset": "x"}}, "platform.file=p", {"platform": {"file": "p"}}),
        (
            {"vehicle": {"aircraft": "x", "initial": {}, "input": [], "rate_hz": 1}},
            "vehicle.script=s",
            {"vehicle": {"script": "s", "rate_hz": 1}},
        ),
        ({"vehicle": {"script": "x"}}, "vehicle.aircraft=a", {"vehicle": {"aircraft": "a"}}),
        ({}, "platform.preset=p", {"platform": {"preset": "p"}}),
        ({"platform": 3}, "platform.preset=p", {"platform": 3}),
    ],
)
def test_one_of_two_takes_the_other_out(before: dict, text: str, after: dict) -> None:
    applied(before, text)
    assert before == after


def test_both_given_are_both_kept() -> None:
    data: dict = {}
    applied(data, "platform.preset=p", "platform.file=f")
    assert data == {"platform": {"preset": "p", "file": "f"}}


@given(st.lists(st.text(alphabet="ab.0=[]{}\"'\n 1", max_size=12), max_size=4))
def test_any_text_is_applied_or_refused(texts: list[str]) -> None:
    data: dict = {"a": [1, {"b": 2}], "b": {"a": 3}}
    try:
        settings = parse_overrides(texts)
    except ScenarioError as refusal:
        settings = {}
        assert str(refusal).count("--set") >= 1  # noqa: PT017 - either outcome is right
    for mistake in apply_overrides(data, settings):
        assert mistake.file == "--set"


@pytest.mark.parametrize(
    "texts",
    [
        ["a.b.c=2", "a.d=3"],
        ["list.1.x=5", "list.0=7"],
        ["vehicle.script=x", "platform.file=y"],
        ["new.deep.key=1"],
        ["a.b.c.d=1", "list.9.x=1", "list.x.y=1", "1.2=3"],
        ["list.1.xs.0=5", "a={}"],
    ],
)
def test_a_table_of_its_own_can_be_set_while_the_first_stays(texts: list[str]) -> None:
    data = {
        "a": {"b": {"c": 1}, "d": 2},
        "list": [{"x": 1}, {"x": 2, "xs": [1, 2]}],
        "vehicle": {"aircraft": "f16", "initial": {}},
        "platform": {"preset": "p"},
    }
    before, expected = deepcopy(data), deepcopy(data)
    overrides = parse_overrides(texts)
    own = with_own(data, overrides)
    assert own == data
    assert apply_overrides(own, overrides) == apply_overrides(expected, overrides)
    assert (own, data) == (expected, before)


def test_what_is_not_set_is_shared() -> None:
    data = {"a": {"b": [1], "c": [2]}, "d": [3]}
    own = with_own(data, parse_overrides(["a.b.0=5"]))
    assert own["d"] is data["d"]
    assert own["a"]["c"] is data["a"]["c"]
    assert own["a"]["b"] is not data["a"]["b"]
