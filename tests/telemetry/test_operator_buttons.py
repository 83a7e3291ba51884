"""Buttons: every press is noticed once, across processes."""

import os
from multiprocessing import get_context

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.telemetry.operator_buttons import BUTTONS, OperatorButtons


def test_nothing_is_pressed_at_first() -> None:
    assert OperatorButtons().edges() == ()


@given(st.lists(st.lists(st.sampled_from(BUTTONS), max_size=4), max_size=8))
def test_what_was_pressed_since_the_last_call_is_told_once_and_in_order(
    bursts: list[list[str]],
) -> None:
    buttons = OperatorButtons()
    for burst in bursts:
        for name in burst:
            buttons.press(name)
        assert buttons.edges() == tuple(name for name in BUTTONS if name in burst)
        assert buttons.edges() == ()


@pytest.mark.parametrize("name", ["", "explode", "Engage"])
def test_another_name_is_refused_and_presses_nothing(name: str) -> None:
    buttons = OperatorButtons()
    with pytest.raises(
        ValueError, match=f"button {name!r}, allowed: engage, hold, park, reset, stop"
    ):
        buttons.press(name)
    assert buttons.edges() == ()


def test_a_count_may_be_large() -> None:
    """Beyond a byte and beyond 32 bits every press still shows, and only once."""
    buttons = OperatorButtons()
    for start in (254, 2**32 - 2):
        buttons._counts[2] = start
        buttons.edges()
        for _ in range(4):
            buttons.press("park")
            assert buttons.edges() == ("park",)
            assert buttons.edges() == ()


def test_two_sets_are_apart() -> None:
    one, other = OperatorButtons(), OperatorButtons()
    one.press("hold")
    assert other.edges() == ()
    assert one.edges() == ("hold",)


def test_a_press_in_another_process_is_noticed_here() -> None:
    """Every press waits until the one before has been noticed, so that each of them has to be."""
    buttons, noticed = OperatorButtons(), OperatorButtons()
    process = get_context("fork").Process(target=_press_one_by_one, args=(buttons, noticed, 40))
    process.start()
    seen: list[str] = []
    while len(seen) < 40 and process.is_alive():
        for name in buttons.edges():
            seen.append(name)
            noticed.press(name)
    process.join(60.0)
    assert process.exitcode == 0
    assert seen == [BUTTONS[k % len(BUTTONS)] for k in range(40)]
    assert buttons.edges() == ()


def _press_one_by_one(buttons: OperatorButtons, noticed: OperatorButtons, count: int) -> None:
    for k in range(count):
        buttons.press(BUTTONS[k % len(BUTTONS)])
        while not noticed.edges():
            pass
    os._exit(0)
