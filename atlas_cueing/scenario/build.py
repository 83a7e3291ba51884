"""A scenario's pipeline."""

from ..cueing import build as build_cueing
from ..errors import InputError
from ..pipeline import Pipeline
from ..smoothing import Smoothing
from ..wheels import Wheels
from .scenario import Scenario


def build(scenario: Scenario, dt: float) -> Pipeline:
    """A new pipeline for one flight of `scenario` with a state every `dt` s (the vehicle's step).

    Raises SlipConditionError for a singular platform and InputError for limits or parameters that do not fit the step.
    """
    platform, method = scenario.platform, scenario.file.cueing
    wheels = Wheels(platform.geometry())
    stage_limits = platform.stage_motion_limits()
    try:
        cueing = build_cueing(method.parameters(), method.stage_parameters(), stage_limits, platform.head_S, dt)
        smoothing = Smoothing(
            dt=dt,
            wheels_from_sphere=wheels.wheels_from_sphere,
            sphere_from_wheels=wheels.sphere_from_wheels,
            wheel_limits=platform.wheel_speed_limits(),
            stage_limits=stage_limits,
        )
    except ValueError as error:
        raise InputError(f"scenario {scenario.name!r} on platform {platform.name!r} at {1.0 / dt:g} Hz: {error}") from error
    return Pipeline(cueing, smoothing, wheels)
