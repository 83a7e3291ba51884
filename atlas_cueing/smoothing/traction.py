"""Steps that keep traction and torque, with stops that keep them along their way.

Wheels and stage each want a step. If the rows of contacts and drives (`signals.ContactRows`) do not
hold, with a reserve, where it leads, the wheels take the nearest accelerations that keep them,

    min |x - w'|^2    subject to the rows, |x - w_0'| <= J h, |x| <= A

one constant jerk each. What is then wanted is flown only if the SOFT stop of all six axes from
where it leads keeps the rows in every tick until rest, and the stage's travel. Otherwise it is
mixed with the step into the soft stop, first that of the wheels alone, then all six; what is left
in the end is the soft stop certified a tick ago. Mixing keeps speed, acceleration and jerk, since
the steps of one tick that keep them are a convex set.

The rest of a soft stop is the soft stop of every state on it, so what is kept once is kept for
ever, for any cue, as long as nothing else moves the platform.
"""

# mypyc: runs every tick

from typing import Final

from ..rotation import Quat, Vec3, apply, integrate_base, normalise
from ..signals import ContactRows
from .axis import Step
from .sphere import SphereSmoothing
from .stage import StageSmoothing
from .stop import Stop

_SPARE: Final = 0.02  # of a row, left by the projection for the step's own turn (assumed)
_EVALUATIONS: Final = 200  # of exact rows for one tick's certificates (assumed)
_BISECTIONS: Final = 6  # of the share of the wanted step (assumed)
_SWEEPS: Final = 40  # of the dual ascent (assumed)
_BETWEEN: Final = 5  # ticks of a stop between two tests for any orientation (assumed)

Steps = tuple[Step, Step, Step]


class KeptTraction:
    """Chooses the steps that are flown, tick by tick."""

    def __init__(
        self, dt: float, rows: ContactRows, sphere: SphereSmoothing, stage: StageSmoothing
    ) -> None:
        """Choose for sphere and stage, whose axes have soft stops; dt in s."""
        self._dt, self._rows, self._sphere, self._stage = dt, rows, sphere, stage
        self._left = 0

    def choose(self, turns: Steps, moves: Steps) -> tuple[Steps, Steps]:
        """Give the steps to fly instead of these of wheels and stage; the same if they are fit."""
        self._left = _EVALUATIONS
        turns = self._projected(turns, moves)
        if self._is_certified(turns, moves):
            return turns, moves
        still_turns, still_moves = self._sphere.stopping(), self._stopping()
        if self._is_certified(still_turns, moves):
            low, best = 0.0, (still_turns, moves)
            for k in range(_BISECTIONS):
                share = low + 0.5 ** (k + 1)
                mixed = (_mixed(share, still_turns, turns), moves)
                if self._is_certified(*mixed):
                    low, best = share, mixed
            return best
        low, best = 0.0, (still_turns, still_moves)
        for k in range(_BISECTIONS):
            share = low + 0.5 ** (k + 1)
            mixed = (_mixed(share, still_turns, turns), _mixed(share, still_moves, moves))
            if self._is_certified(*mixed):
                low, best = share, mixed
        return best

    def _stopping(self) -> Steps:
        x, y, z = self._stage.axes
        return (x.stopping(), y.stopping(), z.stopping())

    def _projected(self, turns: Steps, moves: Steps) -> Steps:
        """Give the nearest steps of the wheels that keep the rows where they lead."""
        q, _ = self._led(turns)
        speed, x, a = _speeds(turns), _accelerations(turns), _accelerations(moves)
        if self._rows.excess(q, speed, x, a) <= -_SPARE:
            return turns
        rows = self._rows.rows(q, speed, a)
        v0, a0 = self._sphere.wheel_motion[1], self._sphere.wheel_motion[2]
        one, two, three = self._sphere.axes
        ranges = (
            one.range_at(a0[0], v0[0]),
            two.range_at(a0[1], v0[1]),
            three.range_at(a0[2], v0[2]),
        )
        x = nearest(x, rows, _SPARE, ranges)
        h = self._dt
        return (
            _even(h, v0[0], a0[0], x[0]),
            _even(h, v0[1], a0[1], x[1]),
            _even(h, v0[2], a0[2], x[2]),
        )

    def _led(self, turns: Steps) -> tuple[Quat, Vec3]:
        """Give orientation and rate where the wheels' steps lead, as the sphere integrates them."""
        J = self._rows.sphere_from_wheels
        x, y, z = turns
        turn = apply(J, (x.displacement, y.displacement, z.displacement))
        w = apply(J, (x.v, y.v, z.v))
        sphere = self._sphere
        return normalise(integrate_base(sphere.q_WS, turn, sphere.w_WS_W, w, self._dt)), w

    def _is_certified(self, turns: Steps, moves: Steps) -> bool:
        """Whether these steps and the soft stop after them keep rows and travel."""
        x, y, z = self._stage.axes
        one, two, three = self._sphere.axes
        if not (x.is_certified(moves[0]) and y.is_certified(moves[1]) and z.is_certified(moves[2])):
            return False
        q, w = self._led(turns)
        self._left -= 1
        if self._left < 0 or not (
            self._rows.excess(q, _speeds(turns), _accelerations(turns), _accelerations(moves))
            <= 0.0
        ):
            return False
        stops = (
            one.stop(turns[0].v, turns[0].a),
            two.stop(turns[1].v, turns[1].a),
            three.stop(turns[2].v, turns[2].a),
            x.stop(moves[0]),
            y.stop(moves[1]),
            z.stop(moves[2]),
        )
        return self._keeps(stops, q, w)

    def _keeps(self, stops: tuple[Stop, Stop, Stop, Stop, Stop, Stop], q: Quat, w: Vec3) -> bool:
        """Whether a soft stop that begins at q, turning with w (rad/s), keeps the rows."""
        h, J = self._dt, self._rows.sphere_from_wheels
        end = max([stop.duration for stop in stops])
        p0 = p1 = p2 = 0.0
        ticks = 0
        while True:
            if ticks % _BETWEEN == 0 and self._is_safe_anyway(stops, ticks * h):
                return True
            ticks += 1
            self._left -= 1
            if self._left < 0:
                return False
            t = ticks * h
            s0, s1, s2 = stops[0].at(t), stops[1].at(t), stops[2].at(t)
            turn = apply(J, (s0[0] - p0, s1[0] - p1, s2[0] - p2))
            p0, p1, p2 = s0[0], s1[0], s2[0]
            before, w = w, apply(J, (s0[1], s1[1], s2[1]))
            q = normalise(integrate_base(q, turn, before, w, h))
            a = (stops[3].at(t)[2], stops[4].at(t)[2], stops[5].at(t)[2])
            speed, acceleration = (s0[1], s1[1], s2[1]), (s0[2], s1[2], s2[2])
            if not self._rows.excess(q, speed, acceleration, a) <= 0.0:
                return False
            if t >= end:
                return True

    def _is_safe_anyway(self, stops: tuple[Stop, Stop, Stop, Stop, Stop, Stop], t: float) -> bool:
        """Whether the rest of a stop, from time t (s) on, keeps the rows in any orientation."""
        l0, h0, v0 = stops[0].bounds_from(t)
        l1, h1, v1 = stops[1].bounds_from(t)
        l2, h2, v2 = stops[2].bounds_from(t)
        l3, h3, _ = stops[3].bounds_from(t)
        l4, h4, _ = stops[4].bounds_from(t)
        l5, h5, _ = stops[5].bounds_from(t)
        return (
            self._rows.largest_excess(
                (l0, l1, l2), (h0, h1, h2), (v0, v1, v2), (l3, l4, l5), (h3, h4, h5)
            )
            <= 0.0
        )


