"""The tables of a platform file that loads need; all of them are optional.

A platform without `[[part]]` is kinematics only.
"""

from collections.abc import Sequence
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, model_validator

from ..loads import Drive, Part, Preload, Support, inertia_tensor, is_realizable
from ..rotation import ZERO, Vec3, add, norm, scale
from .tables import THREE, Finite, ScenarioTable, number, object_to, refuse, says

Direction: TypeAlias = Annotated[tuple[Finite, Finite, Finite], THREE]
Mass: TypeAlias = Annotated[float, number(0.0, 1e6, above=True)]  # kg
Force: TypeAlias = Annotated[float, number(0.0, 1e9)]  # N
Stiffness: TypeAlias = Annotated[float, number(1.0, 1e12)]  # N/m
Torque: TypeAlias = Annotated[float, number(0.0, 1e9, above=True)]  # N m
Inertia: TypeAlias = Annotated[float, number(0.0, 1e6)]  # kg m^2
Loss: TypeAlias = Annotated[float, number(0.0, 1e6)]  # N m or N m s
Friction: TypeAlias = Annotated[float, number(0.001, 10.0)]

_LONGEST = 100  # characters of a label
_MOST = 100  # tables of one kind; Atlas has 24 passive wheels


def _several(value: Any) -> Any:
    if not isinstance(value, list | tuple) or not 1 <= len(value) <= _MOST:
        raise refuse(f"1 to {_MOST} tables")
    return tuple(value)


SEVERAL = BeforeValidator(_several)


def _three_or_six(value: Any) -> Any:
    if not isinstance(value, list | tuple) or len(value) not in (3, 6):
        raise refuse(
            "a list of three (xx, yy, zz) or six (xx, yy, zz, xy, xz, yz) elements of the tensor"
        )
    return tuple(value)


def _label(value: Any) -> str:
    if not isinstance(value, str) or not 0 < len(value) <= _LONGEST or not value.isprintable():
        raise refuse(f"a text of 1 to {_LONGEST} printable characters")
    return value


Label: TypeAlias = Annotated[str, BeforeValidator(_label)]


class PartTable(ScenarioTable):
    """One `[[part]]`: mass, centre of mass from the sphere centre in S, inertia about it.

    The inertia has the elements xx, yy, zz of the tensor, and xy, xz, yz if there are six.
    """

    name: Annotated[Label | None, says("what the part is called")] = None
    mass_kg: Annotated[Mass, says("mass of the part")]
    com_m: Annotated[Direction, says("its centre of mass from the centre of the sphere, in S")] = (
        ZERO
    )
    inertia_kg_m2: Annotated[
        tuple[Finite, ...],
        BeforeValidator(_three_or_six),
        says("its inertia about its own centre of mass, axes S"),
    ]

    @model_validator(mode="after")
    def _is_a_body(self) -> "PartTable":
        if max(map(abs, self.inertia_kg_m2)) > 1e9:
            raise object_to("inertia_kg_m2: allowed: elements within +-1e9")
        if not is_realizable(inertia_tensor(self.inertia_kg_m2)):
            raise object_to(
                f"inertia_kg_m2 = {list(self.inertia_kg_m2)} belongs to no rigid body, allowed:"
                " principal moments >= 0, none larger than the sum of the other two"
            )
        return self

    def part(self) -> Part:
        """The part, SI, frame S."""
        return Part(self.mass_kg, self.com_m, inertia_tensor(self.inertia_kg_m2))


