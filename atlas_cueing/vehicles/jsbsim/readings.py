"""Vehicle states out of JSBSim's properties: feet become metres here."""

# mypyc: runs every tick

from collections.abc import Callable
from math import atan2, cos, pi, sin
from typing import Final, TypeAlias
from warnings import catch_warnings, simplefilter

import jsbsim

from ...rotation import IDENTITY, Quat, continuous, from_euler
from ...signals import STANDARD_GRAVITY, VehicleState

Reader: TypeAlias = Callable[[], float]  # of one property

METRES_PER_FOOT: Final = 0.3048  # the international foot, exactly
EARTH_RATE: Final = 7.292115e-5  # rad/s, WGS 84
_NEAR_VERTICAL: Final = 0.5 * pi - 1e-6  # rad of pitch


class Readings:
    """Reads states; property nodes are looked up once, since a look-up costs six times a reading.

    So are their methods.

    Attitude comes from the Euler angles, a tenth of the cost of JSBSim's matrix. They differ from
    it by 6e-16 rad over the distance of the pitch from +-90 deg, and closer than 1e-8 rad (a rocket
    on its pad) by up to half a turn: there the heading that belongs to the roll is taken from the
    matrix.

    A vehicle at rest shows standard gravity anywhere: forces are scaled by it over the apparent
    gravity, which is JSBSim's gravitation less the centrifugal part of the Earth's turn (0.034
    m/s^2 at the equator), taken at the starting point.

    JSBSim computes the force at the pilot's eye (`a-pilot`) before the accelerations of the same
    step, so it is one step old in every state but the first.
    """

    def __init__(self, fdm: jsbsim.FGFDMExec) -> None:
        self._psi, self._theta, self._phi = _readers(fdm, "attitude/%s-rad", "psi", "theta", "phi")
        self._p, self._q, self._r = _readers(fdm, "velocities/%s-rad_sec", "p", "q", "r")
        self._x, self._y, self._z = _readers(fdm, "accelerations/a-pilot-%s-ft_sec2", "x", "y", "z")
        self._gravity, self._height = _readers(
            fdm, "%s", "accelerations/gravity-ft_sec2", "position/h-agl-ft"
        )
        distance, latitude = _readers(fdm, "position/%s", "radius-to-vehicle-ft", "lat-gc-rad")
        # ft/s^2
        self._centrifugal = EARTH_RATE**2 * distance() * cos(latitude()) ** 2
        self._propagate = fdm.get_propagate()
        self._q_NB: Quat = IDENTITY

    def state(self, time: float) -> VehicleState:
        """The present state, called `time` (s); raises ValueError when an angle is infinite."""
        psi, theta, phi = self._psi(), self._theta(), self._phi()
        if abs(theta) > _NEAR_VERTICAL:
            psi, theta = _heading_and_pitch(self._propagate, phi)
        self._q_NB = continuous(from_euler(psi, theta, phi), self._q_NB)
        # f / g0 = a_pilot / apparent gravity, both of the right hand in ft/s^2
        k = STANDARD_GRAVITY / (self._gravity() - self._centrifugal)
        return VehicleState(
            time,
            self._q_NB,
            (self._p(), self._q(), self._r()),
            (k * self._x(), k * self._y(), k * self._z()),
        )

    def height(self) -> float:
        """Height of the centre of gravity above ground, m."""
        return METRES_PER_FOOT * self._height()


def _readers(fdm: jsbsim.FGFDMExec, pattern: str, *names: str) -> list[Reader]:
    manager = fdm.get_property_manager()
    nodes = [manager.get_node(pattern % name) for name in names]
    return [node.get_double_value for node in nodes if node is not None]


def _heading_and_pitch(propagate: jsbsim.FGPropagate, phi: float) -> tuple[float, float]:
    """Heading and pitch (rad) of JSBSim's attitude with the roll phi, near a pitch of +-90 deg.

    There any roll will do, if the heading fits it. R_BN = X(phi) Y(theta) Z(psi), so the rows of
    X(-phi) R_BN are those of Y(theta) Z(psi): the second is (-sin psi, cos psi, 0) and the third
    ends in cos theta.
    """
    with catch_warnings():
        # JSBSim hands out numpy's old matrix class
        simplefilter("ignore", PendingDeprecationWarning)
        first, second, third = propagate.get_Tl2b().tolist()
    c, s = cos(phi), sin(phi)
    psi = atan2(s * third[0] - c * second[0], c * second[1] - s * third[1])
    return psi, atan2(-first[2], s * second[2] + c * third[2])
