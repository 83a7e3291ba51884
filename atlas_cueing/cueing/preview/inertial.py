"""The flight seen from A: axes that do not turn, the cabin's own as the flight begins.

If the cabin turned with the vehicle's body rates and nothing else, it would stand in A as `q_AS`
says. What a method adds is a turn of A against W, at the rate it adds; so in A the vehicle's
turning drops out of the problem.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...errors import InputError
from ...rotation import IDENTITY, Quat, Vec3, add, flip, integrate_body, normalise, scale
from ...rotations import Array, rotate
from ...signals import VehicleState

# m/s^2 and rad/s; nothing that flies has more, and the arithmetic stays far from overflow
_ABSURD = 1e6


@dataclass(frozen=True, slots=True)
class Inertial:
    """The vehicle at each tick, in A.

    time (n,), s; orientation q_AS (n, 4); body rates w_A (n, 3), rad/s; specific force f_A (n, 3),
    m/s^2.
    """

    time: Array
    q_AS: Array
    w_A: Array
    f_A: Array


def inertial(states: Sequence[VehicleState], dt: float) -> Inertial:
    """Integrate the body rates by the trapezoid, as `Cabin` does tick by tick; dt in s.

    Raises InputError for forces or rates that no vehicle has.
    """
    for state in states:
        if not all(abs(x) <= _ABSURD for x in (*state.f_B, *state.w_NB_B)):
            raise InputError(
                f"method 'preview' finds no plan for this flight: at {state.time:g} s force"
                f" {state.f_B} m/s^2 and rates {state.w_NB_B} rad/s, allowed: magnitudes up to"
                f" {_ABSURD:g}"
            )
    w_S = [flip(state.w_NB_B) for state in states]
    q_AS = np.array(integrate_rates(IDENTITY, w_S, dt))
    return Inertial(
        time=np.array([state.time for state in states]),
        q_AS=q_AS,
        w_A=rotate(q_AS, np.array(w_S)),
        f_A=rotate(q_AS, np.array([flip(state.f_B) for state in states])),
    )


def integrate_rates(q: Quat, rates: Sequence[Vec3], dt: float) -> list[Quat]:
    """Integrate orientations, one for each tick.

    q: the first one; rates: at each tick, rad/s, in axes that turn along; dt in s.
    """
    orientations = [q]
    for before, now in pairwise(rates):
        turn = scale(0.5 * dt, add(before, now))
        orientations.append(normalise(integrate_body(orientations[-1], turn, before, now, dt)))
    return orientations
