"""The `[cueing]` table: one class for each method, mapped to the dataclasses of `atlas_cueing.cueing`.

Defaults come from those dataclasses; here are only units for people and the ranges that make sense.
A new method is one more class, and its name in `METHODS` and `CueingTable`.
"""

from math import degrees, inf, radians
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Tag

from ..cueing import (
    CLASSICAL_STAGE,
    AttitudeParameters,
    BlendParameters,
    ClassicalParameters,
    ForceParameters,
    HorizonParameters,
    MethodParameters,
    PreviewParameters,
    SlowTurnParameters,
    StageParameters,
)
from .tables import ONE_OR_THREE, ScenarioTable, number

Gain: TypeAlias = Annotated[float, number(0.0, 10.0)]
Gains: TypeAlias = Annotated[tuple[Gain, Gain, Gain], ONE_OR_THREE]
TurnRate: TypeAlias = Annotated[float, number(0.0, 90.0, above=True)]
FastRate: TypeAlias = Annotated[float, number(0.0, 720.0, above=True)]
Duration: TypeAlias = Annotated[float, number(0.01, 1000.0)]
Frequency: TypeAlias = Annotated[float, number(0.01, 50.0)]
Frequencies: TypeAlias = Annotated[tuple[Frequency, Frequency, Frequency], ONE_OR_THREE]
Corner: TypeAlias = Annotated[float, number(0.0, 10.0)]
Corners: TypeAlias = Annotated[tuple[Corner, Corner, Corner], ONE_OR_THREE]
Travel: TypeAlias = Annotated[float, number(1e-6, 1e3)]
Travels: TypeAlias = Annotated[tuple[Travel, Travel, Travel], ONE_OR_THREE]
Force: TypeAlias = Annotated[float, number(0.01, 100.0)]

_ATTITUDE = AttitudeParameters()
_BLEND = BlendParameters()
_FORCE = ForceParameters()
_CLASSICAL = ClassicalParameters()
_PREVIEW = PreviewParameters()
_STAGE = StageParameters()
_HORIZON = HorizonParameters()


def _degrees(angle: float) -> float:
    """Degrees without the last digits' rounding, so that 3 deg/s reads 3.0 and goes back to the same radians."""
    return round(degrees(angle), 12)


class StageTable(ScenarioTable):
    """`[cueing.stage]`: see StageParameters.

    `travel_m` is left out where the platform's own travel counts.

    planner: `horizon` plans ahead, by HorizonParameters; `onset` is the onset filter by itself.
    """

    planner: Literal["horizon", "onset"] = "horizon"
    onset_rad_s: Frequencies = _STAGE.onset
    recentre_rad_s: Corners = _STAGE.recentre
    bandwidth_hz: Annotated[float, number(1e-3, 100.0)] = _STAGE.bandwidth
    travel_m: Travels | None = None
    planning_rate_hz: Annotated[float, number(10.0, 1000.0)] = _HORIZON.planning_rate
    horizon_s: Annotated[float, number(1.0, 20.0)] = _HORIZON.length
    memory_s: Annotated[float, number(1.0, 1000.0)] = _HORIZON.memory
    first_share: Annotated[float, number(0.0, 1.0)] = _HORIZON.first_share

    def parameters(self, force_gain: tuple[Gain, Gain, Gain]) -> StageParameters:
        """Parameters of the stage, SI."""
        horizon = HorizonParameters(
            planning_rate=self.planning_rate_hz,
            length=self.horizon_s,
            memory=self.memory_s,
            first_share=self.first_share,
        )
        return StageParameters(
            force_gain,
            self.onset_rad_s,
            self.recentre_rad_s,
            self.bandwidth_hz,
            self.travel_m or (inf, inf, inf),
            horizon if self.planner == "horizon" else None,
        )


class ClassicalStageTable(StageTable):
    """`[cueing.stage]` of the method `classical`: see CLASSICAL_STAGE."""

    planner: Literal["horizon", "onset"] = "onset"
    onset_rad_s: Frequencies = CLASSICAL_STAGE.onset
    recentre_rad_s: Corners = CLASSICAL_STAGE.recentre
    travel_m: Travels | None = CLASSICAL_STAGE.travel


class _Method(ScenarioTable):
    """What every method has."""

    rotation_gain: Gains = _BLEND.rotation_gain
    force_gain: Gains = _STAGE.force_gain
    stage: StageTable = StageTable()

    def stage_parameters(self) -> StageParameters:
        """Parameters of the stage, SI."""
        return self.stage.parameters(self.force_gain)


class AttitudeTable(_Method):
    """Method `attitude`: see AttitudeParameters."""

    method: Literal["attitude"] = "attitude"
    return_rate_deg_s: TurnRate = _degrees(_ATTITUDE.turn.rate)
    return_time_s: Duration = _ATTITUDE.turn.time
    return_smoothing_s: Duration = _ATTITUDE.turn.smoothing

    def parameters(self) -> MethodParameters:
        """Parameters of the method, SI."""
        turn = SlowTurnParameters(
            radians(self.return_rate_deg_s), self.return_time_s, self.return_smoothing_s
        )
        return AttitudeParameters(rotation_gain=self.rotation_gain, turn=turn)


