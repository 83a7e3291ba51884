"""What a recorder refuses, and what is left of a log when disk, system or caller fail."""

import errno
import gc
import os
import resource
from pathlib import Path
from typing import Any

import pytest
from live.logs import largest_file
from mcap.exceptions import EndOfFile

from atlas_cueing.errors import OutputError
from atlas_cueing.recording import McapRecorder, read_log
from atlas_cueing.rotation import ZERO
from atlas_cueing.signals import TOPICS, Tick, VehicleState

from .flights import HEAD, append_all, tumble
from .plain_reading import decoded, open_recorder


@pytest.mark.parametrize("chunk_ticks", [0, -1, 16385])
def test_chunk_sizes_out_of_range_are_refused(tmp_path: Path, chunk_ticks: int) -> None:
    with pytest.raises(OutputError, match="allowed: 1 <= chunk_ticks <= 16384"):
        open_recorder(tmp_path / "x.mcap", chunk_ticks=chunk_ticks)
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_topic_to_leave_out_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"'/wheel' is no topic .* /wheels"):
        open_recorder(tmp_path / "x.mcap", skip_topics=["/wheel"])


def test_leaving_out_every_topic_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="leaves nothing to record"):
        open_recorder(tmp_path / "x.mcap", skip_topics=[topic.name for topic in TOPICS])


@pytest.mark.parametrize("chunk_ticks", [1, 2, 4])
def test_ticks_that_do_not_come_one_after_the_other_are_refused(
    tmp_path: Path, chunk_ticks: int
) -> None:
    ticks = tumble(4, 10.0)
    recorder = open_recorder(tmp_path / "x.mcap", chunk_ticks=chunk_ticks)
    with pytest.raises(
        OutputError, match=r"tick at time_s = 0\.1, allowed: 0 <= time_s <= 1e\+09, after 0\.1"
    ):
        append_all(recorder, [ticks[0], ticks[1], ticks[1], ticks[2]])


@pytest.mark.parametrize("leave", [McapRecorder.abandon, None])
def test_an_unfinished_log_keeps_its_complete_chunks(tmp_path: Path, leave: Any) -> None:
    ticks = tumble(17, 100.0)
    recorder = open_recorder(tmp_path / "x.mcap", chunk_ticks=5)
    append_all(recorder, ticks)
    if leave:
        leave(recorder)
    del recorder
    gc.collect()
    assert not (tmp_path / "x.mcap").exists()
    found: list[Any] = []
    with pytest.raises(EndOfFile):
        found.extend(
            message for topic, _, message in decoded(tmp_path / "x.mcap.part") if topic == "/motion"
        )
    assert [message.time_s for message in found] == [tick.motion.time for tick in ticks[:15]]


def refuses_everything(recorder: McapRecorder, why: str) -> None:
    for call in (
        lambda: recorder.append(tumble(1, 1.0)[0]),
        lambda: recorder.status(0.0, "", ""),
        lambda: recorder.close("ok", ""),
    ):
        with pytest.raises(OutputError, match=why):
            call()


def test_a_closed_recorder_takes_nothing_more(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "x.mcap")
    recorder.close("ok", "")
    refuses_everything(recorder, "closed")
    recorder.abandon()
    assert [file.name for file in tmp_path.iterdir()] == ["x.mcap"]


@pytest.mark.parametrize("time", [float("nan"), float("inf"), -0.5, 1.1e9])
def test_times_that_no_log_can_hold_are_refused(tmp_path: Path, time: float) -> None:
    recorder = open_recorder(tmp_path / "x.mcap", chunk_ticks=1)
    tick = tumble(1, 1.0)[0]
    wrong = Tick(
        VehicleState(time, tick.vehicle.q_NB, ZERO, ZERO), tick.cue, tick.motion, tick.wheels
    )
    with pytest.raises(OutputError, match=r"time_s .* allowed: 0 <= time_s <= 1e"):
        recorder.append(wrong)
    with pytest.raises(OutputError, match="time_s"):
        recorder.close("ok", "")
    assert [file.name for file in tmp_path.iterdir()] == ["x.mcap.part"]


def test_a_folder_that_does_not_exist_is_one_clear_error(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"cannot write log .*x.mcap: No such file or directory"):
        open_recorder(tmp_path / "nowhere" / "x.mcap")


def test_a_full_disk_at_the_start(tmp_path: Path) -> None:
    with largest_file(1000), pytest.raises(OutputError, match="File too large"):
        open_recorder(tmp_path / "x.mcap")
    assert not (tmp_path / "x.mcap").exists()


