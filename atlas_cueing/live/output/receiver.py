"""The drive controller's side of the set points: a reference receiver.

It does what `setpoint` asks of one. Times are ns of the sender's CLOCK_MONOTONIC; a receiver on
another machine adds the difference of the clocks, which it has to keep itself (as with PTP).
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Protocol

from ...errors import SetPointError
from ...rotation import ZERO, Vec3
from ...signals import StageLimits, WheelLimits
from ..control.certified_axis import six_axes
from ..control.command import Command, axes_of, command_from
from .bridge import Bridge
from .sealing import Address, check_key
from .setpoint import SetPoint, decode

AHEAD_S = 0.1  # s that a due time may lie in the future; more is a clock that is not the sender's
REJOIN_S = 0.02  # s into its own stop that it may be led away from it
FREE_S = 0.5  # s without a set point after which a parked ride has ended (assumed)
SAME = 1e-6  # m, rad and their derivatives: a set point as near to the own stop lies on it
_NO_TICK = 1e-9  # s
_NOT_THERE = "packet {} is the first and does not stand where the drives do"


class _Motion(Protocol):
    """One axis over time."""

    def at(self, t: float) -> Vec3:
        """Return position, speed and acceleration t s after its beginning."""


@dataclass(frozen=True, slots=True)
class _Piece:
    """Motion of the six axes from `begin` to `end`, ns."""

    begin: int
    end: int
    axes: Sequence[_Motion]

    def at(self, now: int) -> list[Vec3]:
        """Return position, speed and acceleration of each axis at `now`, ns."""
        t = max(1e-9 * (now - self.begin), 0.0)
        return [axis.at(t) for axis in self.axes]


@dataclass(frozen=True, slots=True)
class ReceiverReport:
    """What the drives tell the loop.

    state: one of control.drive_status.DRIVE_STATES.
    reason: why it stops or is latched, or why the last packet was refused while it waits.
    command: where the drives are; None while waiting.
    margin: least time from a packet's arrival until it was due, since the last report, s.
    good, refused: number of packets taken and not taken since the start.
    """

    state: str
    reason: str
    command: Command | None
    margin: float
    good: int
    refused: int


class SetPointReceiver:
    """Follows the set points of one ride, and stops by itself when one has no successor.

    A ride whose last set point was parked, and which has sent none for FREE_S since, has ended:
    then the next one is followed, from where the drives stand. Anything else needs a `reset`.

    good, refused: number of packets taken and not taken since the start.
    """

    def __init__(
        self,
        wheel_limits: WheelLimits,
        stage_limits: StageLimits,
        key: bytes = b"",
        place: Vec3 = ZERO,
    ) -> None:
        """Wait for the first set point.

        Args:
            wheel_limits: of the wheels, as the sender has them.
            stage_limits: of the stage, as the sender has them.
            key: shared with the sender; empty for none.
            place: of the stage now, m, W.

        Raises InputError for a bad key.
        """
        check_key(key)
        self._limits = six_axes(_NO_TICK, wheel_limits, stage_limits)
        self._key = key
        self.good = self.refused = 0
        self.reset(place)

    def reset(self, place: Vec3 = ZERO) -> None:
        """Forget the sender and why it stopped; the platform stands at `place` (m, W)."""
        self._place = place
        self._pieces: deque[_Piece] = deque()  # up to the newest set point
        self._stop = _Piece(0, 0, ())  # from the newest set point on
        self._sender: Address | None = None
        self._parked_until: int | None = None  # when the newest set point came, if parked, ns
        self._newest: SetPoint | None = None
        self._stopping: int | None = None  # since when, ns
        self._latched = self._refusal = ""
        self._margin = inf

    @property
    def tripped(self) -> str:
        """Why it stops, or has stopped and takes no set points; empty otherwise."""
        if self._latched or self._stopping is None or self._newest is None:
            return self._latched
        return f"no successor of set point {self._newest.sequence} when that was due"

    @property
    def newest(self) -> SetPoint | None:
        """The last good set point; None before the first."""
        return self._newest

    @property
    def place(self) -> Vec3:
        """Where the stage stands as long as it waits for a first set point, m, W."""
        return self._place

    @property
    def state(self) -> tuple[str, str]:
        """Its state and the reason, as in a report."""
        if self._newest is None:
            return "waiting", self._refusal
        reason = self.tripped
        return "latched" if self._latched else "stopping" if reason else "following", reason

    def report(self, now: int) -> ReceiverReport:
        """Return the state at `now` (ns), to be sent 50 times a second and when it changes."""
        command = self.at(now)
        margin, self._margin = self._margin, inf
        return ReceiverReport(*self.state, command, margin, self.good, self.refused)

    def take(self, packet: bytes, sender: Address, now: int) -> str:
        """Take a packet of `sender` that came at `now` (ns); return why it was refused, or ''."""
        self._watch(now)
        try:
            point = decode(packet, self._key)
        except SetPointError as error:
            reason = str(error)
        else:
            reason = self._stranger(point, sender, now) or self._follow(point, now)
        if reason:
            self.refused += 1
            self._refusal = reason
            return reason
        self.good += 1
        self._sender = sender
        self._parked_until = now if point.state == "parked" and _stands(point) else None
        self._margin = min(self._margin, 1e-9 * (point.due - now))
        return ""

    def at(self, now: int) -> Command | None:
        """Return the motion of the drives at `now` (ns), which does not decrease.

        It is None before the first good packet: stand still.
        """
        self._watch(now)
        return None if self._newest is None else command_from(1e-9 * now, self._state(now))

    def _state(self, now: int) -> list[Vec3]:
        while self._pieces and self._pieces[0].end <= now:
            self._pieces.popleft()
        return (self._pieces[0] if self._pieces else self._stop).at(now)

    def _watch(self, now: int) -> None:
        """Begin the own stop when the newest set point is due and moves."""
        newest = self._newest
        if newest and self._stopping is None and now > newest.due and not _stands(newest):
            self._stopping = newest.due

    def _stranger(self, point: SetPoint, sender: Address, now: int) -> str:
        """Describe why an intact packet is none of its sender's next ones; empty when it is."""
        last, ahead = self._newest, 1e-9 * (point.due - now)
        if self._latched:
            return f"stopped: {self._latched}; reset first"
        if ahead > AHEAD_S:
            return f"packet {point.sequence} is due {ahead:.3f} s ahead, allowed: {AHEAD_S} s"
        if last is None:
            return ""
        if (sender, point.session) != (self._sender, last.session):
            return self._successor(point, sender, now)
        if point.sequence <= last.sequence:
            return (
                f"packet {point.sequence} comes after {last.sequence}: out of order or sent again"
            )
        if point.due <= last.due:
            return f"packet {point.sequence} is not due later than the one before"
        return ""

    def _successor(self, point: SetPoint, sender: Address, now: int) -> str:
        """Make room for another ride if this one has ended; describe why not, or return ''."""
        ended = self._parked_until is not None and now - self._parked_until > 1e9 * FREE_S
        if not (ended and self._newest and point.due > now):
            return (
                f"packet {point.sequence} is from another sender, {sender[0]}:{sender[1]}, session"
                f" {point.session}; this ride has not ended parked"
            )
        place = self._newest.command.p_WS_W
        if not _begins(point, place):
            return _NOT_THERE.format(point.sequence)
        self.reset(place)
        return ""

    def _follow(self, point: SetPoint, now: int) -> str:
        """Take a set point into the motion; describe why it cannot be, or return ''."""
        last = self._newest
        if last is None:
            if not _begins(point, self._place):
                return _NOT_THERE.format(point.sequence)
            self._go_on(point)
            return ""
        if _same(self._stop.at(point.due), axes_of(point.command)):
            if point.due > now:
                self._pieces.append(_Piece(last.due, point.due, self._stop.axes))
                self._stopping = None
            self._go_on(point)
            return ""
        if now <= last.due:
            return self._lead(point, last.due, axes_of(last.command))
        if self._stopping is not None and now - self._stopping > 1e9 * REJOIN_S:
            self._latched = f"{self.tripped}, and packet {point.sequence} is not on its way to rest"
            return self._latched
        if point.due <= now:
            return f"packet {point.sequence} came {1e-9 * (now - point.due):.4f} s after it was due"
        return self._lead(point, now, self._state(now))

    def _lead(self, point: SetPoint, begin: int, start: Sequence[Vec3]) -> str:
        """Lead from a state at `begin` (ns) to the set point, if that can be reached."""
        h, end = 1e-9 * (point.due - begin), axes_of(point.command)
        for limits, one, other in zip(self._limits, start, end, strict=True):
            if breach := limits.breach(h, *one, *other):
                return f"packet {point.sequence} cannot be reached: {breach}"
        axes = [
            Bridge(limits, h, one, other)
            for limits, one, other in zip(self._limits, start, end, strict=True)
        ]
        self._pieces.append(_Piece(begin, point.due, axes))
        self._stopping = None
        self._go_on(point)
        return ""

    def _go_on(self, point: SetPoint) -> None:
        """Make the set point the newest; from it on there is its stop."""
        states = zip(self._limits, axes_of(point.command), strict=True)
        self._stop = _Piece(point.due, point.due, [limits.stop(*state) for limits, state in states])
        self._newest = point


def _stands(point: SetPoint) -> bool:
    """Whether the set point is at rest."""
    return not any(v or a for _, v, a in axes_of(point.command))


def _begins(point: SetPoint, place: Vec3) -> bool:
    """Whether the set point may be the first of drives whose stage stands at `place` (m, W)."""
    off = max(abs(a - b) for a, b in zip(point.command.p_WS_W, place, strict=True))
    return _stands(point) and off <= SAME


def _same(one: Sequence[Vec3], other: Sequence[Vec3]) -> bool:
    pairs = zip(one, other, strict=True)
    return all(abs(x - y) <= SAME for a, b in pairs for x, y in zip(a, b, strict=True))
