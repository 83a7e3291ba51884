"""From ring to log, one step at a time and without another process."""

from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from recording.flights import ATTACHMENTS

from atlas_cueing.live.output.ring_recorder import FLUSH_S, Recorded, RingRecorder
from atlas_cueing.recording import read_log
from atlas_cueing.signals import LIVE_TOPICS, StateChange, live_row
from atlas_cueing.telemetry import LiveWriter, Ring, live_ring

from ..logs import largest_file, recovered, times
from ..riding import STARTED_NS, live_recorder, live_tick

RATE = 500.0  # Hz


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run.mcap"


class TestTheLog:
    """One process, with times of our own."""

    def test_the_log_is_what_went_into_the_ring(self, path: Path) -> None:
        _, writer, recorder = following(path)
        rows = []
        for k in range(40):
            tick, timing = live_tick(k / RATE)
            rows.append(live_row(tick, timing))
            writer.tick(tick, timing)
            assert recorder.step(k * 0.01) is None
        writer.end(0.08, "ok", "over")
        assert recorder.step(0.4) == Recorded("ok", "over", 40, 0)
        log = read_log(path)
        given = np.array(rows)
        read = np.hstack(
            [log.tables[topic.name].values for topic in LIVE_TOPICS if topic.name != "/felt"]
        )
        assert read.tobytes() == given.tobytes()
        assert len(log.tables["/felt"].values) == 40
        assert log.attachments == ATTACHMENTS
        assert (log.metadata["result"], log.metadata["reason"]) == ("ok", "over")

    def test_log_time_is_the_wall_clock_of_the_start_and_the_real_time_since(
        self, path: Path
    ) -> None:
        _, writer, recorder = following(path)
        for k in range(3):
            writer.tick(*live_tick(k / RATE))
        writer.end(1.0, "ok", "")
        recorder.step(0.0)
        found = sorted(set(log_times(path, "/timing")))
        assert found == [STARTED_NS + 250_000_000 + k * 2_000_000 for k in range(3)]

    def test_states_are_kept_with_their_reasons_and_told_when_asked(self, path: Path) -> None:
        lines: list[str] = []
        _, writer, recorder = following(path, lines, announce=True)
        writer.status(0.0, "parked", "")
        writer.tick(*live_tick(0.0))
        writer.status(0.0, "running", "engaged by hand")
        writer.tick(*live_tick(3.2))
        writer.status(3.2, "holding", "no input for 0.1 s")
        writer.end(3.2, "ok", "")
        recorder.step(0.0)
        assert lines == [
            "   0.00 s  parked",
            "   0.00 s  running  engaged by hand",
            "   3.20 s  holding  no input for 0.1 s",
        ]
        expected = (StateChange(0.0, "parked", ""), StateChange(0.0, "running", "engaged by hand"))
        assert read_log(path).statuses == (
            *expected,
            StateChange(3.2, "holding", "no input for 0.1 s"),
        )

    def test_nothing_is_told_unasked(self, path: Path) -> None:
        lines: list[str] = []
        _, writer, recorder = following(path, lines)
        writer.status(0.0, "parked", "")
        writer.end(0.0, "ok", "")
        recorder.step(0.0)
        assert lines == []

    def test_a_flush_is_due_after_a_while(self, path: Path) -> None:
        _, writer, recorder = following(path)
        part = path.with_name("run.mcap.part")
        recorder.step(10.0)
        size = part.stat().st_size
        writer.tick(*live_tick(0.0))
        recorder.step(10.0 + 0.99 * FLUSH_S)
        assert part.stat().st_size == size
        recorder.step(10.0 + FLUSH_S)
        assert part.stat().st_size > size

    def test_the_disk_is_asked_to_take_it_once_a_second(
        self, path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        asked: list[int] = []
        monkeypatch.setattr("os.fdatasync", asked.append)
        _, writer, recorder = following(path)
        for k in range(100):
            writer.tick(*live_tick(0.05 * k))
            recorder.step(10.0 + 0.05 * k)
        assert len(asked) == 5

    def test_a_disk_that_takes_nothing_is_told(
        self, path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def full(_: int) -> None:
            raise OSError(28, "No space left on device")

        monkeypatch.setattr("os.fdatasync", full)
        lines: list[str] = []
        _, writer, recorder = following(path, lines)
        writer.tick(*live_tick(0.0))
        recorder.step(0.0)
        assert "nothing more is recorded" in lines[0]

    def test_an_overrun_is_told_where_it_happened(self, path: Path) -> None:
        ring, writer, recorder = following(path)
        writer.tick(*live_tick(0.0))
        recorder.step(0.0)
        for k in range(1, ring.slots + 11):
            writer.tick(*live_tick(k / RATE))
        writer.end(9.0, "ok", "over")
        recorded = recorder.step(0.01)
        assert recorded is not None
        assert recorded.lost + recorded.ticks == ring.slots + 11
        assert recorded.lost >= 11
        assert (recorded.result, recorded.reason) == (
            "ok",
            f"over; {recorded.lost} messages lost: the log was written too slowly",
        )
        log = read_log(path)
        assert log.metadata["reason"] == recorded.reason
        gap = StateChange(
            0.0, "recording_gap", f"{recorded.lost} messages lost: the log is written too slowly"
        )
        assert log.statuses == (gap,)
        assert len(times(log)) == recorded.ticks
        assert times(log)[0] == 0.0
        assert times(log)[1] == pytest.approx((recorded.lost + 1) / RATE)

    def test_ticks_count_when_they_are_in_the_log_however_many_come_at_once(
        self, path: Path
    ) -> None:
        """A thousand ticks in one step, and a disk that is full after some chunks of them."""
        ring = live_ring(2.0, 1000.0)
        recorder = RingRecorder(ring, live_recorder(path), report=lambda _: None)
        writer = LiveWriter(ring)
        for k in range(1000):
            writer.tick(*live_tick(k / RATE))
        writer.end(2.0, "ok", "")
        with largest_file(400_000):
            recorded = recorder.step(0.0)
        assert recorded is not None
        assert recorded.result == "recording_failed"
        assert recovered(path)[0].ticks == recorded.ticks > 0

    def test_a_loop_that_went_without_a_word_leaves_a_finished_log(self, path: Path) -> None:
        _, writer, recorder = following(path)
        writer.tick(*live_tick(0.5))
        recorder.step(0.0)
        recorded = recorder.orphaned()
        assert recorded == Recorded(
            "loop_killed", "the loop ended without a word after 0.500 s", 1, 0
        )
        log = read_log(path)
        assert log.metadata["result"] == "loop_killed"
        assert log.statuses == (StateChange(0.5, "stopped", recorded.reason),)

    def test_a_log_that_cannot_be_written_is_told_once_and_the_ring_goes_on(
        self, path: Path
    ) -> None:
        lines: list[str] = []
        _, writer, recorder = following(path, lines)
        with largest_file(100_000):
            for k in range(2000):
                writer.tick(*live_tick(k / RATE))
                assert recorder.step(k * 0.01) is None
        writer.status(4.0, "parking", "")
        writer.end(4.0, "ok", "over")
        recorded = recorder.step(40.0)
        assert recorded is not None
        assert recorded.result == "recording_failed"
        assert recorded.reason == f"cannot write log {path}: File too large"
        assert lines == [lines[0]]
        assert lines[0].endswith(f"s  nothing more is recorded: {recorded.reason}")
        assert recorded.lost == 0
        assert recovered(path)[0].ticks == recorded.ticks > 0


def following(
    path: Path, lines: list[str] | None = None, *, announce: bool = False
) -> tuple[Ring, LiveWriter, RingRecorder]:
    ring = live_ring(0.1, 100.0)
    say = (lambda _: None) if lines is None else lines.append
    return (
        ring,
        LiveWriter(ring),
        RingRecorder(ring, live_recorder(path), announce=announce, report=say),
    )


def log_times(path: Path, topic: str) -> list[int]:
    with path.open("rb") as stream:
        return [
            message.log_time for _, _, message in make_reader(stream).iter_messages(topics=[topic])
        ]
