"""The stop of a hold: as the guard's, but with a share of jerk and acceleration.

Each axis flies the shortest stop that a smaller jerk s J and acceleration s A allow
(`certified_axis`), from its present position, speed and acceleration; so what it flies keeps the
platform's own limits, whatever they are, and a rider feels s times the jerk of a fault's stop. The
share is the least of SHARES with which

- speed and travel keep their limits (with s = 1 they do, for that stop has been certified), and
- the axis does not turn round, if it can be helped by half of its jerk: an acceleration that brakes
  has to be brought to zero before the speed is, |v| >= a^2 / 2 s J.

Wheels stop together as far as their limits allow: those that could stop sooner take the share with
which they end with the last. With accelerations along the speeds the axis of rotation then stays
what it was.
"""

# mypyc: runs every tick

from collections.abc import Sequence
from math import isinf
from typing import Final

from ...rotation import Vec3
from .certified_axis import AxisLimits, CertifiedStop

# of jerk and acceleration; 0.4 stops 1.5 rad/s of the full-scale platform in 0.7 s (assumed)
SHARES: Final = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0 - 1e-7)
_GENTLE: Final = 0.5  # beyond this share only limits count, not which way it turns
_ROOM: Final = 1e-6  # of the travel, left to smoothing, which begins where it ends
_HALVINGS: Final = 20  # of the share with which a wheel ends with the last


class GentleStop:
    """Six axes, wheels 1 to 3 and stage x, y, z, on their way to rest, one step a tick."""

    def __init__(self, axes: Sequence[AxisLimits], states: Sequence[Vec3], dt: float) -> None:
        """Start from the states, each (position, speed, acceleration), with these limits.

        Tick dt in s.
        """
        self._axes, self._states, self._dt = axes, list(states), dt
        self._ticks, self._begun = 0, [0] * len(axes)  # tick at which each stop was planned
        self._soft = any(axis.soft for axis in axes)
        if self._soft:  # the one that keeps traction: the guard's, but for room for rounding
            self._stops = [
                axis.stop(p, v, a, SHARES[-1]) for axis, (p, v, a) in zip(axes, states, strict=True)
            ]
            return
        stops = [_softest(axis, state) for axis, state in zip(axes, states, strict=True)]
        last = max(stop.duration for _, stop in stops[:3])
        wheels = [
            _until(last, axis, state, share)
            for axis, state, (share, _) in zip(axes[:3], states[:3], stops[:3], strict=True)
        ]
        self._stops = [*wheels, *(stop for _, stop in stops[3:])]

    def next(self) -> list[Vec3]:
        """Return position, speed and acceleration of each axis one tick on."""
        self._ticks += 1
        self._states = [self._step(k) for k in range(len(self._stops))]
        return self._states

    @property
    def arrived(self) -> bool:
        """Whether it is at rest."""
        return all(
            (self._ticks - begun) * self._dt >= stop.duration
            for begun, stop in zip(self._begun, self._stops, strict=True)
        )

    def _step(self, k: int) -> Vec3:
        """Return the next state of one axis, from which the guard could stop it in its travel.

        An axis that brakes too hard for a soft jerk passes zero speed and comes back; on its way it
        may come to where only the stop that was certified a tick ago is left.
        """
        limits = self._axes[k]
        state = self._stops[k].at((self._ticks - self._begun[k]) * self._dt)
        if not self._soft and not _is_certified(limits, state):
            self._stops[k] = _stop(limits, self._states[k], SHARES[-1])
            self._begun[k] = self._ticks - 1
            state = self._stops[k].at(self._dt)
        return state


def _softest(limits: AxisLimits, state: Vec3) -> tuple[float, CertifiedStop]:
    """Return the least of SHARES that will do, and its stop; the last if none does."""
    for share in SHARES:
        stop = _stop(limits, state, share)
        if _keeps(limits, state, share, stop):
            break
    return share, stop


def _until(duration: float, limits: AxisLimits, state: Vec3, share: float) -> CertifiedStop:
    """Return the softest stop of a wheel that takes no longer than `duration` (s).

    share: with which it takes no longer, and keeps its limits.
    """
    if _turns(limits, state, share):
        return _stop(limits, state, share)  # it would only go further the other way
    least, most = 0.0, share
    for _ in range(_HALVINGS):
        middle = 0.5 * (least + most)
        stop = _stop(limits, state, middle)
        if stop.duration <= duration and _keeps(limits, state, middle, stop):
            most = middle
        else:
            least = middle
    return _stop(limits, state, most)


def _stop(limits: AxisLimits, state: Vec3, share: float) -> CertifiedStop:
    p, v, a = state
    return CertifiedStop(p, v, a, max(share * limits.acceleration, abs(a)), share * limits.jerk)


def _keeps(limits: AxisLimits, state: Vec3, share: float, stop: CertifiedStop) -> bool:
    """Whether a stop with this share keeps speed and travel, and does not turn round."""
    _, v, a = state
    reached = abs(v + 0.5 * a * abs(a) / (share * limits.jerk))  # where a has come to zero
    if reached > max(limits.speed, abs(v)):
        return False
    if max(abs(stop.end), abs(stop.turning_point)) > limits.travel * (1.0 - _ROOM):
        return False
    return not _turns(limits, state, share) or _turns(limits, state, _GENTLE)


def _is_certified(limits: AxisLimits, state: Vec3) -> bool:
    """Whether the guard's stop from a state stays inside the travel."""
    if isinf(limits.travel):
        return True
    stop = limits.stop(*state)
    return max(abs(stop.end), abs(stop.turning_point)) <= limits.travel * (1.0 - 0.5 * _ROOM)


def _turns(limits: AxisLimits, state: Vec3, share: float) -> bool:
    """Whether an acceleration that brakes turns the axis round before it can be brought to zero."""
    _, v, a = state
    return v * a < 0.0 and 0.5 * a * a > abs(v) * share * limits.jerk
