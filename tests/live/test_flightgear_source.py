"""Packets of a simulator elsewhere: good ones, and everything that a port may be sent."""

from collections import deque
from collections.abc import Sequence
from math import inf, nan
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vehicles.packets import euler_rates, packet

from atlas_cueing.live.flightgear_source import LONGEST_GAP, MAX_PACKETS, FlightgearSource
from atlas_cueing.live.source import Intake
from atlas_cueing.live.udp import Address, Datagram
from atlas_cueing.rotation import geodesic, to_euler
from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles import Bounds
from atlas_cueing.vehicles.flightgear import METRES_PER_FOOT, normal_gravity

from .motions import Motion, angles, forces, rates, rms

RATE = 60.0
SIMULATOR, STRANGER = ("127.0.0.1", 40000), ("127.0.0.1", 40001)
POSITION = (0.2, 0.8, 1000.0)
FEET = normal_gravity(*POSITION[1:]) / 9.80665 / METRES_PER_FOOT  # ft/s^2 in the packet for 1 m/s^2 of the state


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

    def close(self) -> None:
        self.closed = True


class Ride:
    """A source on such a port, and the motion that the simulator flies."""

    def __init__(self, rate_hz: float = RATE) -> None:
        self.port, self.motion = Port(), Motion(6.0)
        self.source = FlightgearSource(self.port, rate_hz)

    def send(self, times: Sequence[float], delay: float = 0.0) -> None:
        for t in times:
            self.port.send(packet_of(self.motion.at(t)), t + delay)

    def read(self, time: float) -> Intake:
        self.port.now = time
        return self.source.read(time, advance=True)

    def until(self, end: float, begin: float = 0.0, loop_hz: float = 500.0) -> list[Intake]:
        first = round(begin * loop_hz) + 1
        return [self.read(k / loop_hz) for k in range(first, round(end * loop_hz) + 1)]


def packet_of(state: VehicleState) -> bytes:
    psi, theta, phi = to_euler(state.q_NB)
    euler = (phi, theta, psi)
    force = [FEET * f for f in state.f_B]
    return packet(position=POSITION, euler=euler, euler_rates=euler_rates(euler, state.w_NB_B), force=force)


def every(begin: float, end: float, rate_hz: float = RATE) -> list[float]:
    return [begin + k / rate_hz for k in range(round((end - begin) * rate_hz))]


def states(intakes: list[Intake]) -> list[VehicleState]:
    return [intake.vehicle for intake in intakes if intake.vehicle is not None]


def clean(intakes: list[Intake]) -> bool:
    return not any(intake.dropped or intake.bad_in_a_row or intake.jumped or intake.reason for intake in intakes)


def test_nothing_before_the_first_packet() -> None:
    ride = Ride()
    for intake in ride.until(0.5):
        assert intake == Intake(None, inf, 0, 0, False, False, "")


@pytest.mark.parametrize("rate_hz", [30.0, 60.0, 120.0])
def test_a_good_stream_is_followed(rate_hz: float) -> None:
    ride = Ride(rate_hz)
    ride.send(every(0.0, 3.0, rate_hz))
    got = ride.until(3.0)
    assert clean(got)
    assert all(intake.vehicle is not None for intake in got)
    flown = states(got)[250:]
    truth = [ride.motion.at(state.time) for state in flown]
    assert float(np.max(angles(flown, truth))) < 15.0 / rate_hz**2
    assert rms(rates(flown) - rates(truth)) < 30.0 / rate_hz**2
    assert rms(forces(flown) - forces(truth)) < 150.0 / rate_hz**2
    assert max(intake.age for intake in got) <= 1.01 / rate_hz
    assert [state.time for state in flown] == [k / 500.0 for k in range(251, 1501)]


def test_jitter_drops_nothing_and_shakes_nothing() -> None:
    ride, random = Ride(), Random(2)
    for t in every(0.0, 3.0):
        ride.port.send(packet_of(ride.motion.at(t)), t + 0.004 * random.random())
    got = ride.until(3.0)
    assert clean(got)
    flown = states(got)[250:]
    truth = [ride.motion.at(state.time) for state in flown]
    shake, true = (rms(np.diff(rates(s), axis=0)) for s in (flown, truth))
    assert shake < 1.15 * true


