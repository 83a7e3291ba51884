"""The drives' answer to the loop: a status 50 times a second, and at each change."""

from dataclasses import dataclass
from typing import Protocol

from ...errors import SetPointError
from ...rotation import ZERO, Vec3
from ..control.drive_status import CabinSensors, DriveStatus
from . import hello, status
from .receiver import SetPointReceiver
from .sealing import Address

PERIOD_NS = 20_000_000  # from one status to the next
HEARD_NS = 2_500_000_000  # that a hello is answered for
_MOST_LOOPS = 4  # that are answered at a time: the one followed, and others that wait


class MeasuredPlatform(Protocol):
    """Where a platform is at present, as its encoders and sensors tell."""

    def wheel_angle(self) -> Vec3:
        """Return the angle of each wheel, rad, as the set points count them."""

    def sensors(self) -> CabinSensors:
        """Return what the sensors of the cabin tell."""


@dataclass(slots=True)
class _Loop:
    """A sender of hellos: its session, the number of its last hello, and when that came (ns)."""

    session: int
    number: int
    heard: int


class StatusSender:
    """Makes the status packets of a receiver, for all loops that have asked."""

    def __init__(
        self,
        receiver: SetPointReceiver,
        limits: bytes,
        key: bytes = b"",
        platform: MeasuredPlatform | None = None,
    ) -> None:
        """Begin with no loop that has asked.

        Args:
            receiver: whose status is told.
            limits: hash of the limits that it keeps (`hello.limits_hash`).
            key: shared with the loop; empty for none.
            platform: what is measured; without, the drives are where they were told to be, and the
                cabin has no sensors.
        """
        self._receiver, self._limits, self._key = receiver, limits, key
        self._platform = platform
        self._loops: dict[Address, _Loop] = {}
        self._number = 0
        self._told = ("", "")
        self._next = 0  # ns

    def hear(self, packet: bytes, sender: Address, now: int) -> str:
        """Take a hello that came at `now` (ns); return why it was refused, or ''."""
        try:
            heard = hello.decode(packet, self._key)
        except SetPointError as error:
            return str(error)
        known = self._loops.get(sender)
        if known and known.session == heard.session and heard.number <= known.number:
            return f"hello {heard.number} comes after {known.number}: out of order or sent again"
        self._forget(now)
        if known is None and len(self._loops) >= _MOST_LOOPS:
            return f"hello from {sender[0]}:{sender[1]}: {_MOST_LOOPS} loops are answered already"
        self._loops[sender] = _Loop(heard.session, heard.number, now)
        self._next = min(self._next, now)
        return ""

    def due(self, now: int) -> list[tuple[bytes, Address]]:
        """Return the packets to be sent at `now` (ns), each with its address."""
        self._receiver.at(now)  # it may begin to stop
        state = self._receiver.state
        if now < self._next and state == self._told:
            return []
        self._forget(now)
        self._told, self._next = state, now + PERIOD_NS
        one = self._status(now)
        return [
            (status.encode(loop.session, one, self._key), sender)
            for sender, loop in self._loops.items()
        ]

    def _status(self, now: int) -> DriveStatus:
        self._number += 1
        receiver = self._receiver
        report, newest = receiver.report(now), receiver.newest
        angle, platform = report.command.wheel_angle if report.command else ZERO, self._platform
        if report.command and platform:
            angle = platform.wheel_angle()
        place = report.command.p_WS_W if report.command else receiver.place
        followed, sequence = (newest.session, newest.sequence) if newest else (0, 0)
        return DriveStatus(
            number=self._number,
            state=report.state,
            reason=report.reason,
            time=now,
            followed=followed,
            newest=sequence,
            margin=report.margin,
            limits=self._limits,
            wheel_angle=angle,
            p_WS_W=place,
            good=report.good,
            refused=report.refused,
            sensors=platform.sensors() if platform else None,
        )

    def _forget(self, now: int) -> None:
        """Forget who has not asked for long."""
        gone = [sender for sender, loop in self._loops.items() if now - loop.heard > HEARD_NS]
        for sender in gone:
            del self._loops[sender]
