"""A port that is sent packets by hand, and a simulator of the source that listens to it."""

from collections import deque
from collections.abc import Sequence

from vehicles.packets import euler_rates, packet

from atlas_cueing.live.input.packet_source import PacketSource
from atlas_cueing.live.input.source import SourceReading
from atlas_cueing.live.input.udp import Address, Datagram
from atlas_cueing.live.open_source import flightgear_stream
from atlas_cueing.rotation import to_euler
from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles.flightgear import METRES_PER_FOOT, normal_gravity
from atlas_cueing.vehicles.sent_flight import DEFAULT_HOLD_AFTER

from .motions import Motion

RATE = 60.0
SIMULATOR, STRANGER = ("127.0.0.1", 40000), ("127.0.0.1", 40001)
POSITION = (0.2, 0.8, 1000.0)
# ft/s^2 in the packet for 1 m/s^2 of the state
FEET = normal_gravity(*POSITION[1:]) / 9.80665 / METRES_PER_FOOT


class Port:
    """A port that is sent what the test says, at times that the test says (a Receiver)."""

    def __init__(self) -> None:
        self.now, self.received, self.pinned, self.closed = 0.0, 0, None, False
        self._waiting: deque[tuple[float, bytes, Address]] = deque()

    def send(self, content: bytes, time: float, sender: Address = SIMULATOR) -> None:
        self._waiting.append((time, content, sender))

    def receive(self) -> Datagram | None:
        if not self._waiting or self._waiting[0][0] > self.now:
            return None
        time, content, sender = self._waiting.popleft()
        self.received += 1
        return Datagram(content, sender, self.now - time)

    def pin(self, sender: Address) -> None:
        self.pinned = sender

    def release(self) -> None:
        self.pinned = None

    def close(self) -> None:
        self.closed = True


class Simulator:
    """A source on such a port, and the motion that the simulator flies."""

    def __init__(
        self, rate_hz: float = RATE, hold_after: float = DEFAULT_HOLD_AFTER, seconds: float = 6.0
    ) -> None:
        self.port, self.motion = Port(), Motion(seconds)
        self.source = PacketSource(self.port, flightgear_stream("a port", rate_hz, hold_after))

    def send(self, times: Sequence[float], delay: float = 0.0) -> None:
        for t in times:
            self.port.send(packet_of(self.motion.at(t)), t + delay)

    def read(self, time: float) -> SourceReading:
        self.port.now = time
        return self.source.read(time, advance=True)

    def until(self, end: float, begin: float = 0.0, loop_hz: float = 500.0) -> list[SourceReading]:
        first = round(begin * loop_hz) + 1
        return [self.read(k / loop_hz) for k in range(first, round(end * loop_hz) + 1)]


def packet_of(state: VehicleState) -> bytes:
    psi, theta, phi = to_euler(state.q_NB)
    euler = (phi, theta, psi)
    force = [FEET * f for f in state.f_B]
    return packet(
        position=POSITION, euler=euler, euler_rates=euler_rates(euler, state.w_NB_B), force=force
    )


def every(begin: float, end: float, rate_hz: float = RATE) -> list[float]:
    return [begin + k / rate_hz for k in range(round((end - begin) * rate_hz))]


def states(readings: list[SourceReading]) -> list[VehicleState]:
    return [reading.vehicle for reading in readings if reading.vehicle is not None]


def clean(readings: list[SourceReading]) -> bool:
    return not any(
        reading.dropped or reading.bad_in_a_row or reading.jumped or reading.reason
        for reading in readings
    )
