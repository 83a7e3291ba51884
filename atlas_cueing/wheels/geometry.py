"""Where omnidirectional wheels touch a sphere, and what follows from it (paper, section 3.1).

| paper | here | unit |
|---|---|---|
| R, r_i | `Geometry.sphere_radius`, `OmniWheel.radius` | m |
| R-hat_i, v-hat_ai | `OmniWheel.contact`, `OmniWheel.drive`, unit vectors in W | - |
| Omega-hat_i (Eq. 11) | `OmniWheel.induced`, row i of `Geometry.induced_rows` | - |
| J (Eq. 18), J^-1 (Eq. 22) | `Geometry.sphere_from_wheels`, `Geometry.wheels_from_sphere` | - |

The paper has three wheels, and so has what flies. With more of them J^-1 has a row for each, and J
= B^+ diag(r) / R is the left inverse whose transpose gives the torques of the least drive forces.
"""

from dataclasses import dataclass

import numpy as np

from ..errors import InputError, SlipConditionError
from ..rotation import Vec3, cross, dot, norm, scale, subtract

# A drive direction typed with three decimals is off its tangent by up to 1e-3; beyond that the file
# means something else.
TANGENT_TOLERANCE = 1e-3

# From here on a wheel speed error of 1e-6 becomes a sphere rate error of order one: no drive can
# turn that sphere.
LARGEST_CONDITION_NUMBER = 1e6


@dataclass(frozen=True, slots=True)
class OmniWheel:
    """One omnidirectional wheel.

    contact: unit vector from the sphere centre, W; drive: unit vector tangent to the sphere, W;
    radius in m.
    """

    contact: Vec3
    drive: Vec3
    radius: float

    @classmethod
    def along(cls, contact: Vec3, drive: Vec3, radius: float) -> "OmniWheel":
        """Wheel from two directions of any length.

        What is left of `drive` off the tangent plane is taken out.

        Raises InputError when a direction has no length or `drive` misses the tangent plane by more
        than TANGENT_TOLERANCE.
        """
        R, v = _unit("contact", contact), _unit("drive", drive)
        off = dot(R, v)
        if abs(off) > TANGENT_TOLERANCE:
            raise InputError(
                f"drive must be tangent to the sphere: |contact . drive| = {abs(off):.3g} of unit"
                f" vectors, allowed: 0 <= |contact . drive| <= {TANGENT_TOLERANCE:g}"
            )
        return cls(R, _unit("drive", subtract(v, scale(off, R))), radius)

    @property
    def induced(self) -> Vec3:
        """Unit angular velocity that this wheel induces, in W (Eq. 11)."""
        return cross(self.contact, self.drive)


@dataclass(frozen=True, slots=True)
class Geometry:
    """A sphere of `sphere_radius` (m) on three wheels or more; `name` is for messages."""

    name: str
    sphere_radius: float
    wheels: tuple[OmniWheel, ...]

    @property
    def induced_rows(self) -> tuple[Vec3, ...]:
        """The induced unit angular velocities as rows (Omega-hat transposed, Eq. 14)."""
        return tuple(wheel.induced for wheel in self.wheels)

    @property
    def determinant(self) -> float:
        """Determinant of the induced rows B of three wheels: 0 when singular, at most 1 in size.

        Of more wheels it is sqrt(det(B^T B)), the same volume without a sign.
        """
        if len(self.wheels) == 3:
            a, b, c = self.induced_rows
            return dot(a, cross(b, c))
        B = np.array(self.induced_rows)
        return float(np.sqrt(max(np.linalg.det(B.T @ B), 0.0)))

    @property
    def condition_number(self) -> float:
        """Ratio of the largest to the smallest singular value of the induced rows.

        1 at best, up to infinity.
        """
        return float(np.linalg.cond(np.array(self.induced_rows)))

    @property
    def slip_free(self) -> bool:
        """Whether the kinematic slip condition holds: independent induced rows (section 3.1)."""
        return self.condition_number <= LARGEST_CONDITION_NUMBER

    @property
    def wheels_from_sphere(self) -> tuple[Vec3, ...]:
        """J^-1 (Eq. 22): wheel speeds from `w_WS_W`; it exists for singular geometries too."""
        R = self.sphere_radius
        return tuple(scale(R / wheel.radius, wheel.induced) for wheel in self.wheels)

    @property
    def sphere_from_wheels(self) -> tuple[tuple[float, ...], ...]:
        """J (Eq. 18): `w_WS_W` from wheel speeds, three rows.

        Raises SlipConditionError for a singular geometry.
        """
        if not self.slip_free:
            raise SlipConditionError(
                self.name, self.determinant, self.condition_number, LARGEST_CONDITION_NUMBER
            )
        if len(self.wheels) > 3:
            radii = np.array([wheel.radius for wheel in self.wheels]) / self.sphere_radius
            left = np.linalg.pinv(np.array(self.induced_rows)) * radii
            return tuple(tuple(row) for row in left.tolist())
        a, b, c = self.induced_rows
        # The inverse of a matrix with rows a, b, c has the columns b x c, c x a, a x b over its
        # determinant.
        columns = zip((cross(b, c), cross(c, a), cross(a, b)), self.wheels, strict=True)
        scaled = [
            scale(wheel.radius / (self.sphere_radius * self.determinant), column)
            for column, wheel in columns
        ]
        return tuple(zip(*scaled, strict=True))


def _unit(name: str, v: Vec3) -> Vec3:
    """Unit vector along v; InputError when it has no direction."""
    length = norm(v)
    if not 0.0 < length < float("inf"):
        raise InputError(f"{name} = {list(v)} has no direction, allowed: finite and not all zero")
    return scale(1.0 / length, v)
