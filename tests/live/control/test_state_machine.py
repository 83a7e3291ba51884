"""The table of transitions, against what the words of each state and event say."""

from itertools import product

import pytest

from atlas_cueing.live.control.state_machine import (
    TRANSITIONS,
    Event,
    State,
    allowed_buttons,
    next_state,
)
from atlas_cueing.signals import LIVE_STATES

PAIRS = list(product(State, Event))
AT_REST = {State.PARKED, State.STOPPED}


def expected(state: State, event: Event) -> State:
    """Event by event, where the table goes state by state."""
    if event is Event.FAULT:  # stops whatever was not stopped by a fault before
        return state if state in (State.FAULT_STOPPING, State.STOPPED) else State.FAULT_STOPPING
    # a fault is deaf to all but its own end and a reset
    if state in (State.FAULT_STOPPING, State.STOPPED):
        ways = {
            (State.FAULT_STOPPING, Event.ARRIVED): State.STOPPED,
            (State.STOPPED, Event.RESET): State.PARKING,
        }
        return ways.get((state, event), state)
    match event:
        case Event.ENGAGE:
            return State.ENGAGING if state is State.PARKED else state
        case Event.HOLD:  # of what moves or is about to
            return state if state is State.PARKED else State.HOLDING
        case Event.ABSENT:
            return State.WAITING if state is State.ENGAGING else state
        case Event.PARK:
            return state if state is State.PARKED else State.PARKING
        case Event.BAD:
            return State.HOLDING if state in (State.ENGAGING, State.RUNNING) else state
        case Event.LOST:
            return (
                State.PARKING if state in (State.ENGAGING, State.RUNNING, State.HOLDING) else state
            )
        case Event.READY:
            return State.ENGAGING if state in (State.HOLDING, State.WAITING) else state
        case Event.ARRIVED:
            return {State.ENGAGING: State.RUNNING, State.PARKING: State.PARKED}.get(state, state)
        case _:  # a reset is for faults
            return state


@pytest.mark.parametrize(("state", "event"), PAIRS)
def test_every_pair_of_state_and_event(state: State, event: Event) -> None:
    assert next_state(state, event) is expected(state, event)


def test_the_table_names_only_what_changes_something() -> None:
    assert set(TRANSITIONS) == set(State)
    assert all(to is not state for state, ways in TRANSITIONS.items() for to in ways.values())


def test_only_a_reset_leaves_stopped_and_only_by_parking() -> None:
    assert TRANSITIONS[State.STOPPED] == {Event.RESET: State.PARKING}


def test_every_state_can_be_reached_from_every_other() -> None:
    for start in State:
        reached = {start}
        while more := {to for state in reached for to in TRANSITIONS[state].values()} - reached:
            reached |= more
        assert reached == set(State), start


def test_no_way_out_of_a_fault_leads_past_its_stop() -> None:
    """Whoever comes from FAULT_STOPPING has been in STOPPED and PARKING before it runs."""
    reached, blocked = {State.FAULT_STOPPING}, State.PARKING
    while (
        more := {to for state in reached - {blocked} for to in TRANSITIONS[state].values()}
        - reached
    ):
        reached |= more
    assert reached == {State.FAULT_STOPPING, State.STOPPED, State.PARKING}


def test_whoever_comes_to_rest_has_arrived() -> None:
    """Nothing but an arrival says that the platform is where it should be at rest."""
    assert {
        event for ways in TRANSITIONS.values() for event, to in ways.items() if to in AT_REST
    } == {Event.ARRIVED}


def test_names_and_numbers_are_those_of_the_log() -> None:
    assert [state.value for state in State] == list(LIVE_STATES)
    assert [state.number for state in State] == list(range(len(LIVE_STATES)))


def test_buttons_that_do_something() -> None:
    assert allowed_buttons() == {
        "parked": {"engage"},
        "engaging": {"hold", "park"},
        "running": {"hold", "park"},
        "holding": {"engage", "hold", "park"},
        "parking": {"hold"},
        "fault_stopping": set(),
        "stopped": {"reset"},
        "waiting": {"hold", "park"},
    }
