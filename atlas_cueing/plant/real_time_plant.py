"""The plant as drives carry it along in real time: told where to be, step by step.

A drive follows angle, speed and acceleration; the inertia of wheel and sphere that is felt by all
three is given ahead as torque, as drives do that are told an acceleration:

    tau = (J^T R I R^T J + J_w) a,   R of the sphere, I about its centre, J_w of a wheel

What an eccentric mass, gyroscopic moments and the stage take is left to the servos.
"""

from collections.abc import Sequence
from math import ceil
from random import Random

import numpy as np

from ..rotation import (
    IDENTITY,
    ZERO,
    Mat3,
    Quat,
    Vec3,
    apply,
    conjugate,
    exp,
    multiply,
    normalise,
    rotate,
    scale,
    subtract,
)
from ..rotations import Array
from ..scenario import Platform
from ..scenario.plant_table import PlantTable
from .build_plant import Start, build_plant
from .drive_command import Cubic, DriveCommand, hermite
from .plant_felt import plant_felt
from .sensors import AbsoluteFix, PlantGyro

PLANT_ROW = 25
"""Numbers of `RealTimePlant.row`: the fields of /plant but its time, error and estimate."""


class RealTimePlant:
    """A platform that slips, with its sensors; it starts at rest.

    time: s since the start.
    turned: what the gyro has integrated since then, as `CabinSensors.turned`.
    fix: time (s) and q_WS of the newest fix that has come; None before the first.
    """

    def __init__(
        self,
        platform: Platform,
        table: PlantTable | None = None,
        q_WS: Quat = IDENTITY,
        axes: Sequence[Vec3] = (ZERO,) * 6,
    ) -> None:
        """Stand at q_WS with drives at `axes`: angle or place, speed 0, acceleration 0 of each.

        table: replaces `[plant]` of the platform.

        Raises InputError for a platform that makes no plant, or whose contacts cannot hold it.
        """
        plant = build_plant(platform, table)
        t = plant.table
        self._sphere = plant.at(Start(q_WS, ZERO, ZERO, ZERO, ZERO))
        self._head_S, self._step = platform.head_S, t.step_s
        self._axes = list(axes)
        random = Random(t.seed)  # noqa: S311 - noise of a simulated sensor
        self._gyro = PlantGyro(t.gyro_bias_rad_s, t.gyro_noise_rad_sqrt_s, random)
        self._fix = AbsoluteFix(t.fix_rate_hz, t.fix_noise_rad, t.fix_latency_s, random)
        self._inverse = plant.wheels_from_sphere
        J = np.linalg.inv(self._inverse).astype(np.float64)
        self._J, self._J_transposed = _matrix(J), _matrix(J.T)
        m, c = plant.body.mass, np.array(plant.body.com_S)
        about_centre = np.array(plant.body.inertia_S) + m * (c @ c * np.eye(3) - np.outer(c, c))
        self._inertia, self._wheel_inertia = _matrix(about_centre), plant.servo.inertia
        self._angle_before = self._sphere.wheel_angles()
        one, two, three = axes[:3]
        self._zero = subtract(self._angle_before, (one[0], two[0], three[0]))
        self.time, self.turned = 0.0, IDENTITY
        self.fix: tuple[float, Quat] | None = None
        self._rate_S, self._last = ZERO, self._command(self._axes, 1.0)
        self._residual = ZERO

    @property
    def q_WS(self) -> Quat:
        """Where the sphere really is."""
        return self._sphere.orientation()

    @property
    def wheel_angle(self) -> Vec3:
        """Angle of each wheel by its encoder, rad, as the drives count them."""
        return subtract(self._sphere.wheel_angles(), self._zero)

    def advance(self, axes: Sequence[Vec3], h: float) -> None:
        """Fly for h (s) to position, speed and acceleration of wheels 1 to 3 and stage x, y, z."""
        before, sphere = self.q_WS, self._sphere
        command = self._command(axes, h)
        sphere.advance(command, h, ceil(h / self._step - 1e-9))
        self.time, self._axes, self._last = self.time + h, list(axes), command
        self._measure(before, h)

    def row(self) -> tuple[float, ...]:
        """Return the PLANT_ROW numbers of now."""
        sphere, stage = self._sphere, self._axes[3:]
        a, command, t = (stage[0][2], stage[1][2], stage[2][2]), self._last, self._length
        return (
            *(*self.q_WS, *sphere.rate_W(), *plant_felt(sphere, command, t, a, self._head_S)),
            *(*sphere.slips(), *sphere.normals(), *sphere.torques(command, t)),
            *(*sphere.state[16:19], *self._residual),
        )

    def _measure(self, before: Quat, h: float) -> None:
        """Look at gyro, encoders and fixes after h (s) from an orientation."""
        rate_S = self._gyro.rate(before, self.q_WS, h)
        self.turned = normalise(multiply(self.turned, exp(scale(h, rate_S))))
        angle = self._sphere.wheel_angles()
        speed = scale(1.0 / h, subtract(angle, self._angle_before))
        rolled = self._inverse @ np.array(rotate(self.q_WS, rate_S))
        self._residual = subtract(_vector(rolled), speed)
        self._angle_before = angle
        self._fix.look(self.time, self.q_WS)
        for fix in self._fix.arrived(self.time):
            self.fix = fix

    def _command(self, axes: Sequence[Vec3], h: float) -> DriveCommand:
        """Return what the drives do on the way from where they are, h (s) long."""
        self._length = h
        ways = [
            hermite(v0, a0, v1, a1, h)
            for (_, v0, a0), (_, v1, a1) in zip(self._axes, axes, strict=True)
        ]
        ahead, then = self._ahead(self._axes), self._ahead(axes)
        growth = scale(1.0 / h, subtract(then, ahead))
        return DriveCommand(_three(ways[:3]), _three(ways[3:]), ahead, growth)

    def _ahead(self, axes: Sequence[Vec3]) -> Vec3:
        """Return the torque that the wheels' accelerations need, N m."""
        one, two, three = axes[:3]
        a, q = (one[2], two[2], three[2]), self.q_WS
        alpha_S = rotate(conjugate(q), apply(self._J, a))
        moment = rotate(q, apply(self._inertia, alpha_S))
        x, y, z = apply(self._J_transposed, moment)
        own = self._wheel_inertia
        return (x + own * a[0], y + own * a[1], z + own * a[2])


def _three(ways: Sequence[Cubic]) -> tuple[Cubic, Cubic, Cubic]:
    one, two, three = ways
    return (one, two, three)


def _vector(v: Array) -> Vec3:
    x, y, z = v.tolist()
    return (x, y, z)


def _matrix(m: Array) -> Mat3:
    a, b, c = m
    return (_vector(a), _vector(b), _vector(c))