def nearest(
    wanted: Vec3,
    rows: list[tuple[Vec3, float]],
    spare: float,
    ranges: tuple[tuple[float, float], tuple[float, float], tuple[float, float]],
) -> Vec3:
    """Give the x nearest to `wanted` with row . x <= bound - spare, inside the ranges.

    By dual ascent (C. Hildreth, Naval Research Logistics Quarterly 4, 1957): each row in turn has
    its multiplier, at least zero, moved to where the row holds. If rows cannot all hold, it is
    inside the ranges.
    """
    x, y, z = wanted
    sides = [
        *((row, bound - spare) for row, bound in rows),
        ((1.0, 0.0, 0.0), ranges[0][1]), ((-1.0, 0.0, 0.0), -ranges[0][0]),
        ((0.0, 1.0, 0.0), ranges[1][1]), ((0.0, -1.0, 0.0), -ranges[1][0]),
        ((0.0, 0.0, 1.0), ranges[2][1]), ((0.0, 0.0, -1.0), -ranges[2][0]),
    ]  # fmt: skip
    squares = [max(a * a + b * b + c * c, 1e-300) for (a, b, c), _ in sides]
    multipliers = [0.0] * len(sides)
    for _ in range(_SWEEPS):
        moved = 0.0
        for k, ((a, b, c), bound) in enumerate(sides):
            change = max((a * x + b * y + c * z - bound) / squares[k], -multipliers[k])
            if change != 0.0:
                multipliers[k] += change
                x, y, z = x - change * a, y - change * b, z - change * c
                moved = max(moved, change * change * squares[k])
        if moved < 1e-16:
            break
    return (_within(x, ranges[0]), _within(y, ranges[1]), _within(z, ranges[2]))


def _within(x: float, bounds: tuple[float, float]) -> float:
    return min(max(x, bounds[0]), bounds[1])


def _even(h: float, v: float, a: float, a1: float) -> Step:
    """Give the step of one constant jerk from (v, a) to the acceleration a1."""
    return Step(h * (v + h * (2.0 * a + a1) / 6.0), v + 0.5 * h * (a + a1), a1, False)


def _mixed(share: float, still: Steps, wanted: Steps) -> Steps:
    return (
        _mix(share, still[0], wanted[0]),
        _mix(share, still[1], wanted[1]),
        _mix(share, still[2], wanted[2]),
    )


def _mix(share: float, still: Step, wanted: Step) -> Step:
    keep = 1.0 - share
    return Step(
        keep * still.displacement + share * wanted.displacement,
        keep * still.v + share * wanted.v,
        keep * still.a + share * wanted.a,
        False,
    )


def _speeds(steps: Steps) -> Vec3:
    return (steps[0].v, steps[1].v, steps[2].v)


def _accelerations(steps: Steps) -> Vec3:
    return (steps[0].a, steps[1].a, steps[2].a)
