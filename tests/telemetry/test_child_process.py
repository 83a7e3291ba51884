"""A child process: its answer, its end, and that it never runs code of its parent."""

import os
import signal
from select import select
from time import sleep

import pytest
from live.riding import child
from waiting import until

from atlas_cueing.telemetry import child_process
from atlas_cueing.telemetry.child_process import ChildProcess, Left, ProcessExit

PATIENCE = 60.0  # s, for what takes milliseconds on a machine that has time


def patient(left: Left) -> bytes:
    """Until nothing more is expected."""
    while not left():
        sleep(0.002)
    return b"goodbye"


def test_its_answer_comes_back() -> None:
    assert ChildProcess(lambda _: b"x" * 10_000).finish(PATIENCE) == ProcessExit(b"x" * 10_000, 0)


def test_it_is_told_that_the_parent_waits_and_stays_ended() -> None:
    process = ChildProcess(patient)
    sleep(0.02)
    assert process.alive
    assert process.finish(PATIENCE) == ProcessExit(b"goodbye", 0)
    assert process.finish(PATIENCE) == ProcessExit(b"goodbye", 0)
    assert not process.alive


def test_an_exception_is_shown_and_ends_it(capfd: pytest.CaptureFixture[str]) -> None:
    def fail(_: Left) -> bytes:
        raise SystemExit("out of luck")

    process = ChildProcess(fail)
    assert process.finish(PATIENCE) == ProcessExit(b"", 70)
    assert "out of luck" in capfd.readouterr().err


def test_a_killed_one_is_dead_before_it_is_reaped() -> None:
    process = ChildProcess(patient)
    os.kill(process.pid, signal.SIGKILL)
    until(lambda: not process.alive)
    assert process.finish(PATIENCE) == ProcessExit(b"", -signal.SIGKILL)


def busy(left: Left) -> bytes:
    """Ask all the time, on a core of its own if there is one."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    while not left():
        pass
    return b""


def test_one_that_is_looked_at_while_it_answers_never_seems_to_hang() -> None:
    """A beat that is read while it is written is the old one or the new one."""
    process, cores = ChildProcess(busy), os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(cores)})
    try:
        sleep(0.1)
        assert all(process.answers for _ in range(100_000))
    finally:
        os.sched_setaffinity(0, cores)
        process.finish(PATIENCE)


def test_one_that_hangs_lives_and_does_not_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child_process, "HANGS_S", 0.5)
    process = ChildProcess(patient)
    until(lambda: process.answers)
    os.kill(process.pid, signal.SIGSTOP)
    until(lambda: not process.answers)
    assert process.alive
    os.kill(process.pid, signal.SIGCONT)
    until(lambda: process.answers)
    os.kill(process.pid, signal.SIGKILL)
    until(lambda: not process.alive)
    assert not process.answers
    process.finish(PATIENCE)


def test_one_that_does_not_end_is_killed() -> None:
    process = ChildProcess(lambda _: sleep(60.0) or b"")
    assert process.finish(0.05) == ProcessExit(b"", -signal.SIGKILL)


def test_a_half_answer_of_one_that_does_not_end_counts_for_nothing() -> None:
    """Stopped between its answer and its end."""

    def stop(_: Left) -> bytes:
        os.kill(os.getpid(), signal.SIGSTOP)
        return b"never said"

    assert ChildProcess(stop).finish(0.1) == ProcessExit(b"", -signal.SIGKILL)


def test_a_sibling_that_holds_a_copy_of_our_end_does_not_hide_that_we_wait() -> None:
    first = ChildProcess(patient)
    second = ChildProcess(patient)  # has a copy of the first one's channel
    assert first.finish(PATIENCE) == ProcessExit(b"goodbye", 0)
    assert second.alive
    assert second.finish(PATIENCE) == ProcessExit(b"goodbye", 0)


def test_a_sibling_that_holds_a_copy_of_our_end_does_not_hide_that_the_parent_is_gone(
    capfd: pytest.CaptureFixture[str],
) -> None:
    reading, writing = os.pipe()

    def run() -> None:
        """Two processes, of which the second outlives the parent and never looks."""
        first = ChildProcess(lambda left: patient(left) + bytes(os.write(writing, b"noticed")))
        second = ChildProcess(lambda _: sleep(30.0) or b"")
        os.write(writing, str(second.pid).encode())
        signal.pause()
        assert first.alive

    with child(run) as parent:
        second = int(os.read(reading, 100))
        os.kill(parent, signal.SIGKILL)
    try:
        assert select([reading], [], [], PATIENCE)[0]
        assert os.read(reading, 100) == b"noticed"
    finally:
        os.kill(second, signal.SIGKILL)
        os.close(reading)
        os.close(writing)
    sleep(0.02)
    assert capfd.readouterr().err == "", "that nobody heard the answer is no failure"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signals_of_a_terminal_are_not_for_it(number: signal.Signals) -> None:
    before = signal.getsignal(number)
    process = ChildProcess(patient)
    os.kill(process.pid, number)  # perhaps before it has run a single line of its own
    sleep(0.02)
    assert process.alive
    assert process.finish(PATIENCE) == ProcessExit(b"goodbye", 0)
    assert signal.getsignal(number) == before
    assert number not in signal.pthread_sigmask(signal.SIG_BLOCK, ())
