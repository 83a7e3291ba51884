"""The log as anyone sees it, through plain mcap and mcap-protobuf-support; our own reader takes no part here."""

import errno
import gc
import io
import os
import resource
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import accumulate
from math import floor
from pathlib import Path
from typing import Any

import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode
from mcap.reader import NonSeekingReader, SeekingReader, make_reader
from mcap.records import Chunk, Footer, Message, MessageIndex, SummaryOffset
from mcap_protobuf.decoder import DecoderFactory

from atlas_cueing.errors import OutputError
from atlas_cueing.recording import McapRecorder
from atlas_cueing.rotation import ZERO
from atlas_cueing.signals import TOPICS, Tick, VehicleState

from .flights import ATTACHMENTS, HEAD, METADATA, any_ticks, append_all, record, tumble, tumbling_at

EPOCH_NS = 946_684_800 * 10**9  # 2000-01-01T00:00:00Z


def open_recorder(path: Path, **options: Any) -> McapRecorder:
    return McapRecorder(path, head_S=HEAD, metadata=METADATA, attachments=ATTACHMENTS, **options)


def decoded(path: Path) -> Iterator[tuple[str, int, Any]]:
    """Topic, log time and decoded message of everything in the log, every checksum validated, in the order of the file."""
    with path.open("rb") as stream:
        reader = NonSeekingReader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for item in reader.iter_decoded_messages(log_time_order=False):
            assert item.message.log_time == item.message.publish_time
            yield item.channel.topic, item.message.log_time, item.decoded_message


def vector(message: Any, name: str, unit: str) -> tuple[float, ...]:
    return tuple(getattr(message, f"{name}{axis}_{unit}") for axis in "xyz")


def quaternion(message: Any, name: str) -> tuple[float, ...]:
    return tuple(getattr(message, f"{name}_{component}") for component in "wxyz")


