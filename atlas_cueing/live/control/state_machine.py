"""The state machine of a live run: states, events and the table of transitions.

PARKED          at rest, upright and in the centre, until the operator engages
ENGAGING        waits for good input, then blends from where it stands to the cue
RUNNING         follows the cue
HOLDING         comes to rest and keeps its attitude
PARKING         comes to rest and moves back to upright in the centre
FAULT_STOPPING  executes the guard's certified stop; no command from above is taken
STOPPED         at rest after a fault; latched until a reset
WAITING         stands where it is, asked to engage: no good input comes, and the reason is told

The table has no guard conditions: an event is raised only when its condition holds. The conditions
on the input are in `InputMonitor`, those on the platform's motion in `PlatformController`, those on
the loop's timing in `LiveController`.
"""

from collections.abc import Collection, Mapping
from enum import Enum, auto

from ...signals import LIVE_STATES


class State(Enum):
    """States in the order of signals.LIVE_STATES; the value is the name in /status."""

    PARKED = "parked"
    ENGAGING = "engaging"
    RUNNING = "running"
    HOLDING = "holding"
    PARKING = "parking"
    FAULT_STOPPING = "fault_stopping"
    STOPPED = "stopped"
    WAITING = "waiting"

    @property
    def number(self) -> int:
        """Its place in signals.LIVE_STATES, as in /timing."""
        return LIVE_STATES.index(self.value)


class Event(Enum):
    """Everything that can cause a transition.

    ENGAGE, HOLD, PARK, RESET: the operator's buttons; PARK also by a signal or the end of the
        flight.
    READY: the input has been good for long enough and the platform stands.
    BAD: no input for a while, too many bad samples, or a jump of the vehicle.
    LOST: no input for so long that waiting for it is given up.
    ABSENT: asked to engage, and no good input for so long that the reason should be told.
    ARRIVED: the motion that belongs to the state has been completed.
    FAULT: the loop missed its deadlines, the tick raised an exception, the guard refused a command,
        or a stop at once was requested.
    """

    ENGAGE = auto()
    HOLD = auto()
    PARK = auto()
    RESET = auto()
    READY = auto()
    BAD = auto()
    LOST = auto()
    ABSENT = auto()
    ARRIVED = auto()
    FAULT = auto()


TRANSITIONS: Mapping[State, Mapping[Event, State]] = {
    State.PARKED: {
        Event.ENGAGE: State.ENGAGING,
        Event.FAULT: State.FAULT_STOPPING,
    },
    State.ENGAGING: {
        Event.HOLD: State.HOLDING,
        Event.PARK: State.PARKING,
        Event.BAD: State.HOLDING,
        Event.LOST: State.PARKING,
        Event.ABSENT: State.WAITING,
        Event.ARRIVED: State.RUNNING,
        Event.FAULT: State.FAULT_STOPPING,
    },
    State.RUNNING: {
        Event.HOLD: State.HOLDING,
        Event.PARK: State.PARKING,
        Event.BAD: State.HOLDING,
        Event.LOST: State.PARKING,
        Event.FAULT: State.FAULT_STOPPING,
    },
    State.HOLDING: {
        Event.PARK: State.PARKING,
        Event.READY: State.ENGAGING,
        Event.LOST: State.PARKING,
        Event.FAULT: State.FAULT_STOPPING,
    },
    State.PARKING: {
        Event.HOLD: State.HOLDING,
        Event.ARRIVED: State.PARKED,
        Event.FAULT: State.FAULT_STOPPING,
    },
    State.FAULT_STOPPING: {
        Event.ARRIVED: State.STOPPED,
    },
    State.STOPPED: {
        Event.RESET: State.PARKING,
    },
    State.WAITING: {
        Event.HOLD: State.HOLDING,
        Event.PARK: State.PARKING,
        Event.READY: State.ENGAGING,
        Event.FAULT: State.FAULT_STOPPING,
    },
}
"""The next state by state and event; an event that a state does not list leaves it as it is."""

BUTTON_EVENTS: Mapping[str, Event] = {
    "engage": Event.ENGAGE,
    "hold": Event.HOLD,
    "park": Event.PARK,
    "reset": Event.RESET,
}
"""The event that each of the operator's buttons raises."""


def next_state(state: State, event: Event) -> State:
    """Return the state after `event` in `state`."""
    return TRANSITIONS[state].get(event, state)


def allowed_buttons() -> Mapping[str, Collection[str]]:
    """Return the operator's buttons that have an effect, by the name of the state.

    While holding, `hold` makes a hold that the input has caused the operator's own, and `engage`
    ends the operator's hold.
    """
    buttons = {
        state.value: {name for name, event in BUTTON_EVENTS.items() if event in TRANSITIONS[state]}
        for state in State
    }
    buttons[State.HOLDING.value] |= {"engage", "hold"}
    return buttons


def allowed_commands() -> Mapping[str, Collection[str]]:
    """Return the operator's commands that have an effect, by the name of the state.

    They are the buttons, and `stop` for a stop at once of whatever is not stopped by a fault.
    """
    stops = {state.value for state in State if Event.FAULT in TRANSITIONS[state]}
    return {
        state: {*buttons, *(["stop"] if state in stops else [])}
        for state, buttons in allowed_buttons().items()
    }
