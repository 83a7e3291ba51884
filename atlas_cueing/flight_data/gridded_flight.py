"""Vehicle states on a grid, from series of force, rate and attitude.

Specific force at the pilot's eye, body FRD, from what the file has, in this order:

    f_s = a - R_BN (0, 0, g)          where gravity was taken out of the acceleration a
    f   = f_s - w' x r - w x (w x r)  the sensor lies at r from the eye (rigid body)
    f_B = f g0 / g                    at rest 9.80665 m/s^2 wherever it was recorded
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from ..errors import InputError
from ..rotations import Array, cross, length, multiply, rotate, rotate_back
from ..signals import STANDARD_GRAVITY
from ..vehicles import Bounds
from .axes import OF_WORLD, attitude, continuous, in_body, in_world
from .complementary_filter import filtered_attitude
from .flight_map import FlightMap, ForceTable, RateTable
from .grid import Grid, Resampled, resample
from .samples import Part
from .spline_fit import fit_curve
from .stamps import Series

Factors: TypeAlias = Mapping[Part, Array]  # of each column, to SI
_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])
MEASURED, FROM_ATTITUDE = "measured", "derivative of the attitude"
_LEAST_NORM = 0.5  # of a quaternion; a smaller one is none (assumed)


@dataclass(frozen=True, slots=True)
class GriddedFlight:
    """A flight on its grid.

    time: (n,) s from 0. q_NB: (n, 4). w_NB_B: (n, 3) rad/s. f_B: (n, 3) m/s^2 at the pilot's eye.
    begin: s since the file's first stamp. attitude, rate: where they are from, in words. exact:
    whether every number is a sample as it was, none resampled.
    """

    time: Array
    q_NB: Array
    w_NB_B: Array
    f_B: Array
    begin: float
    attitude: str
    rate: str
    exact: bool

    @property
    def step(self) -> float:
        """Time between two states, s."""
        return float(self.time[1])


def flight_on(
    grid: Grid,
    parts: Mapping[Part, Series],
    factors: Factors,
    flight_map: FlightMap,
    progress: Callable[[float], None],
) -> GriddedFlight:
    """Bring the parts of a file onto a grid that all of them cover.

    factors: of the columns of each part, to SI and rad. Raises InputError for what no vehicle does.
    """
    found = {part: resample(series, grid) for part, series in parts.items()}
    exact = all(resampled.exact for resampled in found.values())
    q_NB = _attitude(grid, parts, factors, flight_map) if "attitude" in parts else None
    w_B = _rates(grid, found, factors, flight_map, q_NB)
    f_B = _force(found["force"], factors["force"], flight_map, q_NB)
    told = MEASURED
    if q_NB is None:
        q_NB = filtered_attitude(w_B, f_B, grid.step, flight_map.filter.time_s, progress)
        told = f"complementary filter of {flight_map.filter.time_s:g} s, heading from 0"
    f_B = _at_eye(f_B, w_B, grid, flight_map) * (STANDARD_GRAVITY / flight_map.gravity.m_s2)
    time: Array = grid.step * np.arange(grid.count, dtype=np.float64)
    rate = MEASURED if "rate" in parts else FROM_ATTITUDE
    return GriddedFlight(time, q_NB, w_B, f_B, grid.start, told, rate, exact)


def check_believable(flight: GriddedFlight, path: str, place: Callable[[float], str]) -> None:
    """Raise InputError for the first state that no vehicle with people in it has.

    place: where in the file the time, s since its first stamp, is.
    """
    bounds = Bounds()
    force, rate = length(flight.f_B), length(flight.w_NB_B)
    for name, unit, values, most, table in (
        ("specific force", "m/s^2", force, bounds.force, "force"),
        ("angular rate", "rad/s", rate, bounds.rate, "rate"),
    ):
        wrong = np.flatnonzero(~(values <= most))
        if len(wrong):
            k = int(wrong[0])
            raise InputError(
                f"{path}: {place(flight.begin + float(flight.time[k]))}: {name} {values[k]:.4g}"
                f" {unit}, allowed: 0 <= value <= {most:.4g}; is {table}.unit of the map right?"
            )


def _attitude(
    grid: Grid, parts: Mapping[Part, Series], factors: Factors, flight_map: FlightMap
) -> Array:
    """Return q_NB on the grid: turned into our axes first, since angles wrap and signs flip."""
    assert flight_map.attitude is not None  # noqa: S101 - the part is there
    series = parts["attitude"]
    if flight_map.attitude.kind == "quaternion":
        _check_norms(series)
    q_NB = attitude(series.values, flight_map.attitude, factors["attitude"])
    turned = replace(series, values=q_NB)
    on_grid = resample(turned, grid).values
    return continuous(on_grid / length(on_grid)[:, None])


def _check_norms(series: Series) -> None:
    """Raise InputError for a quaternion that has no direction."""
    wrong = np.flatnonzero(~(length(series.values) > _LEAST_NORM))
    if len(wrong):
        k = int(wrong[0])
        raise InputError(
            f"{series.place(k)}: an attitude of norm {length(series.values[k : k + 1])[0]:.3g},"
            f" allowed: norm > {_LEAST_NORM:g}, best 1"
        )


def _rates(
    grid: Grid,
    found: Mapping[Part, Resampled],
    factors: Factors,
    flight_map: FlightMap,
    q_NB: Array | None,
) -> Array:
    """Return body rates, rad/s: as recorded, or w_B = 2 q* q' by a curve through the attitude."""
    if flight_map.rate is not None:
        return _vectors(found["rate"], factors["rate"], flight_map.rate, q_NB)
    assert q_NB is not None  # noqa: S101 - a map has one of them
    slope = fit_curve(grid.times, q_NB, grid.step).rate(grid.times)
    rates: Array = 2.0 * multiply(q_NB * _CONJUGATE, slope)[:, 1:]
    return rates


