"""Cues of every kind: feasible ones in closed form, and wild ones."""

from collections.abc import Iterator

import numpy as np
from scipy.spatial.transform import Rotation

from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.rotations import Array
from atlas_cueing.signals import Cue

Random = np.random.Generator

UPRIGHT = Cue(0.0, IDENTITY, ZERO, ZERO, ZERO, ZERO)


def cue(time: float, q: Array, w: Array, p: Array, v: Array, a: Array) -> Cue:
    each = (tuple(float(x) for x in vector) for vector in (q, w, p, v, a))
    return Cue(float(time), *each)  # type: ignore[arg-type]


def sines(t: Array, amplitude: Array, omega: Array, phase: Array) -> tuple[Array, Array, Array]:
    """Sum of sines per axis and its first and second derivatives.

    Amplitude, omega, phase (terms, axes).
    """
    angle = omega * t[:, None, None] + phase
    return (
        np.sum(amplitude * np.sin(angle), axis=1),
        np.sum(amplitude * omega * np.cos(angle), axis=1),
        np.sum(-amplitude * omega**2 * np.sin(angle), axis=1),
    )


def turning(
    t: Array, turns: Array, amplitude: Array, omega: Array, phase: Array
) -> tuple[Array, Array]:
    """q_WS (scalar first) and w_WS_W of Rz(a) Ry(b) Rx(c).

    Each angle is a constant rate plus sines.
    """
    angle, rate, _ = sines(t, amplitude, omega, phase)
    angle, rate = angle + turns * t[:, None], rate + turns
    x, y, z = (Rotation.from_rotvec(angle[:, [i]] * np.eye(3)[i]) for i in range(3))
    w = (
        rate[:, [2]] * np.eye(3)[2]
        + z.apply(rate[:, [1]] * np.eye(3)[1])
        + (z * y).apply(rate[:, [0]] * np.eye(3)[0])
    )
    return np.roll((z * y * x).as_quat(), 1, axis=1), w


def smooth(
    dt: float, n: int, random: Random, *, rate: float = 0.5, travel: float = 0.2
) -> list[Cue]:
    """A self-consistent cue that turns for ever; rate (rad/s) and travel (m) set its size.

    It begins at rest in the centre.
    """
    t = dt * np.arange(n)
    ease, ease_1, ease_2 = _ease(t / 3.0)
    x = np.minimum(t / 3.0, 1.0)
    # warped time, s' = ease: at full speed after 3 s
    s = 3.0 * x**4 * (2.5 - 3.0 * x + x * x) + np.maximum(t - 3.0, 0.0)
    omega, phase = random.uniform(0.2, 1.2, (3, 3)), random.uniform(0.0, 6.0, (3, 3))
    q, w = turning(
        s,
        rate * random.uniform(-0.5, 0.5, 3),
        rate * random.uniform(0.0, 0.2, (3, 3)) / omega,
        omega,
        phase,
    )
    p, v, a = sines(t, travel * random.uniform(0.0, 0.4, (3, 3)), omega, phase)
    e1, e2 = ease_1 / 3.0, ease_2 / 9.0
    easing = [x[:, None] for x in (ease, e1, e2)]
    p, v, a = (
        easing[0] * p,
        easing[0] * v + easing[1] * p,
        easing[0] * a + 2.0 * easing[1] * v + easing[2] * p,
    )
    return [cue(*row) for row in zip(t, q, ease[:, None] * w, p, v, a, strict=True)]


def _ease(x: Array) -> tuple[Array, Array, Array]:
    """Quintic from 0 to 1 with level and uncurved ends, and its first two derivatives."""
    x = np.clip(x, 0.0, 1.0)
    return (
        x**3 * (10.0 - 15.0 * x + 6.0 * x * x),
        30.0 * x**2 * (1.0 - x) ** 2,
        60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
    )


BAD = (np.nan, np.inf, -np.inf, 1e300, -1e300, 1e308, 5e-324, 0.0, -0.0, 1e8, 1e16)


def wild(dt: float, n: int, random: Random) -> Iterator[Cue]:
    """n cues with no sense in them, in spells of up to 200.

    Jumps, noise, sines at the limits, what is not a number.
    """
    yield UPRIGHT
    n -= 1
    while n > 0:
        length = min(n, int(random.integers(1, 200)))
        yield from _KINDS[random.integers(len(_KINDS))](dt, length, random)
        n -= length


def _random(random: Random, size: float) -> Cue:
    q = Rotation.random(rng=random).as_quat() * random.choice([-1.0, 1.0])
    return cue(0.0, q, *(size * random.standard_normal(3) for _ in range(4)))


def _held(_: float, n: int, random: Random) -> Iterator[Cue]:
    one = _random(random, 10.0 ** random.uniform(-3.0, 3.0))
    return (one for _ in range(n))


def _noise(_: float, n: int, random: Random) -> Iterator[Cue]:
    size = 10.0 ** random.uniform(-4.0, 2.0)
    return (_random(random, size) for _ in range(n))


def _sine(dt: float, n: int, random: Random) -> Iterator[Cue]:
    """About one axis, slow to faster than the tick, small to far beyond the limits."""
    t, omega = dt * np.arange(n), 10.0 ** random.uniform(-1.0, np.log10(3.0 / dt))
    amplitude = 10.0 ** random.uniform(-2.0, 1.0, (1, 3))
    p, v, a = sines(t, amplitude, np.full((1, 3), omega), random.uniform(0.0, 6.0, (1, 3)))
    q, w = turning(t, np.zeros(3), 0.3 * amplitude, np.full((1, 3), omega), np.zeros((1, 3)))
    return (cue(*row) for row in zip(t, q, w, p, v, a, strict=True))


def _junk(dt: float, n: int, random: Random) -> Iterator[Cue]:
    """Every number may be anything."""
    for _ in range(min(n, 20)):
        good = _random(random, 1.0)
        numbers = np.array(
            [good.time, *good.q_WS, *good.w_WS_W, *good.p_WS_W, *good.v_WS_W, *good.a_WS_W]
        )
        spoilt = random.random(17) < random.choice([0.05, 0.5])
        numbers[spoilt] = random.choice(BAD, spoilt.sum())
        yield cue(
            numbers[0], numbers[1:5], numbers[5:8], numbers[8:11], numbers[11:14], numbers[14:17]
        )
    yield from _held(dt, max(n - 20, 0), random)


def _spike(_: float, n: int, random: Random) -> Iterator[Cue]:
    """Calm at the rails, with single cues from somewhere else."""
    calm = _random(random, 1.0)
    return (_random(random, 1e3) if random.random() < 0.05 else calm for _ in range(n))


def _smooth(dt: float, n: int, random: Random) -> Iterator[Cue]:
    return iter(
        smooth(
            dt,
            n,
            random,
            rate=10.0 ** random.uniform(-1.0, 1.0),
            travel=10.0 ** random.uniform(-1.0, 1.0),
        )
    )


_KINDS = (_held, _noise, _sine, _junk, _spike, _smooth)