def check_vehicle(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.vehicle.time
    assert quaternion(message, "q_nb") == tick.vehicle.q_NB
    assert vector(message, "w", "rad_s") == tick.vehicle.w_NB_B
    assert vector(message, "f", "m_s2") == tick.vehicle.f_B


def check_cue(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.cue.time
    assert quaternion(message, "q_ws") == tick.cue.q_WS
    assert vector(message, "w", "rad_s") == tick.cue.w_WS_W
    assert vector(message, "p", "m") == tick.cue.p_WS_W
    assert vector(message, "v", "m_s") == tick.cue.v_WS_W
    assert vector(message, "a", "m_s2") == tick.cue.a_WS_W


def check_motion(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.motion.time
    assert quaternion(message, "q_ws") == tick.motion.q_WS
    assert vector(message, "w", "rad_s") == tick.motion.w_WS_W
    assert vector(message, "alpha", "rad_s2") == tick.motion.alpha_WS_W
    assert vector(message, "p", "m") == tick.motion.p_WS_W
    assert vector(message, "v", "m_s") == tick.motion.v_WS_W
    assert vector(message, "a", "m_s2") == tick.motion.a_WS_W
    assert (message.wheels_limited, message.stage_limited) == tick.motion.limited


def check_wheels(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.wheels.time
    assert (message.w1_rad_s, message.w2_rad_s, message.w3_rad_s) == tick.wheels.speed
    assert (message.a1_rad_s2, message.a2_rad_s2, message.a3_rad_s2) == tick.wheels.acceleration


CHECKS = {"/vehicle": check_vehicle, "/cue": check_cue, "/motion": check_motion, "/wheels": check_wheels}


@settings(max_examples=40, deadline=None)
@given(any_ticks(), st.integers(1, 6))
def test_every_field_is_read_back_as_it_was_put_in(
    tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick], chunk_ticks: int
) -> None:
    path = record(tmp_path_factory.getbasetemp() / "any.mcap", ticks, chunk_ticks=chunk_ticks)
    seen: Counter[str] = Counter()
    latest = 0
    for topic, log_time, message in decoded(path):
        assert log_time >= latest
        latest = log_time
        if topic in CHECKS:
            tick = ticks[seen[topic]]
            assert abs(log_time - EPOCH_NS - Fraction(tick.vehicle.time) * 10**9) <= Fraction(1, 2) + Fraction(1, 10**6)
            CHECKS[topic](message, tick)
        seen[topic] += 1
    assert {topic: seen[topic] for topic in CHECKS} == dict.fromkeys(CHECKS, len(ticks))
    assert seen["/felt"] == len(ticks)
    assert seen["/status"] == 2


@settings(max_examples=40, deadline=None)
@given(any_ticks())
def test_transforms_carry_stage_position_and_cabin_orientation(
    tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick]
) -> None:
    path = record(tmp_path_factory.getbasetemp() / "tf.mcap", ticks)
    by_time = {}
    for topic, log_time, message in decoded(path):
        if topic == "/motion":
            by_time[log_time] = ticks[len(by_time)].motion
        if topic == "/tf":
            motion = by_time[log_time]  # a transform follows its tick
            stage, cabin = message.transforms
            assert [(t.parent_frame_id, t.child_frame_id) for t in (stage, cabin)] == [("base", "stage"), ("stage", "cabin")]
            assert {t.timestamp.seconds * 10**9 + t.timestamp.nanos for t in (stage, cabin)} == {log_time}
            assert (stage.translation.x, stage.translation.y, stage.translation.z) == motion.p_WS_W
            assert (stage.rotation.w, stage.rotation.x, stage.rotation.y, stage.rotation.z) == (1.0, 0.0, 0.0, 0.0)
            assert (cabin.translation.x, cabin.translation.y, cabin.translation.z) == (0.0, 0.0, 0.0)
            assert (cabin.rotation.w, cabin.rotation.x, cabin.rotation.y, cabin.rotation.z) == motion.q_WS


@pytest.mark.parametrize(("rate_hz", "transforms"), [(1000.0, 60), (120.0, 60), (960.0, 60), (60.0, 60), (50.0, 50)])
def test_transforms_come_at_sixty_hertz_at_most(tmp_path: Path, rate_hz: float, transforms: int) -> None:
    path = record(tmp_path / "rate.mcap", tumble(int(rate_hz), rate_hz), chunk_ticks=7)
    assert sum(topic == "/tf" for topic, _, _ in decoded(path)) == transforms


def test_no_transform_is_lost_where_time_is_summed_up(tmp_path: Path) -> None:
    """Sixtieths of a second added up fall short of k/60 by a rounding error now and then."""
    times = list(accumulate([0.0] + [1.0 / 60.0] * 599))
    assert any(floor(time * 60.0) < k for k, time in enumerate(times))
    path = record(tmp_path / "sum.mcap", [tumbling_at(time) for time in times])
    assert sum(topic == "/tf" for topic, _, _ in decoded(path)) == 600


def test_status_stands_after_the_ticks_up_to_its_time(tmp_path: Path) -> None:
    ticks = tumble(10, 10.0)
    recorder = open_recorder(tmp_path / "s.mcap")
    append_all(recorder, ticks)
    recorder.status(0.35, "limited", "wheels; größer")
    recorder.close("vehicle_failed", "NaN")
    messages = list(decoded(tmp_path / "s.mcap"))
    place = next(k for k, (topic, _, _) in enumerate(messages) if topic == "/status")
    status = messages[place][2]
    assert (status.time_s, status.state, status.reason) == (0.35, "limited", "wheels; größer")
    assert sum(topic == "/motion" for topic, _, _ in messages[:place]) == 4


def test_a_state_between_two_ticks_stands_between_them_and_after_the_transform(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "s.mcap", skip_topics=[topic.name for topic in TOPICS[1:]])
    append_all(recorder, tumble(3, 10.0))
    for time in (0.16, 0.14, 0.5):
        recorder.status(time, "", "")
    recorder.close("ok", "")
    times = [(topic, round((log_time - EPOCH_NS) / 1e9, 6)) for topic, log_time, _ in decoded(tmp_path / "s.mcap")]
    ticks = [[("/vehicle", 0.1 * k), ("/tf", 0.1 * k)] for k in range(3)]
    assert times == [*ticks[0], *ticks[1], ("/status", 0.14), ("/status", 0.16), *ticks[2], ("/status", 0.5)]


def test_a_state_without_ticks_is_kept(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "s.mcap")
    recorder.status(0.0, "vehicle_failed", "no trim")
    recorder.close("vehicle_failed", "no trim")
    ((topic, _, status),) = decoded(tmp_path / "s.mcap")
    assert (topic, status.reason) == ("/status", "no trim")


def test_metadata_and_attachments(tmp_path: Path) -> None:
    path = record(tmp_path / "m.mcap", tumble(3, 10.0))
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        (metadata,) = reader.iter_metadata()
        attachments = list(reader.iter_attachments())
        assert reader.get_header().library == "atlas_cueing"
    assert (metadata.name, metadata.metadata) == ("atlas.run", {**METADATA, "result": "ok", "reason": "end of test"})
    assert {a.name: (a.media_type, a.data) for a in attachments} == {k: ("application/toml", v) for k, v in ATTACHMENTS.items()}
    assert all(a.log_time == a.create_time == EPOCH_NS for a in attachments)


def test_summary_agrees_with_the_messages(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(23, 100.0))
    with path.open("rb") as stream:
        summary = SeekingReader(stream, validate_crcs=True).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    topics = {channel.id: channel.topic for channel in summary.channels.values()}
    counts = {topics[key]: count for key, count in summary.statistics.channel_message_counts.items()}
    messages = list(decoded(path))
    times = [log_time for _, log_time, _ in messages]
    assert counts == Counter(topic for topic, _, _ in messages)
    assert summary.statistics.message_count == len(messages)
    assert (summary.statistics.message_start_time, summary.statistics.message_end_time) == (min(times), max(times))
    assert (summary.statistics.chunk_count, len(summary.chunk_indexes)) == (5, 5)
    assert (summary.statistics.attachment_count, summary.statistics.metadata_count) == (2, 1)
    assert summary.statistics.channel_count == summary.statistics.schema_count == len(TOPICS) + 2
    assert len(summary.attachment_indexes) == 2
    assert len(summary.metadata_indexes) == 1


def record_at(data: bytes, offset: int, opcode: int) -> ReadDataStream:
    """The body of the record at `offset`, which must have this opcode."""
    assert data[offset] == opcode
    length = int.from_bytes(data[offset + 1 : offset + 9], "little")
    return ReadDataStream(io.BytesIO(data[offset + 9 : offset + 9 + length]))


def test_indexes_point_at_every_message(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(23, 100.0))
    data = path.read_bytes()
    with path.open("rb") as stream:
        summary = SeekingReader(stream).get_summary()
    assert summary is not None
    indexed = 0
    for chunk_index in summary.chunk_indexes:
        chunk = Chunk.read(record_at(data, chunk_index.chunk_start_offset, Opcode.CHUNK))
        messages = zstandard.decompress(chunk.data)
        assert len(messages) == chunk_index.uncompressed_size
        assert len(chunk.data) == chunk_index.compressed_size
        end = chunk_index.chunk_start_offset + chunk_index.chunk_length + chunk_index.message_index_length
        assert data[end] in (Opcode.CHUNK, Opcode.METADATA)  # what comes after the last message index
        times = []
        for channel, offset in chunk_index.message_index_offsets.items():
            index = MessageIndex.read(record_at(data, offset, Opcode.MESSAGE_INDEX))
            assert index.channel_id == channel
            for log_time, start in index.records:
                message = Message.read(record_at(messages, start, Opcode.MESSAGE), 22)
                assert (message.channel_id, message.log_time) == (channel, log_time)
                times.append(log_time)
        assert (chunk_index.message_start_time, chunk_index.message_end_time) == (min(times), max(times))
        indexed += len(times)
    assert summary.statistics is not None
    assert indexed == summary.statistics.message_count


def test_summary_offsets_point_at_their_groups(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(23, 100.0))
    data = path.read_bytes()
    footer = Footer.read(record_at(data, len(data) - 8 - 29, Opcode.FOOTER))
    position, groups = footer.summary_offset_start, []
    while data[position] == Opcode.SUMMARY_OFFSET:
        group = SummaryOffset.read(record_at(data, position, Opcode.SUMMARY_OFFSET))
        assert data[group.group_start] == group.group_opcode
        groups.append((group.group_start, group.group_length))
        position += 9 + 17
    ends = [start + length for start, length in groups]
    assert len(groups) == 6
    assert [footer.summary_start, *ends] == [*(start for start, _ in groups), footer.summary_offset_start]


def test_a_log_without_ticks_is_complete(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "empty.mcap")
    recorder.close("vehicle_failed", "no trim")
    assert list(decoded(tmp_path / "empty.mcap")) == []
    with (tmp_path / "empty.mcap").open("rb") as stream:
        assert next(iter(make_reader(stream).iter_metadata())).metadata["result"] == "vehicle_failed"


def test_topics_can_be_left_out(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(12, 100.0), skip_topics=("/cue", "/felt", "/tf", "/status"))
    assert Counter(topic for topic, _, _ in decoded(path)) == {"/vehicle": 12, "/motion": 12, "/wheels": 12}


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
def test_ticks_that_do_not_come_one_after_the_other_are_refused(tmp_path: Path, chunk_ticks: int) -> None:
    ticks = tumble(4, 10.0)
    recorder = open_recorder(tmp_path / "x.mcap", chunk_ticks=chunk_ticks)
    with pytest.raises(OutputError, match=r"tick at time_s = 0\.1, allowed: 0 <= time_s <= 1e\+09, after 0\.1"):
        append_all(recorder, [ticks[0], ticks[1], ticks[1], ticks[2]])


def test_bytes_are_on_the_disk_before_the_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recorder, calls = open_recorder(tmp_path / "x.mcap"), []

    def watch(name: str) -> None:
        real = getattr(os, name)
        monkeypatch.setattr(os, name, lambda *arguments: (calls.append(name), real(*arguments))[1])

    for name in ("write", "fsync", "replace"):
        watch(name)
    recorder.close("ok", "")
    assert calls[-3:] == ["write", "fsync", "replace"]


def test_the_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    first, second = (record(tmp_path / f"{k}.mcap", tumble(40, 1000.0)).read_bytes() for k in range(2))
    other = record(tmp_path / "other.mcap", tumble(41, 1000.0)).read_bytes()
    assert first == second
    assert first != other


def test_a_log_has_its_name_only_when_it_is_complete(tmp_path: Path) -> None:
    path, part = tmp_path / "x.mcap", tmp_path / "x.mcap.part"
    recorder = open_recorder(path)
    assert (path.exists(), part.exists()) == (False, True)
    recorder.close("ok", "")
    assert (path.exists(), part.exists()) == (True, False)


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
        found.extend(message for topic, _, message in decoded(tmp_path / "x.mcap.part") if topic == "/motion")
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
    wrong = Tick(VehicleState(time, tick.vehicle.q_NB, ZERO, ZERO), tick.cue, tick.motion, tick.wheels)
    with pytest.raises(OutputError, match=r"time_s .* allowed: 0 <= time_s <= 1e"):
        recorder.append(wrong)
    with pytest.raises(OutputError, match="time_s"):
        recorder.close("ok", "")
    assert [file.name for file in tmp_path.iterdir()] == ["x.mcap.part"]


def test_values_that_overflowed_are_recorded_as_they_are(tmp_path: Path) -> None:
    tick = tumble(1, 1.0)[0]
    wild = Tick(tick.vehicle, tick.cue, replace(tick.motion, w_WS_W=(1e200, float("inf"), float("nan"))), tick.wheels)
    path = record(tmp_path / "x.mcap", [wild])
    (motion,) = [message for topic, _, message in decoded(path) if topic == "/motion"]
    assert vector(motion, "w", "rad_s")[:2] == (1e200, float("inf"))
    assert motion.wz_rad_s != motion.wz_rad_s


def test_a_folder_that_does_not_exist_is_one_clear_error(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"cannot write log .*x.mcap: No such file or directory"):
        open_recorder(tmp_path / "nowhere" / "x.mcap")


def test_a_full_disk_at_the_start(tmp_path: Path) -> None:
    (tmp_path / "x.mcap.part").symlink_to("/dev/full")
    with pytest.raises(OutputError, match="No space left on device"):
        open_recorder(tmp_path / "x.mcap")
    assert not (tmp_path / "x.mcap").exists()


def test_the_first_write_error_is_latched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The disk has room again after the first error; without the latch the log would have a hole and look complete."""
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
    (tmp_path / "x.mcap").mkdir()
    recorder = open_recorder(tmp_path / "x.mcap")
    with pytest.raises(OutputError, match="Is a directory"):
        recorder.close("ok", "")
    assert (tmp_path / "x.mcap.part").is_file()


def test_two_recorders_of_one_log(tmp_path: Path) -> None:
    """The second is refused and harms nothing; once the first has let go, its .part may be replaced."""
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
