"""Limits of platforms against what their contacts can give."""

import pytest

from atlas_cueing.run import broken_promises
from atlas_cueing.scenario import Platform, load_platform


def changed(**tables: object) -> Platform:
    data = load_platform("atlas-2.9m").model_dump(exclude_none=True)
    for name, change in tables.items():
        if isinstance(change, dict):
            data[name] = data.get(name, {}) | change
        else:
            data[name] = change
    return Platform.model_validate(data)


GENTLE = {
    "wheel_limits": {"acceleration_rad_s2": 20.0},
    "stage_limits": {"acceleration_m_s2": [5.8, 6.7, 9.0]},
}


def test_limits_that_contacts_can_give() -> None:
    assert broken_promises(changed(**GENTLE)) == []


def test_the_full_scale_platform_promises_a_lift_off() -> None:
    """g / (2 tan 40 deg) = 5.84 m/s2 along x, where it allows 6."""
    first, *others = broken_promises(load_platform("atlas-2.9m"))
    assert first == (
        "stage_limits.acceleration_m_s2 along x: 6 is allowed, but from 5.844 m/s2 a wheel lifts"
        " off"
    )
    assert all("a wheel slips" in line for line in others)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"drive": {"torque_n_m": 10.0}}, "the torque of a drive ends"),
        ({"drive": {"motor_speed_rad_s": 300.0}}, "needs 310 rad/s of a motor, which ends at 300"),
        ({"stage_limits": {"acceleration_m_s2": [5.8, 6.8, 9.0]}}, "along y: 6.8 is allowed"),
    ],
)
def test_promises(change: dict[str, dict[str, object]], message: str) -> None:
    lines = broken_promises(changed(**(GENTLE | change)))
    assert lines
    assert all(message in line for line in lines), lines


def test_rest() -> None:
    wheels = load_platform("atlas-2.9m").model_dump(exclude_none=True)["wheel"]
    wheels[1]["load_limit_n"] = 1000.0
    (line,) = broken_promises(changed(**GENTLE, wheel=wheels))
    assert line == "wheel.1 carries 2492 N at rest, load_limit_n = 1000"
    lifted = [{"contact": [0.3, 0.0, -1.0], "force_n": 9e3}]
    assert any(
        "does not touch at rest" in line for line in broken_promises(changed(preload=lifted))
    )
