"""A scenario's pipeline."""

from collections.abc import Sequence
from contextlib import suppress

from ..cueing import CueSource, PlanParameters, build_cueing, needs_flight
from ..errors import InputError, MethodError, Mistake, ScenarioError, SlipConditionError
from ..pipeline import Pipeline
from ..scenario.mistakes import SET, dotted, shown
from ..scenario.platform_file import without_room
from ..scenario.scenario import Scenario
from ..signals import Vehicle, VehicleState
from ..smoothing import Smoothing
from ..vehicles import FlownAhead
from ..wheels import Wheels


def build_pipeline(
    scenario: Scenario, dt: float, states: Sequence[VehicleState] | None = None
) -> Pipeline:
    """A new pipeline for one flight of `scenario` with a state every `dt` s (the vehicle's step).

    states: all states of the flight, for a method that needs them (`Scenario.needs_whole_flight`).

    Raises SlipConditionError for a singular platform and InputError for limits or parameters that
    do not fit the step, and for a method that needs the whole flight and does not have it, or finds
    no plan for it.

    Example:
        >>> from math import cos
        >>> from atlas_cueing import VehicleState, build_pipeline, load_scenario
        >>> pipeline = build_pipeline(load_scenario("scenarios/f16_rolls.toml"), dt=0.01)
        >>> def at(time):  # level, in a yaw that sets in slowly
        ...     rate = 0.1 * (1.0 - cos(time))
        ...     return VehicleState(time, [1, 0, 0, 0], [0, 0, rate], [0, 0, -9.80665])
        >>> ticks = [pipeline.step(at(0.01 * k)) for k in range(101)]
        >>> tick = ticks[-1]  # right is negative about the z axis of W, which points up
        >>> round(tick.motion.w_WS_W[2], 3), tick.motion.limited
        (-0.046, (0.0, 0.0))
        >>> [round(speed, 3) for speed in tick.wheels.speed]
        [0.34, 0.34, 0.34]

    """
    platform = scenario.platform
    _check_room(scenario, dt)
    wheels = _wheels(scenario)
    try:
        smoothing = Smoothing(
            dt=dt,
            wheels_from_sphere=wheels.wheels_from_sphere,
            sphere_from_wheels=wheels.sphere_from_wheels,
            wheel_limits=platform.wheel_limit_values(),
            stage_limits=platform.stage_limit_values(),
            contacts=platform.kept_rows(),
        )
        cueing = _cueing(scenario, dt, states)
    except ValueError as error:
        raise InputError(
            f"{scenario.source}: scenario {scenario.name!r} on platform {platform.name!r} at"
            f" {1.0 / dt:g} Hz: {error}"
        ) from error
    return Pipeline(cueing, smoothing, wheels)


def prepare(scenario: Scenario, vehicle: Vehicle) -> tuple[Vehicle, Pipeline]:
    """The vehicle to fly and its new pipeline, for a flight whose future may be known.

    For a method that needs the whole flight the vehicle is flown to its end here, and the one
    returned plays it back; any other is returned as it is. Raises what `build` raises.
    """
    if not scenario.needs_whole_flight:
        _check_first_pose(scenario, vehicle, None)
        return vehicle, build_pipeline(scenario, vehicle.dt)
    ahead = FlownAhead(vehicle)
    _check_first_pose(scenario, ahead, ahead.states)
    return ahead, build_pipeline(scenario, ahead.dt, ahead.states)


def _check_first_pose(
    scenario: Scenario, vehicle: Vehicle, states: Sequence[VehicleState] | None
) -> None:
    """Raise InputError for a first pose that is not safe at rest, where traction is kept.

    A pipeline of its own makes that pose, before anything is written.
    """
    if scenario.platform.kept_rows() is not None:
        with suppress(MethodError):  # the run itself tells of it
            build_pipeline(scenario, vehicle.dt, states).step(vehicle.state)


def _wheels(scenario: Scenario) -> Wheels:
    try:
        return Wheels(scenario.platform.geometry())
    except SlipConditionError as error:
        error.args = (f"{scenario.name_platform(('wheel',))}: wheel: {error}",)
        raise


def _check_room(scenario: Scenario, dt: float) -> None:
    mistakes = []
    for key, value, allowed in without_room(scenario.platform, dt):
        file = scenario.name_platform(key)
        mistakes.append(
            Mistake(file, dotted(("platform", *key) if file == SET else key), shown(value), allowed)
        )
    if mistakes:
        raise ScenarioError(mistakes)


def _cueing(scenario: Scenario, dt: float, states: Sequence[VehicleState] | None) -> CueSource:
    table, platform = scenario.file.cueing, scenario.platform
    method, stage_limits = table.parameters(), platform.stage_limit_values()
    if states is None and needs_flight(method):
        raise InputError(_no_flight(scenario))
    if isinstance(method, PlanParameters):
        return method.plan(states or (), stage_limits, platform.head_S, dt)
    stage = table.stage_parameters()
    return build_cueing(method, stage, stage_limits, platform.head_S, dt, states or ())


def _no_flight(scenario: Scenario) -> str:
    """Say why the scenario's method cannot fly without a known flight, and what to do."""
    name = scenario.file.cueing.declaration.name
    if isinstance(scenario.file.cueing.parameters(), PlanParameters):
        asks, instead = f"method {name!r} needs", "another method"
    else:
        asks, instead = f"cueing.look_ahead_s of method {name!r} needs", "set it to 0"
    return (
        f"scenario {scenario.name!r}: {asks} the whole flight beforehand, so it does not fly live;"
        f" use run, batch or recue, or {instead}"
    )
