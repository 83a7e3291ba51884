"""Logs read back block by block."""

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.errors import LogError
from atlas_cueing.recording import read_blocks, read_log
from atlas_cueing.signals import Tick

from .flights import any_ticks, record, tumble
from .test_reader import GOOD, crafted


@settings(max_examples=40, deadline=None)
@given(any_ticks(), st.integers(1, 30), st.integers(1, 12))
def test_blocks_are_the_log(tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick], length: int, chunk: int) -> None:
    """Of the same messages, each but the last with as many as asked for, whatever the chunks."""
    path = record(tmp_path_factory.getbasetemp() / "blocks.mcap", ticks, chunk_ticks=chunk)
    log, blocks = read_log(path), list(read_blocks(path, length))
    assert [len(block.tables["/felt"].values) for block in blocks] == [length] * (len(ticks) // length) + [len(ticks) % length]
    for topic, table in log.tables.items():
        pieces = [block.tables[topic] for block in blocks]
        assert {piece.fields for piece in pieces} == {table.fields}
        np.testing.assert_array_equal(np.concatenate([piece.values for piece in pieces]), table.values)
        np.testing.assert_array_equal(np.concatenate([piece.log_times for piece in pieces]), table.log_times)
        assert all(piece.values.flags.f_contiguous for piece in pieces[:-1])
    last = blocks[-1]
    assert (last.metadata, last.attachments, last.statuses) == (log.metadata, log.attachments, log.statuses)
    assert last.transforms is not None
    assert log.transforms is not None
    np.testing.assert_array_equal(last.transforms.values, log.transforms.values)


def test_a_chunk_of_many_blocks(tmp_path: Path) -> None:
    blocks = list(read_blocks(record(tmp_path / "x.mcap", tumble(100, 100.0), chunk_ticks=100), 1))
    assert [len(block.tables["/motion"].values) for block in blocks] == [1] * 100 + [0]


def test_topics_that_are_not_wanted_stay_empty(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(50, 100.0))
    for block in read_blocks(path, 16, ("/motion", "/felt")):
        lengths = {topic: len(table.values) for topic, table in block.tables.items()}
        assert lengths["/motion"] == lengths["/felt"] > 0
        assert lengths["/vehicle"] == lengths["/cue"] == lengths["/wheels"] == 0
        assert block.transforms is None
    assert block.metadata["result"] == "ok"


def test_damage_at_the_end_is_met_after_the_blocks(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(50, 100.0))
    path.write_bytes(path.read_bytes()[:-1] + b"?")
    blocks = read_blocks(path, 16)
    assert len(next(blocks).tables["/felt"].values) == 16
    with pytest.raises(LogError, match=r"x\.mcap: the file does not end after its footer"):
        list(blocks)


def test_damage_in_a_topic_that_is_not_wanted_is_found(tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(crafted(GOOD, zstandard.compress(GOOD[::-1])))
    with pytest.raises(LogError, match="checksum of the chunk"):
        list(read_blocks(path, 16, ("/motion",)))
    path.write_bytes(crafted(GOOD[:-1]))
    with pytest.raises(LogError, match="the last message of a chunk is cut"):
        list(read_blocks(path, 16, ("/motion",)))


def test_a_log_without_ticks_is_one_empty_block(tmp_path: Path) -> None:
    (tmp_path / "x.mcap").write_bytes(crafted(b""))
    (block,) = read_blocks(tmp_path / "x.mcap", 16)
    assert block.tables["/felt"].values.shape == (0, 8)


def test_the_size_of_all_blocks_together_is_bounded(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(20, 100.0))
    with pytest.raises(LogError, match="larger than allowed"):
        list(read_blocks(path, 5, max_bytes=10_000))


def test_what_reading_in_blocks_holds_does_not_grow(tmp_path: Path) -> None:
    """Memory after the last of 40 blocks is that after the second."""
    path = record(tmp_path / "x.mcap", tumble(4000, 1000.0), chunk_ticks=50)
    tracemalloc.start()
    try:
        held = [tracemalloc.get_traced_memory()[0] for _ in read_blocks(path, 100, ("/vehicle", "/motion"))]
    finally:
        tracemalloc.stop()
    assert max(held[2:40]) - held[1] < 50_000  # a block of these topics has 26 kB
