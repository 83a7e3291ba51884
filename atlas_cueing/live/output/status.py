"""The status packet of a drive controller, version 2: where drives and cabin are.

A UDP datagram of 312 bytes, little-endian, without padding, to every sender of a good `hello`
within the last 2.5 s: 50 times a second, and at once when state or reason have changed.

| offset | type      | field                                                                       |
|-------:|-----------|-----------------------------------------------------------------------------|
|      0 | char[4]   | magic: `ATSS`                                                               |
|      4 | uint8     | version: 2                                                                  |
|      5 | uint8     | kind of check, as in `sealing`                                              |
|      6 | uint8     | state: 0 waiting (for a first set point), 1 following, 2 stopping (its own  |
|        |           | stop, also when that has ended), 3 latched (until it is reset by hand)      |
|      7 | uint8     | sensors of the cabin: 0 none, 1 gyro, 2 gyro and a fix from outside         |
|      8 | uint64    | session: that of the hello it answers                                       |
|     16 | uint64    | number: strictly increasing as long as the receiver runs                    |
|     24 | int64     | time of the positions below, ns on the hello's sender's CLOCK_MONOTONIC     |
|     32 | uint64    | followed: session of the set points that it follows; 0 while waiting        |
|     40 | uint64    | newest: sequence of the newest set point taken; 0 while waiting             |
|     48 | double    | margin: least time from a set point's arrival until it was due, of those    |
|        |           | taken since the status before, s; infinite when there were none             |
|     56 | uint8[16] | limits: hash of the limits that the receiver keeps, as in `hello`           |
|     72 | double[3] | angle of wheels 1 to 3, rad, as the set points count them; 0 while waiting  |
|     96 | double[3] | stage position x, y, z from the centre, m, frame W                          |
|    120 | uint64    | good: set points taken since the receiver runs                              |
|    128 | uint64    | refused: packets not taken since the receiver runs                          |
|    136 | double[4] | turned: what the gyro has integrated since the receiver runs, up to the     |
|        |           | time above: a unit quaternion w, x, y, z that turns vectors of the cabin    |
|        |           | now into those of the cabin then; 0 without a gyro                          |
|    168 | int64     | seen: when the newest fix was taken, ns as above; 0 without one             |
|    176 | double[4] | fix: the cabin's orientation q_WS as it was seen then, w, x, y, z; 0        |
|        |           | without one                                                                 |
|    208 | char[88]  | reason: why it stops or is latched, or why the last packet was refused      |
|        |           | while waiting; UTF-8, the rest zeros                                        |
|    296 | uint8[16] | check of bytes 0 to 295                                                     |

Watchdog: the loop faults, by the stop that the drives fly too, within two ticks of a status that
says latched; when it has heard none for its drive timeout (50 ms) while it moves; when a position
is off its own for the same time by more than 0.1 deg or 1 mm; and when another session is followed.
At rest it does not set out as long as any of that holds, the hash of limits is another than its
own, or a margin is under 2 ms.

Positions are those that the drives have (measured, where they are measured), not those they were
told. Clocks: `setpoint`. A gyro is told by its integral, so a lost packet loses no turn; a fix
carries its time, so it may come late. What the loop does with them is in `attitude_correction`.
"""

# mypyc: runs every tick

from math import hypot, isfinite, isnan
from struct import Struct

from ...errors import SetPointError
from ...rotation import Quat, Vec3, normalise
from ..control.drive_status import DRIVE_STATES, CabinSensors, DriveStatus
from .sealing import Layout, seal, unseal

REASON_SIZE = 88  # bytes
_LAYOUT = Layout(b"ATSS", 2, Struct(f"<4sBBBBQQqQQd16s6dQQ4dq4d{REASON_SIZE}s"), 6)
SIZE = _LAYOUT.size
_NONE, _GYRO, _FIX = 0, 1, 2  # sensors
_UNIT = 1e-3  # a quaternion whose norm is off by more is no orientation
_NOTHING = (0.0,) * 4


def encode(session: int, status: DriveStatus, key: bytes = b"") -> bytes:
    """Return the packet that answers a hello of `session`, with the shared key if there is one."""
    s = status
    kind, seen, turned, fix = _NONE, 0, _NOTHING, _NOTHING
    if s.sensors:
        kind, turned = _GYRO, s.sensors.turned
        if s.sensors.fix_WS:
            kind, seen, fix = _FIX, s.sensors.seen, s.sensors.fix_WS
    return seal(
        *(_LAYOUT, key, DRIVE_STATES.index(s.state), kind, session, s.number, s.time, s.followed),
        *(s.newest, s.margin, s.limits, *s.wheel_angle, *s.p_WS_W, s.good, s.refused),
        *(*turned, seen, *fix),
        s.reason.encode()[:REASON_SIZE],
    )


def decode(packet: bytes, key: bytes = b"") -> tuple[int, DriveStatus]:
    """Return the session of the hello that a packet answers, and its status.

    Raises SetPointError for a wrong size, magic, version, check, state, number or orientation.
    """
    state, kind, session, number, time, followed, newest, margin, limits, *rest = unseal(
        _LAYOUT, packet, key
    )
    positions, (good, refused), sensed, reason = rest[:6], rest[6:8], rest[8:17], rest[17]
    if state >= len(DRIVE_STATES):
        raise SetPointError(
            f"status {number} has state {state}, allowed: 0 <= state <= {len(DRIVE_STATES) - 1}"
        )
    if isnan(margin) or not all(map(isfinite, positions)):
        raise SetPointError(f"status {number} has a number that is not finite")
    angle: Vec3 = (positions[0], positions[1], positions[2])
    place: Vec3 = (positions[3], positions[4], positions[5])
    text = reason.rstrip(b"\0").decode(errors="replace")
    return session, DriveStatus(
        *(number, DRIVE_STATES[state], text, time, followed, newest, margin, limits),
        *(angle, place, good, refused, _sensors(number, kind, *sensed)),
    )


def _sensors(number: int, kind: int, *sensed: float) -> CabinSensors | None:
    """Return what the sensors tell: turned, seen and fix of a packet."""
    if kind not in (_NONE, _GYRO, _FIX):
        raise SetPointError(f"status {number} has sensors {kind}, allowed: 0 <= sensors <= {_FIX}")
    if kind == _NONE:
        return None
    w, x, y, z, seen, *fix = sensed
    turned = _orientation(number, (w, x, y, z))
    if kind == _GYRO:
        return CabinSensors(turned)
    w, x, y, z = fix
    return CabinSensors(turned, int(seen), _orientation(number, (w, x, y, z)))


def _orientation(number: int, q: Quat) -> Quat:
    if not abs(hypot(*q) - 1.0) <= _UNIT:
        raise SetPointError(f"status {number} has a quaternion of norm {hypot(*q):.6g}, allowed: 1")
    return normalise(q)
