"""The platform file: geometry, limits and where the rider's head is."""

from dataclasses import dataclass
from functools import cache, lru_cache
from math import cos, radians
from pathlib import Path
from typing import Annotated, Any, TypeAlias
from unicodedata import category, normalize

from pydantic import BeforeValidator, ValidationInfo, field_validator, model_validator

from ..errors import InputError
from ..loads import UNLIMITED, KeptRows, LoadModel, WheelContact, body_of
from ..rotation import ZERO, Vec3, add, norm
from ..signals import SOFT_STAGE_SHARE, SOFT_WHEEL_SHARE, StageLimits, WheelLimits
from ..wheels import Geometry, OmniWheel, RollerRows
from .load_tables import (
    SEVERAL,
    DriveTable,
    Force,
    Friction,
    Inertia,
    PartTable,
    PreloadTable,
    Stiffness,
    SupportTable,
    TractionTable,
    missing_keys,
)
from .plant_table import PlantTable
from .tables import (
    ONE_OR_EACH,
    ONE_OR_THREE,
    THREE,
    WHEELS,
    Finite,
    ScenarioTable,
    check_text,
    number,
    object_to,
    refuse,
    says,
    whole,
)

Direction: TypeAlias = Annotated[tuple[Finite, Finite, Finite], THREE]
Length: TypeAlias = Annotated[float, number(0.001, 100.0)]  # m; from a bead to a gasometer
# squares and quotients of these stay far from overflow
Limit: TypeAlias = Annotated[float, number(1e-6, 1e6)]
Limits: TypeAlias = Annotated[tuple[Limit, Limit, Limit], ONE_OR_THREE]
LimitsOfWheels: TypeAlias = Annotated[tuple[Limit, ...], ONE_OR_EACH]

_LONGEST_NAME = 100  # characters, and ...
_LONGEST_NAME_BYTES = 200  # ... bytes in UTF-8: names of files, which it begins, end at 255
_LETTERS = ("L", "M", "Nd")  # categories of Unicode: letters, marks upon them, digits


def _name(value: Any) -> str:
    """A name, composed (NFC), so that what looks the same is the same."""
    allowed = "letters and digits of any alphabet, '.', '_', '-', not beginning with '.' or a mark"
    allowed += f", at most {_LONGEST_NAME} characters and {_LONGEST_NAME_BYTES} bytes"
    check_text(value, allowed)
    name = normalize("NFC", value)
    if not 0 < len(name) <= _LONGEST_NAME or not all(map(_is_name_part, name)):
        raise refuse(allowed)
    if (
        name[0] == "."
        or category(name[0]).startswith("M")
        or len(name.encode()) > _LONGEST_NAME_BYTES
    ):
        raise refuse(allowed)
    return name


def _is_name_part(character: str) -> bool:
    return character in "._-" or category(character).startswith(_LETTERS)


NAME = BeforeValidator(_name)


class SphereTable(ScenarioTable):
    """`[sphere]`."""

    radius_m: Annotated[Length, says("radius of the sphere")]


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


class StageLimitsTable(ScenarioTable):
    """`[stage_limits]`: one number for all axes of W, or one each.

    Travel is plus or minus from the centre.
    """

    travel_m: Annotated[Limits, says("travel to each side of the centre, along W")]
    speed_m_s: Annotated[Limits, says("largest speed of the stage")]
    acceleration_m_s2: Annotated[Limits, says("largest acceleration of the stage")]
    jerk_m_s3: Annotated[Limits, says("largest jerk of the stage")]


class RiderTable(ScenarioTable):
    """`[rider]`: where the head is, from the sphere centre, in S."""

    head_m: Annotated[
        tuple[Finite, Finite, Finite],
        THREE,
        says("rider's head from the centre of the sphere, in S"),
    ] = (0.0, 0.0, 0.0)


