"""What touches the sphere: driven wheels, constant preloads and passive elastic supports.

Directions are unit vectors in W from the sphere centre to the contact point, as in
`wheels.OmniWheel`.
"""

from dataclasses import dataclass

from ..rotation import Vec3


@dataclass(frozen=True, slots=True)
class WheelContact:
    """One driven wheel, as its loads need it.

    contact, drive: unit vectors as in `wheels.OmniWheel`; radius: the effective one, m: a Mecanum
    wheel's radius times the cosine of the angle between roller axis and rim direction.
    friction: coefficient of the contact. inertia: of wheel, rollers, gear and motor, reflected to
    the axle, kg m^2. viscous, coulomb: losses at the axle, N m s and N m. stiffness: of the
    suspension along the contact, N/m; only ratios between contacts matter. load_limit: N, or None.
    """

    contact: Vec3
    drive: Vec3
    radius: float
    friction: float
    inertia: float = 0.0
    viscous: float = 0.0
    coulomb: float = 0.0
    stiffness: float = 1.0
    load_limit: float | None = None


@dataclass(frozen=True, slots=True)
class Preload:
    """A constant force of `force` N towards the centre at `contact`, as of a pneumatic halo."""

    contact: Vec3
    force: float


@dataclass(frozen=True, slots=True)
class Support:
    """A passive wheel or ball transfer on a spring.

    stiffness: N/m; preload: its force with the sphere in its place, N.
    """

    contact: Vec3
    stiffness: float
    preload: float = 0.0


@dataclass(frozen=True, slots=True)
class Drive:
    """Motor and gear of each wheel; None where the platform names no limit.

    torque, torque_rms: largest at the axle, peak and thermal, N m. motor_speed: largest, rad/s.
    gear: motor turns for one of the wheel. efficiency: of gear and motor, 0 to 1. regeneration:
    whether power goes back to the supply; without it a brake resistor takes it.
    """

    torque: float | None = None
    torque_rms: float | None = None
    motor_speed: float | None = None
    gear: float = 1.0
    efficiency: float = 1.0
    regeneration: bool = True


UNLIMITED = Drive()
"""A drive whose platform names no limit."""
