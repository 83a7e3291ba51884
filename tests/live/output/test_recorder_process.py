"""The recorder behind the loop: its log at the end, and what is left after a kill."""

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from math import inf
from pathlib import Path
from random import Random
from struct import pack, unpack

import numpy as np
import pytest
from waiting import until

from atlas_cueing.errors import LogError
from atlas_cueing.live.output import recorder_process
from atlas_cueing.live.output.recorder_process import POLL_S, RecorderProcess
from atlas_cueing.live.output.ring_recorder import FLUSH_S, Recorded
from atlas_cueing.recording import read_log
from atlas_cueing.telemetry import LiveWriter, Ring, live_ring

from ..logs import largest_file, recovered, times
from ..riding import SharedClock, child, live_recorder, live_tick, write_ticks

RATE = 500.0  # Hz
LOSS = 0.1  # s of ticks that a kill may cost


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run.mcap"


class TestTheProcess:
    """Real processes, real kills."""

    def test_a_run_ends_with_its_log(self, path: Path) -> None:
        ring = live_ring(2.0, RATE)
        process = RecorderProcess(ring, live_recorder(path))
        writer = LiveWriter(ring)
        writer.status(0.0, "running", "engaged")
        write_ticks(writer, RATE, 200)
        assert process.alive
        writer.end(0.4, "ok", "over")
        assert process.finish() == Recorded("ok", "over", 200, 0)
        assert process.finish() == Recorded("ok", "over", 200, 0)
        assert not process.alive
        assert len(times(read_log(path))) == 200
        assert reaped(process.pid)

    def test_what_was_in_the_ring_before_is_of_another_run(self, path: Path) -> None:
        ring = live_ring(2.0, RATE)
        writer = LiveWriter(ring)
        writer.tick(*live_tick(7.0))
        process = RecorderProcess(ring, live_recorder(path))
        writer.end(0.0, "ok", "")
        assert process.finish().ticks == 0

    def test_a_loop_that_finishes_without_end_does_not_wait_for_ever(self, path: Path) -> None:
        ring = live_ring(2.0, RATE)
        process = RecorderProcess(ring, live_recorder(path))
        write_ticks(LiveWriter(ring), RATE, 5)
        assert process.finish().result == "loop_killed"
        assert len(times(read_log(path))) == 5

    @pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
    def test_signals_are_for_the_loop(self, path: Path, number: signal.Signals) -> None:
        ring = live_ring(2.0, RATE)
        process = RecorderProcess(ring, live_recorder(path))
        os.kill(process.pid, number)
        LiveWriter(ring).end(0.0, "ok", "still there")
        assert process.finish() == Recorded("ok", "still there", 0, 0)

    @pytest.mark.parametrize("seed", range(4))
    def test_a_killed_loop_leaves_a_finished_log_with_all_its_ticks(
        self, path: Path, seed: int
    ) -> None:
        """SIGKILL at any moment of the loop.

        The recorder is its child, and alone in the world afterwards.
        """
        last = killed(path, Random(seed).randrange(75, 125), os.kill)
        until(path.exists)
        log = read_log(path)
        assert log.metadata["result"] == "loop_killed"
        assert log.statuses[-1].state == "stopped"
        assert last <= times(log)[-1]
        assert np.allclose(np.diff(times(log)), 1.0 / RATE)

    def test_when_all_are_killed_the_part_has_all_but_a_tenth_of_a_second(
        self, tmp_path: Path
    ) -> None:
        """At any moment between two flushes, by a clock that waits for the recorder."""
        lost = []
        for ticks in range(75, 145, 10):
            path = tmp_path / f"{ticks}" / "run.mcap"
            path.parent.mkdir()
            last = killed(path, ticks, os.killpg, SharedClock())
            assert not path.exists()
            lost.append(last - last_kept(path))
        assert max(lost) <= LOSS

    def test_what_is_not_flushed_yet_is_less_than_that(self) -> None:
        assert FLUSH_S + POLL_S <= 0.8 * LOSS

    def test_a_killed_recorder_is_told_and_its_part_has_what_was(self, path: Path) -> None:
        ring = live_ring(2.0, RATE)
        process = RecorderProcess(ring, live_recorder(path))
        writer, part = LiveWriter(ring), path.with_name("run.mcap.part")
        opened = part.stat().st_size
        write_ticks(writer, RATE, 100)
        until(lambda: part.stat().st_size > opened)
        os.kill(process.pid, signal.SIGKILL)
        until(lambda: not process.alive)
        writer.end(0.2, "ok", "")
        recorded = process.finish()
        assert recorded.result == "recorder_died"
        assert "ended with signal 9" in recorded.reason
        found, log = recovered(path)
        assert 0 < found.ticks == len(times(log)) <= 100

    def test_a_recorder_that_hangs_is_killed_in_the_end(self, path: Path) -> None:
        ring = live_ring(2.0, RATE)
        process = RecorderProcess(ring, live_recorder(path))
        os.kill(process.pid, signal.SIGSTOP)
        assert process.finish(0.1).result == "recorder_died"
        assert reaped(process.pid)

    def test_a_full_disk_is_told_and_no_tick_waits(
        self, path: Path, capfd: pytest.CaptureFixture[str]
    ) -> None:
        ring = live_ring(5.0, RATE)
        with largest_file(100_000):
            process = RecorderProcess(ring, live_recorder(path))
        writer, part = LiveWriter(ring), path.with_name("run.mcap.part")
        opened = part.stat().st_size
        write_ticks(writer, RATE, 50)
        until(lambda: part.stat().st_size > opened)
        write_ticks(writer, 4 * RATE, 1000)
        messages: list[str] = []
        until(
            lambda: bool(
                messages.append(capfd.readouterr().err)
                or "nothing more is recorded: cannot write log" in "".join(messages)
            )
        )
        assert process.alive
        writer.end(0.5, "ok", "")
        recorded = process.finish()
        assert recorded.result == "recording_failed"
        assert recorded.lost == 0
        # a chunk may be whole though its index did not fit
        assert recovered(path)[0].ticks >= recorded.ticks > 0

    def test_a_recorder_that_is_held_up_tells_the_gap_and_the_loop_runs_on(
        self, path: Path
    ) -> None:
        """As by a slow disk, which a stopped process is like."""
        ring = Ring(256, live_ring(1.0, 1.0).size)
        process = RecorderProcess(ring, live_recorder(path))
        writer = LiveWriter(ring)
        os.kill(process.pid, signal.SIGSTOP)
        for k in range(1000):
            writer.tick(*live_tick(k / RATE))
        os.kill(process.pid, signal.SIGCONT)
        writer.end(2.0, "ok", "over")
        recorded = process.finish()
        assert recorded.result == "ok"
        assert recorded.lost + recorded.ticks == 1000
        assert recorded.lost >= 744
        assert read_log(path).statuses[0].state == "recording_gap"

    def test_a_terminal_that_does_not_read_holds_nothing_up(self, path: Path) -> None:
        """stderr of the recorder is a full pipe."""
        ring = live_ring(2.0, RATE)
        _, full = os.pipe()
        os.set_blocking(full, False)
        with suppress(BlockingIOError):
            while True:
                os.write(full, bytes(4096))
        os.set_blocking(full, True)
        before = os.dup(2)
        os.dup2(full, 2)
        try:
            process = RecorderProcess(ring, live_recorder(path), announce=True)
        finally:
            os.dup2(before, 2)
            os.close(before)
        writer = LiveWriter(ring)
        writer.status(0.0, "parked", "nobody listens")
        writer.end(0.0, "ok", "")
        assert process.finish().result == "ok"