def _force(found: Resampled, factors: Array, flight_map: FlightMap, q_NB: Array | None) -> Array:
    """Return the specific force at the sensor, m/s^2, FRD."""
    vectors = _vectors(found, factors, flight_map.force, q_NB)
    if flight_map.force.gravity:
        return vectors
    assert q_NB is not None  # noqa: S101 - the map was checked
    down = np.broadcast_to([0.0, 0.0, flight_map.gravity.m_s2], vectors.shape)
    return vectors - rotate_back(q_NB, down)


def _vectors(
    found: Resampled, factors: Array, table: ForceTable | RateTable, q_NB: Array | None
) -> Array:
    vectors = found.values * factors * np.array(table.scale)
    if table.frame in OF_WORLD and q_NB is not None:
        return rotate_back(q_NB, in_world(vectors, table.frame))
    return in_body(vectors, table.frame)


def _at_eye(f_B: Array, w_B: Array, grid: Grid, flight_map: FlightMap) -> Array:
    """Take the specific force from the sensor to the pilot's eye."""
    r = np.array(flight_map.sensor.position_m)
    if not r.any():
        return f_B
    alpha = fit_curve(grid.times, w_B, grid.step).rate(grid.times)
    arm = np.broadcast_to(r, f_B.shape)
    return f_B - cross(alpha, arm) - cross(w_B, cross(w_B, arm))


def unexplained(flight: GriddedFlight) -> float:
    """Return the rms rate, rad/s, by which the attitude turns and the rates do not tell."""
    slope = np.diff(flight.q_NB, axis=0) / flight.step
    middle = 0.5 * (flight.q_NB[1:] + flight.q_NB[:-1])
    turned = 2.0 * multiply(middle * _CONJUGATE, slope)[:, 1:]
    told = 0.5 * (flight.w_NB_B[1:] + flight.w_NB_B[:-1])
    return float(np.sqrt(np.mean(length(turned - told) ** 2)))


def vertical_share(flight: GriddedFlight) -> float:
    """Return the mean of the upward part of the force over g: about 1 in any vehicle.

    It is -1 where the axes are upside down.
    """
    up = -rotate(flight.q_NB, flight.f_B)[:, 2]
    return float(np.mean(up)) / STANDARD_GRAVITY


def upright_share(flight: GriddedFlight) -> float:
    """Return the upward part, in the body's own axes, of the first second's mean force, over g.

    It is 1 where the vehicle begins upright at rest, -1 where its axes are upside down.
    """
    first = max(round(1.0 / flight.step), 1)
    return -float(np.mean(flight.f_B[:first, 2])) / STANDARD_GRAVITY
