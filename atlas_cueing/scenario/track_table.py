"""The `[vehicle]` table of a rider on a track."""

from math import radians
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator

from ..vehicles import Car, TrackFlight
from .mistakes import Key
from .source_table import MOST_TABLES, SourceTable
from .tables import THREE, number, refuse, says, whole

_Place: TypeAlias = Annotated[float, number(-1e5, 1e5)]
_Point: TypeAlias = Annotated[tuple[_Place, _Place, _Place], THREE]
_Speed: TypeAlias = Annotated[float, number(0.0, 200.0)]
_Bank: TypeAlias = Annotated[float, number(-3600.0, 3600.0)]
DEFAULT_RATE_HZ = 120.0


def _list(value: Any) -> Any:
    if not isinstance(value, list | tuple) or len(value) > MOST_TABLES:
        raise refuse(f"a list of at most {MOST_TABLES}")
    return tuple(value)


class TrackTable(SourceTable):
    """`[vehicle]` of a track: points x forward, y left, z up, m, which a smooth curve goes through.

    bank_deg: one for each point, right side down; left out: no side force. closed: whether the last
    point leads to the first. friction: rolling, of the force across the track. drag_per_m: c of
    a = c v^2. lift_speed_m_s: a chain keeps the car from being slower. head_m: of the rider from
    the track, forward, right, down.
    """

    source: Annotated[Literal["track"], says("rides along a track of points")] = "track"
    points_m: Annotated[
        Annotated[tuple[_Point, ...], BeforeValidator(_list)] | None,
        says("points of the track: x forward, y left, z up"),
    ] = None
    bank_deg: Annotated[
        Annotated[tuple[_Bank, ...], BeforeValidator(_list)] | None,
        says("bank at each point, right side down; left out: no side force"),
    ] = None
    closed: Annotated[bool | None, says("whether the last point leads to the first")] = None
    laps: Annotated[Annotated[int, whole(1, 1000)] | None, says("rounds of a closed track")] = None
    speed_m_s: Annotated[_Speed | None, says("speed at the first point")] = None
    friction: Annotated[
        Annotated[float, number(0.0, 1.0)] | None, says("coefficient of rolling friction")
    ] = None
    drag_per_m: Annotated[
        Annotated[float, number(0.0, 1.0)] | None, says("drag over mass and squared speed, 1/m")
    ] = None
    lift_speed_m_s: Annotated[_Speed | None, says("least speed, as on a lift hill")] = None
    head_m: Annotated[
        Annotated[tuple[_Place, _Place, _Place], THREE] | None,
        says("rider's head from the track, axes B"),
    ] = None
    rate_hz: Annotated[Annotated[float, number(10.0, 1000.0)] | None, says("states a second")] = (
        None
    )

    def flight(self, folder: Path) -> TrackFlight:
        """Return the track in SI."""
        _ = folder
        car = Car(
            self.speed_m_s or 0.0,
            self.friction or 0.0,
            self.drag_per_m or 0.0,
            self.lift_speed_m_s or 0.0,
            self.head_m or (0.0, 0.0, 0.0),
        )
        bank = None if self.bank_deg is None else tuple(map(radians, self.bank_deg))
        rate_hz = self.rate_hz or DEFAULT_RATE_HZ
        return TrackFlight(
            self.points_m or (), car, bank, self.closed is True, self.laps or 1, rate_hz
        )

    @classmethod
    def rules(cls, vehicle: dict[str, Any], data: dict[str, Any]) -> list[tuple[Key, str]]:
        """Find what is missing, and what does not go together."""
        _ = data
        found: list[tuple[Key, str]] = []
        if "points_m" not in vehicle:
            found.append((("vehicle", "points_m"), "missing, the points of the track"))
        if not vehicle.get("speed_m_s") and not vehicle.get("lift_speed_m_s"):
            found.append(
                (("vehicle", "speed_m_s"), "missing, or lift_speed_m_s: a car at rest stays there")
            )
        if "laps" in vehicle and vehicle.get("closed") is not True:
            found.append((("vehicle", "laps"), "only with closed = true"))
        return found
