"""What is granted is used and given back; what is refused is noted and does no harm."""

import errno
import gc
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from atlas_cueing.live import realtime as module
from atlas_cueing.live.realtime import collections, realtime_scheduling


def refuse(*_: object) -> None:
    raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, object]]:
    """A system that grants everything and does nothing."""
    made: list[tuple[str, object]] = []

    def note(name: str) -> Callable[..., int]:
        def call(*arguments: object) -> int:
            made.append((name, arguments))
            return 0

        return call

    monkeypatch.setattr(os, "sched_setscheduler", note("scheduler"))
    monkeypatch.setattr(os, "sched_setaffinity", note("affinity"))
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1, 5})

    class Library:
        def __init__(self, *_: object, **__: object) -> None:
            self.mlockall, self.munlockall = note("lock"), note("unlock")

    monkeypatch.setattr(module.ctypes, "CDLL", Library)
    return made


def test_garbage_is_collected_once_and_then_left() -> None:
    assert gc.isenabled()
    with realtime_scheduling(priority=False) as found:
        assert not gc.isenabled()
        assert gc.get_freeze_count() > 0
        before = collections()
        _ = [[k] for k in range(5000)]
        assert collections() == before
        assert (found.granted, found.refused) == ([], [])
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0
    gc.collect()
    assert collections() > before


def test_collection_that_was_off_stays_off() -> None:
    gc.disable()
    try:
        with realtime_scheduling(priority=False):
            pass
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_without_priority_nothing_is_asked(calls: list[tuple[str, object]]) -> None:
    with realtime_scheduling(priority=False):
        pass
    assert calls == []


def test_what_is_granted_is_given_back(calls: list[tuple[str, object]]) -> None:
    with realtime_scheduling(priority=True) as found:
        assert found.granted == ["SCHED_FIFO", "mlockall", "affinity"]
        assert found.refused == []
        asked = list(calls)
    assert [name for name, _ in asked] == ["scheduler", "lock", "affinity"]
    assert asked[0][1][1] & os.SCHED_FIFO  # type: ignore[index]
    assert asked[0][1][1] & os.SCHED_RESET_ON_FORK  # type: ignore[index]
    assert asked[2][1] == (0, {5})
    after = calls[3:]
    assert [name for name, _ in after] == ["scheduler", "unlock", "affinity"]
    assert after[0][1][1] == os.SCHED_OTHER  # type: ignore[index]
    assert after[2][1] == (0, {0, 1, 5})


def test_refusals_are_told_and_do_no_harm(
    calls: list[tuple[str, object]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A system that refuses every setting, even the present one."""
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    monkeypatch.setattr(os, "sched_setaffinity", refuse)
    monkeypatch.setattr(module, "_lock_memory", refuse)
    with realtime_scheduling(priority=True) as found:
        pass
    text = os.strerror(errno.EPERM)
    assert found.granted == []
    assert found.refused == [f"SCHED_FIFO: {text}", f"mlockall: {text}", f"affinity: {text}"]
    assert gc.isenabled()
    assert calls == []


@pytest.mark.usefixtures("calls")
def test_a_lock_that_fails_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    class Library:
        def __init__(self, *_: object, **__: object) -> None:
            self.mlockall = lambda _: -1

    monkeypatch.setattr(module.ctypes, "CDLL", Library)
    monkeypatch.setattr(module.ctypes, "get_errno", lambda: errno.ENOMEM)
    with realtime_scheduling(priority=True) as found:
        pass
    assert found.refused == [f"mlockall: {os.strerror(errno.ENOMEM)}"]


def test_one_core_is_not_taken(
    monkeypatch: pytest.MonkeyPatch, calls: list[tuple[str, object]]
) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {3})
    with realtime_scheduling(priority=True) as found:
        pass
    assert found.refused == ["affinity: there is only one core"]
    assert "affinity" not in [name for name, _ in calls]


@pytest.mark.usefixtures("calls")
def test_a_priority_that_cannot_be_wholly_given_back_is_given_back_but_for_its_flag(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without privilege SCHED_RESET_ON_FORK cannot be cleared (sched(7))."""
    policies = []

    def set_scheduler(_: int, policy: int, __: object) -> None:
        policies.append(policy)
        if not policy & os.SCHED_RESET_ON_FORK:
            refuse()

    monkeypatch.setattr(os, "sched_setscheduler", set_scheduler)
    with realtime_scheduling(priority=True):
        pass
    fifo = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
    assert policies == [fifo, os.SCHED_OTHER, os.SCHED_OTHER | os.SCHED_RESET_ON_FORK]


def test_everything_is_given_back_after_an_exception() -> None:
    scheduler, cores = os.sched_getscheduler(0), os.sched_getaffinity(0)
    with pytest.raises(ZeroDivisionError), realtime_scheduling(priority=False):
        _ = 1 / 0
    assert gc.isenabled()
    assert (os.sched_getscheduler(0), os.sched_getaffinity(0)) == (scheduler, cores)


@pytest.mark.skipif(not Path("/proc/self/timerslack_ns").exists(), reason="of Linux")
def test_sleeps_end_on_time_inside_and_as_before_afterwards() -> None:
    slack = Path("/proc/self/timerslack_ns")
    before = int(slack.read_text())
    with realtime_scheduling(priority=False):
        assert int(slack.read_text()) == 1
    assert int(slack.read_text()) == before > 1
