"""The `[cueing]` table: one class for each method, mapped to the dataclasses of `atlas_cueing.cueing`.

Defaults come from those dataclasses; here are only units for people and the ranges that make sense. A new method is one
more class, and its name in `CueingTable`.
"""

from math import degrees, radians
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Tag

from ..cueing.parameters import AttitudeParameters, BlendParameters, SlowTurnParameters, StageParameters
from .table import ONE_OR_THREE, Table, number

Gain: TypeAlias = Annotated[float, number(0.0, 10.0)]
Gains: TypeAlias = Annotated[tuple[Gain, Gain, Gain], ONE_OR_THREE]
TurnRate: TypeAlias = Annotated[float, number(0.0, 90.0, above=True)]
Duration: TypeAlias = Annotated[float, number(0.01, 1000.0)]

_ATTITUDE = AttitudeParameters()
_BLEND = BlendParameters()
_STAGE = StageParameters()


def _degrees(angle: float) -> float:
    """Degrees without the last digits' rounding, so that 3 deg/s reads 3.0 and goes back to the same radians."""
    return round(degrees(angle), 12)


class StageTable(Table):
    """`[cueing.stage]`: see StageParameters."""

    onset_rad_s: Annotated[float, number(0.0, 50.0, above=True)] = _STAGE.onset
    recentre_rad_s: Annotated[float, number(0.0, 10.0, above=True)] = _STAGE.recentre
    bandwidth_hz: Annotated[float, number(0.0, 100.0, above=True)] = _STAGE.bandwidth


class _Method(Table):
    """What every method has."""

    rotation_gain: Gains = _BLEND.rotation_gain
    force_gain: Gains = _STAGE.force_gain
    stage: StageTable = StageTable()

    def stage_parameters(self) -> StageParameters:
        """Parameters of the stage, SI."""
        return StageParameters(self.force_gain, self.stage.onset_rad_s, self.stage.recentre_rad_s, self.stage.bandwidth_hz)


class AttitudeTable(_Method):
    """Method `attitude`: see AttitudeParameters."""

    method: Literal["attitude"] = "attitude"
    return_rate_deg_s: TurnRate = _degrees(_ATTITUDE.turn.rate)
    return_time_s: Duration = _ATTITUDE.turn.time
    return_smoothing_s: Duration = _ATTITUDE.turn.smoothing

    def parameters(self) -> AttitudeParameters:
        """Parameters of the method, SI."""
        turn = SlowTurnParameters(radians(self.return_rate_deg_s), self.return_time_s, self.return_smoothing_s)
        return AttitudeParameters(rotation_gain=self.rotation_gain, turn=turn)


class BlendTable(_Method):
    """Method `blend`: see BlendParameters."""

    method: Literal["blend"] = "blend"
    align_rate_deg_s: TurnRate = _degrees(_BLEND.turn.rate)
    align_time_s: Duration = _BLEND.turn.time
    align_smoothing_s: Duration = _BLEND.turn.smoothing
    hold_force_m_s2: Annotated[float, number(0.0, 100.0)] = _BLEND.hold

    def parameters(self) -> BlendParameters:
        """Parameters of the method, SI."""
        turn = SlowTurnParameters(radians(self.align_rate_deg_s), self.align_time_s, self.align_smoothing_s)
        return BlendParameters(rotation_gain=self.rotation_gain, hold=self.hold_force_m_s2, turn=turn)


METHODS: dict[str, type[_Method]] = {"attitude": AttitudeTable, "blend": BlendTable}
DEFAULT_METHOD = "blend"


def _method(value: Any) -> Any:
    return value.get("method", DEFAULT_METHOD) if isinstance(value, dict) else getattr(value, "method", DEFAULT_METHOD)


CueingTable: TypeAlias = Annotated[
    Annotated[AttitudeTable, Tag("attitude")] | Annotated[BlendTable, Tag("blend")],
    Discriminator(_method),
]
