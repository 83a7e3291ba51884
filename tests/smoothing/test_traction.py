"""Traction and torque are kept for any cue, by arithmetic of the tests' own."""

import numpy as np
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.rotation import ZERO
from atlas_cueing.signals import Cue
from atlas_cueing.smoothing import Stop
from atlas_cueing.smoothing.traction import nearest

from .cues import UPRIGHT, smooth, wild
from .flights import check
from .traction_flights import Kept, demand

DT = 1.0 / 120.0
HALF_TURN = Cue(0.0, (np.cos(1.45), np.sin(1.45), 0.0, 0.0), ZERO, ZERO, ZERO, ZERO)


@pytest.mark.parametrize(
    ("preset", "preload", "dt", "seed"),
    [
        ("atlas-2.9m", 0.0, 1.0 / 120.0, 1),
        ("atlas-2.9m", 4500.0, 1.0 / 60.0, 2),
        ("atlas-skewed", 0.0, 1.0 / 250.0, 3),
        ("atlas-1.5m", 600.0, 1.0 / 120.0, 4),
    ],
)
def test_any_cue_keeps_traction_torque_and_every_limit(
    preset: str, preload: float, dt: float, seed: int
) -> None:
    kept = Kept(preset, preload)
    flight = kept.fly(dt, list(wild(dt, 1500, np.random.default_rng(seed))))
    check(kept.limits, flight)
    use, normal, torque = demand(kept.model, flight)
    assert 0.8 < use.max() <= 1.0  # it is also reached, so that the test could fail
    assert normal.min() > 0.0
    assert np.abs(torque).max() <= (kept.model.drive.torque or np.inf)


def test_without_it_wheels_slip_and_lift_off() -> None:
    kept = Kept("atlas-2.9m", 0.0)
    use, normal, _ = demand(kept.model, kept.fly(DT, [UPRIGHT, *[HALF_TURN] * 200], kept=False))
    assert use.max() > 1.0
    assert normal.min() < 0.0


def test_without_a_look_at_the_stop_it_would_not_do() -> None:
    kept = Kept("atlas-2.9m", 0.0, blind=True)
    cues = list(wild(DT, 1500, np.random.default_rng(1)))
    use, _, _ = demand(kept.model, kept.fly(DT, cues))
    assert use.max() > 1.0


def test_a_feasible_cue_passes_unchanged() -> None:
    kept = Kept("atlas-2.9m", 0.0)
    cues = smooth(DT, 900, np.random.default_rng(1))
    one, other = (kept.fly(DT, cues, kept=each) for each in (True, False))
    assert np.all(one.limited == 0.0)
    for name in ("q", "w", "alpha", "p", "v", "a"):
        assert np.array_equal(getattr(one, name), getattr(other, name))


def test_a_jump_is_caught_up_and_ends_on_the_cue() -> None:
    """166 deg at 0 kN."""
    flight = Kept("atlas-2.9m", 0.0).fly(DT, [UPRIGHT, *[HALF_TURN] * 600])
    angle = 2.0 * np.arccos(np.clip(np.abs(flight.q @ np.array(HALF_TURN.q_WS)), 0.0, 1.0))
    assert np.degrees(angle[-1]) < 0.1


def test_a_first_pose_that_is_not_safe_at_rest_is_refused_with_numbers() -> None:
    """The weight hangs 1.2 m off the centre."""
    kept = Kept("atlas-2.9m", 0.0)
    body = kept.model.body
    object.__setattr__(kept.model, "body", type(body)(body.mass, (1.2, 0.0, 0.0), body.inertia_S))
    smoothing = kept.smoothing(DT)
    with pytest.raises(InputError, match=r"wheel\.\d: drive force .* N, allowed: at most"):
        smoothing.step(UPRIGHT)


@pytest.mark.parametrize("preset", ["atlas-2.9m", "atlas-2.9m-halo", "atlas-skewed"])
def test_the_rows_say_what_the_excess_says_and_no_orientation_exceeds_the_bound(
    preset: str,
) -> None:
    rows, random = Kept(preset, 0.0).model.kept_rows(), np.random.default_rng(5)
    for _ in range(50):
        q = random.standard_normal(4)
        q_WS = tuple((q / np.linalg.norm(q)).tolist())
        speed, x, a = (tuple((s * random.standard_normal(3)).tolist()) for s in (9.0, 20.0, 2.0))
        excess = rows.excess(q_WS, speed, x, a)
        by_rows = max(np.dot(row, x) - bound for row, bound in rows.rows(q_WS, speed, a))
        assert by_rows == pytest.approx(excess, abs=1e-9)
        assert excess <= rows.largest_excess(x, x, tuple(map(abs, speed)), a, a) + 1e-9


def test_the_soft_stop_lets_go_first_and_its_rest_is_the_stop_of_every_state_on_it() -> None:
    random = np.random.default_rng(6)
    for _ in range(200):
        v, a = 5.0 * random.standard_normal(), 10.0 * random.uniform(-1.0, 1.0)
        stop = Stop.soft(v, a, 1.0, 50.0)
        at = random.uniform(0.0, stop.duration)
        p, v1, a1 = stop.at(at)
        rest = Stop.soft(v1, a1, 1.0, 50.0)
        assert rest.duration == pytest.approx(stop.duration - at, abs=1e-6)
        end = stop.at(stop.duration)[0]
        assert p + rest.at(rest.duration)[0] == pytest.approx(end, abs=1e-6)
        t = np.linspace(at, stop.duration, 50)
        states = np.array([stop.at(each) for each in t])
        low, high, fastest = stop.bounds_from(at)
        assert low - 1e-9 <= states[:, 2].min()
        assert states[:, 2].max() <= high + 1e-9
        assert np.abs(states[:, 1]).max() <= fastest + 1e-9
        least, most = stop.span()
        path = np.array([stop.at(each)[0] for each in np.linspace(0.0, stop.duration, 99)])
        assert least - 1e-9 <= path.min()
        assert path.max() <= most + 1e-9


def test_the_nearest_accelerations_keep_rows_and_ranges() -> None:
    wide = (-9.0, 9.0)
    x = nearest((3.0, 3.0, 0.0), [((1.0, 1.0, 0.0), 2.0)], 0.0, (wide, wide, wide))
    assert x == pytest.approx((1.0, 1.0, 0.0), abs=1e-6)
    x = nearest((3.0, 3.0, 0.0), [((1.0, 1.0, 0.0), 2.0)], 0.0, ((-9.0, 0.5), wide, wide))
    assert x == pytest.approx((0.5, 1.5, 0.0), abs=1e-6)