class DriveTable(ScenarioTable):
    """`[drive]`: motor and gear of each wheel, torques and losses at its axle.

    torque_rms_n_m is compared with the rms over a whole run, however short, so it is for flights
    that are long against what heats a motor; the presets leave it out.
    """

    torque_n_m: Annotated[Torque | None, says("largest torque at the axle")] = None
    torque_rms_n_m: Annotated[Torque | None, says("largest rms torque at the axle over a run")] = (
        None
    )
    motor_speed_rad_s: Annotated[
        Annotated[float, number(1e-3, 1e6)] | None, says("largest speed of the motor")
    ] = None
    motor_inertia_kg_m2: Annotated[Inertia | None, says("inertia of the rotor")] = None
    gear: Annotated[
        Annotated[float, number(1e-3, 1e4)] | None, says("turns of the motor for one of the axle")
    ] = None
    efficiency: Annotated[
        Annotated[float, number(0.01, 1.0)] | None, says("efficiency of the gear")
    ] = None
    regeneration: Annotated[bool | None, says("whether power flows back into the supply")] = None
    viscous_n_m_s: Annotated[Loss | None, says("viscous loss at the axle")] = None
    coulomb_n_m: Annotated[Loss | None, says("dry friction at the axle")] = None

    def drive(self) -> Drive:
        """Motor and gear, with the defaults of `loads.Drive`."""
        return Drive(
            self.torque_n_m,
            self.torque_rms_n_m,
            self.motor_speed_rad_s,
            self._gear,
            1.0 if self.efficiency is None else self.efficiency,
            self.regeneration is not False,
        )

    @property
    def _gear(self) -> float:
        return 1.0 if self.gear is None else self.gear

    @property
    def reflected_inertia(self) -> float:
        """Inertia of the motor at the axle, G^2 J, kg m^2."""
        return self._gear**2 * (self.motor_inertia_kg_m2 or 0.0)


class PreloadTable(ScenarioTable):
    """One `[[preload]]`: a constant force towards the centre, as of a pneumatic halo."""

    contact: Annotated[Direction, says("where the force acts, direction from the centre in W")]
    force_n: Annotated[Force, says("constant force towards the centre")]

    def preload(self) -> Preload:
        """The preload, with a unit direction."""
        return Preload(_unit(self.contact), self.force_n)

    @model_validator(mode="after")
    def _has_a_direction(self) -> "PreloadTable":
        _check_direction(self.contact)
        return self


class SupportTable(ScenarioTable):
    """One `[[support]]`: a passive wheel on a spring; its force with the sphere in its place."""

    contact: Annotated[
        Direction, says("where the passive wheel is, direction from the centre in W")
    ]
    stiffness_n_m: Annotated[Stiffness, says("stiffness of its spring")]
    preload_n: Annotated[Force, says("its force with the sphere in its place")] = 0.0

    def support(self) -> Support:
        """The support, with a unit direction."""
        return Support(_unit(self.contact), self.stiffness_n_m, self.preload_n)

    @model_validator(mode="after")
    def _has_a_direction(self) -> "SupportTable":
        _check_direction(self.contact)
        return self


class TractionTable(ScenarioTable):
    """`[traction]`: reserve of friction to keep, and whether slip and lift-off are findings."""

    margin: Annotated[
        float,
        number(1.0, 100.0),
        says("reserve of friction to keep: what is there over what is needed"),
    ] = 1.25
    report: Annotated[
        Literal["remark", "finding"], says("whether slip and lift-off are remarks or findings")
    ] = "remark"


def missing_keys(wheels: Sequence[Any], supports: Any) -> list[str]:
    """Keys of wheels that loads need and that are not there."""
    missing = [f"wheel.{k}.friction" for k, wheel in enumerate(wheels) if wheel.friction is None]
    soft = [k for k, wheel in enumerate(wheels) if supports and wheel.stiffness_n_m is None]
    return [*missing, *(f"wheel.{k}.stiffness_n_m" for k in soft)]


def _check_direction(contact: Vec3) -> None:
    if not 1e-150 < norm(contact) < float("inf"):
        raise object_to(
            f"contact = {list(contact)} has no direction, allowed: finite and not all zero"
        )


def _unit(contact: Vec3) -> Vec3:
    return add(scale(1.0 / norm(contact), contact), ZERO)  # adding 0 takes the sign off -0
