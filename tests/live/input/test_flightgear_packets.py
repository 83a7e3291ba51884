"""Packets that no good simulator sends: bad, replayed, too many, from strangers.

None of them is believed.
"""

from math import inf, nan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vehicles.packets import packet

from atlas_cueing.live.input.packet_source import MAX_PACKETS
from atlas_cueing.vehicles import Bounds

from ..flightgear_rides import RATE, SIMULATOR, STRANGER, Simulator, every, packet_of, states
from ..motions import angles

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
    simulator, undisturbed = Simulator(), Simulator()
    for each in (simulator, undisturbed):
        each.send(every(0.0, 1.0))
        each.until(1.0)
        each.send(every(1.0 + 1.0 / RATE, 2.0))
    for k in range(3):
        simulator.port._waiting.appendleft((1.002 + 0.002 * k, bad, SIMULATOR))
        reading = simulator.read(1.002 + 0.002 * k)
        assert (reading.dropped, reading.bad_in_a_row, reading.jumped) == (1, k + 1, False)
        assert reading.reason
        assert reading.vehicle == undisturbed.read(1.002 + 0.002 * k).vehicle
    later = simulator.until(2.0, 1.006)
    assert later[-1].bad_in_a_row == 0
    assert states(later) == states(undisturbed.until(2.0, 1.006))


def test_out_of_order_and_replayed_packets_are_dropped() -> None:
    """A packet of half a second ago between two good ones."""
    simulator = Simulator()
    for k, t in enumerate(every(0.0, 3.0)):
        simulator.send([t])
        if k >= 60 and k % 10 == 0:
            simulator.port.send(packet_of(simulator.motion.at(t - 0.5)), t + 0.004)
    got = simulator.until(3.0)
    assert sum(reading.dropped for reading in got) == 12
    assert max(reading.bad_in_a_row for reading in got) == 1
    assert not any(reading.jumped for reading in got)
    flown = states(got)[250:]
    assert float(np.max(angles(flown, [simulator.motion.at(s.time) for s in flown]))) < 0.01


def test_a_copy_right_behind_is_dropped() -> None:
    simulator = Simulator()
    for t in every(0.0, 1.0):
        simulator.send([t])
        simulator.send([t], delay=0.001)
    got = simulator.until(1.0)
    assert sum(reading.dropped for reading in got) == 60
    assert {reading.reason for reading in got if reading.dropped} == {
        "a copy of the packet before it"
    }
    assert not any(reading.jumped for reading in got)


def test_work_is_bounded_in_a_flood() -> None:
    simulator = Simulator()
    for k in range(1000):
        simulator.port.send(b"flood", 0.0001 * k)
    reading = simulator.read(1.0)
    assert simulator.port.received == MAX_PACKETS
    assert reading.dropped == reading.bad_in_a_row == MAX_PACKETS


def test_a_stranger_is_not_heard_after_pinning() -> None:
    """Its packets are not followed, and do not count as a row of bad ones, which would stop it."""
    simulator = Simulator()
    simulator.send(every(0.0, 1.0))
    simulator.until(1.0)
    simulator.source.pin()
    assert simulator.port.pinned == SIMULATOR
    for t in every(1.0, 2.0):
        simulator.send([t])
        simulator.port.send(packet_of(simulator.motion.at(t + 2.0)), t + 0.003, STRANGER)
        simulator.port.send(b"nonsense", t + 0.004, STRANGER)
    got = simulator.until(2.0, 1.0)
    assert sum(reading.dropped for reading in got) == 120
    assert not any(reading.bad_in_a_row or reading.jumped for reading in got)
    assert any("40001" in reading.reason and "40000" in reading.reason for reading in got)
    assert (
        float(np.max(angles(states(got), [simulator.motion.at(s.time) for s in states(got)])))
        < 0.01
    )


def test_pinning_before_any_packet_pins_nobody() -> None:
    simulator = Simulator()
    simulator.source.pin()
    assert simulator.port.pinned is None
    simulator.send(every(0.0, 0.1))
    assert states(simulator.until(0.2))
    simulator.source.close()
    assert simulator.port.closed


@settings(max_examples=30)
@given(
    st.lists(
        st.tuples(
            st.floats(0.0, 0.03), st.one_of(st.binary(max_size=420), st.integers(0, 5), st.none())
        ),
        max_size=60,
    )
)
def test_whatever_comes_the_state_stays_believable(
    events: list[tuple[float, bytes | int | None]],
) -> None:
    """Good, shifted, copied and senseless packets at any times."""
    simulator, time = Simulator(), 0.0
    for wait, what in events:
        time += wait
        content = (
            what if isinstance(what, bytes) else packet_of(simulator.motion.at(time + (what or 0)))
        )
        simulator.port.send(content, time)
    wide = Bounds(force=1e4, rate=60.0)
    for reading in simulator.until(time + 0.3, loop_hz=100.0):
        assert reading.dropped >= 0
        if reading.vehicle is not None:
            assert wide.objection(reading.vehicle, 0.0) == ""
            assert 0.0 <= reading.age < inf
