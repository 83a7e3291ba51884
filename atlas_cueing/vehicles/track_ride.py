"""A car on a track: where it is, how fast, and what its rider feels.

With the track's tangent t, curvature vector k = dt/ds and gravity g, a car of speed v has

    a = a_t t + v^2 k,     f = a - g,     a_t = t.g - m |f_n| - c v^2

with the force across the track f_n = v^2 k - (g - t (t.g)), rolling friction m and air drag c, 1/m.
Its speed comes from its energy per mass e = v^2 / 2 + g h, of which friction takes

    de/ds = -(m |f_n| + c v^2)

and to which a lift adds where the car would be slower than the lift's chain; there a_t = 0.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline, make_interp_spline

from ..errors import VehicleError
from ..rotations import Array, cross, length, multiply, rotate_back
from ..signals import STANDARD_GRAVITY
from .track_attitude import attitude_along
from .track_car import PER_POINT, Car
from .track_curve import Way, bank_along, spline_through, way_at

_SLOWEST = 0.05  # m/s; a car that slow has come to a stop
_GRAVITY = np.array([0.0, 0.0, STANDARD_GRAVITY])  # N
_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])
_FEWEST = 8  # steps that the car has to come
_HALF = 0.5


@dataclass(frozen=True, slots=True)
class Ride:
    """A whole ride at even times (n,), s: q_NB (n, 4), rates and forces (n, 3), FRD at the head.

    distance, speed: (n,) m from point to point, m/s. stopped: whether the car came to a stop.
    """

    time: Array
    q_NB: Array
    w_B: Array
    f_B: Array
    distance: Array
    speed: Array
    stopped: bool


def ride(
    points: Array, bank: Array | None, closed: bool, laps: int, car: Car, rate_hz: float
) -> Ride:
    """Ride a track of points (n, 3), m, frame N, from the first one on.

    bank: (n,) rad, right side down; None for the one without side force. closed: whether the last
    point leads to the first. laps: of a closed track.
    """
    around = laps if closed else 1
    count = PER_POINT * len(points) * around
    curve, per_lap = spline_through(points, closed)
    halves = way_at(curve, np.linspace(0.0, around * per_lap, 2 * count + 1))
    speed, on_lift = _speeds(halves, car)
    if len(speed) < _FEWEST:
        raise VehicleError(0.0, "the car does not leave the first points of the track")
    way = halves.every(2, len(speed))
    given = None if bank is None else bank_along(way.u, points, bank, closed)
    attitude = attitude_along(way, _across(way, speed), given)
    moments = _moments(way, speed)
    time = np.arange(int(moments[-1] * rate_hz + 1e-9) + 1) / rate_hz
    place = make_interp_spline(moments, way.u, k=3)(time)
    lifted = np.interp(place, way.u, on_lift) > _HALF
    here = way_at(curve, place)
    v = _speed_at(way, here, speed, car)
    return _felt(here, attitude, v, time, lifted, car, len(speed) < count + 1)


def _speeds(way: Way, car: Car) -> tuple[Array, Array]:
    """Return speed and whether the lift pulls, at every other step of the way; shorter by a stop.

    The energy by Runge & Kutta's rule of fourth order, whose middle steps are those between.
    """
    sideways = (_GRAVITY - way.tangent * (way.tangent @ _GRAVITY)[:, None]).tolist()
    bends, heights, stretches = way.curvature.tolist(), way.height.tolist(), way.stretch.tolist()
    least = 0.5 * car.lift_speed**2

    def loss(k: int, e: float) -> float:
        """de/du at step k."""
        square = 2.0 * max(e - STANDARD_GRAVITY * heights[k], 0.0)
        x, y, z = (square * b - g for b, g in zip(bends[k], sideways[k], strict=True))
        across = sqrt(x * x + y * y + z * z)
        lost: float = (car.friction * across + car.drag * square) * stretches[k]
        return -lost

    energy = 0.5 * car.speed**2 + STANDARD_GRAVITY * heights[0]
    speeds, lifted = [], []
    for k in range(0, len(heights), 2):
        if k and (car.friction or car.drag):
            h = way.u[k] - way.u[k - 2]
            one = loss(k - 2, energy)
            two = loss(k - 1, energy + 0.5 * h * one)
            three = loss(k - 1, energy + 0.5 * h * two)
            energy += h / 6.0 * (one + 2.0 * (two + three) + loss(k, energy + h * three))
        kinetic = energy - STANDARD_GRAVITY * heights[k]
        pulled = kinetic <= least
        if pulled:
            energy, kinetic = least + STANDARD_GRAVITY * heights[k], least
        if kinetic <= 0.5 * _SLOWEST**2:
            break
        speeds.append(sqrt(2.0 * kinetic))
        lifted.append(pulled)
    return np.array(speeds), np.array(lifted, dtype=np.float64)


def _across(way: Way, speed: Array) -> Array:
    """Return the force across the track f_n, (n, 3), m/s^2."""
    sideways = _GRAVITY - way.tangent * (way.tangent @ _GRAVITY)[:, None]
    force: Array = way.curvature * (speed**2)[:, None] - sideways
    return force


def _moments(way: Way, speed: Array) -> Array:
    """Return the time at each step, s: the integral of |dr/du| / v."""
    slowness = make_interp_spline(way.u, way.stretch / speed, k=3)
    moments: Array = slowness.antiderivative()(way.u) - slowness.antiderivative()(way.u[0])
    return moments


def _speed_at(way: Way, here: Way, speed: Array, car: Car) -> Array:
    """Return the speeds at places between: exactly, where nothing but gravity does work."""
    if car.friction or car.drag or car.lift_speed:
        between: Array = make_interp_spline(way.u, speed, k=3)(here.u)
        return between
    energy = 0.5 * car.speed**2 + STANDARD_GRAVITY * way.height[0]
    exactly: Array = np.sqrt(np.maximum(2.0 * (energy - STANDARD_GRAVITY * here.height), 0.0))
    return exactly


def _felt(
    here: Way,
    attitude: BSpline,
    v: Array,
    time: Array,
    lifted: NDArray[np.bool_],
    car: Car,
    stopped: bool,
) -> Ride:
    """Return the states at places (n,) of even times."""
    across = _across(here, v)
    downhill = here.tangent @ _GRAVITY
    braked = -car.friction * length(across) - car.drag * v**2
    along = np.where(lifted, -downhill, braked)  # f.t
    f_N = across + here.tangent * along[:, None]
    q_NB, w_B, alpha_B = _turning(here, attitude, v, along + downhill)
    r = np.broadcast_to(car.head, w_B.shape)
    f_B = rotate_back(q_NB, f_N) + cross(alpha_B, r) + cross(w_B, cross(w_B, r))
    return Ride(time, q_NB, w_B, f_B, here.u, v, stopped)


def _turning(here: Way, attitude: BSpline, v: Array, pushed: Array) -> tuple[Array, Array, Array]:
    """Return q_NB, w_B = 2 q* q' and w_B' = 2 q* q'' (their vectors), by u' = v / |dr/du|.

    pushed: a_t, (n,), m/s^2.
    """
    rate = v / here.stretch
    bend = np.einsum("ij,ij->i", here.first, here.second) / here.stretch
    rate_of_rate = (pushed - bend * rate**2) / here.stretch
    q, by_u, by_uu = (attitude(here.u, nu=order) for order in range(3))
    back = q * _CONJUGATE * (2.0 / length(q) ** 2)[:, None]
    w_B = multiply(back, by_u * rate[:, None])[:, 1:]
    second = by_uu * (rate**2)[:, None] + by_u * rate_of_rate[:, None]
    return q / length(q)[:, None], w_B, multiply(back, second)[:, 1:]
