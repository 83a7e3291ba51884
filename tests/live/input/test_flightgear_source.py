"""The stream of a simulator elsewhere: followed, late, lost, jumping and at a standstill."""

from math import inf
from random import Random

import numpy as np
import pytest
from vehicles.packets import packet

from atlas_cueing.live.control.sign_continuity import SignContinuity
from atlas_cueing.rotation import IDENTITY, geodesic
from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles.sent_flight import DEFAULT_HOLD_AFTER

from ..flightgear_rides import RATE, Simulator, clean, every, packet_of, states
from ..motions import angles, forces, rates, rms


def test_nothing_before_the_first_packet() -> None:
    simulator = Simulator()
    for reading in simulator.until(0.5):
        assert (reading.vehicle, reading.age, reading.dropped) == (None, inf, 0)
        assert reading.remark == "nothing comes to a port"


@pytest.mark.parametrize("rate_hz", [30.0, 60.0, 120.0])
def test_a_good_stream_is_followed(rate_hz: float) -> None:
    simulator = Simulator(rate_hz)
    simulator.send(every(0.0, 3.0, rate_hz))
    got = simulator.until(3.0)
    assert clean(got)
    assert all(reading.vehicle is not None for reading in got)
    flown = states(got)[250:]
    truth = [simulator.motion.at(state.time) for state in flown]
    assert float(np.max(angles(flown, truth))) < 15.0 / rate_hz**2
    assert rms(rates(flown) - rates(truth)) < 30.0 / rate_hz**2
    assert rms(forces(flown) - forces(truth)) < 150.0 / rate_hz**2
    assert max(reading.age for reading in got) <= 1.01 / rate_hz
    assert [state.time for state in flown] == [k / 500.0 for k in range(251, 1501)]


def test_jitter_drops_nothing_and_shakes_nothing() -> None:
    simulator, random = Simulator(), Random(2)
    for t in every(0.0, 3.0):
        simulator.port.send(packet_of(simulator.motion.at(t)), t + 0.004 * random.random())
    got = simulator.until(3.0)
    assert clean(got)
    flown = states(got)[250:]
    truth = [simulator.motion.at(state.time) for state in flown]
    shake, true = (rms(np.diff(rates(s), axis=0)) for s in (flown, truth))
    assert shake < 1.15 * true


def test_late_input_is_extrapolated_and_its_age_told() -> None:
    simulator = Simulator()
    simulator.send(every(0.0, 1.0))
    simulator.until(1.0)
    last = every(0.0, 1.0)[-1]
    for t in (1.01, 1.025, last + 1.0 / RATE + 0.025):
        reading = simulator.read(t)
        assert reading.age == pytest.approx(t - last)
        assert reading.vehicle is not None
        assert geodesic(reading.vehicle.q_NB, simulator.motion.at(t).q_NB) < 0.01
    assert simulator.read(60.0).age == pytest.approx(60.0 - last)


def test_a_reset_is_a_jump_one_packet_later() -> None:
    """The first packet after it may be anything; the second tells."""
    simulator = Simulator()
    simulator.send(every(0.0, 1.0))
    for t in every(1.0, 2.0):
        simulator.port.send(packet_of(simulator.motion.at(t + 2.0)), t)
    got = simulator.until(2.0)
    dropped = [i for i, reading in enumerate(got) if reading.dropped]
    jumped = [i for i, reading in enumerate(got) if reading.jumped]
    assert (len(dropped), len(jumped)) == (1, 1)
    assert 1 <= jumped[0] - dropped[0] <= 10
    assert "jumped by" in got[jumped[0]].reason
    after = states(got)[jumped[0] + 10 :]
    assert float(np.max(angles(after, [simulator.motion.at(s.time + 2.0) for s in after]))) < 0.01
    before = states(got)[250 : jumped[0]]  # nothing was chased
    assert float(np.max(angles(before, [simulator.motion.at(s.time) for s in before]))) < 0.02


def test_a_crash_is_a_jump_of_the_force() -> None:
    simulator = Simulator()
    simulator.send(every(0.0, 1.0))
    for t in every(1.0, 1.5):
        still = simulator.motion.at(t)
        simulator.port.send(
            packet_of(VehicleState(t, still.q_NB, still.w_NB_B, (40.0, 0.0, -9.8))), t
        )
    got = simulator.until(1.5)
    (jump,) = [reading for reading in got if reading.jumped]
    assert jump.reason.startswith("force jumped by")


def test_a_simulator_that_stands_still_is_no_fault() -> None:
    """A paused one sends the same packet again and again."""
    simulator = Simulator()
    simulator.send(every(0.0, 1.0))
    frozen = packet_of(simulator.motion.at(1.0 - 1.0 / RATE))
    for t in every(1.0, 3.0):
        simulator.port.send(frozen, t)
    got = simulator.until(3.0)
    assert clean(got)
    last = states(got)[-1]
    assert last.w_NB_B == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    assert geodesic(last.q_NB, simulator.motion.at(1.0 - 1.0 / RATE).q_NB) < 1e-6
    for t in every(3.0, 4.0):
        simulator.port.send(packet_of(simulator.motion.at(t - 2.0)), t)
    assert clean(simulator.until(4.0, 3.0))


def test_after_a_gap_it_begins_anew() -> None:
    simulator = Simulator()
    simulator.send(every(0.0, 1.0))
    simulator.send(every(1.0 + 1.1 * DEFAULT_HOLD_AFTER, 2.0))
    got = simulator.until(2.0)
    jumped = [reading for reading in got if reading.jumped]
    assert len(jumped) == 1
    assert jumped[0].reason.startswith("nothing came for")
    assert sum(reading.dropped for reading in got) == 0
    after = [s for s in states(got) if s.time > 1.4]
    assert float(np.max(angles(after, [simulator.motion.at(s.time) for s in after]))) < 0.01


def test_the_sign_of_the_attitude_can_go_on_across_a_jump() -> None:
    """North, where Euler angles wrap and the quaternion that is made of them changes its sign."""
    simulator = Simulator()
    for heading, begin in ((6.2, 0.0), (0.05, 1.0)):
        for t in every(begin, begin + 0.5):
            simulator.port.send(packet(euler=(0.0, 0.0, heading)), t)
    got = simulator.until(1.5)
    assert sum(reading.jumped for reading in got) == 1
    assert {state.q_NB[0] < 0.0 for state in states(got)} == {True, False}
    signs = SignContinuity(IDENTITY)
    assert {signs.vehicle(state).q_NB[0] < 0.0 for state in states(got)} == {False}


def test_lost_packets_are_bridged() -> None:
    simulator = Simulator()
    simulator.send([t for k, t in enumerate(every(0.0, 3.0)) if k % 5 not in (1, 2)])
    got = simulator.until(2.9)
    assert clean(got)
    flown = states(got)[250:]
    assert float(np.max(angles(flown, [simulator.motion.at(s.time) for s in flown]))) < 0.03
