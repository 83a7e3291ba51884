"""The platform file: geometry, limits and where the rider's head is."""

from functools import cache
from pathlib import Path
from typing import Annotated, TypeAlias

from pydantic import ValidationInfo, field_validator, model_validator

from ..errors import InputError
from ..loads import UNLIMITED, KeptRows, LoadModel, body_of
from ..rotation import Vec3, norm
from ..signals import StageLimits, WheelLimits
from ..wheels import Geometry
from .load_tables import (
    SEVERAL,
    DriveTable,
    PartTable,
    PreloadTable,
    SupportTable,
    TractionTable,
    missing_keys,
)
from .plant_table import PlantTable
from .platform_name import NAME
from .tables import (
    ONE_OR_THREE,
    THREE,
    WHEELS,
    Finite,
    ScenarioTable,
    object_to,
    refuse,
    says,
)
from .wheel_tables import Length, Limit, LimitsOfEach, WheelLimitsTable, WheelTable, of_each

# of the wheels' acceleration, for the stop that keeps traction: the sphere has no travel (assumed)
_SOFT_WHEEL_SHARE = 1.0 / 16.0
# of the stage's, likewise: its full acceleration may lift a wheel by itself (assumed)
_SOFT_STAGE_SHARE = 0.3

Limits: TypeAlias = Annotated[tuple[Limit, Limit, Limit], ONE_OR_THREE]


class SphereTable(ScenarioTable):
    """`[sphere]`."""

    radius_m: Annotated[Length, says("radius of the sphere")]


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

    @field_validator("wheel")
    @classmethod
    def _rows_meet_the_sphere(
        cls, wheels: tuple[WheelTable, ...], info: ValidationInfo
    ) -> tuple[WheelTable, ...]:
        sphere = info.data.get("sphere")  # missing when it has mistakes of its own
        most = max((wheel.row_offset_m or 0.0 for wheel in wheels), default=0.0)
        if sphere and not most < sphere.radius_m:
            raise object_to(
                f"row_offset_m = {most:g} puts a row of rollers beside the sphere, allowed: less"
                f" than sphere.radius_m = {sphere.radius_m:g}"
            )
        return wheels

    @field_validator("wheel_limits")
    @classmethod
    def _fit_the_wheels(cls, limits: WheelLimitsTable, info: ValidationInfo) -> WheelLimitsTable:
        count = len(info.data.get("wheel", ()))
        values = (limits.speed_rad_s, limits.acceleration_rad_s2, limits.jerk_rad_s3)
        if count and not all(of_each(limit, count) for limit in values):
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
            wanted = " for traction.keep = true" if self._keeps_traction else ""
            raise InputError(
                f"platform {self.name!r} has no masses{wanted}; give it [[part]] tables (mass_kg,"
                " com_m, inertia_kg_m2), and each [[wheel]] its friction"
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
            _SOFT_WHEEL_SHARE if self._keeps_traction else 1.0,
        )

    def limits_of_each_wheel(self) -> LimitsOfEach:
        """Limits of the wheels, however many, SI."""
        table = self.wheel_limits
        values = (table.speed_rad_s, table.acceleration_rad_s2, table.jerk_rad_s3)
        return LimitsOfEach(*(of_each(limit, len(self.wheel)) for limit in values))

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
            _SOFT_STAGE_SHARE if self._keeps_traction else 1.0,
        )

    @property
    def _keeps_traction(self) -> bool:
        return self.traction is not None and self.traction.keep is True

    @property
    def head_S(self) -> Vec3:
        """The rider's head from the sphere centre, m, in S."""
        return self.rider.head_m


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
