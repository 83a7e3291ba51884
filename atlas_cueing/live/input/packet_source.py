"""The source for a simulator elsewhere: packets over UDP, of FlightGear's kind or of our own."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import TypeAlias

from ...rotation import ZERO
from ...signals import VehicleState
from ...vehicles import PacketError
from .arrival_times import ArrivalTimes
from .discontinuity import discontinuity
from .extrapolation import Extrapolation
from .measured_rate import MeasuredRate
from .source import SourceReading
from .udp import Address, Datagram, Receiver

MAX_PACKETS = 8  # taken in one read: 67 ms at 120 Hz, and some 0.2 ms of work (assumed)
GAP_PERIODS = 3.0  # of the measured rate; a shorter silence is never a gap (assumed)
LONGEST_PATIENCE = 1.0  # s; then a hold gives the input up, however slow its sender is
ANOTHER_RATE = 1.25  # factor from which on the measured rate is told (assumed)

Decode: TypeAlias = Callable[[bytes, float], tuple[VehicleState, float | None]]
"""From a packet and its arrival (s): the state, called as of then, and the sender's own time (s),
None where packets carry none. Raises PacketError for a packet that cannot be believed."""


@dataclass(frozen=True, slots=True)
class PacketStream:
    """What is known of a stream of packets before it comes.

    decode: of one packet.
    place: where they come to, for messages.
    rate_hz: nominal packets per second.
    hold_after: s without a good packet from which on the platform holds.
    """

    decode: Decode
    place: str
    rate_hz: float
    hold_after: float


class PacketSource:
    """Reads the newest packets, checks them all, and goes on from the last good one.

    The time of a sample is that of its arrival without the jitter, and as far from the last one as
    the sender says, if it does. A packet that does not follow from the one before is dropped; if
    the next follows from it, the vehicle has jumped, and if the next follows from the one before,
    it was late, repeated or forged. The copy of a packet right behind it is dropped; one in due
    time is a simulator that stands still, and taken with rates of zero. After a gap the vehicle is
    where the packet says, and that is a jump, too. A gap is longer than `hold_after` and than three
    periods of the measured rate.
    """

    def __init__(self, receiver: Receiver, stream: PacketStream) -> None:
        """Start without a packet; `receiver` is where datagrams come from."""
        self._receiver, self._stream = receiver, stream
        self._arrivals = ArrivalTimes(stream.rate_hz)
        self._measured = MeasuredRate()
        self._patience = max(stream.hold_after, GAP_PERIODS / stream.rate_hz)
        self._begun: float | None = None  # s; of the first read
        self._gap_before = inf  # s, between the two packets before the last one
        self._rate_told = ""
        self._extrapolation: Extrapolation | None = None
        # of the newest good packet, with its arrival as its time
        self._last: VehicleState | None = None
        self._content = b""  # of the same packet
        self._sender: Address | None = None  # of the same packet
        self._suspect: VehicleState | None = None  # the packet before, when it did not follow
        self._pinned: Address | None = None
        self._dropped = self._bad_in_a_row = 0
        self._jumped = False
        self._reason = ""
        self._objection = ""  # to the last packet, since the last good one

    # The simulator owns its time
    def read(self, time: float, advance: bool) -> SourceReading:  # noqa: ARG002
        """Read the state at `time` (s), see `Source`; takes at most MAX_PACKETS packets."""
        self._dropped, self._jumped, self._reason = 0, False, ""
        self._begun = time if self._begun is None else self._begun
        for _ in range(MAX_PACKETS):
            datagram = self._receiver.receive()
            if datagram is None:
                break
            self._take(datagram, time)
        vehicle = self._extrapolation.at(time) if self._extrapolation else None
        age = time - self._last.time if self._last else inf
        return SourceReading(
            *(vehicle, age, self._dropped, self._bad_in_a_row, self._jumped, False, self._reason),
            patience=self._patience,
            remark=self._remark(age),
        )

    def prepare(self, time: float) -> None:
        """Do nothing: packets come when they come."""

    def pin(self) -> None:
        """Take packets of the present sender only; before the first good packet, do nothing."""
        if self._sender is not None:
            self._pinned = self._sender
            self._receiver.pin(self._sender)

    def release(self) -> None:
        """Take packets of any sender again."""
        self._pinned = None
        self._receiver.release()

    def close(self) -> None:
        """Close the port."""
        self._receiver.close()

    def _remark(self, age: float) -> str:
        if age <= self._patience:
            return self._rate_told
        if self._objection:
            return f"no good packet comes to {self._stream.place}: {self._objection}"
        return f"nothing comes to {self._stream.place}"

    def _take(self, datagram: Datagram, time: float) -> None:
        if self._pinned not in (None, datagram.sender):
            # not counted in a row: a stranger must not be able to stop the vehicle
            self._dropped += 1
            self._reason = f"packet from {datagram.sender}, pinned to {self._pinned}"
            self._objection = f"it is not from {_named(self._pinned)}, as those before"
            return
        before = self._last.time if self._last else -inf
        arrival = min(max(time - datagram.ago, before), time)
        try:
            state, sent = self._decoded(datagram, arrival)
            self._add(state, sent, datagram)
        except PacketError as error:
            self._dropped += 1
            self._bad_in_a_row += 1
            self._reason = self._objection = str(error)

    def _decoded(self, datagram: Datagram, arrival: float) -> tuple[VehicleState, float | None]:
        state, sent = self._stream.decode(datagram.content, arrival)
        if datagram.content != self._content:
            return state, sent
        if self._last and arrival - self._last.time < 0.5 * self._arrivals.period:
            raise PacketError("a copy of the packet before it")
        return replace(state, w_NB_B=ZERO), sent

    def _add(self, state: VehicleState, sent: float | None, datagram: Datagram) -> None:
        """Go on from a packet that follows, or begin anew after a jump.

        Raises PacketError for one that does neither.
        """
        jump = self._jump_to(state)
        self._measure(state.time)
        sample = replace(state, time=self._arrivals.time(state.time, sent))
        if self._extrapolation is None or jump:
            self._extrapolation = Extrapolation(sample, self._arrivals.period)
            self._jumped, self._reason = bool(jump), jump
        else:
            self._extrapolation.add(sample)
        self._last, self._suspect, self._bad_in_a_row = state, None, 0
        self._content, self._sender, self._objection = datagram.content, datagram.sender, ""

    def _measure(self, arrival: float) -> None:
        """Count a good packet; set the patience, and the remark about the rate, which is kept."""
        gap = arrival - self._last.time if self._last else 0.0
        if gap > max(self._patience, GAP_PERIODS * self._gap_before):
            self._measured.restart()
        self._gap_before = gap if self._last else inf
        if self._begun is None or arrival < self._begun:
            return  # left in the port from before the run, with what found no room there missing
        self._measured.add(arrival)
        rate = self._measured.rate_hz
        if rate is None:
            return
        nominal = self._stream.rate_hz
        self._arrivals.expect(rate)
        self._patience = min(max(self._stream.hold_after, GAP_PERIODS / rate), LONGEST_PATIENCE)
        if not self._rate_told and not 1.0 / ANOTHER_RATE < rate / nominal < ANOTHER_RATE:
            self._rate_told = f"packets come at {rate:.3g} Hz, vehicle.rate_hz = {nominal:g}"

    def _jump_to(self, state: VehicleState) -> str:
        """Describe what jumped, if the vehicle did; empty when the packet follows.

        Raises PacketError when that is not known yet.
        """
        if self._last is None:
            return ""
        gap = state.time - self._last.time
        if gap > self._patience:
            return f"nothing came for {gap:.3g} s"
        jitter = self._arrivals.period
        objection = discontinuity(self._last, state, jitter)
        if not objection:
            return ""
        suspect, self._suspect = self._suspect, state
        if suspect is not None and not discontinuity(suspect, state, jitter):
            return objection
        raise PacketError(objection)


def _named(address: Address | None) -> str:
    return f"{address[0]}:{address[1]}" if address else "anybody"
