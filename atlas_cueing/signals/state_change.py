"""A change of state during a run, as the topic /status records it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StateChange:
    """A change to `state` at `time` (s) because of `reason`; the first tick of it is at `time`."""

    time: float
    state: str
    reason: str
