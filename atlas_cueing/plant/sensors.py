"""What a cabin can measure: a gyro that drifts, and a fix from outside that comes late.

| sensor | gives |
|---|---|
| gyro | mean rate of a tick in S, + bias + white noise (an integrating gyro) |
| fix | orientation at a time, + noise, known `latency` later; as optics that see the sphere |

The full-scale Atlas fuses such a pair, external optical and internal gyroscopic (Hobin, Copeland,
Hayes, CCToMM M3 2016). Every number is assumed: `[plant]`.
"""

# mypyc: runs every tick

from math import sqrt
from random import Random
from typing import Final

from ..rotation import Quat, Vec3, conjugate, exp, log, multiply


class PlantGyro:
    """bias in rad/s along (1, 1, 1) / sqrt 3 of S; noise: angle random walk, rad / sqrt(s)."""

    def __init__(self, bias: float, noise: float, random: Random) -> None:
        along = bias / sqrt(3.0)
        self._bias: Final[Vec3] = (along, along, along)
        self._noise: Final[float] = noise
        self._random: Final[Random] = random

    def rate(self, before_WS: Quat, now_WS: Quat, dt: float) -> Vec3:
        """Rate, rad/s, S, of a sphere that turned from one orientation to the other in dt (s)."""
        turn = log(multiply(conjugate(before_WS), now_WS))
        spread, b, r = self._noise / sqrt(dt), self._bias, self._random
        return (
            turn[0] / dt + b[0] + spread * r.gauss(0.0, 1.0),
            turn[1] / dt + b[1] + spread * r.gauss(0.0, 1.0),
            turn[2] / dt + b[2] + spread * r.gauss(0.0, 1.0),
        )


class AbsoluteFix:
    """rate in Hz, noise about each axis in rad, latency in s."""

    def __init__(self, rate: float, noise: float, latency: float, random: Random) -> None:
        self._period: Final[float] = 1.0 / rate
        self._noise: Final[float] = noise
        self._latency: Final[float] = latency
        self._random: Final[Random] = random
        self._taken = 0  # fixes
        self._coming: list[tuple[float, Quat]] = []

    def look(self, time: float, q_WS: Quat) -> None:
        """Take a fix if one is due at `time` (s), at most one a tick."""
        if time + 1e-9 < (self._taken + 1) * self._period:
            return
        self._taken = int((time + 1e-9) / self._period)
        r, s = self._random, self._noise
        error = exp((s * r.gauss(0.0, 1.0), s * r.gauss(0.0, 1.0), s * r.gauss(0.0, 1.0)))
        self._coming.append((time, multiply(error, q_WS)))

    def arrived(self, time: float) -> list[tuple[float, Quat]]:
        """Time taken and q_WS of the fixes that have come by `time` (s), each once."""
        known = [fix for fix in self._coming if fix[0] + self._latency <= time + 1e-9]
        self._coming = self._coming[len(known) :]
        return known
