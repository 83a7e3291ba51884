"""Method `classical`: the washout of hexapods, as the baseline people know.

The three channels of L. D. Reid & M. A. Nahon, "Flight simulation motion-base drive algorithms", UTIAS Report 296, 1985:

- rotation: body rates, scaled, become Euler rates of the cabin and pass s^2 / (s + w)^2, so every angle returns to zero;
- tilt coordination: the lasting part of the scaled specific force, by w^2 / (s + w)^2, becomes pitch and roll angles whose
  rate is limited below the threshold;
- translation: the high-pass of `stage`, with the parameters of the same set.

Angles of the first two add up and are limited as a hexapod's are. Defaults of the TU Delft set; see ClassicalParameters.
"""

from math import asin, cos, inf, sin, tan, tanh

from ..rotation import ZERO, Quat, Vec3, continuous, flip, flip_rotation, from_euler, rotate
from ..signals import STANDARD_GRAVITY, VehicleState
from .damping import CriticalDamping
from .parameters import ClassicalParameters

_STEEPEST = 1.4  # rad of pitch; Euler rates are computed no nearer to the vertical than this


class ClassicalRotation:
    """Orientation of the cabin by washout, in Euler angles (roll, pitch, yaw; FRD axes) over W."""

    def __init__(self, dt: float, parameters: ClassicalParameters) -> None:
        """Begin with nothing but the tilt of the first force; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._channels = [WashoutAngle(dt, omega) for omega in parameters.high_pass]
        self._tilts = [TiltAngle(dt, parameters) for _ in range(2)]
        self._angles, self._q_WS = ZERO, (1.0, 0.0, 0.0, 0.0)

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
        roll, pitch, yaw = (channel.step(r) for channel, r in zip(self._channels, self._euler_rates(vehicle), strict=True))
        kx, ky, _ = self._parameters.tilt_gain
        pitch_tilt, roll_tilt = self._tilts[0].step(kx * vehicle.f_B[0]), self._tilts[1].step(-ky * vehicle.f_B[1])
        limited = [
            _limit(angle, self._parameters.angle_limit) for angle in (_sum(roll, roll_tilt), _sum(pitch, pitch_tilt), yaw)
        ]
        (phi, phi_rate), (theta, theta_rate), (psi, psi_rate) = limited
        self._angles = (phi, theta, psi)
        self._q_WS = continuous(flip_rotation(from_euler(psi, theta, phi)), self._q_WS)
        p = phi_rate - psi_rate * sin(theta)
        q = theta_rate * cos(phi) + psi_rate * cos(theta) * sin(phi)
        r = psi_rate * cos(theta) * cos(phi) - theta_rate * sin(phi)
        return self._q_WS, rotate(self._q_WS, flip((p, q, r)))

    def _euler_rates(self, vehicle: VehicleState) -> Vec3:
        """Roll, pitch and yaw rates (rad/s) that the scaled body rates are in the cabin's attitude."""
        p, q, r = (k * w for k, w in zip(self._parameters.rotation_gain, vehicle.w_NB_B, strict=True))
        phi, theta, _ = self._angles
        theta = min(max(theta, -_STEEPEST), _STEEPEST)
        turn = q * sin(phi) + r * cos(phi)
        return (p + turn * tan(theta), q * cos(phi) - r * sin(phi), turn / cos(theta))


class WashoutAngle:
    """Angle and its rate from an Euler rate r by s r / (s + w)^2; washed out at the start."""

    def __init__(self, dt: float, omega: float) -> None:
        """Natural frequency omega in rad/s; dt in s."""
        self._omega, self._damping = omega, CriticalDamping(omega, dt)
        self._state: tuple[float, float] | None = None
        self._before = 0.0

    def step(self, rate: float) -> tuple[float, float]:
        """Angle (rad) and rate (rad/s) one tick on."""
        omega = self._omega
        rest = rate / (omega * omega)
        if self._state is None:
            self._state, self._before = (rest, 0.0), rest
        x, v = self._state = self._damping.step(*self._state, 0.5 * (self._before + rest))
        self._before = rest
        return v, rate - omega * (omega * x + 2.0 * v)


class TiltAngle:
    """Angle that lets gravity stand for the lasting part of a force, at a limited rate."""

    def __init__(self, dt: float, parameters: ClassicalParameters) -> None:
        """Begin tilted for the first force; dt in s."""
        self._damping = CriticalDamping(parameters.tilt_low_pass, dt)
        self._dt, self._rate = dt, parameters.tilt_rate
        self._state: tuple[float, float] | None = None
        self._angle = 0.0

    def step(self, force: float) -> tuple[float, float]:
        """Angle (rad) and rate (rad/s) one tick on, for a force in m/s^2."""
        start = self._state is None
        self._state = self._damping.step(*(self._state or (force, 0.0)), force)
        wish = asin(min(max(self._state[0] / STANDARD_GRAVITY, -1.0), 1.0))
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
