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


def held_attitude(
    platform: Platform, feedback: str, dt: float, pose: Pose
) -> AttitudeCorrection | None:
    """Return the correction by this feedback; None for none. dt: tick, s. pose: at the start.

    Gains are those of the platform's `[plant]`.

    Raises InputError for another feedback.
    """
    if feedback not in LIVE_FEEDBACKS:
        raise InputError(f"--feedback {feedback}, allowed: {', '.join(LIVE_FEEDBACKS)}")
    if feedback == "none":
        return None
    t, wheels = platform.plant or PlantTable(), Wheels(platform.geometry())
    estimate = EstimateSettings(
        feedback == "fix",
        t.fix_gain,
        t.fix_bias_gain,
        t.fix_rate_hz,
        1.0 + t.fix_latency_s,
        t.first_fix_gain,
    )
    return AttitudeCorrection(
        CorrectionSettings(t.attitude_gain_1_s, t.correction_rate_rad_s, estimate),
        (wheels.sphere_from_wheels, wheels.wheels_from_sphere),
        six_axes(dt, platform.wheel_limit_values(), platform.stage_limit_values()),
        dt,
        pose,
    )
