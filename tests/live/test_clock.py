"""The real clock: it never wakes early, and a signal does not end its wait."""

import signal
import time

import pytest

from atlas_cueing.live.clock import MonotonicClock


@pytest.fixture(params=[True, False], ids=["clock_nanosleep", "sleep"])
def clock(request: pytest.FixtureRequest) -> MonotonicClock:
    found = MonotonicClock()
    if not request.param:
        found._nanosleep = None
    return found


def test_it_is_pythons_monotonic_clock(clock: MonotonicClock) -> None:
    before = time.monotonic()
    assert before <= clock.now() <= time.monotonic()


def test_it_never_wakes_early(clock: MonotonicClock) -> None:
    for k in range(40):
        wanted = clock.now() + 0.0005 + k * 1.234567e-5
        clock.sleep_until(wanted)
        assert clock.now() >= wanted


@pytest.mark.parametrize("past", [0.0, 1e-9, 1.0, 1e9])
def test_what_has_passed_is_not_waited_for(clock: MonotonicClock, past: float) -> None:
    waits = []
    clock._nanosleep = lambda *_: waits.append(1)
    clock.sleep_until(clock.now() - past)
    assert waits == []


def test_a_signal_is_handled_during_the_wait_and_does_not_end_it(clock: MonotonicClock) -> None:
    heard: list[float] = []
    before = signal.signal(signal.SIGALRM, lambda *_: heard.append(clock.now()))
    try:
        # the kernel's: it keeps its time on a busy machine, too
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        wanted = clock.now() + 0.2
        clock.sleep_until(wanted)
        woken = clock.now()
    finally:
        signal.signal(signal.SIGALRM, before)
    assert woken >= wanted
    assert len(heard) == 1
    assert heard[0] < woken
