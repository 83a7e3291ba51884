"""The source for FlightGear, or JSBSim in another process: native FDM packets over UDP."""

from dataclasses import replace
from math import inf

from ...rotation import ZERO
from ...signals import VehicleState
from ...vehicles import Bounds
from ...vehicles.flightgear import PacketError, decode
from .arrival_times import ArrivalTimes
from .discontinuity import discontinuity
from .extrapolation import Extrapolation
from .source import SourceReading
from .udp import Address, Datagram, Receiver

MAX_PACKETS = 8  # taken in one read: 67 ms at 120 Hz, and some 0.2 ms of work (assumed)
# s without a packet; after that the next one does not explain the time between (assumed)
LONGEST_GAP = 0.1
LONGEST_GAP_PERIODS = 3.0  # for senders so slow that it is longer (assumed)


class FlightgearSource:
    """Reads the newest packets, checks them all, and goes on from the last good one.

    A packet carries no time: it is taken from the arrivals, without their jitter. It carries no
    number either, so that its order is judged by its content. A packet that does not follow from
    the one before is dropped; if the next follows from it, the vehicle has jumped, and if the next
    follows from the one before, it was late, repeated or forged. The copy of a packet right behind
    it is dropped; one in due time is a simulator that stands still, and taken with rates of zero.
    After a gap the vehicle is where the packet says, and that is a jump, too.
    """

    def __init__(self, receiver: Receiver, rate_hz: float, bounds: Bounds | None = None) -> None:
        """Start without a packet.

        Args:
            receiver: where datagrams come from.
            rate_hz: nominal packets per second.
            bounds: of a believable state; those of `Bounds` by default.
        """
        self._receiver = receiver
        self._bounds = Bounds() if bounds is None else bounds
        self._arrivals = ArrivalTimes(rate_hz)
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

    # The simulator owns its time
    def read(self, time: float, advance: bool) -> SourceReading:  # noqa: ARG002
        """Read the state at `time` (s), see `Source`; takes at most MAX_PACKETS packets."""
        self._dropped, self._jumped, self._reason = 0, False, ""
        for _ in range(MAX_PACKETS):
            datagram = self._receiver.receive()
            if datagram is None:
                break
            self._take(datagram, time)
        vehicle = self._extrapolation.at(time) if self._extrapolation else None
        age = time - self._last.time if self._last else inf
        return SourceReading(
            vehicle, age, self._dropped, self._bad_in_a_row, self._jumped, False, self._reason
        )

    def pin(self) -> None:
        """Take packets of the present sender only; before the first good packet, do nothing."""
        if self._sender is not None:
            self._pinned = self._sender
            self._receiver.pin(self._sender)

    def close(self) -> None:
        """Close the port."""
        self._receiver.close()

    def _take(self, datagram: Datagram, time: float) -> None:
        if self._pinned not in (None, datagram.sender):
            # not counted in a row: a stranger must not be able to stop the vehicle
            self._dropped += 1
            self._reason = f"packet from {datagram.sender}, pinned to {self._pinned}"
            return
        before = self._last.time if self._last else -inf
        arrival = min(max(time - datagram.ago, before), time)
        try:
            self._add(self._decoded(datagram, arrival), datagram)
        except PacketError as error:
            self._dropped += 1
            self._bad_in_a_row += 1
            self._reason = str(error)

    def _decoded(self, datagram: Datagram, arrival: float) -> VehicleState:
        state = decode(datagram.content, arrival, self._bounds)
        if datagram.content != self._content:
            return state
        if self._last and arrival - self._last.time < 0.5 * self._arrivals.period:
            raise PacketError("a copy of the packet before it")
        return replace(state, w_NB_B=ZERO)

    def _add(self, state: VehicleState, datagram: Datagram) -> None:
        """Go on from a packet that follows, or begin anew after a jump.

        Raises PacketError for one that does neither.
        """
        jump = self._jump_to(state)
        sample = replace(state, time=self._arrivals.time(state.time))
        if self._extrapolation is None or jump:
            self._extrapolation = Extrapolation(sample, self._arrivals.period)
            self._jumped, self._reason = bool(jump), jump
        else:
            self._extrapolation.add(sample)
        self._last, self._suspect, self._bad_in_a_row = state, None, 0
        self._content, self._sender = datagram.content, datagram.sender

    def _jump_to(self, state: VehicleState) -> str:
        """Describe what jumped, if the vehicle did; empty when the packet follows.

        Raises PacketError when that is not known yet.
        """
        if self._last is None:
            return ""
        gap = state.time - self._last.time
        if gap > max(LONGEST_GAP, LONGEST_GAP_PERIODS * self._arrivals.period):
            return f"nothing came for {gap:.3g} s"
        jitter = self._arrivals.period
        objection = discontinuity(self._last, state, jitter)
        if not objection:
            return ""
        suspect, self._suspect = self._suspect, state
        if suspect is not None and not discontinuity(suspect, state, jitter):
            return objection
        raise PacketError(objection)
