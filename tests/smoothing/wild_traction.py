"""Hostile rides of platforms that keep traction, and a count of what breaks a limit.

In spells, drawn anew: what `cues.wild` gives (jumps, noise, sines at and beyond the limits, numbers
that are none, spikes); cues that go against the motion itself, up to half a turn back from where
the sphere turns and to the end of the travel that the stage just left; and consistent flights, from
gentle to ten times what the platform can do, that are long enough to be caught up with.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from atlas_cueing.rotations import Array
from atlas_cueing.signals import Cue, Motion

from .cues import UPRIGHT, Random, cue, smooth, wild
from .flights import Flight, use
from .traction_flights import Kept, demand

RATES = (60.0, 120.0, 250.0, 500.0)
"""Ticks a second; every ride has one of them."""

RIDE = 5000
"""Ticks of one ride, from rest, upright, in the centre."""

_SPELL = 400  # ticks of one kind of cue at most
_FLIGHT = 2000  # ticks of a consistent one at most

PLATFORMS = {
    "atlas-2.9m-halo, 0 kN": ("atlas-2.9m-halo", 0.0, 0.0),
    "atlas-2.9m-halo, 4.5 kN": ("atlas-2.9m-halo", 0.0, 0.5),
    "atlas-2.9m-halo, 9 kN": ("atlas-2.9m-halo", 0.0, 1.0),
    "atlas-2.9m, 0 kN": ("atlas-2.9m", 0.0, 1.0),
    "atlas-2.9m, 4.5 kN": ("atlas-2.9m", 4500.0, 1.0),
    "atlas-1.5m": ("atlas-1.5m", 0.0, 1.0),
}
"""Preset, preload straight down (N) and share of the preset's own preloads, by name."""


@dataclass
class Found:
    """What rides of one platform came to. Shares are of what is allowed; above 1 it is broken."""

    ticks: int = 0
    limited: int = 0
    kinematic: dict[str, float] = field(default_factory=dict)
    kinematic_broken: int = 0
    traction_broken: int = 0
    friction: float = 0.0
    torque: float = 0.0
    normal: float = np.inf

    def add(self, kept: Kept, flight: Flight) -> None:
        """Take one ride in."""
        shares = {name: float(share.max()) for name, share in use(kept.limits, flight).items()}
        self.kinematic_broken += sum(not share <= 1.0 + 1e-6 for share in shares.values())
        for name, share in shares.items():
            self.kinematic[name] = max(self.kinematic.get(name, 0.0), share)
        friction, normal, torque = demand(kept.model, flight)
        torque = np.abs(torque) / (kept.model.drive.torque or np.inf)
        fit = (friction <= 1.0) & (normal[:, :3] > 0.0) & (torque <= 1.0)
        fit &= np.all(normal >= -1e-6, axis=1)[:, None]  # supports may just touch; rounding, N
        self.ticks += len(fit)
        self.limited += int(np.any(flight.limited != 0.0, axis=1).sum())
        self.traction_broken += int((~np.all(fit, axis=1)).sum())
        self.friction = max(self.friction, float(friction.max()))
        self.torque = max(self.torque, float(torque.max()))
        self.normal = min(self.normal, float(normal[:, :3].min()))


def ride(name: str, seed: int, ticks: int, *, kept: bool = True, blind: bool = False) -> Found:
    """Ride the platform of this name for so many ticks, in rides of `RIDE` at every rate in turn.

    kept: False lets go of traction, so that something must be found; and so does `blind`.
    """
    platform, found = Kept(*PLATFORMS[name], blind=blind), Found()
    for number in range(-(-ticks // RIDE)):
        random = np.random.default_rng([seed, list(PLATFORMS).index(name), number])
        dt = 1.0 / RATES[number % len(RATES)]
        length = min(RIDE, ticks - number * RIDE)
        found.add(platform, _one_ride(platform, dt, length, random, kept))
    return found


def _one_ride(platform: Kept, dt: float, ticks: int, random: Random, kept: bool) -> Flight:
    smoothing = platform.smoothing(dt, kept=kept)
    rows: list[tuple[float, ...]] = []
    motion = smoothing.step(UPRIGHT)
    while len(rows) < ticks:
        for source in _spell(platform, dt, random):
            motion = smoothing.step(source(motion))
            rows.append(_row(motion))
    return _flight(dt, np.array(rows[:ticks]))


def _spell(platform: Kept, dt: float, random: Random) -> Iterator[Callable[[Motion], Cue]]:
    """Give what makes the next cue of the last motion, for each tick of a spell."""
    kind, length = random.integers(5), int(random.integers(1, _SPELL))
    if kind < 2:
        against = _Contrary(platform, random)
        yield from (against.cue for _ in range(length))
        return
    if kind < 4:
        cues = wild(dt, length, random)
    else:
        rate, travel = 10.0 ** random.uniform(-1.0, 1.0, 2)
        cues = iter(smooth(dt, int(random.integers(1, _FLIGHT)), random, rate=rate, travel=travel))
    for each in cues:
        yield lambda _, each=each: each


class _Contrary:
    """Cues that go against the motion, kept up for a spell of ticks and then turned to it anew."""

    def __init__(self, platform: Kept, random: Random) -> None:
        self._random, self._travel = random, np.array(platform.limits.stage.travel)
        self._longest = 10.0 ** random.uniform(0.0, 2.5)
        self._left, self._cue = 0, UPRIGHT

    def cue(self, motion: Motion) -> Cue:
        """The cue after this motion."""
        if self._left <= 0:
            self._left = int(self._random.uniform(1.0, self._longest))
            self._cue = self._against(motion)
        self._left -= 1
        return self._cue

    def _against(self, motion: Motion) -> Cue:
        random = self._random
        away = -np.array(motion.w_WS_W) + 1e-3 * random.standard_normal(3)
        back = Rotation.from_rotvec(random.uniform(0.5, 3.1) * away / np.linalg.norm(away))
        q = back * Rotation.from_quat(np.roll(motion.q_WS, -1))
        v = np.array(motion.v_WS_W) + 1e-3 * random.standard_normal(3)
        rate, drift = random.choice([0.0, 1.0], 2)
        return cue(
            motion.time,
            np.roll(q.as_quat(), 1),
            3.0 * rate * away,
            -np.sign(v) * self._travel,
            -3.0 * drift * v,
            np.zeros(3),
        )


def _row(m: Motion) -> tuple[float, ...]:
    states = (*m.q_WS, *m.w_WS_W, *m.alpha_WS_W, *m.p_WS_W, *m.v_WS_W, *m.a_WS_W)
    return (m.time, *states, *m.limited)


def _flight(dt: float, x: Array) -> Flight:
    ends = (1, 5, 8, 11, 14, 17, 20)
    return Flight(dt, x[:, 0], *np.split(x[:, 1:], [end - 1 for end in ends[1:]], axis=1))


def lines(name: str, found: Found) -> Iterator[str]:
    """Say what came of a platform's rides."""
    most = max(found.kinematic, key=lambda each: found.kinematic[each])
    yield (
        f"{name}: {found.ticks} ticks, {found.limited / found.ticks:.0%} of them limited;"
        f" kinematic limits broken {found.kinematic_broken} times, most use"
        f" {found.kinematic[most]:.6f} ({most});"
    )
    yield (
        f"  traction broken on {found.traction_broken} ticks; friction {found.friction:.6f} and"
        f" torque {found.torque:.6f} of what is allowed, normal force {found.normal:.3g} N at least"
    )
