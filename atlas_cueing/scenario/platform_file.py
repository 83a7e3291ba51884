"""The platform file: geometry, limits and where the rider's head is."""

from functools import cache, lru_cache
from pathlib import Path
from typing import Annotated, Any, TypeAlias
from unicodedata import category, normalize

from pydantic import BeforeValidator, ValidationInfo, field_validator, model_validator

from ..errors import InputError
from ..rotation import ZERO, Vec3, add, norm
from ..signals import StageLimits, WheelLimits
from ..wheels import Geometry, OmniWheel
from .tables import (
    ONE_OR_THREE,
    THREE,
    Finite,
    ScenarioTable,
    check_text,
    number,
    object_to,
    refuse,
)

Direction: TypeAlias = Annotated[tuple[Finite, Finite, Finite], THREE]
Length: TypeAlias = Annotated[float, number(0.001, 100.0)]  # m; from a bead to a gasometer
# squares and quotients of these stay far from overflow
Limit: TypeAlias = Annotated[float, number(1e-6, 1e6)]
Limits: TypeAlias = Annotated[tuple[Limit, Limit, Limit], ONE_OR_THREE]

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

    radius_m: Length


class WheelTable(ScenarioTable):
    """One `[[wheel]]`: directions in W, of any length."""

    contact: Direction
    drive: Direction
    radius_m: Length

    @model_validator(mode="after")
    def _is_a_wheel(self) -> "WheelTable":
        try:
            self.wheel()
        except InputError as error:
            raise object_to(str(error)) from None
        return self

    def wheel(self) -> OmniWheel:
        """The wheel with unit directions and a drive exactly tangent to the sphere."""
        return _wheel(self.contact, self.drive, self.radius_m)


@lru_cache(maxsize=64)  # of ten thousand platforms that a sweep makes, few have wheels of their own
def _wheel(contact: Vec3, drive: Vec3, radius: float) -> OmniWheel:
    # 0 and -0 are one key: the sum makes both 0, so that the wheel does not depend on which came
    # first
    return OmniWheel.along(add(contact, ZERO), add(drive, ZERO), radius)


class WheelLimitsTable(ScenarioTable):
    """`[wheel_limits]`: one number for all wheels, or one each."""

    speed_rad_s: Limits
    acceleration_rad_s2: Limits
    jerk_rad_s3: Limits


class StageLimitsTable(ScenarioTable):
    """`[stage_limits]`: one number for all axes of W, or one each.

    Travel is plus or minus from the centre.
    """

    travel_m: Limits
    speed_m_s: Limits
    acceleration_m_s2: Limits
    jerk_m_s3: Limits


class RiderTable(ScenarioTable):
    """`[rider]`: where the head is, from the sphere centre, in S."""

    head_m: Annotated[tuple[Finite, Finite, Finite], THREE] = (0.0, 0.0, 0.0)


class Platform(ScenarioTable):
    """A platform file."""

    name: Annotated[str, NAME]
    sphere: SphereTable
    wheel: Annotated[tuple[WheelTable, WheelTable, WheelTable], THREE]
    wheel_limits: WheelLimitsTable
    stage_limits: StageLimitsTable
    rider: RiderTable = RiderTable()

    @field_validator("rider")
    @classmethod
    def _head_in_sphere(cls, rider: RiderTable, info: ValidationInfo) -> RiderTable:
        sphere = info.data.get("sphere")  # missing when it has mistakes of its own
        if sphere and norm(rider.head_m) > sphere.radius_m:
            raise refuse(f"head_m within the sphere, |head_m| <= {sphere.radius_m:g}")
        return rider

    def geometry(self) -> Geometry:
        """The kinematics; a singular one is refused by whoever needs the drive."""
        first, second, third = self.wheel
        return Geometry(
            self.name, self.sphere.radius_m, (first.wheel(), second.wheel(), third.wheel())
        )

    def wheel_limit_values(self) -> WheelLimits:
        """Limits of the wheels, SI."""
        table = self.wheel_limits
        return WheelLimits(table.speed_rad_s, table.acceleration_rad_s2, table.jerk_rad_s3)

    def stage_limit_values(self) -> StageLimits:
        """Limits of the stage, SI."""
        table = self.stage_limits
        return StageLimits(
            table.travel_m, table.speed_m_s, table.acceleration_m_s2, table.jerk_m_s3
        )

    @property
    def head_S(self) -> Vec3:
        """The rider's head from the sphere centre, m, in S."""
        return self.rider.head_m


def without_room(platform: Platform, dt: float) -> list[tuple[tuple[str, str], float, str]]:
    """Limits that leave no room to move between two ticks of dt s.

    (key, value, what is allowed).
    """
    wheels, stage = platform.wheel_limits, platform.stage_limits
    rows = (
        ("wheel_limits", "speed_rad_s", wheels.speed_rad_s, "jerk_rad_s3", wheels.jerk_rad_s3),
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
    return {path.stem: path for path in sorted((Path(__file__).parent / "presets").glob("*.toml"))}
