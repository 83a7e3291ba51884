"""Test signals as a vehicle: known rates and forces.

They measure what the rest of the pipeline makes of them.

The vehicle begins level and at rest. Its body rates are sums of signals, its attitude is their
integral, and its specific force at the pilot's eye is

    f_B = R_BN (0, 0, -g) + signals     `force_follows_attitude` (default): turned in place,
                                        gravity moves in its axes
    f_B =      (0, 0, -g) + signals     held: a coordinated vehicle, whose turns are not
                                        felt as force

The objective motion cueing test (ICAO Doc 9625; R. Hosman & S. Advani, Aeronautical Journal 120,
2016) drives one axis at a time with sines and asks for rotation and specific force at the rider's
place: four kinds of transfer function. They are well defined here because the signals are the only
inputs. With the force following, a rotation brings the gravity component that belongs to it and
nothing else, so rotation to force can be compared with the vehicle's own g / s. Held, rates and
forces are independent inputs, and any force felt in answer to a rotation is a false cue; the
response with the force following is this one plus that to a force of g / s. That the test means the
former is our reading, not a quotation.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from typing import ClassVar, TypeAlias

from ..errors import InputError, VehicleError
from ..rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    add,
    continuous,
    integrate_body,
    normalise,
    scale,
    up_in_body,
)
from ..signals import STANDARD_GRAVITY, Vehicle, VehicleState
from .bounds import Bounds
from .flight import Flight
from .jsbsim.flights import DEFAULT_RATE_HZ, MAX_RATE_HZ, MIN_RATE_HZ
from .signal_shapes import FORCE_AXES, RATE_AXES, Signal, SignalAxis

MIN_STEPS_PER_PERIOD = 8  # of the highest frequency; with fewer a sine is no longer one (assumed)

# of one step; the attitude is then off by 5e-7 of its swing at 8 steps a period, by 4e-10 at 48
_SUBSTEPS = 4


@dataclass(frozen=True, slots=True)
class SignalFlight(Flight):
    """Signals to fly at `rate_hz` steps per second; None for the default.

    Without `force_follows_attitude` the force is held.
    """

    live_only: ClassVar[str] = ""
    ends_itself: ClassVar[bool] = False

    signals: tuple[Signal, ...]
    rate_hz: float | None = None
    force_follows_attitude: bool = True

    @property
    def name(self) -> str:
        """Return the word for all of them."""
        return "signal"

    def vehicle(self) -> Vehicle:
        """Build the vehicle. Raises InputError for signals that cannot be flown."""
        return SignalVehicle(self)

    def length(self) -> float | None:
        """Return the end of the last signal, s; None without signals."""
        return max((signal.time + signal.duration for signal in self.signals), default=None)

    def step(self) -> float:
        """Return the time between two states, s."""
        return 1.0 / (self.rate_hz or DEFAULT_RATE_HZ)


class SignalVehicle:
    """A vehicle that does nothing but its signals (implements signals.Vehicle).

    The attitude is integrated from the rates by the fourth-order Magnus expansion, with Simpson's
    rule for their integral: for one axis at a time it is the signal's own integral to a millionth
    of its swing at worst.

    Building it raises InputError for signals that cannot be flown, `advance` VehicleError when they
    add up to more than a vehicle that people ride in does.
    """

    def __init__(self, flight: SignalFlight, bounds: Bounds | None = None) -> None:
        _check(flight)
        rate_hz = flight.rate_hz or DEFAULT_RATE_HZ
        self._bounds = Bounds() if bounds is None else bounds
        self._dt = 1.0 / rate_hz
        self._follows = flight.force_follows_attitude
        self._rates, self._forces = (
            _of_axes(flight.signals, axes) for axes in (RATE_AXES, FORCE_AXES)
        )
        self._turning = any(self._rates)
        self._step, self._q_NB, self._w_B = 0, IDENTITY, ZERO
        self._state = self._at(0)

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._dt

    @property
    def state(self) -> VehicleState:
        """The present state; the last good one after a failure."""
        return self._state

    def advance(self) -> bool:
        """Go one step on, for ever. Raises VehicleError when the state is not believable."""
        if self._turning:
            self._turn()
        state = self._at(self._step + 1)
        objection = self._bounds.objection(state, height=0.0)
        if objection:
            raise VehicleError(state.time, objection)
        self._step, self._state = self._step + 1, state
        return True

    def _at(self, step: int) -> VehicleState:
        t = step * self._dt
        gravity = (
            scale(-STANDARD_GRAVITY, up_in_body(self._q_NB))
            if self._follows
            else (0.0, 0.0, -STANDARD_GRAVITY)
        )
        return VehicleState(t, self._q_NB, self._w_B, add(gravity, _values(self._forces, t)))

    def _turn(self) -> None:
        """Integrate the rates over the next step.

        The one place where the attitude is renormalised.
        """
        h = self._dt / _SUBSTEPS
        q_NB: Quat = self._q_NB
        for k in range(1, _SUBSTEPS + 1):
            w0 = self._w_B
            end = self._dt * (self._step + k / _SUBSTEPS)
            middle, self._w_B = _values(self._rates, end - 0.5 * h), _values(self._rates, end)
            turn = scale(h / 6.0, add(add(w0, self._w_B), scale(4.0, middle)))
            q_NB = integrate_body(q_NB, turn, w0, self._w_B, h)
        self._q_NB = continuous(normalise(q_NB), self._q_NB)


_ByAxis: TypeAlias = tuple[list[Signal], list[Signal], list[Signal]]


def _of_axes(signals: Sequence[Signal], axes: tuple[SignalAxis, SignalAxis, SignalAxis]) -> _ByAxis:
    one, two, three = ([signal for signal in signals if signal.axis == axis] for axis in axes)
    return one, two, three


def _values(by_axis: _ByAxis, t: float) -> Vec3:
    """Sum of the signals of each axis at time t."""
    one, two, three = (
        sum(signal.value(t) for signal in signals) if signals else 0.0 for signals in by_axis
    )
    return (one, two, three)


def _check(flight: SignalFlight) -> None:
    """Refuse what cannot be flown."""
    rate_hz = flight.rate_hz or DEFAULT_RATE_HZ
    if not MIN_RATE_HZ <= rate_hz <= MAX_RATE_HZ:
        raise InputError(
            f"rate {rate_hz:g} Hz, allowed: {MIN_RATE_HZ:g} <= rate_hz <= {MAX_RATE_HZ:g}"
        )
    highest = 2.0 * pi * rate_hz / MIN_STEPS_PER_PERIOD
    for signal in flight.signals:
        signal.check()
        if signal.fastest > highest:
            raise InputError(
                f"signal on {signal.axis}: frequency {signal.fastest:g} rad/s at {rate_hz:g} Hz, "
                f"allowed: 0 < frequency <= {highest:g} ({MIN_STEPS_PER_PERIOD} steps a period)"
            )
