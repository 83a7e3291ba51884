"""The set-point packet for a drive controller, version 2, and the socket that sends one every tick.

It is a UDP datagram of 200 bytes, little-endian, without padding: all fields lie where a C struct
of the same order has them.

| offset | type      | field                                                                       |
|-------:|-----------|-----------------------------------------------------------------------------|
|      0 | char[4]   | magic: `ATSP`                                                               |
|      4 | uint8     | version: 2                                                                  |
|      5 | uint8     | kind of check: 0 = CRC-32, 1 = keyed BLAKE2s                                |
|      6 | uint8     | state: 0 parked, 1 engaging, 2 running, 3 holding, 4 parking,               |
|        |           | 5 fault_stopping, 6 stopped, 7 waiting                                      |
|      7 | uint8     | 0; not looked at                                                            |
|      8 | uint64    | session: a random number, another one each time a loop starts               |
|     16 | uint64    | sequence: strictly increasing within a session                              |
|     24 | int64     | due: when the drives shall have the motion below, ns on the sender's        |
|        |           | CLOCK_MONOTONIC                                                             |
|     32 | double    | time of the run, s                                                          |
|     40 | double[3] | speed of wheels 1 to 3, rad/s                                               |
|     64 | double[3] | acceleration of wheels 1 to 3, rad/s^2                                      |
|     88 | double[3] | stage position x, y, z from the centre, m, frame W (x forward, y left,      |
|        |           | z up)                                                                       |
|    112 | double[3] | stage velocity, m/s                                                         |
|    136 | double[3] | stage acceleration, m/s^2                                                   |
|    160 | double[3] | angle of wheels 1 to 3, rad, continuous: beyond a turn it goes on; zero at  |
|        |           | the first set point of a session                                            |
|    184 | uint8[16] | check of bytes 0 to 183                                                     |

Check 0 is the CRC-32 of zlib, PNG and Ethernet as a uint32, then 12 zeros; it finds damage, not
forgery, and is for loopback.
Check 1 is BLAKE2s (RFC 7693) with a shared key of 16 to 32 bytes, a digest of 16 bytes, no salt and
no personalisation. A receiver with a key takes nothing but check 1. The key keeps out forged
packets, and session and sequence replayed ones; but a receiver that has just been reset and has not
received anything from its loop yet cannot distinguish an old session from a new one, except by its
due time. Nothing in a packet is encrypted.

Set point k of a run is due one period after number k - 1, through holds, faults and lateness. It is
sent about lead + dt ahead (`loop`), at the latest before number k - 1 is due; so k packets lost
in a row do no harm when lead >= k dt + transport. Angles and positions are what a drive follows;
speeds and accelerations are their derivatives, to be fed forward. Jerk stays inside the platform
file's limit between any two set points, and so do speed, acceleration and travel at them; a
receiver holds the same limits by configuration. The state tells, and commands nothing.

What a receiver has to do (`receiver` does it, and is the reference):

1. Refuse another size, magic, version or state, a wrong check, a number that is not finite, a
   sequence or a due time that does not increase, a due time more than 0.1 s ahead, and any other
   sender or session than the first good one's.
2. Take as the first a set point that stands where the drives stand, and each other one only if
   limited jerk leads to it from the newest, h = the difference of their due times: the inequality
   of `guard`, with its limits. A lost packet is just a longer h.
3. Move from one to the next so that position, speed and acceleration meet both and jerk keeps its
   limit, as `bridge` does.
4. Fly the shortest stop of limited jerk from the newest set point as soon as that is due and has no
   successor: it is certified to keep the travel. There is no other watchdog and no coasting. The
   sender derives the same stop from the same set point, and its set points then lie on it.
5. Leave that stop for a set point on it (1e-6), or within 20 ms for one that is still to come and
   reachable from where the drives are; refuse all else from then on, until it is reset by hand.

Clocks: due times are the sender's. On another machine they have to be translated by a clock that is
kept within a millisecond (as by PTP). A receiver that is 3 ms off only shifts the motion; one that
is ahead by more than the lead finds every set point late, and stops. A correction
beside the schedule is a constant of the run: a receiver may add any constant to all due times, and
count angles from any place where the platform stood.
"""

import hmac
import ipaddress
import secrets
import socket
import zlib
from dataclasses import dataclass
from hashlib import blake2s
from math import isfinite
from struct import Struct
from typing import TypeAlias

from ...errors import InputError, SetPointError
from ...signals import LIVE_STATES
from ..control.command import Command

Address: TypeAlias = tuple[str, int]
"""Host and port of a sender."""

VERSION = 2
CRC32, BLAKE2S = 0, 1
SHORTEST_KEY = 16  # bytes
LONGEST_KEY = blake2s.MAX_KEY_SIZE
_MAGIC = b"ATSP"
_content = Struct("<4sBBBxQQq19d")
_CHECK = 16  # bytes
SIZE = _content.size + _CHECK


@dataclass(frozen=True, slots=True)
class SetPoint:
    """The content of a packet.

    session, sequence: as in the packet.
    due: when the drives shall have the motion, ns on the sender's CLOCK_MONOTONIC.
    state: by its name.
    command: motion of the drives, with the time of the run.
    """

    session: int
    sequence: int
    due: int
    state: str
    command: Command


