"""A driven wheel on the sphere: a spring along the contact, friction with creep along the drive.

    n = max(0, k delta + c delta'),  delta = u . d                               normal force
    s = r omega - (R b . Omega + v . d')                                         slip
    z' = s - sigma0 |s| / g(s) z - kappa |r omega| z                             bristle
    F = n phi,  phi = sigma0 z + sigma1 z'                                       friction       (12)
    g = mu_c + (mu_s - mu_c) exp(-(s / v_s)^2),  kappa = sigma0 / C

LuGre's model (Canudas de Wit et al., IEEE Trans. Automatic Control 40(3), 1995). The term with
kappa carries bristles out of the contact as it rolls (brush model), which gives creep: a wheel that
transmits phi at rolling speed V slips at s / V = (phi / C) / (1 - phi / mu), C the creep stiffness.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import exp
from typing import Final

from ..rotation import Vec3


@dataclass(frozen=True, slots=True)
class Friction:
    """Friction of a contact: mu_c, mu_s / mu_c, v_s (m/s), sigma0 (1/m), sigma1 (s/m), C."""

    sliding: float
    static_ratio: float
    stribeck_speed: float
    bristle_stiffness: float
    bristle_damping: float
    creep_stiffness: float


class RollingContact:
    """One wheel on the sphere; directions in W, unit, from the sphere centre to the contact.

    radius: of the wheel at the contact, m; stiffness N/m and damping N s/m along the contact.
    """

    def __init__(
        self,
        contact: Vec3,
        drive: Vec3,
        radius: float,
        sphere_radius: float,
        stiffness: float,
        damping: float,
        friction: Friction,
    ) -> None:
        u, v = contact, drive
        self.u: Final[Vec3] = u
        self.v: Final[Vec3] = v
        self.radius: Final[float] = radius
        self.stiffness: Final[float] = stiffness
        self.damping: Final[float] = damping
        self.lever: Final[Vec3] = (  # R b = R u x v
            sphere_radius * (u[1] * v[2] - u[2] * v[1]),
            sphere_radius * (u[2] * v[0] - u[0] * v[2]),
            sphere_radius * (u[0] * v[1] - u[1] * v[0]),
        )
        self._mu: Final[float] = friction.sliding
        self._extra: Final[float] = friction.sliding * (friction.static_ratio - 1.0)
        self._speed: Final[float] = friction.stribeck_speed
        self.bristle_stiffness: Final[float] = friction.bristle_stiffness
        self.bristle_damping: Final[float] = friction.bristle_damping
        self._kappa: Final[float] = friction.bristle_stiffness / friction.creep_stiffness

    def normal(self, delta: float, delta_rate: float) -> float:
        """Normal force, N, of a sphere pressed in by delta (m), at delta_rate (m/s)."""
        if delta <= 0.0:
            return 0.0
        force = self.stiffness * delta + self.damping * delta_rate
        return max(0.0, force)

    def slip(self, omega: float, Omega: Vec3, velocity: Vec3) -> float:
        """Slip s, m/s: the wheel's rim against the sphere's surface, along the drive.

        omega rad/s; Omega, velocity: of the sphere, W, relative to the wheels' frame.
        """
        b, v = self.lever, self.v
        return (
            self.radius * omega
            - (b[0] * Omega[0] + b[1] * Omega[1] + b[2] * Omega[2])
            - (v[0] * velocity[0] + v[1] * velocity[1] + v[2] * velocity[2])
        )

    def relaxation(self, slip: float, omega: float) -> float:
        """How fast the bristle forgets, 1/s: sigma0 |s| / g + kappa |r omega|."""
        g = self._mu
        if self._extra > 0.0:
            g += self._extra * exp(-((slip / self._speed) ** 2))
        return self.bristle_stiffness * abs(slip) / g + self._kappa * abs(self.radius * omega)

    def bristle_rate(self, z: float, slip: float, omega: float) -> float:
        """Rate z' of (12), m/s."""
        return slip - self.relaxation(slip, omega) * z

    def transmitted(self, z: float, z_rate: float) -> float:
        """Friction phi = F / n of (12)."""
        return self.bristle_stiffness * z + self.bristle_damping * z_rate
