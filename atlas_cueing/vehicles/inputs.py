"""Timed inputs, played on JSBSim's properties."""

# mypyc: runs every tick

from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite
from typing import Final

import jsbsim

from ..errors import InputError
from .flights import TimedInput
from .library import is_property_name, suggestion, writable_names

_TIME_TOLERANCE: Final = 1e-9  # s; an input at n dt belongs to step n however n dt was rounded


@dataclass(frozen=True, slots=True)
class _Ramp:
    """A property on its way from `start` to the input's value."""

    node: jsbsim.FGPropertyNode
    start: float
    event: TimedInput

    def value(self, time: float) -> float:
        """Linear in time, and exactly the input's value at its end."""
        share = (time - self.event.time) / self.event.ramp if self.event.ramp > 0.0 else 1.0
        if share >= 1.0 - _TIME_TOLERANCE:
            return self.event.value
        return self.start + (self.event.value - self.start) * share


class InputPlayer:
    """Plays inputs in order of time. Raises InputError for a property that is missing or read-only and for bad numbers."""

    def __init__(self, inputs: Iterable[TimedInput], fdm: jsbsim.FGFDMExec) -> None:
        events = sorted(inputs, key=lambda event: event.time)
        self._nodes = {event.property: _writable_node(event.property, fdm) for event in events}
        for event in events:
            _check(event)
        self._due = events[::-1]
        self._ramps: dict[str, _Ramp] = {}

    def play(self, time: float) -> bool:
        """Set what is due at `time` (s, never going back); True when something was set."""
        while self._due and self._due[-1].time <= time + _TIME_TOLERANCE:
            event = self._due.pop()
            self._move(event.time)
            node = self._nodes[event.property]
            self._ramps[event.property] = _Ramp(node, node.get_double_value(), event)
        moving = bool(self._ramps)
        self._move(time)
        return moving

    def _move(self, time: float) -> None:
        for name, ramp in list(self._ramps.items()):
            ramp.node.set_double_value(ramp.value(time))
            if time >= ramp.event.time + ramp.event.ramp - _TIME_TOLERANCE:
                del self._ramps[name]


def _writable_node(name: str, fdm: jsbsim.FGFDMExec) -> jsbsim.FGPropertyNode:
    """The property's node; InputError with the nearest name when it is missing, or when JSBSim would ignore what is set.

    JSBSim itself creates a missing property in silence, so that a misspelt control does nothing.
    """
    node = fdm.get_property_manager().get_node(name) if is_property_name(name) else None
    if not node:
        raise InputError(f"unknown JSBSim property {name!r}{suggestion(name, writable_names(fdm))}")
    if not node.get_attribute(jsbsim.Attribute.WRITE):
        raise InputError(f"JSBSim property {name!r} can be read but not set")
    return node


def _check(event: TimedInput) -> None:
    if not isfinite(event.value):
        raise InputError(f"input on {event.property!r}: value = {event.value}; must be finite")
    if not (0.0 <= event.time < float("inf") and 0.0 <= event.ramp < float("inf")):
        raise InputError(
            f"input on {event.property!r}: time = {event.time} s, ramp = {event.ramp} s; must be finite and not negative"
        )
