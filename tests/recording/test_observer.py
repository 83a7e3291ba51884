"""Whoever looks at a run while it is recorded sees what its log will say."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.recording import Log, McapRecorder, read_log
from atlas_cueing.rotations import Array
from atlas_cueing.signals import LIVE_TOPICS, TOPICS, Tick, Topic

from .flights import ATTACHMENTS, HEAD, METADATA, any_ticks, append_all, tumble


def recorded(path: Path, ticks: list[Tick], **options: object) -> list[Array]:
    """What an observer of the log is given."""
    seen: list[Array] = []
    everything = {
        "head_S": HEAD,
        "metadata": METADATA,
        "attachments": ATTACHMENTS,
        "observer": seen.append,
    }
    recorder = McapRecorder(path, **everything | options)  # type: ignore[arg-type]
    append_all(recorder, ticks)
    recorder.close("ok", "")
    return seen


def numbers(log: Log, topics: tuple[Topic, ...] = TOPICS) -> Array:
    return np.hstack([log.tables[topic.name].values for topic in topics])


@settings(max_examples=40)
@given(any_ticks(), st.integers(1, 13))
def test_the_numbers_of_every_chunk_are_those_of_the_log(
    tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick], chunk: int
) -> None:
    path = tmp_path_factory.getbasetemp() / "observed.mcap"
    seen = recorded(path, ticks, chunk_ticks=chunk)
    assert [len(numbers) for numbers in seen if len(numbers)][:-1] == [chunk] * (
        (len(ticks) - 1) // chunk
    )
    np.testing.assert_array_equal(np.concatenate(seen), numbers(read_log(path)))


def test_a_log_of_ticks_in_memory(tmp_path: Path) -> None:
    seen = np.concatenate(recorded(tmp_path / "x.mcap", tumble(50, 100.0)))
    log, inside = read_log(tmp_path / "x.mcap"), Log.of_ticks(seen)
    assert list(inside.tables) == list(log.tables)
    for topic, table in log.tables.items():
        assert inside.tables[topic].fields == table.fields
        np.testing.assert_array_equal(inside.tables[topic].values, table.values)


def test_topics_that_are_left_out_are_seen(tmp_path: Path) -> None:
    ticks = tumble(50, 100.0)
    everything = np.concatenate(recorded(tmp_path / "a.mcap", ticks))
    skipped = np.concatenate(recorded(tmp_path / "b.mcap", ticks, skip_topics=("/felt", "/cue")))
    np.testing.assert_array_equal(skipped, everything)


def test_a_live_log(tmp_path: Path) -> None:
    seen: list[Array] = []
    recorder = McapRecorder(
        tmp_path / "x.mcap",
        head_S=HEAD,
        metadata={},
        attachments={},
        started_ns=10**18,
        observer=seen.append,
    )
    width = sum(len(topic.fields) for topic in LIVE_TOPICS[:-1])
    rows = np.random.default_rng(1).random((30, width)).cumsum(axis=0)
    recorder.append_live(rows.tobytes())
    recorder.close("ok", "")
    np.testing.assert_array_equal(
        np.concatenate(seen), numbers(read_log(tmp_path / "x.mcap"), LIVE_TOPICS)
    )


def test_one_that_fails_is_told_once_and_the_log_is_whole(tmp_path: Path) -> None:
    class FailingError(Exception):
        pass

    calls = []

    def failing(ticks: Array) -> None:
        calls.append(len(ticks))
        raise FailingError

    path, ticks = tmp_path / "x.mcap", tumble(50, 100.0)
    recorder = McapRecorder(
        path, head_S=HEAD, metadata={}, attachments={}, chunk_ticks=20, observer=failing
    )
    with pytest.raises(FailingError):
        append_all(recorder, ticks)
    append_all(recorder, ticks[20:])
    recorder.close("failed", "")
    assert calls == [20]
    assert len(read_log(path).column("/motion", "time_s")) == 50
