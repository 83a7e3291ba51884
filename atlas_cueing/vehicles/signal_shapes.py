"""The shapes that a test signal on one axis can have: sine, sweep, step and doublet."""

from dataclasses import dataclass
from math import expm1, inf, log, sin
from typing import Literal, TypeAlias

from ..errors import InputError

SignalAxis: TypeAlias = Literal[
    "roll_rate", "pitch_rate", "yaw_rate", "force_x", "force_y", "force_z"
]
Shape: TypeAlias = Literal["sine", "sweep", "step", "doublet"]

RATE_AXES: tuple[SignalAxis, SignalAxis, SignalAxis] = ("roll_rate", "pitch_rate", "yaw_rate")
FORCE_AXES: tuple[SignalAxis, SignalAxis, SignalAxis] = ("force_x", "force_y", "force_z")
SHAPES: tuple[Shape, ...] = ("sine", "sweep", "step", "doublet")
DEFAULT_RAMP = 0.25  # s (assumed)


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