def test_the_first_write_error_is_latched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The disk has room again after the first error.

    Without the latch the log would have a hole and look complete.
    """
    recorder = open_recorder(tmp_path / "x.mcap", chunk_ticks=5)
    ticks = tumble(30, 100.0)
    append_all(recorder, ticks[:5])
    good = (tmp_path / "x.mcap.part").stat().st_size
    write, calls = os.write, []

    def full(file: int, data: memoryview) -> int:
        calls.append(len(data))
        if len(calls) == 1:
            return write(file, data[: len(data) // 2])  # a full disk first takes a part
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "write", full)
        with pytest.raises(OutputError, match=r"x.mcap: No space left"):
            append_all(recorder, ticks[5:])
    assert calls[1] == calls[0] - calls[0] // 2
    assert (tmp_path / "x.mcap.part").stat().st_size == good + calls[0] // 2
    refuses_everything(recorder, "No space left")
    assert (tmp_path / "x.mcap.part").stat().st_size == good + calls[0] // 2
    recorder.abandon()
    assert [file.name for file in tmp_path.iterdir()] == ["x.mcap.part"]


def test_a_file_size_limit_of_the_system(tmp_path: Path) -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    recorder = open_recorder(tmp_path / "x.mcap", chunk_ticks=50)
    size = (tmp_path / "x.mcap.part").stat().st_size
    resource.setrlimit(resource.RLIMIT_FSIZE, (size + 1000, hard))
    try:
        with pytest.raises(OutputError, match="File too large"):
            append_all(recorder, tumble(200, 100.0))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert (tmp_path / "x.mcap.part").stat().st_size == size + 1000


def test_a_failed_rename_leaves_the_part(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "x.mcap")
    (tmp_path / "x.mcap").mkdir()
    with pytest.raises(OutputError, match="no regular file"):
        recorder.close("ok", "")
    assert (tmp_path / "x.mcap.part").is_file()


def test_two_recorders_of_one_log(tmp_path: Path) -> None:
    """The second is refused and harms nothing.

    Once the first has let go, its .part may be replaced.
    """
    path = tmp_path / "x.mcap"
    first = McapRecorder(path, head_S=HEAD, metadata={}, attachments={}, chunk_ticks=1)
    first.append(tumble(1, 10.0)[0])
    before = path.with_name("x.mcap.part").read_bytes()
    with pytest.raises(OutputError, match="another run is writing it"):
        McapRecorder(path, head_S=HEAD, metadata={}, attachments={})
    assert path.with_name("x.mcap.part").read_bytes() == before
    first.abandon()
    McapRecorder(path, head_S=HEAD, metadata={}, attachments={}).close("ok", "")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["x.mcap"]


def test_a_log_that_appears_meanwhile_stays(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "x.mcap")
    (tmp_path / "x.mcap").write_text("of another")
    with pytest.raises(OutputError, match="another file has taken its name"):
        recorder.close("ok", "")
    assert (tmp_path / "x.mcap").read_text() == "of another"
    assert (tmp_path / "x.mcap.part").is_file()


def test_a_link_is_followed_and_its_part_lies_beside_the_real_file(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    (tmp_path / "x.mcap").symlink_to("there/y.mcap")
    recorder = open_recorder(tmp_path / "x.mcap")
    assert recorder.part == tmp_path / "there" / "y.mcap.part"
    assert recorder.part.is_file()
    recorder.close("ok", "")
    assert (tmp_path / "x.mcap").is_symlink()
    assert [path.name for path in (tmp_path / "there").iterdir()] == ["y.mcap"]


@pytest.mark.parametrize("what", ["link", "fifo", "folder"])
def test_a_part_that_is_no_file_is_left_alone(tmp_path: Path, what: str) -> None:
    part, precious = tmp_path / "x.mcap.part", tmp_path / "precious"
    precious.write_text("kept")
    {
        "link": lambda: part.symlink_to(precious),
        "fifo": lambda: os.mkfifo(part),
        "folder": part.mkdir,
    }[what]()
    with pytest.raises(
        OutputError, match=r"x.mcap: .*(symbolic link|no regular file|No such device|directory)"
    ):
        open_recorder(tmp_path / "x.mcap")
    assert precious.read_text() == "kept"


def test_texts_that_utf8_cannot_hold_have_question_marks(tmp_path: Path) -> None:
    name = os.fsdecode(b"caf\xe9")
    recorder = open_recorder(tmp_path / "x.mcap")
    recorder.append(tumble(1, 100.0)[0])
    recorder.status(0.0, "running", name)
    recorder.close("ok", name)
    log = read_log(tmp_path / "x.mcap")
    assert (log.metadata["reason"], log.statuses[0].reason) == ("caf?", "caf?")
