"""The tables of a platform's wheels: where they are, what they are, and how fast they may turn."""

from dataclasses import dataclass
from functools import lru_cache
from math import cos, radians
from typing import Annotated, TypeAlias

from pydantic import model_validator

from ..errors import InputError
from ..loads import WheelContact
from ..rotation import ZERO, Vec3, add
from ..wheels import OmniWheel, RollerRows
from .load_tables import DriveTable, Force, Friction, Inertia, Stiffness
from .tables import ONE_OR_EACH, THREE, Finite, ScenarioTable, number, object_to, says, whole

Direction: TypeAlias = Annotated[tuple[Finite, Finite, Finite], THREE]
Length: TypeAlias = Annotated[float, number(0.001, 100.0)]  # m; from a bead to a gasometer
# squares and quotients of these stay far from overflow
Limit: TypeAlias = Annotated[float, number(1e-6, 1e6)]
LimitsOfWheels: TypeAlias = Annotated[tuple[Limit, ...], ONE_OR_EACH]


class WheelTable(ScenarioTable):
    """One `[[wheel]]`: directions in W, of any length.

    roller_deg: of a Mecanum wheel, the angle between roller axis (`drive`) and rim direction. The
    last three keys describe two rows of rollers; loads need friction.
    """

    contact: Annotated[
        Direction, says("direction of the contact from the centre of the sphere, in W")
    ]
    drive: Annotated[Direction, says("direction in which the wheel drives the sphere, in W")]
    radius_m: Annotated[Length, says("radius of the wheel")]
    roller_deg: Annotated[
        Annotated[float, number(0.0, 80.0)] | None,
        says("of a Mecanum wheel: angle between roller axis and rim"),
    ] = None
    inertia_kg_m2: Annotated[Inertia | None, says("inertia of the wheel about its axle")] = None
    friction: Annotated[Friction | None, says("coefficient of friction at the contact")] = None
    stiffness_n_m: Annotated[Stiffness | None, says("stiffness of contact and suspension")] = None
    load_limit_n: Annotated[Force | None, says("largest normal force")] = None
    row_offset_m: Annotated[
        Annotated[float, number(0.0, 10.0)] | None,
        says("of two rows of rollers: distance of a row from the middle"),
    ] = None
    roller_profile_radius_m: Annotated[
        Annotated[float, number(0.0, 10.0)] | None, says("radius of a roller's profile")
    ] = None
    rollers_per_row: Annotated[Annotated[int, whole(3, 1000)] | None, says("rollers in a row")] = (
        None
    )

    @model_validator(mode="after")
    def _is_a_wheel(self) -> "WheelTable":
        try:
            self.wheel()
        except InputError as error:
            raise object_to(str(error)) from None
        keys = (self.row_offset_m, self.roller_profile_radius_m, self.rollers_per_row)
        if None in keys and any(key is not None for key in keys):
            raise object_to(
                "allowed: all or none of row_offset_m, roller_profile_radius_m, rollers_per_row"
            )
        return self

    def wheel(self) -> OmniWheel:
        """The wheel with unit directions and a drive exactly tangent to the sphere."""
        return _wheel(self.contact, self.drive, self.effective_radius_m)

    @property
    def effective_radius_m(self) -> float:
        """The radius that turns the sphere along the drive: of a Mecanum wheel r cos(roller)."""
        if self.roller_deg is None:
            return self.radius_m
        return self.radius_m * cos(radians(self.roller_deg))

    @property
    def rows(self) -> RollerRows | None:
        """Its two rows of rollers; None for a wheel with one, or none described."""
        offset, profile = self.row_offset_m, self.roller_profile_radius_m
        if offset is None or profile is None or self.rollers_per_row is None:
            return None
        return RollerRows(offset, profile, self.rollers_per_row)

    def load_contact(self, drive: DriveTable) -> WheelContact:
        """The wheel as loads need it, with motor and losses of `drive`."""
        wheel = self.wheel()
        return WheelContact(
            wheel.contact,
            wheel.drive,
            wheel.radius,
            friction=self.friction or 0.0,
            inertia=(self.inertia_kg_m2 or 0.0) + drive.reflected_inertia,
            viscous=drive.viscous_n_m_s or 0.0,
            coulomb=drive.coulomb_n_m or 0.0,
            stiffness=self.stiffness_n_m or 1.0,
            load_limit=self.load_limit_n,
        )


@lru_cache(maxsize=64)  # of ten thousand platforms that a sweep makes, few have wheels of their own
def _wheel(contact: Vec3, drive: Vec3, radius: float) -> OmniWheel:
    # 0 and -0 are one key: the sum makes both 0, so that the wheel does not depend on which came
    # first
    return OmniWheel.along(add(contact, ZERO), add(drive, ZERO), radius)


class WheelLimitsTable(ScenarioTable):
    """`[wheel_limits]`: one number for all wheels, kept as three of them, or one each."""

    speed_rad_s: Annotated[LimitsOfWheels, says("largest speed of a wheel")]
    acceleration_rad_s2: Annotated[LimitsOfWheels, says("largest acceleration of a wheel")]
    jerk_rad_s3: Annotated[LimitsOfWheels, says("largest jerk of a wheel")]


@dataclass(frozen=True, slots=True)
class LimitsOfEach:
    """Limits of each wheel, however many: speed rad/s, acceleration rad/s^2, jerk rad/s^3."""

    speed: tuple[float, ...]
    acceleration: tuple[float, ...]
    jerk: tuple[float, ...]


def of_each(limits: tuple[float, ...], count: int) -> tuple[float, ...]:
    """Limits of `count` wheels: one each, or one number, which three stand for; () for others."""
    if len(limits) == count:
        return limits
    return limits[:1] * count if limits == limits[:1] * 3 else ()
