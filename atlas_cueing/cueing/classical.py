"""Method `classical`: the washout of hexapods, as the baseline people know.

The three channels of L. D. Reid & M. A. Nahon, "Flight simulation motion-base drive algorithms",
UTIAS Report 296, 1985:

- rotation: body rates, scaled, become Euler rates of the cabin and pass s^2 / (s + w)^2, so every
    angle returns to zero;
- tilt coordination: the lasting part of the scaled specific force, by w^2 / (s + w)^2, becomes
  pitch and roll angles whose rate is limited below the threshold;
- translation: the high-pass of `stage`, with the parameters of the same set.

Angles of the first two add up and are limited as a hexapod's are. Defaults are those of the set of
TU Delft: gains 0.6, critically damped.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import asin, cos, inf, radians, sin, tan, tanh
from typing import Final

from ..rotation import ZERO, Quat, Vec3, continuous, flip, flip_rotation, from_euler, rotate
from ..signals import STANDARD_GRAVITY, VehicleState
from .cabin import CUSTOMARY
from .damping import CriticalDamping
from .method import Method
from .parameter import Parameter, Range
from .stage.stage_parameters import GAIN, StageParameters

_STEEPEST: Final = 1.4  # rad of pitch; Euler rates are computed no nearer to the vertical than this


@dataclass(frozen=True, slots=True)
class ClassicalParameters:
    """Parameters of `classical`; METHOD says what each is. An infinite angle_limit is none."""

    rotation_gain: Vec3 = (0.6, 0.6, 0.6)
    tilt_gain: Vec3 = (0.6, 0.6, 0.5)
    high_pass: Vec3 = (1.0, 0.8, 1.0)
    tilt_low_pass: float = 2.0
    tilt_rate: float = radians(3.0)
    angle_limit: float = radians(25.0)

    def rotation(self, dt: float) -> "ClassicalRotation":
        """Make the rotation that begins at the first state; dt in s."""
        return ClassicalRotation(dt, self)


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
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""
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
        """Give the roll, pitch and yaw rates (rad/s) of the scaled body rates, in this attitude."""
        gain, w = self._parameters.rotation_gain, vehicle.w_NB_B
        p, q, r = gain[0] * w[0], gain[1] * w[1], gain[2] * w[2]
        phi, theta = self._angles[0], min(max(self._angles[1], -_STEEPEST), _STEEPEST)
        turn = q * sin(phi) + r * cos(phi)
        return (p + turn * tan(theta), q * cos(phi) - r * sin(phi), turn / cos(theta))


class WashoutAngle:
    """Angle and its rate from an Euler rate r by s r / (s + w)^2; washed out at the start."""

    def __init__(self, dt: float, omega: float) -> None:
        """Begin with the first rate; natural frequency omega in rad/s, dt in s."""
        self._omega, self._damping = omega, CriticalDamping(omega, dt)
        self._x = self._v = self._before = 0.0
        self._started = False

    def step(self, rate: float) -> tuple[float, float]:
        """Give angle (rad) and rate (rad/s) one tick on, for an Euler rate in rad/s."""
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
        """Give angle (rad) and rate (rad/s) one tick on, for a force in m/s^2."""
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
    """Give angle and rate behind the smooth limit bound tanh(angle / bound)."""
    if bound == inf:
        return angle
    share = tanh(angle[0] / bound)
    return bound * share, angle[1] * (1.0 - share * share)


CLASSICAL_STAGE = StageParameters(
    (0.6, 0.6, 0.5),
    onset=(0.8, 1.0, 1.0),
    recentre=(0.0, 0.0, 0.2),
    travel=(0.6, 0.6, 0.6),
    planner="onset",
)
"""The stage of the same set; the travel is assumed, that of a hexapod of 60 inch stroke."""

METHOD = Method(
    "classical",
    "the washout of hexapods, as the baseline people know",
    ClassicalParameters(),
    (
        Parameter(
            "rotation_gain",
            "rotation_gain",
            GAIN,
            "factor on the body rates p, q, r",
            "set of TU Delft",
        ),
        Parameter(
            "force_gain",
            "tilt_gain",
            GAIN,
            "factor on the specific force behind the tilt and on what the stage does of it",
            "set of TU Delft",
        ),
        Parameter(
            "high_pass_rad_s",
            "high_pass",
            Range(0.01, 50.0),
            "natural frequencies of the rotation washout: roll, pitch, yaw",
            "set of TU Delft",
        ),
        Parameter(
            "tilt_low_pass_rad_s",
            "tilt_low_pass",
            Range(0.01, 50.0),
            "natural frequency of the low-pass behind the tilt",
            "set of TU Delft",
        ),
        Parameter(
            "tilt_rate_deg_s",
            "tilt_rate",
            Range(0.0, 90.0, above=True),
            "largest rate of the tilt",
            CUSTOMARY,
        ),
        Parameter(
            "angle_limit_deg",
            "angle_limit",
            Range(0.0, 1e6, above=True),
            "limit of roll, pitch and yaw, approached smoothly; 1e6 is none",
            "assumed: 25 deg, as hexapods of 60 inch stroke reach",
        ),
    ),
    CLASSICAL_STAGE,
)