class BlendTable(_Method):
    """Method `blend`: see BlendParameters."""

    method: Literal["blend"] = "blend"
    align_rate_deg_s: TurnRate = _degrees(_BLEND.turn.rate)
    align_time_s: Duration = _BLEND.turn.time
    align_smoothing_s: Duration = _BLEND.turn.smoothing
    hold_force_m_s2: Force = _BLEND.hold

    def parameters(self) -> MethodParameters:
        """Parameters of the method, SI."""
        turn = SlowTurnParameters(
            radians(self.align_rate_deg_s), self.align_time_s, self.align_smoothing_s
        )
        return BlendParameters(
            rotation_gain=self.rotation_gain, hold=self.hold_force_m_s2, turn=turn
        )


class ForceTable(_Method):
    """Method `force`: see ForceParameters."""

    method: Literal["force"] = "force"
    bandwidth_rad_s: Frequency = _FORCE.bandwidth
    align_rate_deg_s: FastRate = _degrees(_FORCE.turn.rate)
    align_time_s: Duration = _FORCE.turn.time
    align_smoothing_s: Duration = _FORCE.turn.smoothing
    hold_force_m_s2: Force = _FORCE.hold

    def parameters(self) -> MethodParameters:
        """Parameters of the method, SI."""
        turn = SlowTurnParameters(
            radians(self.align_rate_deg_s), self.align_time_s, self.align_smoothing_s
        )
        return ForceParameters(self.rotation_gain, self.bandwidth_rad_s, self.hold_force_m_s2, turn)


class ClassicalTable(_Method):
    """Method `classical`: see ClassicalParameters; a limit of 1e6 deg is none."""

    method: Literal["classical"] = "classical"
    rotation_gain: Gains = _CLASSICAL.rotation_gain
    force_gain: Gains = CLASSICAL_STAGE.force_gain
    high_pass_rad_s: Frequencies = _CLASSICAL.high_pass
    tilt_low_pass_rad_s: Frequency = _CLASSICAL.tilt_low_pass
    tilt_rate_deg_s: TurnRate = _degrees(_CLASSICAL.tilt_rate)
    angle_limit_deg: Annotated[float, number(0.0, 1e6, above=True)] = _degrees(
        _CLASSICAL.angle_limit
    )
    stage: ClassicalStageTable = ClassicalStageTable()

    def parameters(self) -> MethodParameters:
        """Parameters of the method, SI."""
        return ClassicalParameters(
            rotation_gain=self.rotation_gain,
            tilt_gain=self.force_gain,
            high_pass=self.high_pass_rad_s,
            tilt_low_pass=self.tilt_low_pass_rad_s,
            tilt_rate=radians(self.tilt_rate_deg_s),
            angle_limit=radians(self.angle_limit_deg),
        )


class PreviewTable(ScenarioTable):
    """Method `preview`, which has to know the whole flight: see PreviewParameters."""

    method: Literal["preview"] = "preview"
    align_rate_deg_s: FastRate = _degrees(_PREVIEW.rate)
    align_smoothing_s: Duration = _PREVIEW.smoothing
    force_unit_m_s2: Force = _PREVIEW.force_unit
    rate_unit_deg_s: TurnRate = _degrees(_PREVIEW.rate_unit)
    planning_rate_hz: Annotated[float, number(1.0, 100.0)] = _PREVIEW.planning_rate

    def parameters(self) -> PreviewParameters:
        """Parameters of the method, SI."""
        return PreviewParameters(
            rate=radians(self.align_rate_deg_s),
            smoothing=self.align_smoothing_s,
            force_unit=self.force_unit_m_s2,
            rate_unit=radians(self.rate_unit_deg_s),
            planning_rate=self.planning_rate_hz,
        )


METHODS: dict[str, type[_Method]] = {
    "attitude": AttitudeTable,
    "blend": BlendTable,
    "force": ForceTable,
    "classical": ClassicalTable,
}
"""The methods that know only the past, so that they fly anywhere."""

ALL_METHODS: dict[str, type[ScenarioTable]] = {**METHODS, "preview": PreviewTable}
DEFAULT_METHOD = "blend"


def _method(value: Any) -> Any:
    return (
        value.get("method", DEFAULT_METHOD)
        if isinstance(value, dict)
        else getattr(value, "method", DEFAULT_METHOD)
    )


CueingTable: TypeAlias = Annotated[
    Annotated[AttitudeTable, Tag("attitude")]
    | Annotated[BlendTable, Tag("blend")]
    | Annotated[ForceTable, Tag("force")]
    | Annotated[ClassicalTable, Tag("classical")]
    | Annotated[PreviewTable, Tag("preview")],
    Discriminator(_method),
]
