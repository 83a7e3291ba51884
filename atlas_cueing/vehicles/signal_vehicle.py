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
from math import expm1, inf, log, pi, sin
from pathlib import Path
from typing import ClassVar, Literal, TypeAlias

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
from .jsbsim.flights import DEFAULT_RATE_HZ, MAX_RATE_HZ, MIN_RATE_HZ

SignalAxis: TypeAlias = Literal[
    "roll_rate", "pitch_rate", "yaw_rate", "force_x", "force_y", "force_z"
]
Shape: TypeAlias = Literal["sine", "sweep", "step", "doublet"]

RATE_AXES: tuple[SignalAxis, SignalAxis, SignalAxis] = ("roll_rate", "pitch_rate", "yaw_rate")
FORCE_AXES: tuple[SignalAxis, SignalAxis, SignalAxis] = ("force_x", "force_y", "force_z")
SHAPES: tuple[Shape, ...] = ("sine", "sweep", "step", "doublet")
DEFAULT_RAMP = 0.25  # s (assumed)
MIN_STEPS_PER_PERIOD = 8  # of the highest frequency; with fewer a sine is no longer one (assumed)

# of one step; the attitude is then off by 5e-7 of its swing at 8 steps a period, by 4e-10 at 48
_SUBSTEPS = 4


@dataclass(frozen=True, slots=True)
class Signal:
    """A smooth signal on one axis, with two continuous derivatives.

    It is zero until `time` and after `time` + `duration` (s).

    axis: body rate about, or specific force along, the forward, right or down axis of the body;
        what signals of one axis ask for is added.
    shape: sine; sweep, a sine whose frequency rises or falls exponentially (A. Farina, AES 108th
        Convention, 2000); step, up and back; doublet, half of the time up and half down.
    amplitude: rad/s or m/s^2; with a negative one the signal begins the other way.
    ramp: s in which it comes and goes, in and out; a doublet has one at each end of both halves.
    frequency, end_frequency: rad/s; of a sine the first, of a sweep both.
    """

    axis: SignalAxis
    shape: Shape
    amplitude: float
    time: float
    duration: float
    ramp: float = DEFAULT_RAMP
    frequency: float = 0.0
    end_frequency: float = 0.0

    def value(self, t: float) -> float:
        """The signal at time t (s): rad/s or m/s^2."""
        s = t - self.time
        if not 0.0 < s < self.duration:
            return 0.0
        match self.shape:
            case "sine":
                carrier = sin(self.frequency * s)
            case "sweep":
                carrier = sin(self._swept(s))
            case "step":
                carrier = 1.0
            case "doublet":
                half = 0.5 * self.duration
                return self.amplitude * (
                    self._envelope(s, half) if s < half else -self._envelope(s - half, half)
                )
        return self.amplitude * carrier * self._envelope(s, self.duration)

    @property
    def fastest(self) -> float:
        """Highest frequency of the carrier, rad/s; 0 without one."""
        return {"sine": self.frequency, "sweep": max(self.frequency, self.end_frequency)}.get(
            self.shape, 0.0
        )

    def check(self) -> None:
        """Raise InputError for what cannot be a signal.

        An unknown word, a bad number, ramps that do not fit.
        """
        objection = self._bad_word() or self._bad_number() or self._long_ramp()
        if objection:
            raise InputError(f"signal on {self.axis}: {objection}")

    def _bad_word(self) -> str:
        if self.axis not in RATE_AXES + FORCE_AXES:
            return f"no such axis, allowed: {', '.join(RATE_AXES + FORCE_AXES)}"
        return (
            "" if self.shape in SHAPES else f"no shape {self.shape!r}, allowed: {', '.join(SHAPES)}"
        )

    def _bad_number(self) -> str:
        positive = {"duration": self.duration, "ramp": self.ramp}
        if self.shape in ("sine", "sweep"):
            positive["frequency"] = self.frequency
        if self.shape == "sweep":
            positive["end_frequency"] = self.end_frequency
        for name, value in positive.items():
            if not 0.0 < value < inf:
                return f"{name} = {value:g}, allowed: finite, 0 < {name}"
        if not 0.0 <= self.time < inf:
            return f"time = {self.time:g} s, allowed: finite, 0 <= time"
        return (
            "" if abs(self.amplitude) < inf else f"amplitude = {self.amplitude:g}, allowed: finite"
        )

    def _long_ramp(self) -> str:
        longest = self.duration / (4.0 if self.shape == "doublet" else 2.0)
        if self.ramp <= longest:
            return ""
        bounds = f"allowed: 0 < ramp <= {longest:g}"
        return (
            f"the ramps of a {self.shape} of {self.duration:g} s must fit into it: ramp ="
            f" {self.ramp:g} s, {bounds}"
        )

    def _envelope(self, s: float, duration: float) -> float:
        """0 to 1 to 0 between 0 and `duration`: the smoothstep of fifth order at both ends."""
        x = min(s, duration - s) / self.ramp
        return x * x * x * (10.0 - x * (15.0 - 6.0 * x)) if x < 1.0 else 1.0

    def _swept(self, s: float) -> float:
        """Phase of the sweep (rad).

        The integral of frequency * k^(s / duration), with k = end_frequency / frequency.
        """
        growth = log(self.end_frequency / self.frequency)
        if abs(growth) < 1e-9:
            return self.frequency * s
        return self.frequency * self.duration / growth * expm1(growth * s / self.duration)


@dataclass(frozen=True, slots=True)
class SignalFlight:
    """Signals to fly at `rate_hz` steps per second; None for the default (implements Flight).

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

    def files(self) -> dict[str, Path]:
        """Return nothing: the scenario holds the signals."""
        return {}

    def large_files(self) -> dict[str, Path]:
        """Return nothing: the scenario holds the signals."""
        return {}


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
