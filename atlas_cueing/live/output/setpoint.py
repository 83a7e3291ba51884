"""The set-point packet for a drive controller, version 2, of which one is sent every tick.

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
|    160 | double[3] | angle of wheels 1 to 3, rad, continuous: beyond a turn it goes on; begins |
|        |           | at that of the pose from which the session starts, zero at home             |
|    184 | uint8[16] | check of bytes 0 to 183                                                     |

The checks are those of `sealing`. The key keeps out forged packets, and session and sequence
replayed ones; but a receiver that has just been reset and has not received anything from its loop
yet cannot distinguish an old session from a new one, except by its due time. Nothing in a packet is
encrypted.

Set point k of a run is due one period after number k - 1, through holds, faults and lateness. It is
sent about lead + dt ahead (`loop`), at the latest before number k - 1 is due; so k packets lost
in a row do no harm when lead >= k dt + transport. How a receiver answers is in `hello` and
`status`. Angles and positions are what a drive follows; speeds and accelerations are their
derivatives, to be fed forward. Jerk stays inside the platform
file's limit between any two set points, and so do speed, acceleration and travel at them; a
receiver holds the same limits by configuration. The state tells, and commands nothing.

What a receiver has to do (`receiver` does it, and is the reference):

1. Refuse another size, magic, version or state, a wrong check, a number that is not finite, a
   sequence or a due time that does not increase, a due time more than 0.1 s ahead, and any other
   sender or session than the first good one's, but for 6.
2. Take as the first a set point that stands where the drives stand, and each other one only if
   limited jerk leads to it from the newest, h = the difference of their due times: the inequality
   of `guard`, with its limits. A lost packet is just a longer h.
3. Move from one to the next so that position, speed and acceleration meet both and jerk keeps its
   limit, as `bridge` does.
4. Fly the certified stop, the shortest of limited jerk, or the soft one of a platform that keeps
   traction (`hello`), from the newest set point as soon as that is due and has no
   successor: it is certified to keep the travel. There is no other watchdog and no coasting. The
   sender derives the same stop from the same set point, and its set points then lie on it.
5. Leave that stop for a set point on it (1e-6), or within 20 ms for one that is still to come and
   reachable from where the drives are; refuse all else from then on, until it is reset by hand.
6. When the newest set point was parked and at rest and nothing has come from its sender for 0.5 s,
   that ride has ended: take the first set point of another session, still to come, as in 2. After
   any other end, only once it has been reset by hand.

Clocks: due times are the sender's. On another machine they have to be translated by a clock that is
kept within a millisecond (as by PTP). A receiver that is 3 ms off only shifts the motion; one that
is ahead by more than the lead finds every set point late, and stops; its margins tell the loop. A
receiver may add any constant to all due times of a session, and count angles from any place where
the platform stood.

Where the attitude is corrected by what the cabin's sensors tell (`attitude_correction`), angle,
speed and acceleration of the wheels are those of schedule and correction together. A receiver does
the same as ever.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import isfinite
from struct import Struct

from ...errors import SetPointError
from ...signals import LIVE_STATES
from ..control.command import Command
from .sealing import Layout, seal, unseal

_LAYOUT = Layout(b"ATSP", 2, Struct("<4sBBBxQQq19d"), 5)
SIZE = _LAYOUT.size


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
    return seal(
        *(_LAYOUT, key, state, session, sequence, due, time),
        *(*c.wheel_speed, *c.wheel_acceleration, *c.p_WS_W, *c.v_WS_W, *c.a_WS_W, *c.wheel_angle),
    )


def decode(packet: bytes, key: bytes = b"") -> SetPoint:
    """Return the content of a packet, with the shared key if there is one.

    Raises SetPointError for a wrong size, magic, version, check, state or number.
    """
    state, session, sequence, due, *numbers = unseal(_LAYOUT, packet, key)
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
