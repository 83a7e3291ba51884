"""Our own packet of a vehicle's state, version 1, for simulators that have none of their own.

It is a UDP datagram of 128 bytes, little-endian, without padding: all fields lie where a C struct
of the same order has them. `atlas_packet.h` beside this file writes it in C, `encode` in Python.

| offset | type      | field                                                                       |
|-------:|-----------|-----------------------------------------------------------------------------|
|      0 | char[4]   | magic: `ATVP`                                                               |
|      4 | uint8     | version: 1                                                                  |
|      5 | uint8     | kind of check: 0 = CRC-32, 1 = HMAC-SHA-256                                 |
|      6 | uint8     | attitude: 0 = quaternion, 1 = Euler angles                                  |
|      7 | uint8     | 0; not looked at                                                            |
|      8 | uint64    | session: a random number, another one each time the sender starts           |
|     16 | uint64    | sequence: strictly increasing within a session                              |
|     24 | double    | time of the simulation, s; it stands still while the simulation does        |
|     32 | double[4] | attitude of the body in local north-east-down: quaternion w, x, y, z that   |
|        |           | turns vectors of the body into north-east-down, of length 1 to 1e-3; or     |
|        |           | roll, pitch, heading (rad; within 2 pi, pi / 2, 2 pi of zero) and a number  |
|        |           | that is not looked at                                                       |
|     64 | double[3] | body rates p, q, r, forward-right-down, rad/s; not the Euler angles' rates  |
|     88 | double[3] | specific force at the pilot's eye, forward-right-down, m/s^2: acceleration  |
|        |           | less gravity, what an accelerometer there shows. At rest and upright it is  |
|        |           | (0, 0, -9.80665): scale it by that over the local gravity                   |
|    112 | uint8[16] | check of bytes 0 to 111                                                     |

Check 0 is the CRC-32 of zlib, PNG and Ethernet as a uint32, then 12 zeros; it finds damage, not
forgery. Check 1 is the first 16 bytes of HMAC-SHA-256 (RFC 2104, FIPS 180-4) with a shared key of
16 to 64 bytes. A receiver with a key takes nothing but check 1: a stranger's packets are refused,
and recorded ones of the same run, too. Packets recorded in an earlier run are not told from new
ones until the sender's own have come. Nothing in a packet is encrypted.

A packet of another session is refused for as long as the one before it still sends (`Stream`).
"""

import hmac
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from math import hypot, inf, pi
from pathlib import Path
from struct import Struct
from typing import ClassVar

from ..rotation import ZERO, Vec3, from_euler
from ..signals import VehicleState
from .bounds import Bounds, PacketError
from .sent_flight import SentFlight

MAGIC, VERSION = b"ATVP", 1
CRC32, HMAC_SHA256 = 0, 1
QUATERNION, EULER = 0, 1
SHORTEST_KEY, LONGEST_KEY = 16, 64  # bytes; longer ones HMAC would hash first
DEFAULT_PORT = 5502
SILENCE = 0.3  # s of a session after which another one may begin (assumed)

_content = Struct("<4sBBBxQQd4d3d3d")
_CHECK = 16  # bytes
PACKET_BYTES = _content.size + _CHECK
_LENGTH_ERROR = 1e-3  # of a quaternion
_ROUNDING = 1e-6  # rad
_MOST_SESSIONS = 1000  # that are remembered as over


@dataclass(frozen=True, slots=True)
class PacketFlight(SentFlight):
    """A vehicle that any simulator flies elsewhere and sends here.

    key_file: file with the shared key; None for packets without. It does not go into the log.
    """

    live_only: ClassVar[str] = "source = 'packets' flies only live: atlas-cueing live FILE"

    port: int = DEFAULT_PORT
    key_file: Path | None = None

    @property
    def name(self) -> str:
        """Return the word for all of them."""
        return "packets"

    def large_files(self) -> dict[str, Path]:
        """Return the key's file: it is read where it lies, and no output replaces it."""
        return {} if self.key_file is None else {self.key_file.name: self.key_file}


@dataclass(frozen=True, slots=True)
class Packet:
    """The content of a packet; `state` has the sender's time."""

    session: int
    sequence: int
    state: VehicleState


def encode(session: int, sequence: int, state: VehicleState, key: bytes = b"") -> bytes:
    """Return the packet of a state, with a quaternion.

    Args:
        session: random number of the sender's run, below 2^64.
        sequence: number of the packet in it.
        state: its time is that of the simulation.
        key: shared with the receiver; empty for CRC-32.
    """
    kind = HMAC_SHA256 if key else CRC32
    head = MAGIC, VERSION, kind, QUATERNION, session, sequence, state.time
    content = _content.pack(*head, *state.q_NB, *state.w_NB_B, *state.f_B)
    return content + _check(content, key)


