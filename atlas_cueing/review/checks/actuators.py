"""Check of the actuators: limits, wheels against motion, and integrals of each other."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...rotations import Array
from ..finding import Finding, exceeding
from ..recorded_run import RecordedRun
from .integrals import mean_step, speed_error, turn, turn_error

# of a limit: over 1 ms, differences of values up to 30 carry rounding of 1e-11, resting on a limit
# is fair
LIMIT = 1e-6
# rad/s, rad/s^2: J^-1 Omega again in double precision was within 1e-14 on every bundled flight
WHEELS = 1e-9
ROUNDING = 1e-9  # m/s, m, rad/s


@dataclass(frozen=True, slots=True)
class _Chain:
    """Logged position, speed and acceleration of an actuator, and its limits.

    places: names of the columns, by quantity and component; unit: of position, speed, acceleration
    and jerk; values: (n, 3) each, no position for wheels; limits: of each, and of the jerk.
    """

    places: tuple[Sequence[str], Sequence[str], Sequence[str]]
    unit: tuple[str, str, str, str]
    values: tuple[Array | None, Array, Array]
    limits: tuple[Sequence[float] | None, Sequence[float], Sequence[float], Sequence[float]]


def check_actuators(run: RecordedRun) -> list[Finding]:
    """Check the actuators.

    Every limit is kept by logged values and by finite differences, each quantity is the integral of
    the next, and the wheels are J^-1 Omega.
    """
    found = []
    for chain in (_wheels(run), _stage(run)):
        found += _limits(run.flight.time, chain) + _integrals(run.flight.time, chain)
    return found + _mismatch(run)


def limit_shares(run: RecordedRun) -> dict[str, Array]:
    """Use of each limit at each tick as a share of it, by name: `wheel_speed` and so on (n, 3).

    The jerk is by differences of the acceleration, (n - 1, 3).
    """
    shares: dict[str, Array] = {}
    for name, chain in (("wheel", _wheels(run)), ("stage", _stage(run))):
        for quantity, values, limit in zip(
            ("travel", "speed", "acceleration"), chain.values, chain.limits, strict=False
        ):
            if values is not None and limit is not None:
                shares[f"{name}_{quantity}"] = values / np.asarray(limit)
        shares[f"{name}_jerk"] = _slope(chain.values[2], run.flight.time) / np.asarray(
            chain.limits[3]
        )
    return shares


def _wheels(run: RecordedRun) -> _Chain:
    limits, flight = run.platform.wheel_limit_values(), run.flight
    return _Chain(
        places=(
            (),
            [f"/wheels w{i}_rad_s" for i in (1, 2, 3)],
            [f"/wheels a{i}_rad_s2" for i in (1, 2, 3)],
        ),
        unit=("rad", "rad/s", "rad/s2", "rad/s3"),
        values=(None, flight.wheel_speed, flight.wheel_acceleration),
        limits=(None, limits.speed, limits.acceleration, limits.jerk),
    )


def _stage(run: RecordedRun) -> _Chain:
    limits, flight = run.platform.stage_limit_values(), run.flight
    p, v, a = (
        [f"/motion {name}{axis}_{unit}" for axis in "xyz"]
        for name, unit in (("p", "m"), ("v", "m_s"), ("a", "m_s2"))
    )
    return _Chain(
        places=(p, v, a),
        unit=("m", "m/s", "m/s2", "m/s3"),
        values=(flight.motion_p_W, flight.motion_v_W, flight.motion_a_W),
        limits=(limits.travel, limits.speed, limits.acceleration, limits.jerk),
    )


def _limits(time: Array, chain: _Chain) -> list[Finding]:
    found = []
    for k, values in enumerate(chain.values):
        limit, above = chain.limits[k], chain.limits[k + 1]
        if values is None:
            continue
        if limit is not None:
            found += exceeding(
                "limit", chain.places[k], time, values, _allowed(limit), chain.unit[k]
            )
        if len(time) > 1 and above is not None:
            places = [f"{place} by differences" for place in chain.places[k]]
            found += exceeding(
                "limit", places, time[1:], _slope(values, time), _allowed(above), chain.unit[k + 1]
            )
    if len(time) > 2:
        places = [f"{place} by second differences" for place in chain.places[1]]
        curvature = (
            np.diff(_slope(chain.values[1], time), axis=0) / (0.5 * (time[2:] - time[:-2]))[:, None]
        )
        found += exceeding(
            "limit", places, time[2:], curvature, _allowed(chain.limits[3]), chain.unit[3]
        )
    return found


def _integrals(time: Array, chain: _Chain) -> list[Finding]:
    if len(time) < 2:
        return []
    h = np.diff(time)
    x, v, a = chain.values
    jerk = _allowed(chain.limits[3])
    error, bound = np.diff(v, axis=0) - mean_step(a, h), speed_error(a, h, jerk) + ROUNDING
    found = exceeding(
        "not the integral of its acceleration",
        chain.places[1],
        time[1:],
        error,
        bound,
        chain.unit[1],
        quantity="error",
    )
    if x is not None:
        error = np.diff(x, axis=0) - turn(v, a, h)
        bound = turn_error(h, jerk) + ROUNDING
        found += exceeding(
            "not the integral of its speed",
            chain.places[0],
            time[1:],
            error,
            bound,
            "m",
            quantity="error",
        )
    return found


def _mismatch(run: RecordedRun) -> list[Finding]:
    """The logged wheels against J^-1 times the logged motion (Eq. 22, and Eq. 19 inverted)."""
    flight, chain, from_sphere = run.flight, _wheels(run), run.wheels_from_sphere().T
    check, difference = "not J^-1 of the motion", "difference"
    speed = flight.wheel_speed - flight.motion_w_W @ from_sphere
    acceleration = flight.wheel_acceleration - flight.motion_alpha_W @ from_sphere
    return [
        *exceeding(
            check, chain.places[1], flight.time, speed, WHEELS, "rad/s", quantity=difference
        ),
        *exceeding(
            check, chain.places[2], flight.time, acceleration, WHEELS, "rad/s2", quantity=difference
        ),
    ]


def _allowed(limit: Sequence[float]) -> Array:
    return np.asarray(limit) * (1.0 + LIMIT)


def _slope(values: Array, time: Array) -> Array:
    with np.errstate(all="ignore"):  # time that stands still is the clock's finding
        slope: Array = np.diff(values, axis=0) / np.diff(time)[:, None]
    return slope
