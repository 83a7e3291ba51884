"""The simulated sphere: rigid body on contacts, wheels with servos, energy kept account of.

    F = sum of contact forces,  M = sum R u x (F_i v_i)          on the sphere, W, about its centre
    d'' = F / m - (a - g) - alpha x c - Omega x (Omega x c)      centre against the stage
    I_c alpha = R^T (M - c x F) - w x I_c w                      Euler about the centre of mass, S
    J omega' = tau - r F - losses                                each wheel
    tau = k_p (omega_c - omega) + k_i (theta_c - theta) + tau_ff, |tau| <= limit        its servo

Shared with the rest of the program are rotations only. Integrated by Runge-Kutta of fourth order,
and so are motor and stage work, friction, damping and losses: what the energy of the sphere lacks
against them in the end is the error of integration.
"""

# mypyc: runs every tick

from collections.abc import Sequence
from math import sqrt
from typing import Final

from ..rotation import Quat, Vec3, apply, cross, dot, rotate
from .drive_command import DriveCommand, integral, slope, value
from .passive_contacts import PassiveContacts
from .plant_parts import PlantBody, PlantServo, PlantWheel

GRAVITY: Final = 9.80665
_ROUNDS: Final = 0.05  # rad/s: below it Coulomb's loss at an axle fades to nothing
_STIFFEST: Final = 2.0  # rate times step; more is divided (Runge-Kutta is stable up to 2.78)
_MOST_PIECES: Final = 64

# places in the state: q_WS, w_S, d, d', theta_c - theta, omega, z, then work:
Q, W, D, V, LAG, OMEGA, Z, WORK = 0, 4, 7, 10, 13, 16, 19, 22
SIZE = 27  # of motors, stage, friction, damping and losses; |motors| + |stage|