def decode(packet: bytes, bounds: Bounds, key: bytes = b"") -> Packet:
    """Return the content of a packet.

    Raises PacketError for a wrong size, magic, version, check or attitude, and whatever `bounds`
    objects to; what is not finite is out of every bound.
    """
    content = packet[: _content.size]
    _check_kind(packet)
    _, _, kind, attitude, session, sequence, time, *numbers = _content.unpack(content)
    wanted = HMAC_SHA256 if key else CRC32
    if kind != wanted:
        raise PacketError(
            f"check {kind}, allowed: {wanted}, as the receiver has {'a' if key else 'no'} key"
        )
    if not hmac.compare_digest(packet[_content.size :], _check(content, key)):
        raise PacketError("a wrong check: it is damaged, or its sender has another key")
    if not abs(time) < inf:
        raise PacketError(f"time {time} s, allowed: a finite number")
    w: Vec3 = (numbers[4], numbers[5], numbers[6])
    f: Vec3 = (numbers[7], numbers[8], numbers[9])
    state = VehicleState(time, _attitude(attitude, numbers[:4]), w, f)
    objection = bounds.objection(state, 0.0)
    if objection:
        raise PacketError(objection)
    return Packet(session, sequence, state)


class Stream:
    """Decodes the packets of one sender after the other.

    Within a session only a higher sequence is taken. Another session may begin when the present one
    has been silent for SILENCE, and none that is over begins again.
    """

    def __init__(self, bounds: Bounds, key: bytes = b"") -> None:
        """Start without a session; `key` is shared with the sender, or empty."""
        self._bounds, self._key = bounds, key
        self._session: int | None = None
        self._over: dict[int, None] = {}
        self._sequence, self._arrival, self._time = -1, -inf, -inf

    def decode(self, packet: bytes, arrival: float) -> tuple[VehicleState, float | None]:
        """Return the state, called `arrival` (s), and the time of the simulation (s).

        A state whose time has not gone on stands still: its rates are zero. Raises PacketError as
        the function does, and for a packet whose turn it is not.
        """
        found = decode(packet, self._bounds, self._key)
        if found.session != self._session:
            self._begin(found.session, arrival)
        elif found.sequence <= self._sequence:
            raise PacketError(f"sequence {found.sequence} after {self._sequence}, allowed: higher")
        state = found.state
        rates = ZERO if state.time == self._time else state.w_NB_B
        self._sequence, self._arrival, self._time = found.sequence, arrival, state.time
        return VehicleState(arrival, state.q_NB, rates, state.f_B), state.time

    def _begin(self, session: int, arrival: float) -> None:
        if session in self._over:
            raise PacketError(f"session {session:#x} is over, allowed: a new one")
        if arrival - self._arrival < SILENCE:
            raise PacketError(f"session {session:#x} while another one sends, allowed: one sender")
        if self._session is not None:
            self._over[self._session] = None
        if len(self._over) > _MOST_SESSIONS:
            del self._over[next(iter(self._over))]
        self._session, self._time = session, -inf


def _check_kind(packet: bytes) -> None:
    """Magic and version first: the size belongs to them."""
    if packet[:4] != MAGIC:
        raise PacketError(f"it starts with {packet[:4]!r}, allowed: {MAGIC!r}")
    if len(packet) > len(MAGIC) and packet[4] != VERSION:
        raise PacketError(f"version {packet[4]} of our own packet, allowed: {VERSION}")
    if len(packet) != PACKET_BYTES:
        raise PacketError(f"{len(packet)} bytes, allowed: {PACKET_BYTES}")


def _attitude(kind: int, numbers: Sequence[float]) -> tuple[float, float, float, float]:
    a, b, c, d = numbers
    if kind == QUATERNION:
        length = hypot(a, b, c, d)
        if not abs(length - 1.0) <= _LENGTH_ERROR:
            raise PacketError(f"quaternion of length {length:.6g}, allowed: 1 to {_LENGTH_ERROR:g}")
        return a / length, b / length, c / length, d / length
    if kind != EULER:
        raise PacketError(f"attitude of kind {kind}, allowed: {QUATERNION} or {EULER}")
    largest = 2.0 * pi + _ROUNDING
    if not (abs(a) <= largest and abs(b) <= 0.5 * pi + _ROUNDING and abs(c) <= largest):
        raise PacketError(
            f"roll {a:.4g}, pitch {b:.4g}, heading {c:.4g} rad is no triple of Euler angles"
        )
    return from_euler(c, b, a)


def _check(content: bytes, key: bytes) -> bytes:
    if key:
        return hmac.digest(key, content, sha256)[:_CHECK]
    return zlib.crc32(content).to_bytes(_CHECK, "little")
