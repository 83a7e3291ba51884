"""What a cueing method is, and the declaration that everything a user meets of it is built from."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol, TypeAlias, runtime_checkable

from ..rotation import Quat, Vec3
from ..signals import Cue, StageLimits, VehicleState
from .parameter import Parameter, Value, with_values
from .stage.stage_parameters import FORCE_GAIN, STAGE, StageParameters


class Rotation(Protocol):
    """How the sphere follows the vehicle, tick by tick."""

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""


class CueSource(Protocol):
    """The cues of a flight in order, made as it goes on or planned beforehand."""

    def step(self, vehicle: VehicleState) -> Cue:
        """Give the cue for the next vehicle state."""


class RotationParameters(Protocol):
    """Parameters of a causal method: it turns the sphere by the past alone, beside the stage."""

    def rotation(self, dt: float) -> Rotation:
        """Make the rotation that begins at the first state; dt in s."""


@runtime_checkable
class LookAheadParameters(Protocol):
    """Parameters of a method that is causal, or looks ahead in a flight that is known.

    A class with the attribute `look_ahead` is one of these, whatever else it has.
    """

    @property
    def look_ahead(self) -> float:
        """Time that the method looks ahead, s; with 0 it needs the past alone."""

    def rotation(self, dt: float, flight: Sequence[VehicleState] = ()) -> Rotation:
        """Make the rotation that begins at the first state.

        Args:
            dt: tick, s.
            flight: every state of the flight, dt apart; it may be empty without look-ahead.

        Raises InputError for look-ahead without a flight.

        """


@runtime_checkable
class PlanParameters(Protocol):
    """Parameters of a method that needs the whole flight: it plans rotation and stage at once."""

    def plan(
        self, states: Sequence[VehicleState], limits: StageLimits, head_S: Vec3, dt: float
    ) -> CueSource:
        """Plan all cues of a flight.

        Args:
            states: every state of the flight, dt apart.
            limits: what the stage can do.
            head_S: the rider's head from the sphere's centre, m, in S.
            dt: time step, s.

        Raises InputError when there is no plan for the flight.

        """


MethodParameters: TypeAlias = RotationParameters | LookAheadParameters | PlanParameters


def needs_flight(parameters: MethodParameters) -> bool:
    """Whether the whole flight has to be known before the first cue, so that none flies live."""
    if isinstance(parameters, LookAheadParameters):
        return parameters.look_ahead > 0.0
    return isinstance(parameters, PlanParameters)


def rotation_of(
    parameters: RotationParameters | LookAheadParameters, dt: float, flight: Sequence[VehicleState]
) -> Rotation:
    """Make the rotation of a method, which knows the flight if it looks ahead.

    Args:
        parameters: of the method.
        dt: tick, s.
        flight: every state of the flight, dt apart; it may be empty without look-ahead.

    Raises InputError for look-ahead without a flight.

    """
    if isinstance(parameters, LookAheadParameters):
        return parameters.rotation(dt, flight)
    return parameters.rotation(dt)


@dataclass(frozen=True, slots=True)
class Method:
    """Declaration of a cueing method; `methods` has the table of all.

    name: as a file has it; also the name of the module.
    summary: one line on what the method does.
    defaults: its parameters, as they are where a file is silent.
    parameters: the keys that a user may set.
    fixed: fields of the defaults that have no key, for nobody is to choose them.
    stage: defaults of the stage beside it, which has the keys of `stage_parameters`.
    files: of a method that is no part of this package, what goes into logs, by name.
    """

    name: str
    summary: str
    defaults: MethodParameters
    parameters: tuple[Parameter, ...]
    stage: StageParameters = field(default_factory=StageParameters)
    files: Mapping[str, bytes] = field(default_factory=dict)
    fixed: tuple[str, ...] = ()

    @property
    def needs_flight(self) -> bool:
        """Whether it has to know the whole flight, whatever its parameters: it cannot fly live."""
        return isinstance(self.defaults, PlanParameters)

    def metadata(self) -> dict[str, str]:
        """What a log says of the method beside its name; the package's own have its version."""
        return {}

    def with_values(self, values: Mapping[str, Value | None]) -> MethodParameters:
        """Set the method's parameters from values by key, in the units of the file."""
        return with_values(self.defaults, self.parameters, values)

    def stage_with_values(self, values: Mapping[str, Value | None]) -> StageParameters:
        """Set the stage's parameters from values by key, in the units of the file."""
        return with_values(self.stage, (FORCE_GAIN, *STAGE), values)

    def reference(self) -> str:
        """List the keys with default, range, unit, what each does and where the default is from."""
        lines = [f"Method `{self.name}`: {self.summary}.", ""]
        lines += [_entry(parameter, self.defaults) for parameter in self.parameters]
        if not self.needs_flight:
            shown = {parameter.key for parameter in self.parameters}
            lines += [_entry(FORCE_GAIN, self.stage)] if FORCE_GAIN.key not in shown else []
            lines += [_entry(parameter, self.stage, "stage.") for parameter in STAGE]
        return "\n".join(lines)


def _entry(parameter: Parameter, defaults: object, table: str = "") -> str:
    default, unit = parameter.default(defaults), parameter.unit.symbol
    about = f"{parameter.allowed}{unit and f' {unit}'}"
    return (
        f"{table}{parameter.key} = {'(none)' if default is None else default} ({about}):"
        f" {parameter.description}; {parameter.source}"
    )
