"""Timed inputs, played on JSBSim's properties."""

# mypyc: runs every tick

from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite
from typing import Final

import jsbsim

from ...errors import InputError, VehicleError
from .flights import TimedInput
from .library import JSBSIM_ERRORS, one_line, property_objection

_TIME_TOLERANCE: Final = 1e-9  # s; an input at n dt belongs to step n however n dt was rounded
# Controls and wind, which JSBSim only stores: nothing throws there. Others may start a trim.
_STORED: Final = ("fcs/", "ap/", "atmosphere/wind-")


@dataclass(frozen=True, slots=True)
class _Ramp:
    """A property on its way from `start` to the input's value."""

    node: jsbsim.FGPropertyNode
    stored: bool  # without acting on it
    start: float
    event: TimedInput

    def value(self, time: float) -> float:
        """Linear in time, and exactly the input's value at its end."""
        share = (time - self.event.time) / self.event.ramp if self.event.ramp > 0.0 else 1.0
        if share >= 1.0 - _TIME_TOLERANCE:
            return self.event.value
        return self.start + (self.event.value - self.start) * share


class InputPlayer:
    """Plays inputs in order of time.

    A property node lets C++ exceptions through, which end the process; setting by name turns them
    into Python's, at nine times the cost. So only what JSBSim stores without acting on it is set by
    its node.

    Raises InputError for a property that is missing or cannot be set, and for bad numbers.
    """

    def __init__(self, inputs: Iterable[TimedInput], fdm: jsbsim.FGFDMExec) -> None:
        self._fdm = fdm
        events = sorted(inputs, key=lambda event: event.time)
        self._nodes = {event.property: _writable_node(event.property, fdm) for event in events}
        for event in events:
            _check(event)
        self._due = events[::-1]
        self._ramps: dict[str, _Ramp] = {}

    def play(self, time: float) -> bool:
        """Set what is due at `time` (s, never going back); True when something was set.

        Raises VehicleError when JSBSim fails by it, as a trim may.
        """
        while self._due and self._due[-1].time <= time + _TIME_TOLERANCE:
            event = self._due.pop()
            self._move(event.time)
            node = self._nodes[event.property]
            stored = event.property.startswith(_STORED)
            self._ramps[event.property] = _Ramp(node, stored, node.get_double_value(), event)
        moving = bool(self._ramps)
        self._move(time)
        return moving

    def _move(self, time: float) -> None:
        for name, ramp in list(self._ramps.items()):
            if ramp.stored:
                ramp.node.set_double_value(ramp.value(time))
            else:
                self._set(name, ramp.value(time), time)
            if time >= ramp.event.time + ramp.event.ramp - _TIME_TOLERANCE:
                del self._ramps[name]

    def _set(self, name: str, value: float, time: float) -> None:
        try:
            self._fdm[name] = value
        except JSBSIM_ERRORS as error:
            reason = f"input on {name!r} = {value:g}: JSBSim: {one_line(error)}"
            raise VehicleError(time, reason) from error


def _writable_node(name: str, fdm: jsbsim.FGFDMExec) -> jsbsim.FGPropertyNode:
    objection = property_objection(name, fdm)
    node = None if objection else fdm.get_property_manager().get_node(name)
    if node is None:
        raise InputError(objection)
    return node


def _check(event: TimedInput) -> None:
    if not isfinite(event.value):
        raise InputError(f"input on {event.property!r}: value = {event.value}; must be finite")
    if not (0.0 <= event.time < float("inf") and 0.0 <= event.ramp < float("inf")):
        raise InputError(
            f"input on {event.property!r}: time = {event.time} s, ramp = {event.ramp} s; must be"
            " finite and not negative"
        )
