import os
import signal
import threading

import pytest

from atlas_cueing.run.stop_request import StopRequest

NUMBERS = (signal.SIGINT, signal.SIGTERM)


@pytest.mark.parametrize("interrupt", [False, True])
def test_a_terminal_that_hangs_up_asks_once(interrupt: bool) -> None:
    """Its shell and the kernel both say so; only another signal is a second request."""
    before = signal.getsignal(signal.SIGHUP)
    with StopRequest(interrupt=interrupt) as stop:
        for _ in range(3):
            signal.raise_signal(signal.SIGHUP)
        assert stop.count == 1
        if not interrupt:
            signal.raise_signal(signal.SIGTERM)
            signal.raise_signal(signal.SIGHUP)
            assert stop.count == 2
    assert signal.getsignal(signal.SIGHUP) is before


def test_a_hangup_that_was_ignored_before_is_ignored() -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with StopRequest() as stop:
            signal.raise_signal(signal.SIGHUP)
            assert stop.count == 0
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.parametrize("number", NUMBERS)
def test_a_signal_is_a_request_and_the_next_one_interrupts(number: signal.Signals) -> None:
    before = signal.getsignal(number)
    with StopRequest() as stop:
        assert not stop.requested
        signal.raise_signal(number)
        assert stop.requested
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(number)
    assert signal.getsignal(number) is before


def test_signals_of_both_kinds_are_counted_together_where_none_interrupts() -> None:
    with StopRequest(interrupt=False) as stop:
        assert stop.count == 0
        for count, number in enumerate((*NUMBERS, signal.SIGINT), start=1):
            os.kill(os.getpid(), number)
            assert stop.count == count


def test_handlers_come_back_after_an_error() -> None:
    before = [signal.getsignal(number) for number in NUMBERS]

    def fail_inside() -> None:
        with StopRequest():
            assert [signal.getsignal(number) for number in NUMBERS] != before
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail_inside()
    assert [signal.getsignal(number) for number in NUMBERS] == before


def test_a_signal_after_the_result_changes_nothing() -> None:
    before = [signal.getsignal(number) for number in NUMBERS]
    try:
        with StopRequest(interrupt=False) as stop:
            stop.finish()
            signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGTERM)
        assert stop.count == 0
    finally:
        for number, handler in zip((*NUMBERS, signal.SIGHUP), (*before, None), strict=True):
            signal.signal(number, handler or signal.SIG_DFL)


def test_another_thread_counts_nothing() -> None:
    seen = []

    def enter() -> None:
        with StopRequest() as stop:
            seen.append(stop.requested)

    thread = threading.Thread(target=enter)
    thread.start()
    thread.join()
    assert seen == [False]
