"""The guard keeps traction by arithmetic of its own, and its stop is smoothing's soft stop."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from smoothing.cues import wild
from smoothing.flights import Flight
from smoothing.traction_flights import Kept, demand

from atlas_cueing.live.control.certified_axis import SoftStop, six_axes
from atlas_cueing.live.control.command import Command, axes_of, command_from
from atlas_cueing.live.control.gentle_stop import GentleStop
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.live.kept_contacts import check_of
from atlas_cueing.rotation import ZERO, Vec3
from atlas_cueing.signals import (
    Motion,
)
from atlas_cueing.smoothing import Stop

DT = 1.0 / 120.0


def soft_guard(kept: Kept) -> Guard:
    return Guard(DT, kept.limits.wheels, kept.limits.stage, check_of(kept.model))


def command_of(motion: Motion, wheels: tuple[Vec3, Vec3, Vec3]) -> Command:
    angle, speed, acceleration = wheels
    stage = motion.p_WS_W, motion.v_WS_W, motion.a_WS_W
    return Command(motion.time, speed, acceleration, *stage, angle)


def turn_of(before: Command, after: Command) -> np.ndarray:
    return np.subtract(after.wheel_angle, before.wheel_angle)


def test_the_stop_is_smoothings_soft_stop() -> None:
    random = np.random.default_rng(1)
    for _ in range(200):
        v, a = 5.0 * random.standard_normal(), 10.0 * random.uniform(-1.0, 1.0)
        one, other = SoftStop(0.0, v, a, 1.0, 50.0), Stop.soft(v, a, 1.0, 50.0)
        assert one.duration == pytest.approx(other.duration, abs=1e-9)
        for t in np.linspace(0.0, 1.1 * other.duration, 20):
            assert one.at(t) == pytest.approx(other.at(t), abs=1e-9)
        low, high = other.span()
        assert min(0.0, one.end, one.turning_point) == pytest.approx(low, abs=1e-9)
        assert max(0.0, one.end, one.turning_point) == pytest.approx(high, abs=1e-9)


def test_it_passes_what_smoothing_makes_and_stops_with_traction_from_anywhere() -> None:
    """Wild flights at 0 kN, and the guard's stop from two of their states."""
    kept = Kept("atlas-2.9m", 0.0)
    J = np.array(kept.wheels.sphere_from_wheels)
    for seed in (1, 2):
        smoothing, guard = kept.smoothing(DT), soft_guard(kept)
        cues = list(wild(DT, 400 + 100 * seed, np.random.default_rng(seed)))
        motion = smoothing.step(cues[0])
        guard.start(Command(0.0, ZERO, ZERO, motion.p_WS_W, ZERO, ZERO, ZERO))
        for cue in cues[1:]:
            motion = smoothing.step(cue)
            given = command_of(motion, smoothing.wheel_motion())
            assert guard.check(given, motion.q_WS) is given, guard.reason
        q, rows, time = motion.q_WS, [], motion.time
        for _ in range(2000):
            before, time = given, time + DT
            given = guard.stop(time)
            q = turned(q, J @ turn_of(before, given))
            rows.append((q, given))
            if guard.standing:
                break
        assert guard.standing
        use, normal, _ = demand(kept.model, flight_of(J, rows))
        assert use.max() <= 1.0
        assert normal.min() > 0.0


@pytest.mark.parametrize("preset", ["atlas-2.9m", "atlas-2.9m-halo"])
def test_it_passes_a_hold_from_anywhere(preset: str) -> None:
    """The hold flies the same soft stop, command by command."""
    kept = Kept(preset, 0.0, 0.0)
    for seed in (1, 2, 3):
        smoothing, guard = kept.smoothing(DT), soft_guard(kept)
        cues = list(wild(DT, 300 + 100 * seed, np.random.default_rng(seed)))
        motion = smoothing.step(cues[0])
        given = Command(0.0, ZERO, ZERO, motion.p_WS_W, ZERO, ZERO, ZERO)
        guard.start(given)
        for cue in cues[1:]:
            motion = smoothing.step(cue)
            given = command_of(motion, smoothing.wheel_motion())
            assert guard.check(given, motion.q_WS) is given, guard.reason
        assert any(given.wheel_speed)
        q, hold = (
            motion.q_WS,
            GentleStop(six_axes(DT, kept.limits.wheels, kept.limits.stage), axes_of(given), DT),
        )
        while not hold.arrived:
            before, given = given, command_from(given.time + DT, hold.next())
            q = turned(q, np.array(kept.wheels.sphere_from_wheels) @ turn_of(before, given))
            assert guard.check(given, q) is given, guard.reason


def test_it_stops_at_a_command_that_slips() -> None:
    kept = Kept("atlas-2.9m", 0.0)
    smoothing, guard = kept.smoothing(DT, kept=False), soft_guard(kept)
    cues = list(wild(DT, 900, np.random.default_rng(1)))
    motion = smoothing.step(cues[0])
    guard.start(Command(0.0, ZERO, ZERO, motion.p_WS_W, ZERO, ZERO, ZERO))
    for cue in cues[1:]:
        motion = smoothing.step(cue)
        guard.check(command_of(motion, smoothing.wheel_motion()), motion.q_WS)
    assert "force" in guard.reason or "standstill" in guard.reason
    assert "allowed" in guard.reason


@pytest.mark.parametrize("torque", [None, 40.0])
def test_it_finds_every_kind_of_breach_and_no_other(torque: float | None) -> None:
    """Beside the same laws in other axes, over random states."""
    kept = Kept("atlas-2.9m", 0.0)
    model = replace(kept.model, drive=replace(kept.model.drive, torque=torque))
    check, J = check_of(model), np.array(kept.wheels.sphere_from_wheels)
    random, kinds = np.random.default_rng(7), set()
    for _ in range(400):
        size = 10.0 ** random.uniform(-2.0, 1.3)
        vectors = [tuple((size * random.standard_normal(3)).tolist()) for _ in range(5)]
        q = tuple(np.roll(Rotation.random(random_state=random).as_quat(), 1).tolist())
        given = Command(0.0, *vectors, ZERO)  # type: ignore[arg-type]
        breach = check.breach(given, q)
        use, normal, torques = demand(model, flight_of(J, [(q, given)]))
        strong = torque is not None and np.abs(torques).max() > torque
        assert (breach == "") == (use.max() <= 1.0 and normal.min() >= 0.0 and not strong), breach
        kinds |= {kind for kind in ("normal force", "drive force", "torque") if kind in breach}
    assert kinds == {"normal force", "drive force"} | ({"torque"} if torque else set())


def turned(q: tuple[float, ...], turn: np.ndarray) -> tuple[float, ...]:
    after = Rotation.from_rotvec(turn) * Rotation.from_quat(np.roll(q, -1))
    return tuple(np.roll(after.as_quat(), 1).tolist())


def flight_of(J: np.ndarray, rows: list[tuple[tuple[float, ...], Command]]) -> Flight:
    q = np.array([q for q, _ in rows])
    w, alpha, p, v, a = (
        np.array([x(c) for _, c in rows])
        for x in (
            lambda c: J @ np.array(c.wheel_speed),
            lambda c: J @ np.array(c.wheel_acceleration),
            lambda c: c.p_WS_W,
            lambda c: c.v_WS_W,
            lambda c: c.a_WS_W,
        )
    )
    return Flight(DT, np.arange(len(q)) * DT, q, w, alpha, p, v, a, np.zeros((len(q), 2)))
