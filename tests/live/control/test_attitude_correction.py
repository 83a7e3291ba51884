"""The loop on a sphere that rolls as it is told, late: errors fade however fast it turns."""

from math import degrees

import pytest

from atlas_cueing.live.control.attitude_correction import AttitudeCorrection, CorrectionSettings
from atlas_cueing.live.control.attitude_estimate import EstimateSettings
from atlas_cueing.live.control.certified_axis import six_axes
from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.drive_status import CabinSensors, DriveStatus
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    add,
    apply,
    conjugate,
    exp,
    geodesic,
    multiply,
    scale,
    subtract,
)
from atlas_cueing.scenario import load_platform

H, NS = 0.01, 10_000_000
KICK: Vec3 = (0.03, -0.03, 0.02)


def flown(turning: float, lead: int, seconds: float, gain: float = 4.0) -> list[float]:
    """Errors, deg, by tick since the sphere was kicked; set points are `lead` ticks ahead."""
    platform = load_platform("atlas-2.9m")
    geometry = platform.geometry()
    J, inverse = geometry.sphere_from_wheels, geometry.wheels_from_sphere
    axes = six_axes(H, platform.wheel_limit_values(), platform.stage_limit_values())
    settings = CorrectionSettings(gain, 0.5, 0.1, EstimateSettings(True, 1.0, 0.0, 50.0))
    loop = AttitudeCorrection(settings, (J, inverse), axes, H)
    schedule: list[tuple[Vec3, Quat]] = []  # wheel angles and orientation, by tick
    sent: list[Vec3] = []
    angle, q, speed = ZERO, IDENTITY, 0.0
    truth, gyro, errors = IDENTITY, IDENTITY, []
    kicked = round(4.0 / H)
    for k in range(kicked + round(seconds / H)):
        speed = min(turning, speed + 1.5 * H)
        rate = (0.4 * speed, -0.3 * speed, (1.0 - 0.25) ** 0.5 * speed)
        wheels = apply(inverse, rate)
        acceleration = apply(inverse, scale(1.5 if speed < turning else 0.0, (0.4, -0.3, 0.866)))
        angle, q = add(angle, scale(H, wheels)), multiply(exp(scale(H, rate)), q)
        schedule.append((angle, q))
        due = (k + lead) * NS
        command = Command(k * H, wheels, acceleration, ZERO, ZERO, ZERO, angle)
        sent.append(loop.corrected(due, command, q, stopping=False).wheel_angle)
        done = k - lead  # the tick that is due now
        if done < 1:
            continue
        turn = exp(apply(J, subtract(sent[done], sent[done - 1])))
        before, truth = truth, multiply(turn, truth)
        if k == kicked:
            truth = multiply(exp(KICK), truth)
        gyro = multiply(gyro, multiply(conjugate(before), truth))
        if k % 2 == 0:  # 50 Hz
            sensors = CabinSensors(gyro, k * NS, truth)
            loop.hear(DriveStatus(k, "following", "", k * NS, 7, k, 0.01, b"", *POSITIONS, sensors))
        if k >= kicked:
            errors.append(degrees(geodesic(truth, schedule[done][1])))
    return errors


POSITIONS = (ZERO, ZERO, 1, 0)


@pytest.mark.parametrize(("turning", "soon"), [(0.2, 0.1), (3.0, 0.3)])
@pytest.mark.parametrize("lead", [1, 8])
def test_a_kick_fades_as_the_gain_says(turning: float, soon: float, lead: int) -> None:
    errors = flown(turning, lead, 3.0)
    assert errors[0] > 2.0
    # what is on its way turns with the sphere
    assert max(errors[round(0.8 / H) : round(1.5 / H)]) < soon
    late = round(1.5 / H)
    assert max(errors[late:]) < 0.05, "five time constants and the delay"


def test_it_does_not_overshoot_for_the_delay() -> None:
    slow, quick = flown(0.2, 8, 2.0), flown(0.2, 1, 2.0)
    assert min(slow) < 0.05
    end = slow.index(min(slow))
    assert max(slow[end:]) < 0.15, "with what is on its way unknown it rings"
    assert max(quick[100:]) < 0.1
