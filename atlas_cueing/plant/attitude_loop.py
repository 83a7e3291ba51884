"""Closes the loop: from sensors to an estimate, to a correction of the wheels' schedule.

    e = log(q_ref q_hat^-1),  |Omega_c| <= limit,  wheels: J^-1 Omega_c
    Omega_c = K e  near the end,  sqrt(2 a (|e| - a / (2 K^2))) e / |e|  for |e| > a / K^2

with a the acceleration that the correction may have about any axis: it falls by a, so that the
correction can stop where the error ends.

| feedback | the estimate q_hat |
|---|---|
| none | none: nothing is corrected |
| odometry | J omega of the wheels, integrated; slip is not seen |
| gyro | the gyro, integrated; its bias is not seen |
| fix | gyro and absolute fixes (`attitude_observer`) |

Against slip only a sensor that does not ride on the wheels helps: the constraint of rolling is not
holonomic, so the wheels' angles do not tell the orientation.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import inf, sqrt
from random import Random
from typing import Final

from ..rotation import Mat3, Quat, Vec3, apply, conjugate, exp, log, multiply, norm, rotate, scale
from .attitude_observer import AttitudeObserver
from .bounded_sum import SHARE
from .sensors import AbsoluteFix, PlantGyro
from .wheel_correction import WheelCorrection

FEEDBACKS = ("none", "odometry", "gyro", "fix")


@dataclass(frozen=True, slots=True)
class LoopSettings:
    """Gain (1/s) and limit (rad/s) of the correction, and the sensors: see `[plant]`."""

    gain: float
    largest_rate: float
    gyro_bias: float
    gyro_noise: float
    fix_rate: float
    fix_noise: float
    fix_latency: float
    fix_gain: float
    fix_bias_gain: float
    seed: int
    first_fix_gain: float = 0.0
    share: float = SHARE  # of the wheels' acceleration limits


def correction_rate(error: Vec3, gain: float, largest: float, acceleration: float) -> Vec3:
    """Rate, rad/s, that takes an error (rotation vector, rad) away.

    gain 1/s; largest rad/s; acceleration rad/s^2: with which the rate can fall again.
    """
    size, near = norm(error), acceleration / (gain * gain) if gain > 0.0 else inf
    if size <= near:
        return scale(min(gain, largest / size) if size > 0.0 else 0.0, error)
    rate = sqrt(2.0 * acceleration * (size - 0.5 * near))
    return scale(min(rate, largest) / size, error)


def sphere_acceleration(wheels_from_sphere: Mat3, acceleration: Vec3) -> float:
    """Angular acceleration, rad/s^2, that wheels of such limits reach about any axis."""
    return min(acceleration[i] / norm(wheels_from_sphere[i]) for i in range(3))


class AttitudeLoop:
    """Sensors, observer and correction of one flight; time begins at 0."""

    def __init__(
        self,
        feedback: str,
        settings: LoopSettings,
        q_WS: Quat,
        matrices: tuple[Mat3, Mat3],
        limits: tuple[Vec3, Vec3, Vec3],
    ) -> None:
        """Start at a known orientation.

        matrices: J and J^-1. limits: speed, acceleration and jerk of the wheels.
        """
        s = settings
        random = Random(s.seed)  # noqa: S311 - noise of a simulated sensor
        self.feedback: Final[str] = feedback
        self._settings: Final[LoopSettings] = settings
        self._sphere_from_wheels: Final[Mat3] = matrices[0]
        self._wheels_from_sphere: Final[Mat3] = matrices[1]
        self._gyro: Final[PlantGyro] = PlantGyro(s.gyro_bias, s.gyro_noise, random)
        self._fix: Final[AbsoluteFix] = AbsoluteFix(s.fix_rate, s.fix_noise, s.fix_latency, random)
        memory = s.fix_latency + 1.0 / s.fix_rate
        self._observer: Final[AttitudeObserver] = AttitudeObserver(
            q_WS, s.fix_gain, s.fix_bias_gain, 1.0 / s.fix_rate, memory, s.first_fix_gain
        )
        self.estimate_WS = q_WS
        self.residual: Vec3 = (0.0, 0.0, 0.0)
        self._before = q_WS
        self._angles: Vec3 = (0.0, 0.0, 0.0)
        speed, acceleration, jerk = limits
        self.corrections: Final[list[WheelCorrection]] = [
            WheelCorrection(speed[i], acceleration[i], jerk[i], s.share) for i in range(3)
        ]
        self._acceleration: Final[float] = s.share * sphere_acceleration(
            self._wheels_from_sphere, acceleration
        )

    def measure(self, time: float, q_WS: Quat, wheel_angles: Vec3, dt: float) -> None:
        """Look at the plant at `time` (s), dt (s) after the last look.

        q_WS: where it is, which only the sensors see; wheel_angles: of the drives' encoders, rad.
        """
        rate_S = self._gyro.rate(self._before, q_WS, dt)
        a, b = wheel_angles, self._angles
        omega = ((a[0] - b[0]) / dt, (a[1] - b[1]) / dt, (a[2] - b[2]) / dt)
        self._fix.look(time, q_WS)
        fixes = self._fix.arrived(time)
        if self.feedback == "odometry":
            turned = exp(scale(dt, apply(self._sphere_from_wheels, omega)))
            self.estimate_WS = multiply(turned, self.estimate_WS)
        else:
            self._observer.turn(time, rate_S, dt)
            for taken, fix in fixes if self.feedback == "fix" else ():
                self._observer.take_fix(taken, fix)
            self.estimate_WS = self._observer.q_WS
        self._find_slip(rate_S, omega)
        self._before, self._angles = q_WS, wheel_angles

    def correct(
        self, wanted_WS: Quat, schedule: list[tuple[float, float, float]], h: float
    ) -> None:
        """Move the corrections by a tick of h (s), towards the orientation that is wanted.

        schedule: of each wheel speed and acceleration now, and acceleration at the tick's end.
        """
        if self.feedback == "none":
            return
        error = log(multiply(wanted_WS, conjugate(self.estimate_WS)))
        s = self._settings
        rate = correction_rate(error, s.gain, s.largest_rate, self._acceleration)
        speeds = apply(self._wheels_from_sphere, rate)
        for i in range(3):
            self.corrections[i].step(speeds[i], schedule[i], h)

    def _find_slip(self, rate_S: Vec3, omega: Vec3) -> None:
        """Slip rho = J^-1 R w_gyro - omega: each wheel turns that much too slowly."""
        rate_W = rotate(self.estimate_WS, rate_S)
        rolled = apply(self._wheels_from_sphere, rate_W)
        self.residual = (rolled[0] - omega[0], rolled[1] - omega[1], rolled[2] - omega[2])
