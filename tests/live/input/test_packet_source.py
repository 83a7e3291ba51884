"""Streams of packets that stutter or come from nowhere: how long is borne, and what is told."""

from itertools import pairwise
from random import Random

import pytest
from vehicles.packets import packet

from atlas_cueing.live.control.input_monitor import InputMonitor
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.live.input.measured_rate import MeasuredRate
from atlas_cueing.live.input.source import SourceReading

from ..flightgear_rides import SIMULATOR, STRANGER, Simulator, every, packet_of, states

LOOP_HZ = 100.0


def stuttering(rate_hz: float, seconds: float, longest: float, seed: int = 1) -> list[float]:
    """Times of packets at a mean rate, as of a busy FlightGear, with gaps of up to `longest` s."""
    random, times, t = Random(seed), [], 0.0
    while t < seconds:
        times.append(t)
        gap = random.uniform(0.6, 1.4) / rate_hz
        t += random.uniform(0.15, longest) if random.random() < 0.03 else min(gap, longest)
    return times


def events(readings: list[SourceReading]) -> list[str]:
    """What a ride in RUNNING would be told of them."""
    monitor = InputMonitor()
    return [
        reason
        for k, reading in enumerate(readings)
        for _, reason in monitor.watch(k / LOOP_HZ, State.RUNNING, True, reading)
    ]


@pytest.mark.parametrize("nominal", [None, 120.0])
@pytest.mark.parametrize("rate_hz", [10.0, 15.0, 43.0])
def test_a_simulator_that_stutters_is_borne(rate_hz: float, nominal: float | None) -> None:
    """Also where the scenario does not know its rate: no hold in 60 s."""
    simulator = Simulator(nominal or rate_hz, seconds=63.0)
    times = stuttering(rate_hz, 62.0, 0.28)
    simulator.send(times)
    gaps = [b - a for a, b in pairwise(times)]
    assert 0.25 < max(gaps) <= 0.28
    got = simulator.until(61.0, loop_hz=LOOP_HZ)
    assert events(got[100:]) == []
    assert sum(reading.dropped for reading in got) == 0
    told = {reading.remark for reading in got[100:]} - {""}
    if nominal and rate_hz < 100.0:
        (remark,) = told
        assert remark.startswith("packets come at ")
        assert remark.endswith(" Hz, vehicle.rate_hz = 120")
        assert float(remark.split()[3]) == pytest.approx(rate_hz, rel=0.35)
    else:
        assert len(told) <= 1


@pytest.mark.parametrize(
    ("hold_after", "gap", "borne"), [(0.1, 0.09, True), (0.1, 0.12, False), (0.4, 0.3, True)]
)
def test_the_key_says_how_long(hold_after: float, gap: float, borne: bool) -> None:
    simulator = Simulator(60.0, hold_after)
    simulator.send([*every(0.0, 1.0), *every(0.985 + gap, 3.0)])
    got = simulator.until(3.0, loop_hz=LOOP_HZ)
    assert (events(got) == []) == borne
    assert any(reading.jumped for reading in got) != borne


@pytest.mark.parametrize("rate_hz", [2.0, 5.0, 12.0])
def test_three_periods_of_what_comes_are_borne_but_never_more_than_a_second(rate_hz: float) -> None:
    simulator = Simulator(120.0, 0.1, seconds=20.0)
    simulator.send(every(0.0, 20.0, rate_hz))
    patience = simulator.until(20.0, loop_hz=LOOP_HZ)[-1].patience
    assert patience == pytest.approx(min(3.0 / rate_hz, 1.0), rel=0.05)


def test_a_pause_is_no_part_of_the_rate() -> None:
    simulator = Simulator(60.0)
    simulator.send([*every(0.0, 3.0), *every(3.9, 6.0)])
    got = simulator.until(6.0, loop_hz=LOOP_HZ)
    assert got[-1].patience == 0.3
    assert {reading.remark for reading in got} == {"", "nothing comes to a port"}


def test_a_sender_far_faster_than_nominal_is_not_run_ahead_of() -> None:
    simulator = Simulator(10.0, seconds=8.0)
    simulator.send(every(0.0, 8.0, 120.0))
    got = simulator.until(8.0)
    assert got[-1].remark == "packets come at 120 Hz, vehicle.rate_hz = 10"
    late = states(got)[-500:]
    truth = [simulator.motion.at(state.time) for state in late]
    off = max(
        abs(a - b)
        for one, other in zip(late, truth, strict=True)
        for a, b in zip(one.w_NB_B, other.w_NB_B, strict=True)
    )
    assert off < 0.05


ABSENT = {
    "version 25": packet(version=25) + bytes(144),
    "swapped bytes": packet(version=int.from_bytes(bytes([24, 0, 0, 0]), "big")),
    "bytes, allowed: 408": packet()[:-4],
}


@pytest.mark.parametrize("why", ABSENT)
def test_the_reason_why_nothing_good_comes_is_told(why: str) -> None:
    simulator = Simulator()
    assert simulator.read(0.1).remark == "nothing comes to a port"
    for t in every(0.2, 1.0):
        simulator.port.send(ABSENT[why], t)
    got = simulator.until(1.5)
    assert why in got[-1].remark
    assert got[-1].remark.startswith("no good packet comes to a port: ")
    simulator.send(every(1.5, 2.0))
    assert simulator.until(2.0, 1.5)[-1].remark == ""


def test_another_sender_than_the_pinned_is_named_and_taken_after_a_release() -> None:
    simulator = Simulator()
    simulator.send(every(0.0, 1.0))
    simulator.until(1.0)
    simulator.source.pin()
    assert simulator.port.pinned == SIMULATOR
    for t in every(1.0, 3.0):
        simulator.port.send(packet_of(simulator.motion.at(t)), t, STRANGER)
    got = simulator.until(2.0, 1.0)
    assert "it is not from 127.0.0.1:40000" in got[-1].remark
    simulator.source.release()
    assert simulator.until(3.0, 2.0)[-1].remark == ""


def test_a_rate_is_known_after_two_seconds() -> None:
    rate = MeasuredRate()
    for k in range(100):
        assert (rate.rate_hz is None) == (k <= 20)
        rate.add(0.1 * k + 1e-9)
    assert rate.rate_hz == pytest.approx(10.0)
    rate.restart()
    assert rate.rate_hz is None
