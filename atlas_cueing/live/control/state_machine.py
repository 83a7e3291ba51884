"""What the platform does in a live run, and what takes it from one state to the next: all of it in one table.

PARKED          at rest, upright and in the centre, until somebody engages
ENGAGING        waits for good input, then blends from where it stands to the cue
RUNNING         follows the cue
HOLDING         comes to rest and keeps its attitude
PARKING         comes to rest and drives home
FAULT_STOPPING  flies the guard's certified stop; no command from above is taken
STOPPED         at rest after a fault; latched until a reset
"""

from collections.abc import Collection, Mapping
from enum import Enum, auto

from ...signals import LIVE_STATES


class State(Enum):
    """States; the value is the name in /status."""

    PARKED, ENGAGING, RUNNING, HOLDING, PARKING, FAULT_STOPPING, STOPPED = LIVE_STATES

    @property
    def number(self) -> int:
        """Its place in signals.LIVE_STATES, as in /timing."""
        return LIVE_STATES.index(self.value)


class Event(Enum):
    """What can happen in a tick.

    ENGAGE, HOLD, PARK, RESET: asked by the operator; PARK by a signal or the end of the flight,
        too.
    READY: the input has been good for long enough and the platform stands.
    BAD: no input for a while, too many bad samples, or a jump of the vehicle.
    LOST: no input for so long that nobody waits any more.
    ARRIVED: what the state was about is done.
    FAULT: the loop failed its deadlines, the tick raised, the guard refused a command, or somebody
        asked to stop now.
    """

    ENGAGE = auto()
    HOLD = auto()
    PARK = auto()
    RESET = auto()
    READY = auto()
    BAD = auto()
    LOST = auto()
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
}
"""Any event that a state does not name leaves it as it is."""


def after(state: State, event: Event) -> State:
    """The state that follows."""
    return TRANSITIONS[state].get(event, state)


def allowed_buttons() -> Mapping[str, Collection[str]]:
    """Which of the operator's buttons do something, by the name of the state.

    A hold that the input has caused can be made the operator's own, and the operator's be ended by
    engaging.
    """
    asked = {"engage": Event.ENGAGE, "hold": Event.HOLD, "park": Event.PARK, "reset": Event.RESET}
    buttons = {
        state.value: {name for name, event in asked.items() if event in TRANSITIONS[state]}
        for state in State
    }
    buttons[State.HOLDING.value] |= {"engage", "hold"}
    return buttons