class SphereOnWheels:
    """The plant.

    state: what moves, SIZE numbers in the order of the constants Q to WORK: orientation q_WS, rate
    w_S (rad/s), the centre's place and speed against the stage d, d' (W, m, m/s); of each wheel
    the angle that it lags (rad), its speed (rad/s), the deflection of its bristles; work (J) of
    motors, stage, friction, damping and losses.
    """

    def __init__(
        self,
        body: PlantBody,
        wheels: Sequence[PlantWheel],
        servo: PlantServo,
        passive: PassiveContacts,
        state: Sequence[float],
    ) -> None:
        """Start at `state`; the wheels are commanded to angle 0, and lag by what `state` says."""
        self._body: Final[PlantBody] = body
        self._wheels: Final[tuple[PlantWheel, ...]] = tuple(wheels)
        self._servo: Final[PlantServo] = servo
        self._passive: Final[PassiveContacts] = passive
        self.state = [float(x) for x in state]
        self.angle = [0.0, 0.0, 0.0]  # commanded, rad
        self._touching = [wheel.touching(0.0) for wheel in self._wheels]
        self._height = 0.0  # m, of the stage, from the start
        self._natural: Final[float] = 2.0 * sqrt(  # twice: it rings
            (passive.stiffness + sum(wheel.rows[0].stiffness for wheel in wheels)) / body.mass
        )
        self.row_work = 0.0  # J: by springs when another row of rollers takes over
        passive.tune((self.state[D], self.state[D + 1], self.state[D + 2]))

    def advance(self, command: DriveCommand, duration: float, steps: int) -> None:
        """Fly `command` for `duration` (s) in so many steps, or more where wheels slide fast."""
        h = duration / steps
        for k in range(steps):
            self._change_rows(command, k * h)
            pieces = self._pieces(h)
            for piece in range(pieces):
                self._step(command, k * h + piece * h / pieces, h / pieces)
        for i in range(3):
            self.angle[i] += integral(command.wheels[i], duration)
        self._height += integral(command.stage[2], duration)

    def orientation(self) -> Quat:
        """Where the sphere is, q_WS."""
        y = self.state
        return (y[0], y[1], y[2], y[3])

    def rate_W(self) -> Vec3:
        """Angular velocity, rad/s, W."""
        return rotate(self.orientation(), _three(self.state, W))

    def wheel_angles(self) -> Vec3:
        """How far the wheels have turned, rad."""
        y, a = self.state, self.angle
        return (a[0] - y[LAG], a[1] - y[LAG + 1], a[2] - y[LAG + 2])

    def slips(self) -> Vec3:
        """Slip of each wheel, m/s."""
        Omega, velocity, y = self.rate_W(), _three(self.state, V), self.state
        a, b, c = [self._touching[i].slip(y[OMEGA + i], Omega, velocity) for i in range(3)]
        return (a, b, c)

    def normals(self) -> Vec3:
        """Normal force of each wheel, N."""
        d, velocity = _three(self.state, D), _three(self.state, V)
        a, b, c = [w.normal(dot(w.u, d), dot(w.u, velocity)) for w in self._touching]
        return (a, b, c)

    def torques(self, command: DriveCommand, t: float) -> Vec3:
        """Torque of each servo, N m, at t (s) of the command."""
        return (
            self._torque(self.state, 0, command, t),
            self._torque(self.state, 1, command, t),
            self._torque(self.state, 2, command, t),
        )

    def energy(self, stage: Vec3) -> float:
        """Kinetic, elastic and potential energy, J, with the stage moving at `stage` (m/s, W)."""
        y, body = self.state, self._body
        w, d, v = _three(y, W), _three(y, D), _three(y, V)
        q = self.orientation()
        c, turning = rotate(q, body.com_S), rotate(q, cross(w, body.com_S))
        vx, vy, vz = stage[0] + v[0] + turning[0], stage[1] + v[1] + turning[1], stage[2] + v[2]
        vz += turning[2]
        moving = 0.5 * body.mass * (vx * vx + vy * vy + vz * vz)
        moving += 0.5 * dot(w, apply(body.inertia_S, w))
        for i in range(3):
            moving += 0.5 * self._servo.inertia * y[OMEGA + i] ** 2
        height = self._height + d[2] + c[2]
        return moving + body.mass * GRAVITY * height + self._elastic(d) + self._passive.energy(d)

    def accelerations(self, command: DriveCommand, t: float) -> tuple[Vec3, Vec3]:
        """Angular acceleration (S) and acceleration of the centre against the stage (W)."""
        rates = self._rates(self.state, command, t)
        return _three(rates, W), _three(rates, V)

    def _elastic(self, d: Vec3) -> float:
        stored = 0.0
        for wheel in self._touching:
            delta = dot(wheel.u, d)
            if delta > 0.0:
                stored += 0.5 * wheel.stiffness * delta * delta
        return stored

    def _change_rows(self, command: DriveCommand, t: float) -> None:
        """Let the row touch that the wheel's angle brings; springs may gain energy by that."""
        for i in range(3):
            if len(self._wheels[i].rows) == 1:
                continue
            turned = self.angle[i] + integral(command.wheels[i], t) - self.state[LAG + i]
            touching = self._wheels[i].touching(turned)
            if touching is not self._touching[i]:
                d = _three(self.state, D)
                before = self._elastic(d)
                self._touching[i] = touching
                self.row_work += self._elastic(d) - before

    def _pieces(self, h: float) -> int:
        """How many parts a step has to be divided into, so that it stays stable.

        Fast are a sphere on its springs, sliding bristles, and a wheel that rocks on them.
        """
        slips, normals, y, fastest = self.slips(), self.normals(), self.state, self._natural
        for i in range(3):
            wheel = self._touching[i]
            lightness = normals[i] * wheel.radius * wheel.radius / self._servo.inertia
            fastest = max(
                fastest,
                wheel.relaxation(slips[i], y[OMEGA + i]),
                sqrt(wheel.bristle_stiffness * lightness),
                wheel.bristle_damping * lightness,
                self._servo.speed_gain / self._servo.inertia,
            )
        return min(_MOST_PIECES, 1 + int(fastest * h / _STIFFEST))

    def _step(self, command: DriveCommand, t: float, h: float) -> None:
        y = self.state
        half = 0.5 * h
        k1 = self._rates(y, command, t)
        k2 = self._rates([a + half * b for a, b in zip(y, k1, strict=True)], command, t + half)
        k3 = self._rates([a + half * b for a, b in zip(y, k2, strict=True)], command, t + half)
        k4 = self._rates([a + h * b for a, b in zip(y, k3, strict=True)], command, t + h)
        sixth = h / 6.0
        y = [
            a + sixth * (b + 2.0 * (c + d) + e)
            for a, b, c, d, e in zip(y, k1, k2, k3, k4, strict=True)
        ]
        n = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3])
        y[0], y[1], y[2], y[3] = y[0] / n, y[1] / n, y[2] / n, y[3] / n
        self.state = y

    def _torque(self, y: list[float], i: int, command: DriveCommand, t: float) -> float:
        servo = self._servo
        torque = servo.speed_gain * (value(command.wheels[i], t) - y[OMEGA + i])
        torque += servo.angle_gain * y[LAG + i] + command.torque[i] + t * command.torque_rate[i]
        return max(-servo.limit, min(servo.limit, torque))

    def _rates(self, y: list[float], command: DriveCommand, t: float) -> list[float]:
        """Derivative of the state."""
        w, x, yy, z = y[0], y[1], y[2], y[3]
        wx, wy, wz = y[4], y[5], y[6]
        q, w_S, d, velocity = (w, x, yy, z), (wx, wy, wz), (y[7], y[8], y[9]), (y[10], y[11], y[12])
        rates = [
            0.5 * (-x * wx - yy * wy - z * wz),
            0.5 * (w * wx + yy * wz - z * wy),
            0.5 * (w * wy + z * wx - x * wz),
            0.5 * (w * wz + x * wy - yy * wx),
            *(0.0, 0.0, 0.0),
            *velocity,
            *(0.0, 0.0, 0.0),
        ]
        Omega = rotate(q, w_S)
        push, lost = self._passive.force(d, velocity)
        force, moment, wheels, work = self._wheel_forces(y, command, t, Omega, push, lost)
        self._body_rates(rates, q, w_S, force, moment, command, t)
        rates += wheels
        stage = command.stage
        carried = (force[0] * value(stage[0], t) + force[1] * value(stage[1], t)) + force[
            2
        ] * value(stage[2], t)
        rates += [work[0], carried, work[1], work[2], work[3] + abs(carried)]
        return rates

    def _wheel_forces(
        self,
        y: list[float],
        command: DriveCommand,
        t: float,
        Omega: Vec3,
        push: Vec3,
        lost: float,
    ) -> tuple[Vec3, Vec3, list[float], tuple[float, float, float, float]]:
        """Add the wheels' forces to `push`: force, moment (W), rates of wheels, powers (W).

        Powers: of the motors, of friction, of damping and losses (`lost` included), and the sum of
        the motors' sizes.
        """
        servo = self._servo
        d, velocity = (y[7], y[8], y[9]), (y[10], y[11], y[12])
        fx, fy, fz = push
        mx = my = mz = motors = sizes = rubbed = 0.0
        lags, speeds, bristles = [], [], []
        for i in range(3):
            wheel, omega, bristle = self._touching[i], y[OMEGA + i], y[Z + i]
            u, v, b = wheel.u, wheel.v, wheel.lever
            delta = u[0] * d[0] + u[1] * d[1] + u[2] * d[2]
            delta_rate = u[0] * velocity[0] + u[1] * velocity[1] + u[2] * velocity[2]
            n = wheel.normal(delta, delta_rate)
            s = wheel.slip(omega, Omega, velocity)
            rate = wheel.bristle_rate(bristle, s, omega)
            F = n * wheel.transmitted(bristle, rate)
            fx += F * v[0] - n * u[0]
            fy += F * v[1] - n * u[1]
            fz += F * v[2] - n * u[2]
            mx, my, mz = mx + F * b[0], my + F * b[1], mz + F * b[2]
            torque = self._torque(y, i, command, t)
            drag = servo.viscous * omega
            if servo.coulomb > 0.0:
                drag += servo.coulomb * omega / sqrt(omega * omega + _ROUNDS * _ROUNDS)
            lags.append(value(command.wheels[i], t) - omega)
            speeds.append((torque - wheel.radius * F - drag) / servo.inertia)
            bristles.append(rate)
            motors, sizes = motors + torque * omega, sizes + abs(torque * omega)
            rubbed += F * s
            lost += drag * omega
            lost += (n - wheel.stiffness * delta if delta > 0.0 else 0.0) * delta_rate
        found = (motors, rubbed, lost, sizes)
        return (fx, fy, fz), (mx, my, mz), lags + speeds + bristles, found

    def _body_rates(
        self,
        rates: list[float],
        q: Quat,
        w: Vec3,
        force: Vec3,
        moment: Vec3,
        command: DriveCommand,
        t: float,
    ) -> None:
        """Fill in w' (S) and d'' (W)."""
        body, back = self._body, (q[0], -q[1], -q[2], -q[3])
        c, f = body.com_S, rotate(back, force)
        M, arm = rotate(back, moment), cross(c, f)
        spin = cross(w, apply(body.inertia_S, w))
        alpha = apply(
            body.inverse_S,
            (M[0] - arm[0] - spin[0], M[1] - arm[1] - spin[1], M[2] - arm[2] - spin[2]),
        )
        rates[4], rates[5], rates[6] = alpha
        turned, pulled = cross(alpha, c), cross(w, cross(w, c))
        offset = (turned[0] + pulled[0], turned[1] + pulled[1], turned[2] + pulled[2])
        a, stage = rotate(q, offset), command.stage
        rates[10] = force[0] / body.mass - slope(stage[0], t) - a[0]
        rates[11] = force[1] / body.mass - slope(stage[1], t) - a[1]
        rates[12] = force[2] / body.mass - slope(stage[2], t) - GRAVITY - a[2]


def _three(y: Sequence[float], start: int) -> Vec3:
    return (y[start], y[start + 1], y[start + 2])
