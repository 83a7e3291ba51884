"""The motion of one axis between two set points."""

from ...rotation import Vec3
from ..control.certified_axis import AxisLimits


class Bridge:
    """A motion that meets a state at both ends, in position, speed and acceleration.

    Two extreme motions lead from (v0, a0) to (v1, a1) in h s: the upper with jerk J but -J on a
    window, the lower the reverse. With D = a1 - a0 and m = h (a0 + a1) / 2 - (v1 - v0), the windows
    are (h -+ D / J) / 2 long and off the middle by -+m / (J (h -+ D / J)). Any position between
    their ends is met by a blend of the two, whose jerk is no larger.
    """

    def __init__(self, limits: AxisLimits, h: float, start: Vec3, end: Vec3) -> None:
        """Lead from `start` to `end`, each (position, speed, acceleration), in h > 0 s.

        The end is reachable, as AxisLimits.place_checks tells.
        """
        (p0, v0, a0), (p1, v1, a1) = start, end
        jerk = limits.reach
        skew, m = (a1 - a0) / jerk, 0.5 * h * (a0 + a1) - (v1 - v0)
        self._start, self._jerk = start, jerk
        self._upper = _window(h, 0.5 * (h - skew), -m / jerk)
        self._lower = _window(h, 0.5 * (h + skew), m / jerk)
        low, high = limits.reachable(h, p0, v0, a0, v1, a1)
        share = (p1 - low) / (high - low) if high > low else 0.5
        self._share = min(max(share, 0.0), 1.0)

    def at(self, t: float) -> Vec3:
        """Return position, speed and acceleration t s after the start, 0 <= t <= h."""
        s, upper = self._share, _run(self._start, self._jerk, self._upper, t)
        lower = _run(self._start, -self._jerk, self._lower, t)
        return (
            s * upper[0] + (1.0 - s) * lower[0],
            s * upper[1] + (1.0 - s) * lower[1],
            s * upper[2] + (1.0 - s) * lower[2],
        )


def _window(h: float, length: float, moment: float) -> tuple[float, float]:
    """Return beginning and end of a window in h s; `moment` is twice its length by its offset."""
    length = min(max(length, 0.0), h)
    aside = 0.5 * (h - length)
    offset = 0.5 * moment / length if length > 1e-9 * h else 0.0
    begin = aside + min(max(offset, -aside), aside)
    return begin, begin + length


def _run(start: Vec3, jerk: float, window: tuple[float, float], t: float) -> Vec3:
    """Return the state t s after the start with `jerk`, and its opposite inside the window."""
    state = _coast(start, jerk, min(t, window[0]))
    if t > window[0]:
        state = _coast(state, -jerk, min(t, window[1]) - window[0])
    if t > window[1]:
        state = _coast(state, jerk, t - window[1])
    return state


def _coast(state: Vec3, jerk: float, t: float) -> Vec3:
    p, v, a = state
    return (
        p + t * (v + t * (0.5 * a + t * jerk / 6.0)),
        v + t * (a + 0.5 * t * jerk),
        a + t * jerk,
    )
