"""FlightGear's native FDM packet, version 24, as JSBSim and FlightGear send it over UDP.

Feet become metres here.

408 bytes, big-endian (FlightGear, src/Network/net_fdm.hxx): what is read of them is

    version, padding                    uint32 each
    longitude, latitude (geodetic, rad), altitude   double each; metres above the ellipsoid
    height above ground                 float; m
    phi, theta, psi                     float; rad: roll, pitch, heading
    alpha, beta                         float; not used
    phidot, thetadot, psidot            float; rad/s: rates of the Euler angles, not of the body
    vcas ... w                                      eight floats; not used
    A_X, A_Y, A_Z pilot                 float; ft/s^2: specific force at the pilot's eye, body FRD

A packet has no time of the simulation and no number. Floats give an attitude good to 3e-7 rad and a
force to 4e-6 m/s^2.
"""

from dataclasses import dataclass
from math import cos, inf, pi, sin, sqrt
from struct import Struct
from typing import ClassVar

from ..rotation import Vec3, from_euler
from ..signals import STANDARD_GRAVITY, VehicleState
from .bounds import Bounds, PacketError
from .jsbsim.readings import METRES_PER_FOOT
from .sent_flight import SentFlight

VERSION = 24
PACKET_BYTES = 408

DEFAULT_PORT = 5501  # of FlightGear's own examples

_VERSION = Struct(">I")
_HIGHEST_VERSION = 1000  # that FlightGear may come to; beyond it is no version at all (assumed)
_SWAPPED = int.from_bytes(VERSION.to_bytes(4, "little"), "big")
_FIELDS = Struct(">II3d4f8x3f32x3f")
_ROUNDING = 1e-6  # rad; of a float near pi
# m; the lowest dry land lies at -430, and the ellipsoid up to 107 m from mean sea level
_LOWEST = -1e4

# Ellipsoid and normal gravity of WGS 84 (NIMA TR8350.2, 2000, tables 3.1, 3.3 and 3.4, eq. 4-1 and
# 4-3).
_EQUATOR = 6378137.0  # m
_FLATTENING = 1.0 / 298.257223563
_ECCENTRICITY_2 = _FLATTENING * (2.0 - _FLATTENING)
_GRAVITY_AT_EQUATOR = 9.7803253359  # m/s^2
_SOMIGLIANA = 0.00193185265241
_SPIN = 0.00344978650684  # m = w^2 a^2 b / GM


@dataclass(frozen=True, slots=True)
class FlightgearFlight(SentFlight):
    """A vehicle that FlightGear or JSBSim flies elsewhere and sends here."""

    live_only: ClassVar[str] = "source = 'flightgear' flies only live: atlas-cueing live FILE"

    port: int = DEFAULT_PORT

    @property
    def name(self) -> str:
        """Return the word for all of them."""
        return "flightgear"


def decode(packet: bytes, time: float, bounds: Bounds) -> VehicleState:
    """Decode the state in a packet, called `time` (s).

    Attitude, body rates and specific force are as in `signals.VehicleState`.

    The force is scaled by standard gravity over normal gravity at the packet's latitude and
    altitude, which takes in the Earth's turn, so that a vehicle at rest shows (0, 0, -9.80665)
    anywhere. The sign of the quaternion is from_euler's.

    Body rates are worth less near a pitch of +-90 deg, where the Euler rates grow without bounds:
    their rounding adds some 1e-7 / cos(theta)^2 of the true rate.

    Raises PacketError for another version, a wrong size, numbers that are not finite, angles out of
    range, and whatever `bounds` objects to.
    """
    _check_kind(packet)
    _, _, longitude, latitude, altitude, height, phi, theta, psi, *rest = _FIELDS.unpack_from(
        packet
    )
    # NaN and infinity are out of every range
    if not (
        abs(phi) <= 2.0 * pi
        and abs(theta) <= 0.5 * pi + _ROUNDING
        and abs(psi) <= 2.0 * pi + _ROUNDING
    ):
        raise PacketError(
            f"attitude roll {phi:.4g}, pitch {theta:.4g}, heading {psi:.4g} rad is no triple of"
            " Euler angles"
        )
    if not (
        abs(longitude) < inf
        and abs(latitude) <= 0.5 * pi + _ROUNDING
        and _LOWEST <= altitude <= bounds.height
    ):
        raise PacketError(
            f"position {longitude:.4g} rad east, {latitude:.4g} rad north, {altitude:.4g} m up is"
            " nowhere"
        )
    k = METRES_PER_FOOT * STANDARD_GRAVITY / normal_gravity(latitude, altitude)
    force: Vec3 = (k * rest[3], k * rest[4], k * rest[5])
    state = VehicleState(
        time, from_euler(psi, theta, phi), _body_rates(phi, theta, rest[0], rest[1], rest[2]), force
    )
    objection = bounds.objection(state, height)
    if objection:
        raise PacketError(objection)
    return state


def normal_gravity(latitude: float, altitude: float) -> float:
    """Gravity of the turning ellipsoid (m/s^2).

    At a geodetic latitude (rad) and an altitude above it (m).

    On the ellipsoid Somigliana's formula. Above it the inverse square that begins as the series of
    WGS 84 does; the series itself turns upwards again some thousand kilometres up.
    """
    s2 = sin(latitude) ** 2
    surface = _GRAVITY_AT_EQUATOR * (1.0 + _SOMIGLIANA * s2) / sqrt(1.0 - _ECCENTRICITY_2 * s2)
    shrink = 1.0 + altitude * (1.0 + _FLATTENING + _SPIN - 2.0 * _FLATTENING * s2) / _EQUATOR
    return surface / (shrink * shrink)


def _check_kind(packet: bytes) -> None:
    """Version first: the size belongs to it."""
    version = _VERSION.unpack_from(packet)[0] if len(packet) >= _VERSION.size else None
    if version == _SWAPPED:
        raise PacketError(
            f"swapped bytes: version {VERSION} of the native FDM packet in little-endian, allowed:"
            " big-endian"
        )
    if version is not None and version > _HIGHEST_VERSION:
        raise PacketError(
            f"{len(packet)} bytes that begin with {packet[:4]!r}, allowed: a native FDM packet of"
            f" version {VERSION} ({PACKET_BYTES} bytes)"
        )
    if version is not None and version != VERSION:
        raise PacketError(
            f"version {version} of the native FDM packet ({len(packet)} bytes), allowed: {VERSION}"
            f" ({PACKET_BYTES} bytes)"
        )
    if len(packet) != PACKET_BYTES:
        raise PacketError(
            f"{len(packet)} bytes, allowed: {PACKET_BYTES}, a native FDM packet of version"
            f" {VERSION}"
        )


def _body_rates(phi: float, theta: float, phidot: float, thetadot: float, psidot: float) -> Vec3:
    """Rates about the body's axes from those of the Euler angles (rad/s).

    Stevens & Lewis, Aircraft Control and Simulation, 1.4.
    """
    c, s, turn = cos(phi), sin(phi), psidot * cos(theta)
    return (phidot - psidot * sin(theta), thetadot * c + turn * s, turn * c - thetadot * s)