class Platform(ScenarioTable):
    """A platform file."""

    name: Annotated[str, NAME, says("name of the platform")]
    sphere: SphereTable
    wheel: Annotated[tuple[WheelTable, ...], WHEELS]
    wheel_limits: WheelLimitsTable
    stage_limits: StageLimitsTable
    rider: RiderTable = RiderTable()
    drive: DriveTable | None = None
    preload: Annotated[tuple[PreloadTable, ...], SEVERAL] | None = None
    support: Annotated[tuple[SupportTable, ...], SEVERAL] | None = None
    traction: TractionTable | None = None
    plant: PlantTable | None = None
    part: Annotated[tuple[PartTable, ...], SEVERAL] | None = None

    @field_validator("wheel_limits")
    @classmethod
    def _fit_the_wheels(cls, limits: WheelLimitsTable, info: ValidationInfo) -> WheelLimitsTable:
        count = len(info.data.get("wheel", ()))
        values = (limits.speed_rad_s, limits.acceleration_rad_s2, limits.jerk_rad_s3)
        if count and not all(_of_each(limit, count) for limit in values):
            raise refuse(f"a number, or a list of {count}: one for each wheel")
        return limits

    @field_validator("rider")
    @classmethod
    def _head_in_sphere(cls, rider: RiderTable, info: ValidationInfo) -> RiderTable:
        sphere = info.data.get("sphere")  # missing when it has mistakes of its own
        if sphere and norm(rider.head_m) > sphere.radius_m:
            raise refuse(f"head_m within the sphere, |head_m| <= {sphere.radius_m:g}")
        return rider

    @field_validator("part")
    @classmethod
    def _parts_in_sphere(
        cls, parts: tuple[PartTable, ...] | None, info: ValidationInfo
    ) -> tuple[PartTable, ...] | None:
        sphere = info.data.get("sphere")
        if sphere and any(norm(part.com_m) > sphere.radius_m for part in parts or ()):
            raise refuse(f"every com_m within the sphere, |com_m| <= {sphere.radius_m:g}")
        names = [part.name for part in parts or () if part.name is not None]
        if twice := sorted({name for name in names if names.count(name) > 1}):
            raise object_to(f"two parts are called {twice[0]!r}, allowed: a name of its own each")
        missing = missing_keys(info.data.get("wheel", ()), info.data.get("support"))
        if parts and missing:
            raise object_to(f"with [[part]] there have to be {', '.join(missing)} too")
        return parts

    @model_validator(mode="after")
    def _has_definite_loads(self) -> "Platform":
        if self.has_loads:
            try:
                self.load_model()
            except InputError as error:
                raise object_to(str(error)) from None
        return self

    @property
    def has_loads(self) -> bool:
        """Whether loads are known: the platform has masses, and its wheels can turn it."""
        return self.part is not None and self.geometry().slip_free

    def kept_rows(self) -> KeptRows | None:
        """What motions have to keep, where `[traction] keep = true`. Raises InputError."""
        if not self._keeps_traction:
            return None
        return self.load_model().kept_rows()

    def load_model(self) -> LoadModel:
        """What the loads depend on.

        Raises InputError for a platform without masses, and for contacts that cannot hold a force
        along every axis.
        """
        if self.part is None:
            raise InputError(
                f"platform {self.name!r} has no masses; give it [[part]] tables (mass_kg, com_m,"
                " inertia_kg_m2), and each [[wheel]] its friction"
            )
        drive, traction = self.drive or DriveTable(), self.traction or TractionTable()
        model = LoadModel(
            name=self.name,
            sphere_radius=self.sphere.radius_m,
            body=body_of([part.part() for part in self.part]),
            wheels=tuple(wheel.load_contact(drive) for wheel in self.wheel),
            preloads=tuple(each.preload() for each in self.preload or ()),
            supports=tuple(each.support() for each in self.support or ()),
            drive=self.drive.drive() if self.drive else UNLIMITED,
            traction_margin=traction.margin,
            traction_finding=traction.report == "finding",
            traction_kept=traction.keep is True,
        )
        model.check()
        return model

    def geometry(self) -> Geometry:
        """The kinematics; a singular one is refused by whoever needs the drive."""
        wheels = tuple(wheel.wheel() for wheel in self.wheel)
        return Geometry(self.name, self.sphere.radius_m, wheels)

    def wheel_limit_values(self) -> WheelLimits:
        """Limits of three wheels, SI. Raises InputError for any other number of them."""
        each = self.limits_of_each_wheel()
        return WheelLimits(
            self._three(each.speed),
            self._three(each.acceleration),
            self._three(each.jerk),
            SOFT_WHEEL_SHARE if self._keeps_traction else 1.0,
        )

    def limits_of_each_wheel(self) -> LimitsOfEach:
        """Limits of the wheels, however many, SI."""
        table = self.wheel_limits
        values = (table.speed_rad_s, table.acceleration_rad_s2, table.jerk_rad_s3)
        return LimitsOfEach(*(_of_each(limit, len(self.wheel)) for limit in values))

    def _three(self, limits: tuple[float, ...]) -> Vec3:
        if len(limits) != 3:
            raise InputError(
                f"platform {self.name!r} has {len(self.wheel)} wheels, allowed in a run: 3"
            )
        first, second, third = limits
        return (first, second, third)

    def stage_limit_values(self) -> StageLimits:
        """Limits of the stage, SI."""
        table = self.stage_limits
        return StageLimits(
            table.travel_m,
            table.speed_m_s,
            table.acceleration_m_s2,
            table.jerk_m_s3,
            SOFT_STAGE_SHARE if self._keeps_traction else 1.0,
        )

    @property
    def _keeps_traction(self) -> bool:
        return self.traction is not None and self.traction.keep is True

    @property
    def head_S(self) -> Vec3:
        """The rider's head from the sphere centre, m, in S."""
        return self.rider.head_m


def _of_each(limits: tuple[float, ...], count: int) -> tuple[float, ...]:
    """Limits of `count` wheels: one each, or one number, which three stand for; () for others."""
    if len(limits) == count:
        return limits
    return limits[:1] * count if limits == limits[:1] * 3 else ()


def without_room(platform: Platform, dt: float) -> list[tuple[tuple[str, str], float, str]]:
    """Limits that leave no room to move between two ticks of dt s.

    (key, value, what is allowed).
    """
    wheels, stage = platform.limits_of_each_wheel(), platform.stage_limits
    rows = (
        ("wheel_limits", "speed_rad_s", wheels.speed, "jerk_rad_s3", wheels.jerk),
        ("stage_limits", "speed_m_s", stage.speed_m_s, "jerk_m_s3", stage.jerk_m_s3),
        ("stage_limits", "travel_m", stage.travel_m, "acceleration_m_s2", stage.acceleration_m_s2),
    )
    found = []
    for table, key, values, steeper, others in rows:
        for value, other in dict.fromkeys(zip(values, others, strict=True)):
            least = other * dt * dt / 8.0  # between two ticks it swings by that much
            if not value > least:
                allowed = (
                    f"value > {least:.3g}, which is {steeper} ({other:g}) dt^2 / 8 at"
                    f" {1.0 / dt:g} Hz"
                )
                found.append(((table, key), value, f"allowed: {allowed}"))
    return found


@cache
def presets() -> dict[str, Path]:
    """The platforms that ship with the package: name to file."""
    files = {path.stem: path for path in (Path(__file__).parent / "presets").glob("*.toml")}
    return dict(sorted(files.items()))
