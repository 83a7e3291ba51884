"""The `[vehicle]` table of a free rigid body."""

from math import radians
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from ..rotation import Vec3, from_euler
from ..vehicles import RigidBodyFlight
from .mistakes import Key
from .source_table import SourceTable
from .tables import THREE, number, says

DEFAULT_RATE_HZ = 120.0
_Moment: TypeAlias = Annotated[float, number(0.0, 1e12, above=True)]
_Rate: TypeAlias = Annotated[float, number(-2500.0, 2500.0)]
_Arm: TypeAlias = Annotated[float, number(-1000.0, 1000.0)]
_Angle: TypeAlias = Annotated[float, number(-360.0, 360.0)]
Three: TypeAlias = tuple[float, float, float]


class RigidBodyTable(SourceTable):
    """`[vehicle]` of a free rigid body: moments and rates about its forward, right and down axes.

    seat_m: the rider's head from the centre of gravity. free_fall: false for a body held up there.
    attitude_deg: roll, pitch and heading at the start.
    """

    source: Annotated[Literal["rigid_body"], says("tumbles a rigid body without torque")] = (
        "rigid_body"
    )
    inertia_kg_m2: Annotated[
        Annotated[tuple[_Moment, _Moment, _Moment], THREE] | None,
        says("principal moments about its forward, right and down axes"),
    ] = None
    initial_rate_deg_s: Annotated[
        Annotated[tuple[_Rate, _Rate, _Rate], THREE] | None, says("body rates at the start")
    ] = None
    attitude_deg: Annotated[
        Annotated[tuple[_Angle, _Angle, _Angle], THREE] | None,
        says("roll, pitch and heading at the start"),
    ] = None
    seat_m: Annotated[
        Annotated[tuple[_Arm, _Arm, _Arm], THREE] | None,
        says("rider's head from the centre of gravity, axes B"),
    ] = None
    free_fall: Annotated[bool | None, says("false: held up against gravity")] = None
    rate_hz: Annotated[Annotated[float, number(10.0, 1000.0)] | None, says("states a second")] = (
        None
    )

    def flight(self, folder: Path) -> RigidBodyFlight:
        """Return the body in SI."""
        _ = folder
        assert self.inertia_kg_m2 is not None  # noqa: S101 - rules
        assert self.initial_rate_deg_s is not None  # noqa: S101 - rules
        roll, pitch, heading = map(radians, self.attitude_deg or (0.0, 0.0, 0.0))
        return RigidBodyFlight(
            self.inertia_kg_m2,
            _radians(self.initial_rate_deg_s),
            from_euler(heading, pitch, roll),
            self.seat_m or (0.0, 0.0, 0.0),
            self.free_fall is not False,
            self.rate_hz or DEFAULT_RATE_HZ,
        )

    @classmethod
    def rules(cls, vehicle: dict[str, Any], data: dict[str, Any]) -> list[tuple[Key, str]]:
        """Find what is missing, and moments that no body has."""
        needed = {
            "inertia_kg_m2": "principal moments about the forward, right and down axes",
            "initial_rate_deg_s": "body rates at the start",
        }
        found: list[tuple[Key, str]] = [
            (("vehicle", key), f"missing, {what}")
            for key, what in needed.items()
            if key not in vehicle
        ]
        if "duration_s" not in data:
            found.append((("duration_s",), "missing, a free body tumbles for ever"))
        objection = _objection(vehicle.get("inertia_kg_m2"))
        return [*found, *([(("vehicle", "inertia_kg_m2"), objection)] if objection else [])]


def _radians(degrees: Three) -> Vec3:
    a, b, c = map(radians, degrees)
    return (a, b, c)


def _objection(inertia: Any) -> str:
    """Say why no body has these moments; nothing for what is no list of numbers at all."""
    usable = isinstance(inertia, list | tuple) and len(inertia) == 3
    if not usable or not all(type(x) in (int, float) and 0 < x <= 1e12 for x in inertia):
        return ""
    a, b, c = map(float, inertia)
    return RigidBodyFlight((a, b, c), (0.0, 0.0, 0.0)).objection()