def test_late_input_is_extrapolated_and_its_age_told() -> None:
    ride = Ride()
    ride.send(every(0.0, 1.0))
    ride.until(1.0)
    last = every(0.0, 1.0)[-1]
    for t in (1.01, 1.025, last + 1.0 / RATE + 0.025):
        intake = ride.read(t)
        assert intake.age == pytest.approx(t - last)
        assert intake.vehicle is not None
        assert geodesic(intake.vehicle.q_NB, ride.motion.at(t).q_NB) < 0.01
    assert ride.read(60.0).age == pytest.approx(60.0 - last)


BAD = {
    "nan": packet(force=(nan, 0.0, -32.0)),
    "absurd": packet(euler_rates=(1e6, 0.0, 0.0)),
    "version": packet(version=25) + bytes(144),
    "size": packet()[:-4],
    "empty": b"",
    "text": b"GET / HTTP/1.1\r\n\r\n",
}


@pytest.mark.parametrize("bad", BAD.values(), ids=BAD)
def test_bad_packets_are_dropped_and_change_nothing(bad: bytes) -> None:
    """One, two, three in a row are counted; a good one sets the count back."""
    ride, undisturbed = Ride(), Ride()
    for each in (ride, undisturbed):
        each.send(every(0.0, 1.0))
        each.until(1.0)
        each.send(every(1.0 + 1.0 / RATE, 2.0))
    for k in range(3):
        ride.port._waiting.appendleft((1.002 + 0.002 * k, bad, SIMULATOR))
        intake = ride.read(1.002 + 0.002 * k)
        assert (intake.dropped, intake.bad_in_a_row, intake.jumped) == (1, k + 1, False)
        assert intake.reason
        assert intake.vehicle == undisturbed.read(1.002 + 0.002 * k).vehicle
    later = ride.until(2.0, 1.006)
    assert later[-1].bad_in_a_row == 0
    assert states(later) == states(undisturbed.until(2.0, 1.006))


def test_a_reset_is_a_jump_one_packet_later() -> None:
    """The first packet after it may be anything; the second tells."""
    ride = Ride()
    ride.send(every(0.0, 1.0))
    for t in every(1.0, 2.0):
        ride.port.send(packet_of(ride.motion.at(t + 2.0)), t)
    got = ride.until(2.0)
    dropped = [i for i, intake in enumerate(got) if intake.dropped]
    jumped = [i for i, intake in enumerate(got) if intake.jumped]
    assert (len(dropped), len(jumped)) == (1, 1)
    assert 1 <= jumped[0] - dropped[0] <= 10
    assert "jumped by" in got[jumped[0]].reason
    after = states(got)[jumped[0] + 10 :]
    assert float(np.max(angles(after, [ride.motion.at(s.time + 2.0) for s in after]))) < 0.01
    before = states(got)[250 : jumped[0]]  # nothing was chased
    assert float(np.max(angles(before, [ride.motion.at(s.time) for s in before]))) < 0.02


def test_a_crash_is_a_jump_of_the_force() -> None:
    ride = Ride()
    ride.send(every(0.0, 1.0))
    for t in every(1.0, 1.5):
        still = ride.motion.at(t)
        ride.port.send(packet_of(VehicleState(t, still.q_NB, still.w_NB_B, (40.0, 0.0, -9.8))), t)
    got = ride.until(1.5)
    (jump,) = [intake for intake in got if intake.jumped]
    assert jump.reason.startswith("force jumped by")


def test_out_of_order_and_replayed_packets_are_dropped() -> None:
    """A packet of half a second ago between two good ones."""
    ride = Ride()
    for k, t in enumerate(every(0.0, 3.0)):
        ride.send([t])
        if k >= 60 and k % 10 == 0:
            ride.port.send(packet_of(ride.motion.at(t - 0.5)), t + 0.004)
    got = ride.until(3.0)
    assert sum(intake.dropped for intake in got) == 12
    assert max(intake.bad_in_a_row for intake in got) == 1
    assert not any(intake.jumped for intake in got)
    flown = states(got)[250:]
    assert float(np.max(angles(flown, [ride.motion.at(s.time) for s in flown]))) < 0.01


def test_a_copy_right_behind_is_dropped() -> None:
    ride = Ride()
    for t in every(0.0, 1.0):
        ride.send([t])
        ride.send([t], delay=0.001)
    got = ride.until(1.0)
    assert sum(intake.dropped for intake in got) == 60
    assert {intake.reason for intake in got if intake.dropped} == {"a copy of the packet before it"}
    assert not any(intake.jumped for intake in got)


