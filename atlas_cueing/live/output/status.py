"""The status packet of a drive controller, version 1: where the drives are, and why they stop.

A UDP datagram of 240 bytes, little-endian, without padding, to every sender of a good `hello`
within the last 2.5 s: 50 times a second, and at once when state or reason have changed.

| offset | type      | field                                                                       |
|-------:|-----------|-----------------------------------------------------------------------------|
|      0 | char[4]   | magic: `ATSS`                                                               |
|      4 | uint8     | version: 1                                                                  |
|      5 | uint8     | kind of check, as in `sealing`                                              |
|      6 | uint8     | state: 0 waiting (for a first set point), 1 following, 2 stopping (its own  |
|        |           | stop, also when that has ended), 3 latched (until it is reset by hand)      |
|      7 | uint8     | 0; not looked at                                                            |
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
|    136 | char[88]  | reason: why it stops or is latched, or why the last packet was refused      |
|        |           | while waiting; UTF-8, the rest zeros                                        |
|    224 | uint8[16] | check of bytes 0 to 223                                                     |

Watchdog: the loop faults, by the stop that the drives fly too, within two ticks of a status that
says latched; when it has heard none for its drive timeout (50 ms) while it moves; when a position
is off its own for the same time by more than 0.1 deg or 1 mm; and when another session is followed.
At rest it does not set out as long as any of that holds, the hash of limits is another than its
own, or a margin is under 2 ms.

Positions are those that the drives have (measured, where they are measured), not those they were
told. Clocks: `setpoint`.
"""

from math import isfinite, isnan
from struct import Struct

from ...errors import SetPointError
from ...rotation import Vec3
from ..control.drive_status import DRIVE_STATES, DriveStatus
from .sealing import Layout, seal, unseal

REASON_SIZE = 88  # bytes
_LAYOUT = Layout(b"ATSS", 1, Struct(f"<4sBBBxQQqQQd16s6dQQ{REASON_SIZE}s"), 5)
SIZE = _LAYOUT.size


def encode(session: int, status: DriveStatus, key: bytes = b"") -> bytes:
    """Return the packet that answers a hello of `session`, with the shared key if there is one."""
    s = status
    return seal(
        *(_LAYOUT, key, DRIVE_STATES.index(s.state), session, s.number, s.time, s.followed),
        *(s.newest, s.margin, s.limits, *s.wheel_angle, *s.p_WS_W, s.good, s.refused),
        s.reason.encode()[:REASON_SIZE],
    )


def decode(packet: bytes, key: bytes = b"") -> tuple[int, DriveStatus]:
    """Return the session of the hello that a packet answers, and its status.

    Raises SetPointError for a wrong size, magic, version, check, state or number.
    """
    state, session, number, time, followed, newest, margin, limits, *rest = unseal(
        _LAYOUT, packet, key
    )
    *positions, good, refused, reason = rest
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
        *(angle, place, good, refused),
    )
