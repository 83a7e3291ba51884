"""Every bundled scenario still flies as it did."""

import pytest

from .figures import PINNED, TOLERANCE, differences, flown, names, pinned

REMEDY = "if that is meant, run: tools/update_references"


@pytest.mark.parametrize("name", names())
def test_a_scenario_flies_as_pinned(name: str) -> None:
    assert name in pinned(), f"{name} has no reference; {REMEDY}"
    assert differences(pinned()[name], flown(name)) == {}, REMEDY


def test_no_reference_is_left_over() -> None:
    assert set(pinned()) <= set(names()), REMEDY


def test_references_are_worth_comparing() -> None:
    """Each figure is far from zero in some scenario, or its comparison would prove nothing.

    Being limited may be rare.
    """
    for figure in (name for name in PINNED if not name.endswith("_limited_share")):
        assert max(abs(table[figure]) for table in pinned().values()) > 10.0 * TOLERANCE, figure


def test_a_difference_is_seen() -> None:
    was = {"a": 2.0, "b": 0.001, "c": 1.0}
    assert differences(was, dict(was)) == {}
    assert differences(was, {**was, "a": 2.0019, "b": 0.0019}) == {}
    assert differences(was, {**was, "a": 2.0021}) == {"a": (2.0, 2.0021)}
    assert differences(was, {**was, "b": 0.0021}) == {"b": (0.001, 0.0021)}
    assert differences(was, {"a": 2.0, "b": 0.001, "d": 1.0}) == {
        "c": (1.0, None),
        "d": (None, 1.0),
    }
    assert differences(was, {**was, "a": float("nan")}).keys() == {"a"}
