"""Method `classical`: the washout of hexapods, as the baseline people know.

The three channels of L. D. Reid & M. A. Nahon, "Flight simulation motion-base drive algorithms",
UTIAS Report 296, 1985:

- rotation: body rates, scaled, become Euler rates of the cabin and pass s^2 / (s + w)^2, so every
    angle returns to zero;
- tilt coordination: the lasting part of the scaled specific force, by w^2 / (s + w)^2, becomes
  pitch and roll angles whose rate is limited below the threshold;
- translation: the high-pass of `stage`, with the parameters of the same set.

Angles of the first two add up and are limited as a hexapod's are. Defaults of the TU Delft set; see
ClassicalParameters.
"""

# mypyc: runs every tick

from math import asin, cos, inf, sin, tan, tanh
from typing import Final

from ..rotation import ZERO, Quat, Vec3, continuous, flip, flip_rotation, from_euler, rotate
from ..signals import STANDARD_GRAVITY, VehicleState
from .damping import CriticalDamping
from .parameters import ClassicalParameters

_STEEPEST: Final = 1.4  # rad of pitch; Euler rates are computed no nearer to the vertical than this


class ClassicalRotation:
    """Orientation of the cabin by washout, in Euler angles (roll, pitch, yaw; FRD axes) over W."""

    def __init__(self, dt: float, parameters: ClassicalParameters) -> None:
        """Begin with nothing but the tilt of the first force; dt in s."""
        self._dt, self._parameters = dt, parameters
        roll, pitch, yaw = parameters.high_pass
        self._roll, self._pitch, self._yaw = (
            WashoutAngle(dt, roll),
            WashoutAngle(dt, pitch),
            WashoutAngle(dt, yaw),
        )
        self._roll_tilt, self._pitch_tilt = TiltAngle(dt, parameters), TiltAngle(dt, parameters)
        self._angles, self._q_WS = ZERO, (1.0, 0.0, 0.0, 0.0)

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
        rates, gain, bound = (
            self._euler_rates(vehicle),
            self._parameters.tilt_gain,
            self._parameters.angle_limit,
        )
        roll_tilt = self._roll_tilt.step(-gain[1] * vehicle.f_B[1])
        pitch_tilt = self._pitch_tilt.step(gain[0] * vehicle.f_B[0])
        phi, phi_rate = _limit(_sum(self._roll.step(rates[0]), roll_tilt), bound)
        theta, theta_rate = _limit(_sum(self._pitch.step(rates[1]), pitch_tilt), bound)
        psi, psi_rate = _limit(self._yaw.step(rates[2]), bound)
        self._angles = (phi, theta, psi)
        self._q_WS = continuous(flip_rotation(from_euler(psi, theta, phi)), self._q_WS)
        p = phi_rate - psi_rate * sin(theta)
        q = theta_rate * cos(phi) + psi_rate * cos(theta) * sin(phi)
        r = psi_rate * cos(theta) * cos(phi) - theta_rate * sin(phi)
        return self._q_WS, rotate(self._q_WS, flip((p, q, r)))

    def _euler_rates(self, vehicle: VehicleState) -> Vec3:
        """Roll, pitch and yaw rates (rad/s) that the scaled body rates are in the cabin's attitude."""
        gain, w = self._parameters.rotation_gain, vehicle.w_NB_B
        p, q, r = gain[0] * w[0], gain[1] * w[1], gain[2] * w[2]
        phi, theta = self._angles[0], min(max(self._angles[1], -_STEEPEST), _STEEPEST)
        turn = q * sin(phi) + r * cos(phi)
        return (p + turn * tan(theta), q * cos(phi) - r * sin(phi), turn / cos(theta))


class WashoutAngle:
    """Angle and its rate from an Euler rate r by s r / (s + w)^2; washed out at the start."""

    def __init__(self, dt: float, omega: float) -> None:
        """Natural frequency omega in rad/s; dt in s."""
        self._omega, self._damping = omega, CriticalDamping(omega, dt)
        self._x = self._v = self._before = 0.0
        self._started = False

    def step(self, rate: float) -> tuple[float, float]:
        """Angle (rad) and rate (rad/s) one tick on."""
        omega = self._omega
        rest = rate / (omega * omega)
        if not self._started:
            self._x, self._before, self._started = rest, rest, True
        self._x, self._v = self._damping.step(self._x, self._v, 0.5 * (self._before + rest))
        self._before = rest
        return self._v, rate - omega * (omega * self._x + 2.0 * self._v)


class TiltAngle:
    """Angle that lets gravity stand for the lasting part of a force, at a limited rate."""

    def __init__(self, dt: float, parameters: ClassicalParameters) -> None:
        """Begin tilted for the first force; dt in s."""
        self._damping = CriticalDamping(parameters.tilt_low_pass, dt)
        self._dt, self._rate = dt, parameters.tilt_rate
        self._lasting = self._change = self._angle = 0.0  # m/s^2, m/s^3, rad
        self._started = False

    def step(self, force: float) -> tuple[float, float]:
        """Angle (rad) and rate (rad/s) one tick on, for a force in m/s^2."""
        start, self._started = not self._started, True
        lasting = force if start else self._lasting
        self._lasting, self._change = self._damping.step(lasting, self._change, force)
        wish = asin(min(max(self._lasting / STANDARD_GRAVITY, -1.0), 1.0))
        most = inf if start else self._rate * self._dt
        step = min(max(wish - self._angle, -most), most)
        self._angle += step
        return self._angle, 0.0 if start else step / self._dt


def _sum(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    return (a[0] + b[0], a[1] + b[1])


def _limit(angle: tuple[float, float], bound: float) -> tuple[float, float]:
    """Angle and rate behind the smooth limit bound tanh(angle / bound)."""
    if bound == inf:
        return angle
    share = tanh(angle[0] / bound)
    return bound * share, angle[1] * (1.0 - share * share)
