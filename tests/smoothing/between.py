"""What happens between two ticks: some motion inside the limits leads from one to the next.

This file works it out for itself, from the ends of the step alone.
"""

from collections.abc import Iterator
from itertools import product
from math import sqrt

import numpy as np

from atlas_cueing.rotations import Array
from atlas_cueing.smoothing import AxisSmoothing, Stop
from atlas_cueing.smoothing.axis import Step

SUBSTEPS = 10
_TRIPLES = [(i, j, k) for i, j, k in product((-1.0, 0.0, 1.0), repeat=3) if i != j != k]
_ROUNDING = 1e-6  # of a tick, that a phase may be too long

Phases = tuple[tuple[float, float, float], float, float]
"""Jerks of three phases, and what is left of the tick when the first and the second end."""


class Between:
    """Finds (displacement, v, a) at ten points of each step of an axis, in rows.

    kinds: how many steps were two halves of constant jerk, phases as ruckig plans them (full jerk
    or none), and the certified stop.
    """

    def __init__(self, axis: AxisSmoothing) -> None:
        self.axis, self.times = axis, np.linspace(0.0, axis.dt, SUBSTEPS + 1)
        self.kinds = {"halves": 0, "ruckig": 0, "stop": 0}

    def path(self, v: float, a: float, step: Step) -> Array:
        """The path of a step from (v, a) that ends nearest to it; there has to be one."""
        for ways in (self._simple(v, a, step), self._planned(v, a, step)):
            found = [(self._off(path, step), kind, path) for kind, path in ways]
            off, kind, path = min(found, key=lambda each: each[0], default=(np.inf, "", None))
            if off <= 1.0:
                self.kinds[kind] += 1
                return path
        raise AssertionError(f"no motion inside the limits from {(v, a)} to {step}")

    def _simple(self, v: float, a: float, step: Step) -> Iterator[tuple[str, Array]]:
        dt = self.axis.dt
        gained, missing = (step.a - a) / dt, 4.0 * (step.v - v - a * dt) / dt**2
        jerks = (missing - gained, 3.0 * gained - missing, 0.0)
        halves = self._flown(v, a, (jerks, 0.5 * dt, 0.0))
        if self._admissible(halves):
            yield "halves", halves
        stop = Stop.plan(v, a, self.axis.acceleration, self.axis.jerk)
        yield "stop", np.array([stop.at(t) for t in self.times])

    def _planned(self, v: float, a: float, step: Step) -> Iterator[tuple[str, Array]]:
        for phases in (*self._three_phases(v, a, step), *self._two_phases(v, a, step)):
            path = self._flown(v, a, phases)
            if self._admissible(path):
                yield "ruckig", path

    def _three_phases(self, v: float, a: float, step: Step) -> Iterator[Phases]:
        """Full jerk or none in each of three phases.

        With A and B the changes of jerk, s and t what is left of the tick h when they come, D and V
        what acceleration and speed gain, but for a h, all over the full jerk:

            D = j1 h + A s + B t        2 V = j1 h^2 + A s^2 + B t^2
        """
        h, full = self.axis.dt, self.axis.jerk
        D, V = (step.a - a) / full, (step.v - v - a * h) / full
        for j1, j2, j3 in _TRIPLES:
            A, B = j2 - j1, j3 - j2
            d, w = D - j1 * h, 2.0 * V - j1 * h * h
            # B w = A B s^2 + (d - A s)^2
            for s in _roots(A * B + A * A, -A * d, d * d - B * w):
                t = (d - A * s) / B
                if -_ROUNDING * h <= t <= s + _ROUNDING * h <= h * (1.0 + 2.0 * _ROUNDING):
                    yield (full * j1, full * j2, full * j3), s, max(t, 0.0)

    def _two_phases(self, v: float, a: float, step: Step) -> Iterator[Phases]:
        """Less than the full jerk: j and then -j, j and then none, or none and then j.

        With s what is left of the tick h at the change, D and V what acceleration and speed gain,
        but for a h:

            D = j (h - 2 s), 2 V = j (h^2 - 2 s^2)    D = j (h - s), 2 V = j (h^2 - s^2)
            D = j s, 2 V = j s^2
        """
        h = self.axis.dt
        D, V = step.a - a, step.v - v - a * h
        ways = [(1.0, -1.0, s) for s in _roots(D, -V, V * h - 0.5 * D * h * h)]
        if abs(V) < h * abs(D):
            ways += [(1.0, 0.0, 2.0 * V / D - h), (0.0, 1.0, 2.0 * V / D)]
        for first, last, s in ways:
            share = first * (h - s) + last * s
            if 0.0 <= s <= h and abs(share) > _ROUNDING * h:
                jerk = D / share
                yield (jerk * first, jerk * last, 0.0), s, 0.0

    def _flown(self, v: float, a: float, phases: Phases) -> Array:
        """Path of three phases of constant jerk from (v, a)."""
        (j1, j2, j3), s, t = phases
        h, now = self.axis.dt, self.times
        path = coast(0.0, v, a, j1, np.minimum(now, h - s))
        path = coast(*path, j2, np.clip(now - (h - s), 0.0, max(s - t, 0.0)))
        return np.stack(coast(*path, j3, np.maximum(now - (h - t), 0.0)), axis=1)

    def _admissible(self, path: Array) -> bool:
        """Whether jerk and acceleration stay inside their limits, but for rounding."""
        a, axis = path[:, 2], self.axis
        return bool(
            np.max(np.abs(a)) <= axis.acceleration * (1.0 + 1e-10)
            and np.max(np.abs(np.diff(a))) <= axis.jerk * axis.dt / SUBSTEPS * (1.0 + 1e-8)
        )

    def _off(self, path: Array, step: Step) -> float:
        """How far the path ends from where the step does.

        1 is a millionth of what the jerk could do, and rounding.
        """
        dt, jerk = self.axis.dt, self.axis.jerk
        near = (
            1e-6 * jerk * dt**3 + 1e-13,
            1e-6 * jerk * dt**2 + 1e-12,
            1e-9 * self.axis.acceleration,
        )
        return float(np.max(np.abs(path[-1] - (step.displacement, step.v, step.a)) / near))


def _roots(a: float, b: float, c: float) -> tuple[float, ...]:
    """The real roots of a x^2 + 2 b x + c, one as exact as the other; a double one but for
    rounding, too.
    """
    square = b * b - a * c
    if square < -1e-9 * (b * b + abs(a * c)):
        return ()
    q = -(b + np.copysign(sqrt(max(square, 0.0)), b))
    return (*([q / a] if abs(q) < 1e9 * abs(a) else []), *([c / q] if q else []))


def coast(
    p: float | Array, v: float | Array, a: float | Array, j: float, t: Array
) -> tuple[Array, Array, Array]:
    return p + v * t + a * t**2 / 2.0 + j * t**3 / 6.0, v + a * t + j * t**2 / 2.0, a + j * t
