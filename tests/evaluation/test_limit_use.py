"""Use of the limits on trajectories that use them exactly."""

import numpy as np
import pytest

from atlas_cueing.evaluation import (
    BLOCK_TICKS,
    LimitUse,
    RunColumns,
    by_limit,
    gathered,
    violations,
)
from atlas_cueing.signals import StageLimits, WheelLimits

from .flights import still

WHEELS = WheelLimits(
    speed=(10.0, 20.0, 30.0), acceleration=(6.0, 12.0, 18.0), jerk=(60.0, 120.0, 180.0)
)
STAGE = StageLimits(
    travel=(1.0, 1.0, 0.5),
    speed=(2.0, 1.0, 1.0),
    acceleration=(4.0, 5.0, 6.0),
    jerk=(40.0, 50.0, 60.0),
)
DT = 0.001
T = np.arange(1001) * DT


def limit_use(flight: RunColumns) -> dict[str, float]:
    return gathered(LimitUse(WHEELS, STAGE), flight)


def on_axis(values: np.ndarray, axis: int) -> np.ndarray:
    columns = np.zeros((len(values), 3))
    columns[:, axis] = values
    return columns


def test_nothing_used_at_rest() -> None:
    use = limit_use(still(100))
    assert len(use) == 11
    assert set(use.values()) == {0.0}
    assert violations(use) == []


@pytest.mark.parametrize("count", [0, 1, 2])
def test_very_short_flights(count: int) -> None:
    assert set(limit_use(still(count)).values()) == {0.0}


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_wheel_at_full_jerk(axis: int) -> None:
    """Acceleration grows at the jerk limit for 0.1 s, then stays at the acceleration limit.

    Then speed 3 wheel units.
    """
    jerk, top = WHEELS.jerk[axis], WHEELS.acceleration[axis]
    acceleration = np.minimum(jerk * T, top)
    speed = np.where(T < 0.1, 0.5 * jerk * T**2, 0.5 * top * 0.1 + top * (T - 0.1))
    flight = still(
        len(T), DT, wheel_speed=on_axis(speed, axis), wheel_acceleration=on_axis(acceleration, axis)
    )
    use = limit_use(flight)
    assert use["wheel_speed_logged"] == pytest.approx(speed[-1] / WHEELS.speed[axis])
    assert use["wheel_acceleration_logged"] == pytest.approx(1.0)
    assert use["wheel_acceleration_difference"] == pytest.approx(1.0)
    assert use["wheel_jerk_difference"] == pytest.approx(1.0)
    assert use["wheel_jerk_second_difference"] == pytest.approx(1.0)
    assert violations(use) == []


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_stage_axis_at_full_jerk(axis: int) -> None:
    jerk = -STAGE.jerk[axis]
    t = T[:101]
    flight = still(
        len(t),
        DT,
        motion_p_W=on_axis(jerk * t**3 / 6.0, axis),
        motion_v_W=on_axis(jerk * t**2 / 2.0, axis),
        motion_a_W=on_axis(jerk * t, axis),
    )
    use = limit_use(flight)
    assert use["stage_jerk_difference"] == pytest.approx(1.0)
    assert use["stage_acceleration_logged"] == pytest.approx(1.0)
    middle = 0.0995  # of the last tick
    assert use["stage_acceleration_difference"] == pytest.approx(10.0 * middle)
    assert use["stage_speed_logged"] == pytest.approx(-jerk * 0.005 / STAGE.speed[axis])
    assert use["stage_speed_difference"] == pytest.approx(
        -jerk * 0.005 / STAGE.speed[axis], rel=0.02
    )
    assert use["stage_travel_logged"] == pytest.approx(-jerk * 0.001 / 6.0 / STAGE.travel[axis])


@pytest.mark.parametrize(
    ("field", "caught"),
    [
        ("wheel_speed", {"wheel_acceleration_difference", "wheel_jerk_second_difference"}),
        ("wheel_acceleration", {"wheel_jerk_difference"}),
        ("motion_p_W", {"stage_speed_difference"}),
        ("motion_v_W", {"stage_acceleration_difference"}),
        ("motion_a_W", {"stage_jerk_difference"}),
    ],
)
def test_a_jump_between_two_ticks_is_a_violation(field: str, caught: set[str]) -> None:
    values = np.zeros((100, 3))
    values[50:, 1] = 0.3
    use = limit_use(still(100, DT, **{field: values}))
    assert {line.split()[0] for line in violations(use)} == caught


@pytest.mark.parametrize("tick", [BLOCK_TICKS + k for k in (-3, -2, -1, 0, 1, 2)])
@pytest.mark.parametrize("kind", [np.sign, np.abs], ids=["jump", "kink"])
@pytest.mark.parametrize(
    "field", ["wheel_speed", "wheel_acceleration", "motion_p_W", "motion_v_W", "motion_a_W"]
)
def test_where_a_block_ends_does_not_matter(field: str, kind: np.ufunc, tick: int) -> None:
    """A jump, or a kink, at the last tick of a block or at the first ticks of the next."""

    def use(count: int, place: int) -> dict[str, float]:
        values = np.minimum(kind(np.arange(count) - place), 9.0)
        return limit_use(still(count, 1.0, **{field: on_axis(values, 1)}))

    assert use(tick + 500, tick) == use(1000, 500)


def test_uneven_ticks() -> None:
    """A parabola has one acceleration, at any spacing: speed 3 t^2 has the curvature 6."""
    time = np.cumsum(np.random.default_rng(1).uniform(0.5, 1.5, 200)) * 0.01
    flight = still(200, time=time, wheel_speed=on_axis(3.0 * time**2, 0))
    assert limit_use(flight)["wheel_jerk_second_difference"] == pytest.approx(6.0 / 60.0)


def test_violations_name_the_limit_and_the_use() -> None:
    use = {"a": 1.0, "b": 1.0 + 0.9e-6, "c": 1.0 + 1.1e-6, "d": float("nan"), "e": float("inf")}
    assert violations(use) == [
        "c = 1.0000011 of the limit, allowed: at most 1",
        "d = nan of the limit, allowed: at most 1",
        "e = inf of the limit, allowed: at most 1",
    ]


def test_rounding_on_an_hour_of_ticks_is_within_the_tolerance() -> None:
    """Full speed and full acceleration held through times with few digits left after the point."""
    time = 3600.0 + T
    speed = on_axis(6.0 * (time - time[0]), 0)
    use = limit_use(still(len(T), time=time, wheel_speed=speed))
    assert use["wheel_acceleration_difference"] == pytest.approx(1.0)
    assert violations(use) == []


def test_a_limit_counts_once_however_it_is_measured() -> None:
    use = limit_use(still(3))
    assert by_limit(dict.fromkeys(use, 0.5)) == {
        "wheel_speed": 0.5,
        "wheel_acceleration": 0.5,
        "wheel_jerk": 0.5,
        "stage_travel": 0.5,
        "stage_speed": 0.5,
        "stage_acceleration": 0.5,
        "stage_jerk": 0.5,
    }
    for name in use:
        (largest,) = {value for value in by_limit({**use, name: 2.0}).values() if value}
        assert largest == 2.0
