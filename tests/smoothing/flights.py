"""Smooth a sequence of cues, and hold what comes out against every limit by finite differences."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from atlas_cueing.rotations import Array
from atlas_cueing.signals import Cue

from .platforms import Platform

# Jerk-limited by J, x1 - x0 = dt (v0 + v1) / 2 - dt^2 (a1 - a0) / 12 up to J dt^3 times the
# integral over u of |u^2/2 - u/2 + 1/12| (Euler-Maclaurin with Peano's kernel); v1 - v0 = dt (a0 +
# a1) / 2 up to J dt^2 times that of |u - 1/2|.
_BEND_X, _BEND_V = np.sqrt(3.0) / 54.0, 0.25


@dataclass(frozen=True)
class Flight:
    """What smoothing gave, one row a tick."""

    dt: float
    time: Array
    q: Array
    w: Array
    alpha: Array
    p: Array
    v: Array
    a: Array
    limited: Array


def fly(platform: Platform, dt: float, cues: Iterable[Cue]) -> Flight:
    step = platform.smoothing(dt).step
    rows = [
        (m.time, *m.q_WS, *m.w_WS_W, *m.alpha_WS_W, *m.p_WS_W, *m.v_WS_W, *m.a_WS_W, *m.limited)
        for m in map(step, cues)
    ]
    x = np.array(rows)
    return Flight(
        dt,
        x[:, 0],
        x[:, 1:5],
        x[:, 5:8],
        x[:, 8:11],
        x[:, 11:14],
        x[:, 14:17],
        x[:, 17:20],
        x[:, 20:22],
    )


def turned(q: Array) -> Array:
    """Rotation vector in W from each orientation (scalar first) to the next."""
    r = Rotation.from_quat(np.roll(q, -1, axis=1))
    return (r[1:] * r[:-1].inv()).as_rotvec()


def wheel_turns(platform: Platform, flight: Flight) -> Array:
    """Angle of each wheel in each tick, from the orientation alone.

    Magnus' commutator is taken off again.
    """
    w = flight.w
    return (
        turned(flight.q) - flight.dt**2 / 12.0 * np.cross(w[1:], w[:-1])
    ) @ platform.wheels_from_sphere.T


def use(platform: Platform, flight: Flight) -> dict[str, Array]:
    """Largest share used of every limit, from states and finite differences."""
    dt, to_wheels = flight.dt, platform.wheels_from_sphere.T
    wheels, stage = platform.wheels, platform.stage
    shares = {
        f"wheel {name}": share
        for name, share in _dynamic(
            dt,
            wheel_turns(platform, flight),
            flight.w @ to_wheels,
            flight.alpha @ to_wheels,
            (wheels.speed, wheels.acceleration, wheels.jerk),
        ).items()
    }
    moved = _dynamic(
        dt,
        np.diff(flight.p, axis=0),
        flight.v,
        flight.a,
        (stage.speed, stage.acceleration, stage.jerk),
    )
    shares |= {f"stage {name}": share for name, share in moved.items()}
    return shares | {"stage travel": np.max(np.abs(flight.p), axis=0) / stage.travel}


def _dynamic(
    dt: float, dx: Array, v: Array, a: Array, limits: tuple[object, ...]
) -> dict[str, Array]:
    speed, acceleration, jerk = (np.array(x) for x in limits)

    def most(*x: Array) -> Array:
        return np.max([np.max(np.abs(each), axis=0, initial=0.0) for each in x], axis=0)

    return {
        "speed": most(v, dx / dt) / speed,
        "acceleration": (
            most(a, np.diff(v, axis=0) / dt, np.diff(dx, axis=0) / dt**2) / acceleration
        ),
        "jerk": (
            most(
                np.diff(a, axis=0) / dt,
                np.diff(v, 2, axis=0) / dt**2,
                np.diff(dx, 2, axis=0) / dt**3,
            )
            / jerk
        ),
        "fit of displacement": (
            most(dx - 0.5 * dt * (v[1:] + v[:-1]) + dt**2 / 12.0 * np.diff(a, axis=0))
            / (_BEND_X * jerk * dt**3 + 1e-13)
        ),
        "fit of speed": (
            most(np.diff(v, axis=0) - 0.5 * dt * (a[1:] + a[:-1]))
            / (_BEND_V * jerk * dt**2 + 1e-12)
        ),
    }


def check(platform: Platform, flight: Flight) -> dict[str, Array]:
    """Assert that the flight is a motion inside every limit; the shares used, for the record."""
    everything = np.hstack(
        [flight.q, flight.w, flight.alpha, flight.p, flight.v, flight.a, flight.limited]
    )
    assert np.all(np.isfinite(everything))
    np.testing.assert_allclose(np.linalg.norm(flight.q, axis=1), 1.0, rtol=0.0, atol=1e-12)
    assert np.all(np.sum(flight.q[1:] * flight.q[:-1], axis=1) > 0.0), "the quaternion's sign jumps"
    assert np.all(np.isin(flight.limited, [0.0, 1.0]))
    np.testing.assert_allclose(np.diff(flight.time), flight.dt, rtol=1e-6)
    shares = use(platform, flight)
    beyond = {name: share for name, share in shares.items() if not np.all(share <= 1.0 + 1e-6)}
    assert not beyond, beyond
    return shares
