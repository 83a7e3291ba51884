"""When the input is trusted, sample by sample with a time of our own."""

from dataclasses import replace
from math import inf

import pytest

from atlas_cueing.live.control.input_monitor import (
    BAD_SAMPLES,
    GOOD_TO_RESUME,
    LOST,
    STALE,
    InputMonitor,
)
from atlas_cueing.live.control.state_machine import Event, State
from atlas_cueing.live.input.source import SourceReading, no_vehicle

GOOD = SourceReading(no_vehicle(0.0), 0.0, 0, 0, False, False, "")
NOTHING = SourceReading(None, inf, 0, 0, False, False, "")
MOVING = (State.ENGAGING, State.RUNNING)
TROUBLES = {
    "stale": replace(GOOD, age=STALE + 0.001),
    "bad": replace(GOOD, bad_in_a_row=BAD_SAMPLES, reason="NaN"),
    "jump": replace(GOOD, jumped=True, reason="reset"),
    "nothing": NOTHING,
}


def test_the_numbers_of_the_specification() -> None:
    from atlas_cueing.live.control import input_monitor as monitor

    assert (STALE, LOST, BAD_SAMPLES, GOOD_TO_RESUME) == (0.1, 1.0, 3, 0.5)
    assert monitor.GOOD_TO_ENGAGE == 1.0
    assert 3.0 <= monitor.ENGAGE_TIME <= 5.0
    assert monitor.RESUME_TIME == 1.0


@pytest.mark.parametrize("state", State)
@pytest.mark.parametrize("trouble", TROUBLES)
@pytest.mark.parametrize("moving", [False, True])
def test_trouble_stops_what_follows_the_cue(state: State, trouble: str, moving: bool) -> None:
    events = [event for event, _ in InputMonitor().watch(1.0, state, moving, TROUBLES[trouble])]
    if state is State.HOLDING:
        assert events == ([Event.LOST] if trouble == "nothing" else [])
    else:
        assert events == ([Event.BAD] if moving and state in MOVING else [])


@pytest.mark.parametrize("state", [state for state in State if state is not State.WAITING])
def test_good_input_says_nothing(state: State) -> None:
    monitor = InputMonitor()
    for k in range(200):
        events = monitor.watch(0.01 * k, state, True, GOOD)
        assert events == []


@pytest.mark.parametrize(("age", "bad"), [(STALE, 0), (0.025, 0), (0.0, BAD_SAMPLES - 1)])
def test_what_is_borne(age: float, bad: int) -> None:
    assert (
        InputMonitor().watch(1.0, State.RUNNING, True, replace(GOOD, age=age, bad_in_a_row=bad))
        == []
    )


def test_a_source_says_how_long_a_silence_it_bears() -> None:
    slow = replace(GOOD, age=0.3, patience=0.3)
    assert InputMonitor().watch(1.0, State.RUNNING, True, slow) == []
    assert InputMonitor().watch(1.0, State.RUNNING, True, replace(slow, age=0.31)) == [
        (Event.BAD, "no input for 0.31 s")
    ]


def test_waiting_ends_after_a_second_of_good_input() -> None:
    monitor = InputMonitor()
    events = [monitor.watch(0.1 * k, State.WAITING, False, GOOD) for k in range(12)]
    assert [bool(event) for event in events] == [False] * 10 + [True] * 2
    assert events[-1] == [(Event.READY, "input is good")]


def test_each_trouble_is_told_with_its_reason() -> None:
    reasons = {
        name: InputMonitor().watch(1.0, State.RUNNING, True, reading)[0][1]
        for name, reading in TROUBLES.items()
    }
    assert reasons == {
        "stale": "no input for 0.10 s",
        "bad": "3 bad samples in a row: NaN",
        "jump": "the vehicle jumped: reset",
        "nothing": "no input yet",
    }


def test_good_for_counts_from_the_last_trouble() -> None:
    monitor = InputMonitor()
    assert monitor.good_for(5.0) == 0.0
    for time, reading, good in (
        (1.0, GOOD, 0.0),
        (1.5, GOOD, 0.5),
        (1.6, TROUBLES["jump"], 0.0),
        (1.7, GOOD, 0.0),
        (2.0, GOOD, 0.3),
    ):
        monitor.watch(time, State.PARKED, False, reading)
        assert monitor.good_for(time) == pytest.approx(good)


def ready(monitor: InputMonitor, *, moving: bool = False, seconds: float = 2.0) -> float | None:
    """When a hold is said to be over, s after its beginning."""
    for k in range(round(100 * seconds)):
        if (Event.READY, "input is good again") in monitor.watch(
            3.0 + 0.01 * k, State.HOLDING, moving, GOOD
        ):
            return 0.01 * k
    return None


def test_a_hold_ends_after_half_a_second_of_good_input_at_rest() -> None:
    assert ready(InputMonitor()) == pytest.approx(GOOD_TO_RESUME, abs=0.011)
    assert ready(InputMonitor(), moving=True) is None


def test_an_operators_hold_does_not_end_by_itself() -> None:
    monitor = InputMonitor()
    monitor.held = True
    assert ready(monitor) is None


def test_an_operators_hold_does_not_end_with_the_input() -> None:
    """Nor does the engagement that ends it find the input lost at once."""
    monitor, gone = InputMonitor(), replace(GOOD, age=100.0)
    monitor.held = True
    assert monitor.watch(1.0, State.HOLDING, False, gone) == []
    monitor.held = False
    assert monitor.watch(1.0 + LOST, State.HOLDING, False, gone) == []
    assert [event for event, _ in monitor.watch(1.01 + LOST, State.HOLDING, False, gone)] == [
        Event.LOST
    ]


def test_a_hold_waits_a_second_for_input() -> None:
    monitor = InputMonitor()
    assert monitor.watch(1.0, State.HOLDING, False, replace(GOOD, age=LOST)) == []
    assert monitor.watch(1.1, State.HOLDING, True, replace(GOOD, age=LOST + 0.01)) == [
        (Event.LOST, "no input for 1.01 s")
    ]