def killed(
    path: Path, ticks: int, kill: Callable[[int, int], None], clock: SharedClock | None = None
) -> float:
    """Kill a loop with a recorder, or both, once so many ticks are in the ring.

    The time of the last one that was.
    """
    reading, writing = os.pipe()
    with child(partial(run, path, writing, clock)) as loop:
        os.close(writing)
        heard = b""
        while len(heard) < 8 * ticks:
            heard += os.read(reading, 8 * ticks - len(heard)) or pytest.fail(
                "the loop ended by itself"
            )
        kill(loop, signal.SIGKILL)
    heard += os.read(reading, 65536)  # a pipe holds no more
    os.close(reading)
    return float(unpack("=d", heard[-8:])[0])


def run(path: Path, writing: int, clock: SharedClock | None) -> None:
    """A loop with a recorder, in a group of its own.

    Writes the time of each tick that is in the ring to `writing`.
    """
    os.setpgid(0, 0)
    if clock:
        recorder_process.monotonic, recorder_process.sleep = clock.now, clock.sleep  # type: ignore[attr-defined]
    ring = live_ring(2.0, RATE)
    process = RecorderProcess(ring, live_recorder(path))

    def report(time: float) -> None:
        os.write(writing, pack("=d", time))
        if clock:
            clock.advance(1.0 / RATE)

    write_ticks(LiveWriter(ring), RATE, written=report)
    assert process.alive


def last_kept(path: Path) -> float:
    """Time of the last tick in what is left of a log, without a gap before it, s.

    -inf when nothing is.
    """
    try:
        _, log = recovered(path)
    except LogError:
        return -inf
    assert np.allclose(np.diff(times(log)), 1.0 / RATE)
    return float(times(log)[-1])


def reaped(pid: int) -> bool:
    try:
        os.waitpid(pid, os.WNOHANG)
    except ChildProcessError:
        return True
    return False