def test_a_simulator_that_stands_still_is_no_fault() -> None:
    """A paused one sends the same packet again and again."""
    ride = Ride()
    ride.send(every(0.0, 1.0))
    frozen = packet_of(ride.motion.at(1.0 - 1.0 / RATE))
    for t in every(1.0, 3.0):
        ride.port.send(frozen, t)
    got = ride.until(3.0)
    assert clean(got)
    last = states(got)[-1]
    assert last.w_NB_B == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    assert geodesic(last.q_NB, ride.motion.at(1.0 - 1.0 / RATE).q_NB) < 1e-6
    for t in every(3.0, 4.0):
        ride.port.send(packet_of(ride.motion.at(t - 2.0)), t)
    assert clean(ride.until(4.0, 3.0))


def test_after_a_gap_it_begins_anew() -> None:
    ride = Ride()
    ride.send(every(0.0, 1.0))
    ride.send(every(1.0 + 2.0 * LONGEST_GAP, 2.0))
    got = ride.until(2.0)
    jumped = [intake for intake in got if intake.jumped]
    assert len(jumped) == 1
    assert jumped[0].reason.startswith("nothing came for")
    assert sum(intake.dropped for intake in got) == 0
    after = [s for s in states(got) if s.time > 1.3]
    assert float(np.max(angles(after, [ride.motion.at(s.time) for s in after]))) < 0.01


def test_the_sign_of_the_attitude_goes_on_across_a_jump() -> None:
    """Heading north, where the Euler angles begin anew and the quaternion made of them changes its sign."""
    ride = Ride()
    for heading, begin in ((6.2, 0.0), (0.05, 1.0)):
        for t in every(begin, begin + 0.5):
            ride.port.send(packet(euler=(0.0, 0.0, heading)), t)
    got = ride.until(1.5)
    assert sum(intake.jumped for intake in got) == 1
    assert {state.q_NB[0] < 0.0 for state in states(got)} == {True}


def test_lost_packets_are_bridged() -> None:
    ride = Ride()
    ride.send([t for k, t in enumerate(every(0.0, 3.0)) if k % 5 not in (1, 2)])
    got = ride.until(2.9)
    assert clean(got)
    flown = states(got)[250:]
    assert float(np.max(angles(flown, [ride.motion.at(s.time) for s in flown]))) < 0.03


def test_work_is_bounded_in_a_flood() -> None:
    ride = Ride()
    for k in range(1000):
        ride.port.send(b"flood", 0.0001 * k)
    intake = ride.read(1.0)
    assert ride.port.received == MAX_PACKETS
    assert intake.dropped == intake.bad_in_a_row == MAX_PACKETS


def test_a_stranger_is_not_heard_after_pinning() -> None:
    """Neither followed nor able to stop the vehicle: what it sends does not count as a row of bad packets."""
    ride = Ride()
    ride.send(every(0.0, 1.0))
    ride.until(1.0)
    ride.source.pin()
    assert ride.port.pinned == SIMULATOR
    for t in every(1.0, 2.0):
        ride.send([t])
        ride.port.send(packet_of(ride.motion.at(t + 2.0)), t + 0.003, STRANGER)
        ride.port.send(b"nonsense", t + 0.004, STRANGER)
    got = ride.until(2.0, 1.0)
    assert sum(intake.dropped for intake in got) == 120
    assert not any(intake.bad_in_a_row or intake.jumped for intake in got)
    assert any("40001" in intake.reason and "40000" in intake.reason for intake in got)
    assert float(np.max(angles(states(got), [ride.motion.at(s.time) for s in states(got)]))) < 0.01


def test_pinning_before_any_packet_pins_nobody() -> None:
    ride = Ride()
    ride.source.pin()
    assert ride.port.pinned is None
    ride.send(every(0.0, 0.1))
    assert states(ride.until(0.2))
    ride.source.close()
    assert ride.port.closed


@settings(max_examples=30)
@given(st.lists(st.tuples(st.floats(0.0, 0.03), st.one_of(st.binary(max_size=420), st.integers(0, 5), st.none())), max_size=60))
def test_whatever_comes_the_state_stays_believable(events: list[tuple[float, bytes | int | None]]) -> None:
    """Good, shifted, copied and senseless packets at any times."""
    ride, time = Ride(), 0.0
    for wait, what in events:
        time += wait
        content = what if isinstance(what, bytes) else packet_of(ride.motion.at(time + (what or 0)))
        ride.port.send(content, time)
    wide = Bounds(force=1e4, rate=60.0)
    for intake in ride.until(time + 0.3, loop_hz=100.0):
        assert intake.dropped >= 0
        if intake.vehicle is not None:
            assert wide.objection(intake.vehicle, 0.0) == ""
            assert 0.0 <= intake.age < inf
