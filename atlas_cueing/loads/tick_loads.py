"""Loads of one tick on three wheels, in plain floats: the equations of `balance` for a loop.

Contacts are bilateral here: a negative normal force says which one would have to pull. Where a
support opens, `balance` shares its force among the rest.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from typing import Final

from ..rotation import Mat3, Quat, Vec3, apply, conjugate, cross, rotate
from ..signals import STANDARD_GRAVITY, Motion, WheelSpeeds


@dataclass(slots=True, init=False)
class TickLoads:
    """Loads at `time` (s) of each wheel.

    drive, normal in N; torque in N m; power in W; use: traction use, infinite where the wheel does
    not touch.
    """

    time: Final[float]
    drive: Final[Vec3]
    normal: Final[Vec3]
    torque: Final[Vec3]
    power: Final[Vec3]
    use: Final[Vec3]

    def __init__(
        self, time: float, drive: Vec3, normal: Vec3, torque: Vec3, power: Vec3, use: Vec3
    ) -> None:
        self.time = time
        self.drive = drive
        self.normal = normal
        self.torque = torque
        self.power = power
        self.use = use


class WheelLoads:
    """The loads of three wheels, tick by tick; `LoadModel` gives the constants."""

    def __init__(
        self,
        *,
        mass: float,
        com_S: Vec3,
        inertia_S: Mat3,
        drive_from_moment: Mat3,
        force_from_drive: Mat3,
        normal_from_push: Mat3,
        normal_at_rest: Vec3,
        radius: Vec3,
        inertia: Vec3,
        viscous: Vec3,
        coulomb: Vec3,
        friction: Vec3,
    ) -> None:
        """Keep the constants.

        Args:
            mass: of the body, kg.
            com_S: centre of mass from the sphere centre, m, S.
            inertia_S: about the sphere centre, kg m^2, S.
            drive_from_moment: (R B^T)^-1 (3), 1/m.
            force_from_drive: V^T: the drives' forces in W.
            normal_from_push: normal forces of the wheels from -need (7).
            normal_at_rest: what they have without any need, N.
            radius: effective, m.
            inertia: at the axles, kg m^2.
            viscous: N m s.
            coulomb: N m.
            friction: coefficients.
        """
        self.mass = mass
        self.com = com_S
        self.inertia = inertia_S
        self.drive_from_moment = drive_from_moment
        self.force_from_drive = force_from_drive
        self.normal_from_push = normal_from_push
        self.normal_at_rest = normal_at_rest
        self.radius = radius
        self.wheel_inertia = inertia
        self.viscous = viscous
        self.coulomb = coulomb
        self.friction = friction

    def loads(self, motion: Motion, wheels: WheelSpeeds) -> TickLoads:
        """Give the loads of a motion whose wheels turn as `wheels` says."""
        M, F = self.wrench(motion.q_WS, motion.w_WS_W, motion.alpha_WS_W, motion.a_WS_W)
        drive = apply(self.drive_from_moment, M)  # (3)
        pulled = apply(self.force_from_drive, drive)
        push = (pulled[0] - F[0], pulled[1] - F[1], pulled[2] - F[2])
        n, rest = apply(self.normal_from_push, push), self.normal_at_rest
        normal = (n[0] + rest[0], n[1] + rest[1], n[2] + rest[2])  # (7)
        w, dw = wheels.speed, wheels.acceleration
        torque = (
            self._torque(0, drive[0], w[0], dw[0]),
            self._torque(1, drive[1], w[1], dw[1]),
            self._torque(2, drive[2], w[2], dw[2]),
        )
        mu = self.friction
        return TickLoads(
            motion.time,
            drive,
            normal,
            torque,
            (torque[0] * w[0], torque[1] * w[1], torque[2] * w[2]),
            (
                _use(drive[0], mu[0] * normal[0]),
                _use(drive[1], mu[1] * normal[1]),
                _use(drive[2], mu[2] * normal[2]),
            ),
        )

    def wrench(self, q: Quat, w_W: Vec3, alpha_W: Vec3, a_W: Vec3) -> tuple[Vec3, Vec3]:
        """Moment and force on the sphere, W ((1), (2))."""
        back, m, c = conjugate(q), self.mass, self.com
        w, alpha = rotate(back, w_W), rotate(back, alpha_W)
        f = rotate(back, (a_W[0], a_W[1], a_W[2] + STANDARD_GRAVITY))
        spun, gyro = apply(self.inertia, alpha), cross(w, apply(self.inertia, w))
        hung = cross(c, f)
        led, pulled = cross(alpha, c), cross(w, cross(w, c))
        M = (
            spun[0] + gyro[0] + m * hung[0],
            spun[1] + gyro[1] + m * hung[1],
            spun[2] + gyro[2] + m * hung[2],
        )
        F = (
            m * (f[0] + led[0] + pulled[0]),
            m * (f[1] + led[1] + pulled[1]),
            m * (f[2] + led[2] + pulled[2]),
        )
        return rotate(q, M), rotate(q, F)

    def _torque(self, i: int, drive: float, w: float, dw: float) -> float:
        """Torque at an axle (4)."""
        coulomb = self.coulomb[i] if w > 0.0 else -self.coulomb[i] if w < 0.0 else 0.0
        return self.radius[i] * drive + self.wheel_inertia[i] * dw + self.viscous[i] * w + coulomb


def _use(drive: float, grip: float) -> float:
    """Share of the friction in use (8)."""
    return abs(drive) / grip if grip > 0.0 else float("inf")
