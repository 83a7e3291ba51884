"""The packet by which a loop asks the drives for their status, version 1.

A UDP datagram of 112 bytes, little-endian, without padding. It comes from the address of the set
points and goes to theirs, before the first of them and once a second from then on.

| offset | type      | field                                                                       |
|-------:|-----------|-----------------------------------------------------------------------------|
|      0 | char[4]   | magic: `ATSH`                                                               |
|      4 | uint8     | version: 1                                                                  |
|      5 | uint8     | kind of check, as in `sealing`                                              |
|      6 | uint16    | 0; not looked at                                                            |
|      8 | uint64    | session: that of the set points                                             |
|     16 | uint64    | number: strictly increasing within a session                                |
|     24 | int64     | time: when it was sent, ns on the sender's CLOCK_MONOTONIC                  |
|     32 | uint8[16] | limits: hash of the limits that the sender keeps, see below                 |
|     48 | double[3] | correction of the angles of wheels 1 to 3, rad: 0                           |
|     72 | double[3] | correction of the stage's position x, y, z, m, frame W: 0                   |
|     96 | uint8[16] | check of bytes 0 to 95                                                      |

The hash of limits is BLAKE2s, without a key, of 16 bytes, over 21 doubles, little-endian: speed,
acceleration and jerk of the wheels, 1 to 3 each (rad, s), then travel, speed, acceleration and jerk
of the stage, x, y, z each (m, s), exactly as in the platform file. Equal hashes say that both sides
derive the same stop from the same set point. Where the platform keeps traction (`[traction] keep`)
its stop is soft, and two doubles follow: the share of their acceleration that wheels and stage
brake with (`certified_axis.SoftStop`).

The correction is room for a constant that a later version may add to all set points of its session,
such as an encoder's offset. A receiver of version 1 refuses any but zero.

A receiver that hears a good one sends its status (`status`) to where it came from for the next
2.5 s, whether it follows that sender or not.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from hashlib import blake2s
from struct import Struct, pack

from ...errors import SetPointError
from ...signals import StageLimits, WheelLimits
from .sealing import Layout, seal, unseal

HASH_SIZE = 16  # bytes
_LAYOUT = Layout(b"ATSH", 1, Struct("<4sBB2xQQq16s6d"), 4)
SIZE = _LAYOUT.size
_NO_CORRECTION = (0.0,) * 6


@dataclass(frozen=True, slots=True)
class Hello:
    """The content of a packet: session, number, time (ns) and hash of limits."""

    session: int
    number: int
    time: int
    limits: bytes


def encode(hello: Hello, key: bytes = b"") -> bytes:
    """Return the packet, with the shared key if there is one."""
    h = hello
    return seal(_LAYOUT, key, h.session, h.number, h.time, h.limits, *_NO_CORRECTION)


def decode(packet: bytes, key: bytes = b"") -> Hello:
    """Return the content of a packet.

    Raises SetPointError for a wrong size, magic, version, check, or a correction.
    """
    session, number, time, limits, *correction = unseal(_LAYOUT, packet, key)
    if tuple(correction) != _NO_CORRECTION:
        raise SetPointError(f"packet {number} has a correction {correction}, allowed: 0 only")
    return Hello(session, number, time, limits)


def is_hello(packet: bytes) -> bool:
    """Whether a datagram claims to be one, by its magic."""
    return packet[:4] == _LAYOUT.magic


def limits_hash(wheels: WheelLimits, stage: StageLimits) -> bytes:
    """Return the hash of these limits, 16 bytes."""
    numbers = (
        *(*wheels.speed, *wheels.acceleration, *wheels.jerk),
        *(*stage.travel, *stage.speed, *stage.acceleration, *stage.jerk),
    )
    soft = (wheels.stop_share, stage.stop_share)
    packed = pack("<21d", *numbers)
    if soft != (1.0, 1.0):  # drives with another stop are not these
        packed += pack("<2d", *soft)
    return blake2s(packed, digest_size=HASH_SIZE).digest()
