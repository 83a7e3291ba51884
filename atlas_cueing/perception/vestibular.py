"""Transfer functions of the organs of balance, for angular rate and for specific force.

Models of Telban & Cardullo, "Motion Cueing Algorithm Development: Human-Centered Linear and
Nonlinear Approaches", NASA/CR-2005-213747, without their thresholds:

    canals    5.73 * 80 s^2 / ((5.73 s + 1)(80 s + 1))       sensed over true angular rate
    otoliths  0.4 (10 s + 1) / ((5 s + 1)(0.016 s + 1))      sensed over true specific force
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..rotations import Array
from .carried import carried

# that one row of a matrix product filters; the lags' states are carried from row to row
_TICKS = 32


@dataclass(frozen=True, slots=True)
class Organ:
    """A sensor with two real poles, in partial fractions.

    sensed = direct * input + sum of gain * input / (lag s + 1)

    direct: part that follows the input at once; lags: (gain, time constant in s) of each pole.
    """

    direct: float
    lags: tuple[tuple[float, float], tuple[float, float]]

    def response(self, frequency: ArrayLike) -> NDArray[np.complex128]:
        """Complex frequency response at `frequency` (rad/s)."""
        s = 1j * np.asarray(frequency, dtype=np.float64)
        response = np.full(s.shape, self.direct, dtype=np.complex128)
        for gain, lag in self.lags:
            response += gain / (lag * s + 1.0)
        return response

    def sense(self, signal: Array, dt: float) -> Array:
        """The sensed signal (n,) for a signal (n,) whose ticks are `dt` (s) apart.

        The organ is in the steady state of the signal's first value when it begins.
        Exact for a signal that is straight between ticks (first-order hold).
        """
        return Sensing(self, dt).sense(signal)

    def discrete(self, dt: float) -> tuple[Array, Array, Array, float]:
        """The organ by first-order hold, for ticks `dt` (s) apart.

        Gives decay and drive of each lag in a tick (2,), its state under a steady input of 1 (2,),
        and the direct part.
        """
        gain, lag = np.array(self.lags).T
        rise = -np.expm1(-dt / lag)  # of a lag's output in a tick, under a steady input of 1
        new = 1.0 - rise * lag / dt  # weight of the present input in it
        # State = output less the present input's part, so that it depends on past inputs only.
        decay = 1.0 - rise
        return decay, rise - new + decay * new, 1.0 - new, self.direct + float(gain @ new)


class Sensing:
    """An organ that senses a signal that comes block by block.

    A recursion z' = decay z + drive u a lag, run as one matrix product a few ticks;
    scipy.signal.lfilter does the same and takes two seconds to import.
    """

    def __init__(self, organ: Organ, dt: float) -> None:
        """Begin in the steady state of the first value to come; ticks are `dt` (s) apart."""
        self._decay, drive, self._steady, direct = organ.discrete(dt)
        gains = np.array([gain for gain, _ in organ.lags])
        powers = self._decay ** np.arange(_TICKS)[:, None]  # (ticks, lags)
        kernel = np.concatenate([[direct], (powers * drive) @ gains])[:_TICKS]
        steps = np.subtract.outer(np.arange(_TICKS), np.arange(_TICKS))
        self._impulses = np.where(steps > 0, 0.0, kernel[-steps])  # (from, to) tick
        self._readout = (powers * gains).T
        # of the inputs in the lags' states behind the last of them
        self._weights = powers[::-1] * drive
        self._state: Array | None = None

    def sense(self, signal: Array) -> Array:
        """The sensed signal (n,) for the next values (n,)."""
        if not len(signal):
            return np.empty(0)
        state = self._steady * signal[0] if self._state is None else self._state
        rest = len(signal) % _TICKS
        padded = np.pad(signal, (0, _TICKS - rest), mode="edge") if rest else signal
        rows = np.ascontiguousarray(padded).reshape(-1, _TICKS)
        states = _carried(rows @ self._weights, self._decay**_TICKS, state)
        if rest:  # of the last row
            self._state = states[-2] * self._decay**rest + rows[-1, :rest] @ self._weights[-rest:]
        else:
            self._state = states[-1]
        sensed: Array = rows @ self._impulses
        sensed += states[:-1] @ self._readout
        return sensed.ravel()[: len(signal)]


def _carried(ends: Array, decay: Array, start: Array) -> Array:
    """States (rows + 1, lags) before each row and behind the last.

    ends: what each row adds to the states at its end (rows, lags); decay: factor of each lag in a
    row (lags,); start: states before the first row (lags,).
    """
    columns = [
        carried(first, factor, added)
        for first, factor, added in zip(
            start.tolist(), decay.tolist(), ends.T.tolist(), strict=True
        )
    ]
    return np.array(columns).T


def _canals(short: float, long: float) -> Organ:
    """The organ short long s^2 / ((short s + 1)(long s + 1))."""
    return Organ(1.0, ((long / (short - long), short), (short / (long - short), long)))


def _otoliths(gain: float, lead: float, long: float, short: float) -> Organ:
    """The organ gain (lead s + 1) / ((long s + 1)(short s + 1))."""
    return Organ(
        0.0,
        (
            (gain * (long - lead) / (long - short), long),
            (gain * (short - lead) / (short - long), short),
        ),
    )


CANALS = _canals(5.73, 80.0)
"""Semicircular canals: angular rate, rad/s to rad/s."""

OTOLITHS = _otoliths(0.4, 10.0, 5.0, 0.016)
"""Otoliths: specific force, m/s^2 to m/s^2."""