def encode(
    session: int,
    sequence: int,
    time: float,
    due: int,
    state: int,
    command: Command,
    key: bytes = b"",
) -> bytes:
    """Return the packet.

    Args:
        session: random number of the sender's run.
        sequence: number of the packet.
        time: of the run, s.
        due: when the drives shall have the motion, ns on CLOCK_MONOTONIC.
        state: place of the state in LIVE_STATES.
        command: motion of the drives.
        key: shared with the receiver; empty for CRC-32.
    """
    c = command
    content = _content.pack(
        *(
            _MAGIC,
            VERSION,
            BLAKE2S if key else CRC32,
            state,
            session,
            sequence,
            due,
            time,
        ),
        *(*c.wheel_speed, *c.wheel_acceleration, *c.p_WS_W, *c.v_WS_W, *c.a_WS_W, *c.wheel_angle),
    )
    return content + _check(content, key)


def decode(packet: bytes, key: bytes = b"") -> SetPoint:
    """Return the content of a packet, with the shared key if there is one.

    Raises SetPointError for a wrong size, magic, version, check, state or number.
    """
    if len(packet) != SIZE:
        raise SetPointError(f"packet of {len(packet)} bytes, allowed: {SIZE}")
    content = packet[: _content.size]
    magic, version, kind, state, session, sequence, due, *numbers = _content.unpack(content)
    if magic != _MAGIC:
        raise SetPointError(f"packet starts with {magic!r}, allowed: {_MAGIC!r}")
    if version != VERSION:
        raise SetPointError(f"packet of version {version}, allowed: {VERSION}")
    wanted = BLAKE2S if key else CRC32
    if kind != wanted:
        raise SetPointError(
            f"packet has check {kind}, allowed: {wanted}, as the receiver has"
            f" {'a' if key else 'no'} key"
        )
    if not hmac.compare_digest(packet[_content.size :], _check(content, key)):
        raise SetPointError(
            f"packet {sequence} has a wrong check: it is damaged, or its sender has another key"
        )
    if state >= len(LIVE_STATES):
        raise SetPointError(
            f"packet {sequence} has state {state}, allowed: 0 <= state <= {len(LIVE_STATES) - 1}"
        )
    for place, number in enumerate(numbers):
        if not isfinite(number):
            raise SetPointError(
                f"packet {sequence} has {number} as number {place}, allowed: finite numbers"
            )
    time, w1, w2, w3, b1, b2, b3, px, py, pz, vx, vy, vz, ax, ay, az, q1, q2, q3 = numbers
    rates = (w1, w2, w3), (b1, b2, b3)
    command = Command(time, *rates, (px, py, pz), (vx, vy, vz), (ax, ay, az), (q1, q2, q3))
    return SetPoint(session, sequence, due, LIVE_STATES[state], command)


class SetPointSender:
    """Sends set points to one receiver and never waits for it.

    unsent: packets that the kernel did not take: its buffer was full, or there is no receiver.
    """

    def __init__(self, host: str, port: int, key: bytes = b"") -> None:
        """Connect to a numeric IPv4 address; one off this machine needs a shared key.

        Raises InputError for an address without its key, one of a group or of all, and a bad port
        or key.
        """
        check_key(key)
        _check_address(host, key)
        self.unsent = 0
        self._key, self._session = key, secrets.randbits(64)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        try:
            self._socket.connect((host, port))
        except (OSError, OverflowError) as error:
            self._socket.close()
            raise InputError(f"set points cannot be sent to {host}:{port}: {error}") from error

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        """Send one set point, see `encode`; what cannot be sent at once is not sent at all.

        Return whether the kernel took it.
        """
        packet = encode(self._session, sequence, time, due, state, command, self._key)
        try:
            self._socket.send(packet)
        except OSError:
            # BlockingIOError: the buffer is full; ConnectionRefusedError: there is no receiver
            self.unsent += 1
            return False
        return True

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()


def check_key(key: bytes) -> None:
    """Raise InputError for a key that is too short or too long; an empty one means none."""
    if key and not SHORTEST_KEY <= len(key) <= LONGEST_KEY:
        raise InputError(
            f"shared key of {len(key)} bytes, allowed: {SHORTEST_KEY} <= bytes <= {LONGEST_KEY}"
        )


def _check_address(host: str, key: bytes) -> None:
    try:
        address = ipaddress.IPv4Address(host)
    except ValueError as error:
        raise InputError(
            f"set-point receiver {host!r}: allowed: a numeric IPv4 address such as 127.0.0.1"
        ) from error
    if address.is_multicast or address.is_unspecified:
        raise InputError(f"set-point receiver {host}: allowed: the address of one machine")
    if not (address.is_loopback or key):
        raise InputError(
            f"set-point receiver {host} is not on this machine: allowed with a shared key only, or"
            " 127.0.0.1"
        )


def _check(content: bytes, key: bytes) -> bytes:
    if key:
        return blake2s(content, digest_size=_CHECK, key=key).digest()
    return zlib.crc32(content).to_bytes(_CHECK, "little")
