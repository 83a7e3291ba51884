"""What the loop believes of the cabin's sensors, against a cabin whose motion is known."""

from math import degrees, inf, radians

import pytest

from atlas_cueing.live.control.attitude_estimate import AttitudeEstimate, EstimateSettings
from atlas_cueing.live.control.drive_status import CabinSensors, DriveStatus
from atlas_cueing.rotation import IDENTITY, ZERO, Quat, Vec3, exp, geodesic, multiply

PERIOD, START = 20_000_000, 5_000_000_000  # ns
BIAS: Vec3 = (0.01, -0.02, 0.005)


def told(time: int, sensors: CabinSensors | None) -> DriveStatus:
    return DriveStatus(time, "following", "", time, 7, 1, 0.009, b"", ZERO, ZERO, 1, 0, sensors)


def cabin(time: float) -> Quat:
    """Turning with the rate (0.3, -0.2, 0.5) rad/s of S."""
    return exp((0.3 * time, -0.2 * time, 0.5 * time))


def gyro(time: float, bias: Vec3 = ZERO) -> Quat:
    """Its integral: rate and bias are both constant in S."""
    return exp(((0.3 + bias[0]) * time, (-0.2 + bias[1]) * time, (0.5 + bias[2]) * time))


def estimate(uses_fix: bool = True) -> AttitudeEstimate:
    return AttitudeEstimate(EstimateSettings(uses_fix, 0.2, 0.02, 10.0), cabin(-0.02))


def heard(
    one: AttitudeEstimate, seconds: float, late: float = 0.0, bias: Vec3 = ZERO, wrong: Vec3 = ZERO
) -> float:
    """Hear statuses with a fix every 0.1 s that comes `late`; return the error at the end, deg."""
    fix: Quat | None = None
    seen = 0
    for k in range(round(50.0 * seconds)):
        time = 0.02 * k
        if k % 5 == 0 and time >= late + 0.1:
            seen = START + round(1e9 * (time - late))
            fix = multiply(exp(wrong), cabin(time - late))
        one.hear(told(START + k * PERIOD, CabinSensors(gyro(time, bias), seen, fix)))
    return degrees(geodesic(one.q_WS, cabin(time)))


def test_a_perfect_gyro_is_followed() -> None:
    one = estimate(uses_fix=False)
    # the status before the first counts as rest: 20 ms of 0.6 rad/s
    assert heard(one, 10.0) == pytest.approx(degrees(0.02 * (0.3**2 + 0.2**2 + 0.5**2) ** 0.5))


@pytest.mark.parametrize("late", [0.0, 0.013, 0.05, 0.2])
def test_a_bias_is_found_by_fixes_however_late(late: float) -> None:
    alone = heard(estimate(uses_fix=False), 30.0, bias=BIAS)
    assert alone > 20.0
    assert heard(estimate(), 30.0, late, BIAS) < 0.02


def test_a_fix_is_compared_with_the_estimate_of_its_own_time() -> None:
    """Between two statuses as well."""
    one = estimate()
    for k in range(10):
        one.hear(told(START + k * PERIOD, CabinSensors(gyro(0.02 * k))))
    before = one.q_WS
    seen = START + 7 * PERIOD + 9_000_000
    right = multiply(before, exp((0.3 * -0.031, -0.2 * -0.031, 0.5 * -0.031)))
    one.hear(told(START + 10 * PERIOD, CabinSensors(gyro(0.2), seen, right)))
    assert geodesic(one.q_WS, multiply(before, exp((0.006, -0.004, 0.01)))) < 1e-9
    assert one.fixes == 1


def test_fixes_that_cannot_be_are_refused_and_tell() -> None:
    one = estimate()
    off = heard(one, 5.0, wrong=(0.0, radians(30.0), 0.0))
    assert off < 1.0, "the gyro goes on alone"
    assert one.fixes_refused == one.fixes > 30
    assert "are not where the gyro says, by 29.8" in one.fault  # less the turn before the first
    assert one.trouble == one.fault
    assert heard(estimate(), 5.0, wrong=(0.0, radians(1.0), 0.0)) == pytest.approx(1.0, abs=0.1)


def test_what_is_missing_is_told() -> None:
    one = estimate()
    assert "no gyro" in one.fault
    one.hear(told(START, CabinSensors(IDENTITY)))
    assert (one.fault, one.fix_age) == ("", inf)
    assert "no fix of the cabin" in one.trouble
    one.hear(told(START + PERIOD, CabinSensors(IDENTITY, START, one.q_WS)))
    assert one.trouble == ""
    one.hear(told(START + 120 * PERIOD, CabinSensors(IDENTITY, START, one.q_WS)))
    assert "for 2 s" in one.trouble
    one.hear(told(START + 121 * PERIOD, None))
    assert "no gyro" in one.fault
    alone = estimate(uses_fix=False)
    alone.hear(told(START, CabinSensors(IDENTITY)))
    assert alone.trouble == ""


def test_a_status_again_or_out_of_order_changes_nothing() -> None:
    one = estimate()
    heard(one, 1.0)
    before = one.q_WS
    assert not one.hear(told(START + 10 * PERIOD, CabinSensors(gyro(0.9))))
    assert one.q_WS == before


def test_statuses_that_are_lost_lose_no_turn() -> None:
    whole, gaps = estimate(uses_fix=False), estimate(uses_fix=False)
    for k in range(500):
        status = told(START + k * PERIOD, CabinSensors(gyro(0.02 * k)))
        whole.hear(status)
        if k % 7 == 0 or k == 499:
            gaps.hear(status)
    assert geodesic(whole.q_WS, gaps.q_WS) < 1e-9
