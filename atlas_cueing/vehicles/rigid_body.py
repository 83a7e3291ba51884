"""A free rigid body that tumbles, with a rider in it: a satellite, a cabin in free fall.

The specific force at a seat r from the centre of gravity is what turning asks for,

    f_B = w' x r + w x (w x r)                     in free fall
    f_B = w' x r + w x (w x r) - R_BN (0, 0, g)    held up at the centre of gravity

and the rates are exact (`euler_top`).
"""

from dataclasses import dataclass
from math import inf
from typing import ClassVar

from ..errors import InputError, VehicleError
from ..rotation import IDENTITY, ZERO, Quat, Vec3, add, cross, scale, up_in_body
from ..signals import STANDARD_GRAVITY, VehicleState
from .bounds import Bounds
from .euler_top import EulerTop, rate_of_change
from .flight import Flight
from .jsbsim.flights import DEFAULT_RATE_HZ


@dataclass(frozen=True, slots=True)
class RigidBodyFlight(Flight):
    """A tumble to fly.

    inertia: principal moments, kg m^2, about the forward, right and down axes.
    w_B: body rates at the start, rad/s. q_NB: attitude at the start.
    seat: of the rider's head from the centre of gravity, m, forward, right, down.
    free_fall: whether nothing holds the body up.
    rate_hz: states a second.
    """

    live_only: ClassVar[str] = ""
    ends_itself: ClassVar[bool] = False

    inertia: Vec3
    w_B: Vec3
    q_NB: Quat = IDENTITY
    seat: Vec3 = ZERO
    free_fall: bool = True
    rate_hz: float = DEFAULT_RATE_HZ

    @property
    def name(self) -> str:
        """Return the word for all of them."""
        return "rigid_body"

    def vehicle(self) -> "RigidBodyVehicle":
        """Build the body. Raises InputError for moments that no body has."""
        return RigidBodyVehicle(self)

    def length(self) -> float | None:
        """Return nothing: it tumbles for ever."""
        return None

    def step(self) -> float:
        """Return the time between two states, s."""
        return 1.0 / self.rate_hz

    def objection(self) -> str:
        """Say why there is no such body; empty when there is."""
        a, b, c = sorted(self.inertia)
        if not 0.0 < a <= b <= c < inf:
            return f"moments {a:g}, {b:g}, {c:g} kg m^2, allowed: positive"
        if c > (a + b) * (1.0 + 1e-9):  # a plate has c = a + b
            return (
                f"the largest moment is {c:g} kg m^2, allowed: at most {a + b:g}, the sum of the"
                " others, as of every body"
            )
        return ""


class RigidBodyVehicle:
    """The body on its way (implements signals.Vehicle).

    Building it raises InputError for moments that no body has, and VehicleError for rates or forces
    that no rider bears.
    """

    def __init__(self, flight: RigidBodyFlight, bounds: Bounds | None = None) -> None:
        objection = flight.objection()
        if objection:
            raise InputError(f"rigid body: {objection}")
        self._flight = flight
        self._bounds = Bounds() if bounds is None else bounds
        self._top = EulerTop(flight.inertia, flight.w_B, flight.q_NB)
        self._step = 0
        self._state = self._at(0)

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._flight.step()

    @property
    def state(self) -> VehicleState:
        """The present state."""
        return self._state

    def advance(self) -> bool:
        """Go one step on, for ever. Raises VehicleError when a state is not believable."""
        self._state = self._at(self._step + 1)
        self._step += 1
        return True

    def _at(self, step: int) -> VehicleState:
        time = step / self._flight.rate_hz
        w_B, q_NB = self._top.rates(time), self._top.attitude(time)
        r = self._flight.seat
        turning = add(
            cross(rate_of_change(self._flight.inertia, w_B), r), cross(w_B, cross(w_B, r))
        )
        held = ZERO if self._flight.free_fall else scale(-STANDARD_GRAVITY, up_in_body(q_NB))
        state = VehicleState(time, q_NB, w_B, add(turning, held))
        objection = self._bounds.objection(state, height=0.0)
        if objection:
            raise VehicleError(time, objection)
        return state
