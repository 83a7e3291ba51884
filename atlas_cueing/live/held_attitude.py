"""The correction of a platform's attitude, from its file."""

from ..errors import InputError
from ..scenario import Platform
from ..scenario.plant_table import PlantTable
from ..wheels import Wheels
from .control import AttitudeCorrection
from .control.attitude_correction import CorrectionSettings
from .control.attitude_estimate import LIVE_FEEDBACKS, EstimateSettings
from .control.certified_axis import six_axes
from .control.pose import Pose

_MOST_FIXES = 50.0  # Hz; a status tells one
_MOST_LATE = 5.0  # fixes on their way that the gains are meant for (assumed)


def held_attitude(
    platform: Platform, feedback: str, dt: float, pose: Pose
) -> AttitudeCorrection | None:
    """Return the correction by this feedback; None for none. dt: tick, s. pose: at the start.

    Gains are those of the platform's `[plant]`; where more than five fixes are on their way at a
    time, each is believed less, or the estimate of the gyro's bias swings (30 are too many).

    Raises InputError for another feedback.
    """
    if feedback not in LIVE_FEEDBACKS:
        raise InputError(f"--feedback {feedback}, allowed: {', '.join(LIVE_FEEDBACKS)}")
    if feedback == "none":
        return None
    t, wheels = platform.plant or PlantTable(), Wheels(platform.geometry())
    rate = min(t.fix_rate_hz, _MOST_FIXES)
    calm = min(1.0, _MOST_LATE / (rate * t.fix_latency_s)) if t.fix_latency_s > 0.0 else 1.0
    estimate = EstimateSettings(
        feedback == "fix",
        calm * t.fix_gain,
        calm * calm * t.fix_bias_gain,
        rate,
        1.0 + t.fix_latency_s,
        calm * t.first_fix_gain,
    )
    return AttitudeCorrection(
        CorrectionSettings(
            t.attitude_gain_1_s, t.correction_rate_rad_s, t.correction_share, estimate
        ),
        (wheels.sphere_from_wheels, wheels.wheels_from_sphere),
        six_axes(dt, platform.wheel_limit_values(), platform.stage_limit_values()),
        dt,
        pose,
    )
