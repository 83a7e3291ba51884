"""Signals become a count, and only for a while."""

import os
import signal
from contextlib import suppress

import pytest

from atlas_cueing.live.stop_signals import ending


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals_are_counted(number: signal.Signals) -> None:
    with ending() as found:
        assert found.asked() == 0
        for count in (1, 2):
            os.kill(os.getpid(), number)
            assert found.asked() == count


def test_both_count_together_and_so_does_who_asks_without_a_signal() -> None:
    with ending() as found:
        os.kill(os.getpid(), signal.SIGINT)
        os.kill(os.getpid(), signal.SIGTERM)
        found.ask()
        assert found.asked() == 3


def test_handlers_are_given_back() -> None:
    before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
    with suppress(ZeroDivisionError), ending():
        assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)] != before
        _ = 1 / 0
    assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)] == before
