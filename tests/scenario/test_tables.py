from typing import Annotated

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from atlas_cueing.scenario.tables import (
    ONE_OR_THREE,
    THREE,
    Finite,
    ScenarioTable,
    number,
    tables_in,
    text,
    whole,
)

HUGE = 10**400  # an integer that no float holds


class Inner(ScenarioTable):
    closed: Annotated[float, number(-1.0, 2.0)] = 0.0
    half_open: Annotated[float, number(0.0, 2.0, above=True)] = 1.0
    finite: Finite = 0.0
    count: Annotated[int, whole(1, 5)] = 1
    word: Annotated[str, text("a short word", lambda word: len(word) < 5)] = "word"
    three: Annotated[tuple[Finite, Finite, Finite], THREE] = (0.0, 0.0, 0.0)
    spread: Annotated[tuple[Finite, Finite, Finite], ONE_OR_THREE] = (0.0, 0.0, 0.0)


class Outer(ScenarioTable):
    inner: Inner | None = None
    many: tuple[Inner, ...] = ()
    plain: int = 0


def message(**data: object) -> str:
    with pytest.raises(ValidationError) as refusal:
        Inner.model_validate(data)
    texts = {error["msg"] for error in refusal.value.errors()}
    assert len(texts) == 1
    return texts.pop()


@pytest.mark.parametrize("value", [-1, -1.0, 0, 2, 2.0])
def test_bounds_are_allowed(value: float) -> None:
    kept = Inner(closed=value).closed
    assert kept == value
    assert type(kept) is float


@pytest.mark.parametrize(
    "bad", [-1.001, 2.001, float("nan"), float("inf"), HUGE, -HUGE, True, "1", None, [1.0], {}]
)
def test_a_number_says_its_bounds(bad: object) -> None:
    assert message(closed=bad) == "a number, -1 <= value <= 2"


@pytest.mark.parametrize("bad", [0.0, 0, -0.0, -1.0, float("nan")])
def test_a_bound_can_be_left_out(bad: object) -> None:
    assert message(half_open=bad) == "a number, 0 < value <= 2"
    assert Inner(half_open=1e-300).half_open == 1e-300


@pytest.mark.parametrize("bad", [float("nan"), float("-inf"), HUGE, False, "0"])
def test_finite(bad: object) -> None:
    assert message(finite=bad) == "a finite number"


@pytest.mark.parametrize("bad", [0, 6, 1.0, True, "1", HUGE])
def test_whole(bad: object) -> None:
    assert message(count=bad) == "a whole number, 1 <= value <= 5"
    assert Inner(count=5).count == 5


@pytest.mark.parametrize("bad", ["longer", None, ["word"], True, HUGE])
def test_text(bad: object) -> None:
    assert message(word=bad) == "a short word"


def test_a_number_for_a_text_is_told_how_it_is_written() -> None:
    assert message(word=3) == """a short word; as a text: "3", in a shell '"3"'"""


@given(st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=3))
def test_three(values: list[float]) -> None:
    assert Inner(three=values).three == tuple(values)
    assert Inner(spread=values).spread == tuple(values)


def test_one_stands_for_three() -> None:
    assert Inner(spread=4).spread == (4.0, 4.0, 4.0)
    assert message(three=4) == "a list of three"


@pytest.mark.parametrize("bad", [[], [1.0, 2.0], [1.0, 2.0, 3.0, 4.0]])
def test_neither_two_nor_four(bad: object) -> None:
    assert message(three=bad) == "a list of three"
    assert message(spread=bad) == "a number, or a list of three"


def test_unknown_keys_and_changes_are_refused() -> None:
    with pytest.raises(ValidationError, match="extra"):
        Inner(close=1.0)
    with pytest.raises(ValidationError, match="frozen"):
        Inner().closed = 1.0


def test_tables_in_a_type() -> None:
    fields = Outer.model_fields
    assert tables_in(fields["inner"].annotation) == [Inner]
    assert tables_in(fields["many"].annotation) == [Inner]
    assert tables_in(fields["plain"].annotation) == []
