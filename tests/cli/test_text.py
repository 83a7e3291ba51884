import json

from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.cli.text import aligned, copyable, one_json

leaves = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5))
values = st.recursive(
    leaves,
    lambda inner: st.one_of(st.lists(inner), st.tuples(inner), st.dictionaries(st.text(), inner)),
    max_leaves=8,
)


@settings(max_examples=50)
@given(st.dictionaries(st.text(max_size=5), values, max_size=3))
def test_any_figures_are_strict_json(figures: dict) -> None:
    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    assert json.loads(one_json(figures), parse_constant=refuse).keys() == figures.keys()


def test_what_is_not_finite_is_null() -> None:
    text = one_json({"a": float("nan"), "b": [1.5, float("inf")], "c": {"d": (float("-inf"),)}})
    assert json.loads(text) == {"a": None, "b": [1.5, None], "c": {"d": [None]}}


def test_numbers_keep_every_bit() -> None:
    assert json.loads(one_json({"a": 0.1 + 0.2}))["a"] == 0.1 + 0.2


def test_values_stand_under_each_other() -> None:
    assert aligned([("a", "1"), ("long", "2"), ("b", "")]) == ["  a     1", "  long  2", "  b"]
    assert aligned([]) == []


def test_commands_of_a_help_can_be_copied() -> None:
    command = "  atlas-cueing run a_scenario.toml " + " ".join(f"--set key_{k}=2" for k in range(9))
    text = copyable(f"\nExample:\n\n{command}\n\nAnd no word of it is lost, however long it is.\n")
    shown = text.split("\b\n")[1].split("\n\n")[0]
    assert shown.replace("\\\n", " ").split() == command.split()
    assert max(map(len, shown.splitlines())) < 80
    assert text.endswith("\n\nAnd no word of it is lost, however long it is.\n")
