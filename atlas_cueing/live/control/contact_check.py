"""The guard's own check of traction and torque, where the platform keeps them.

It shares no arithmetic with what smoothing keeps: in W instead of S, with the moment about the
centre of mass, and drive forces F and the sphere's displacement d found at once from

    R (u_i x v_i) F_i               = M
    v_i F_i - (sum k_j u_j u_j^T) d = f - preloads + sum n0_j u_j        n_j = n0_j + k_j u_j . d

(j: wheels, then supports), by the inverse of the constant matrix on the left.
"""

# mypyc: runs every tick

from ...rotation import Mat3, Quat, Vec3, add, apply, conjugate, cross, dot, rotate, scale
from .certified_axis import ROUNDING, outside
from .command import Command

Six = tuple[float, float, float, float, float, float]

_GRAVITY = 9.80665  # m/s^2


class ContactCheck:
    """Friction, normal forces and torques of three wheels at one state."""

    def __init__(
        self,
        *,
        mass: float,
        com_S: Vec3,
        central_inertia_S: Mat3,
        sphere_from_wheels: Mat3,
        inverse: tuple[Six, Six, Six, Six, Six, Six],
        unloaded_W: Vec3,
        contacts: list[tuple[Vec3, float, float]],
        grip: Vec3,
        axles: list[tuple[float, float, float, float]],
        torque: float,
    ) -> None:
        """Keep the constants.

        Args:
            mass: kg.
            com_S: centre of mass from the sphere centre, m.
            central_inertia_S: about the centre of mass, kg m^2.
            sphere_from_wheels: J.
            inverse: of the matrix above.
            unloaded_W: what is added to f on its right, N.
            contacts: u_j, k_j (N/m) and n0_j (N), wheels first.
            grip: friction over margin.
            axles: of each wheel: radius, inertia, viscous and Coulomb loss, SI.
            torque: largest, N m.
        """
        self._mass, self._com, self._inertia = mass, com_S, central_inertia_S
        self._J, self._inverse, self._unloaded = sphere_from_wheels, inverse, unloaded_W
        self._contacts, self._grip = contacts, grip
        self._names = [
            f"wheel {j + 1} " if j < 3 else f"support {j - 2} " for j in range(len(contacts))
        ]
        self._axles, self._torque = axles, torque

    def breach(self, command: Command, q_WS: Quat) -> str:
        """Describe what does not hold for `command` in this orientation; empty when all does."""
        found = self._balance(command, q_WS)
        d: Vec3 = (found[3], found[4], found[5])
        for j, (u, k, alone) in enumerate(self._contacts):
            normal, name = alone + k * dot(u, d), self._names[j]
            breach = outside(name, "normal force", normal, 0.0, 1e300)
            if j < 3 and not breach:
                breach = self._wheel_breach(j, name, found[:3][j], normal, command)
            if breach:
                return breach
        return ""

    def _wheel_breach(
        self, i: int, name: str, drive: float, normal: float, command: Command
    ) -> str:
        """Look at friction and torque of wheel i, which drives by a force (N)."""
        most = self._grip[i] * normal * (1.0 + ROUNDING)
        torque, strong = self._torque_of(i, drive, command), self._torque * (1.0 + ROUNDING)
        return outside(name, "drive force", drive, -most, most) or outside(
            name, "torque", torque, -strong, strong
        )

    def _balance(self, command: Command, q_WS: Quat) -> Six:
        """Return the drive forces (N) and the displacement of the sphere (m)."""
        w, alpha = apply(self._J, command.wheel_speed), apply(self._J, command.wheel_acceleration)
        c = rotate(q_WS, self._com)
        led = add(cross(alpha, c), cross(w, cross(w, c)))
        x, y, z = add(command.a_WS_W, led)
        force = scale(self._mass, (x, y, z + _GRAVITY))
        spin, turned = self._turned(q_WS, w), self._turned(q_WS, alpha)
        moment = add(add(turned, cross(w, spin)), cross(c, force))
        rest = add(force, self._unloaded)
        right = (moment[0], moment[1], moment[2], rest[0], rest[1], rest[2])
        a, b, c1, d, e, f = self._inverse
        return (
            *(_product(a, right), _product(b, right), _product(c1, right)),
            *(_product(d, right), _product(e, right), _product(f, right)),
        )

    def _turned(self, q_WS: Quat, x: Vec3) -> Vec3:
        """Return the central inertia times x, in W."""
        return rotate(q_WS, apply(self._inertia, rotate(conjugate(q_WS), x)))

    def _torque_of(self, i: int, drive: float, command: Command) -> float:
        radius, inertia, viscous, coulomb = self._axles[i]
        w = command.wheel_speed[i]
        loss = coulomb if w > 0.0 else -coulomb if w < 0.0 else 0.0
        return radius * drive + inertia * command.wheel_acceleration[i] + viscous * w + loss


def _product(row: Six, x: Six) -> float:
    a, b, c, d, e, f = row
    return 0.0 + a * x[0] + b * x[1] + c * x[2] + d * x[3] + e * x[4] + f * x[5]
