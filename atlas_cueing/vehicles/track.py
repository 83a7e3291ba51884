"""A rider on a track of points, such as a roller coaster."""

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from ..errors import InputError, VehicleError
from ..rotation import Vec3
from ..rotations import length
from ..signals import VehicleState
from .bounds import Bounds
from .flight import Flight
from .jsbsim.flights import DEFAULT_RATE_HZ
from .track_car import PER_POINT, Car

if TYPE_CHECKING:
    from .track_ride import Ride

FEWEST_POINTS = 6  # that a quintic curve goes through
MOST_STEPS = 400_000  # of the whole ride
MOST_STATES = 1_000_000
_APART = 1e-3  # m; points nearer than this are one


@dataclass(frozen=True, slots=True)
class TrackFlight(Flight):
    """A track to ride.

    points: m, x forward, y left, z up. bank: of each, rad, right side down; None for the one that
        leaves no side force.
    closed: whether the last point leads back to the first; laps: how often.
    """

    live_only: ClassVar[str] = ""
    ends_itself: ClassVar[bool] = True

    points: tuple[Vec3, ...]
    car: Car
    bank: tuple[float, ...] | None = None
    closed: bool = False
    laps: int = 1
    rate_hz: float = DEFAULT_RATE_HZ

    @property
    def name(self) -> str:
        """Return the word for all of them."""
        return "track"

    def vehicle(self) -> "TrackVehicle":
        """Build the car. Raises InputError for what is no track, VehicleError for one at rest."""
        return TrackVehicle(self)

    def length(self) -> float:
        """Return the time of the whole ride, s. Raises as `vehicle`."""
        return float(whole_ride(self).time[-1])

    def step(self) -> float:
        """Return the time between two states, s."""
        return 1.0 / self.rate_hz

    def objection(self) -> str:
        """Say why nobody can ride it; empty when one can."""
        count = len(self.points)
        if count < FEWEST_POINTS:
            return f"{count} points, allowed: at least {FEWEST_POINTS}"
        if self.bank is not None and len(self.bank) != count:
            return f"{len(self.bank)} banks for {count} points, allowed: one for each"
        steps = count * PER_POINT * (self.laps if self.closed else 1)
        if steps > MOST_STEPS:
            return f"{steps // PER_POINT} points in all laps, allowed: {MOST_STEPS // PER_POINT}"
        points = np.array(self.points)
        ahead = np.concatenate([points[1:], points[:1]]) if self.closed else points[1:]
        gaps = length(ahead - points[: len(ahead)])
        if float(gaps.min()) < _APART:
            k = int(np.argmin(gaps))
            return f"points {k} and {(k + 1) % count} are the same, allowed: {_APART:g} m apart"
        return ""


class TrackVehicle:
    """The car on its way (implements signals.Vehicle); its ride is known when it is built."""

    def __init__(self, flight: TrackFlight, bounds: Bounds | None = None) -> None:
        self._ride = whole_ride(flight)
        self._bounds = Bounds() if bounds is None else bounds
        self._dt = flight.step()
        self._step = 0
        self._state = self._at(0)

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._dt

    @property
    def state(self) -> VehicleState:
        """The present state."""
        return self._state

    def advance(self) -> bool:
        """Go one step on; False at the end of the track.

        Raises VehicleError where the car comes to a stop, and for a state that is not believable.
        """
        if self._step + 1 == len(self._ride.time):
            if self._ride.stopped:
                raise VehicleError(
                    float(self._ride.time[-1]),
                    f"the car comes to a stop {self._ride.distance[-1]:.1f} m along the track; give"
                    " it more speed_m_s, a lift_speed_m_s or a lower hill",
                )
            return False
        self._state = self._at(self._step + 1)
        self._step += 1
        return True

    def _at(self, step: int) -> VehicleState:
        here = self._ride
        (a, b, c, d), (p, q, r) = here.q_NB[step].tolist(), here.w_B[step].tolist()
        x, y, z = here.f_B[step].tolist()
        state = VehicleState(float(here.time[step]), (a, b, c, d), (p, q, r), (x, y, z))
        objection = self._bounds.objection(state, height=0.0)
        if objection:
            raise VehicleError(state.time, objection)
        return state


@lru_cache(maxsize=4)  # asked for its length, and then flown
def whole_ride(flight: TrackFlight) -> "Ride":
    """Return the ride from the first point to the end.

    Raises InputError for what is no track, and VehicleError for a car that does not leave.
    """
    from .track_ride import ride  # loads scipy, for seconds

    objection = flight.objection()
    if objection:
        raise InputError(f"track: {objection}")
    points = np.array(flight.points) * np.array([1.0, -1.0, -1.0])
    bank = None if flight.bank is None else np.array(flight.bank)
    return ride(points, bank, flight.closed, flight.laps, flight.car, flight.rate_hz)
