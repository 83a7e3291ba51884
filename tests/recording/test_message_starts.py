"""Messages found by the log's own index where it is right, and otherwise one by one."""

from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import LogError
from atlas_cueing.recording import message_starts as module
from atlas_cueing.recording import read_log
from atlas_cueing.recording.message_starts import Starts, message_starts, windows
from atlas_cueing.recording.reader import _Content
from atlas_cueing.recording.records import MessageOffsets
from atlas_cueing.recording.wire import record_template

from .flights import record, tumble

LENGTHS = [(1, 16), (2, 90), (1, 16), (3, 0), (2, 90), (1, 16)]  # channel and bytes of each message
DATA = b"".join(record_template(channel, bytes(size)) for channel, size in LENGTHS)
GOOD: Starts = {1: np.array([0, 168, 367]), 2: np.array([47, 246]), 3: np.array([215])}
OTHER_OPCODE = bytes([4]) + DATA[1:]


def same(one: Starts, other: Starts) -> bool:
    return one.keys() == other.keys() and all(np.array_equal(one[k], other[k]) for k in one)


def the_slow_way_is_gone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        module, "_one_after_the_other", lambda _: pytest.fail("the index was not believed")
    )


def test_both_ways_find_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    assert same(message_starts(DATA, {}), GOOD)
    the_slow_way_is_gone(monkeypatch)
    assert same(message_starts(DATA, GOOD), GOOD)


def changed(channel: int, starts: list[int]) -> Starts:
    return GOOD | {channel: np.array(starts, dtype=np.int64)}


@pytest.mark.parametrize(
    "index",
    [
        changed(1, [0, 168]),  # the last message is missing
        changed(1, [168, 367]),  # the first one
        changed(2, [47]),  # one amid the others
        changed(2, [47, 247]),
        changed(2, [47, 246, 246]),
        changed(1, [168, 0, 367]),  # in another order than theirs
        changed(2, [47, 47]),
        changed(3, [-1]),
        changed(3, [2**62]),
        changed(3, []),
        changed(4, [0]),
        {1: GOOD[2], 2: GOOD[1], 3: GOOD[3]},  # channels changed over
        {1: np.array([], dtype=np.int64)},
    ],
    ids=str,
)
def test_an_index_that_lies_is_not_believed(index: Starts) -> None:
    assert same(message_starts(DATA, index), GOOD)


def test_records_that_are_no_messages_are_passed_over_by_the_slow_way() -> None:
    expected = {1: np.array([168, 367]), 2: GOOD[2], 3: GOOD[3]}
    assert same(message_starts(OTHER_OPCODE, GOOD), expected)
    assert same(message_starts(OTHER_OPCODE, expected), expected)


@pytest.mark.parametrize("length", [0, 21, 39, 2**63, 2**64 - 9, 2**64 - 1])
def test_lying_lengths_are_found_whatever_the_index_says(length: int) -> None:
    lying = DATA[:1] + length.to_bytes(8, "little") + DATA[9:]
    with pytest.raises(LogError, match=r"cut|at least"):
        message_starts(lying, GOOD)


@pytest.mark.parametrize("size", [1, 46, len(DATA) - 1])
def test_a_cut_chunk_is_found_whatever_the_index_says(size: int) -> None:
    with pytest.raises(LogError, match="cut"):
        message_starts(DATA[:size], GOOD)


def test_messages_that_overlap_are_not_believed() -> None:
    """One message holds another, whose end is the first one's end.

    Every end is a start, but lengths do not add up.
    """
    inner = record_template(3, bytes(5))
    data = record_template(1, bytes(40)) + record_template(2, inner)
    lying: Starts = {1: np.array([0]), 2: np.array([71]), 3: np.array([102])}
    assert same(message_starts(data, lying), {1: lying[1], 2: lying[2]})


def test_a_message_that_ends_where_none_starts_is_not_believed() -> None:
    """The index has one inside the first message in the place of the second; lengths add up."""
    second = record_template(2, bytes(16))
    first = record_template(1, second[:11] + bytes(40))
    data, start, end = (
        first + second + record_template(1, bytes(5)),
        len(first),
        len(first + second),
    )
    assert same(
        message_starts(data, {1: np.array([0, end]), 2: np.array([31])}),
        {1: np.array([0, end]), 2: np.array([start])},
    )


def test_every_record_of_a_chunk_can_be_looked_at() -> None:
    dtype = np.dtype([("a", "u1"), ("b", "<u2")])
    found = windows(bytes(range(5)), dtype)
    assert [bytes(each.tobytes()) for each in found] == [bytes([k, k + 1, k + 2]) for k in range(3)]
    assert found[[2, 0]].view(dtype)["a"].tolist() == [2, 0]
    assert len(windows(b"ab", dtype)) == 0


def test_our_own_logs_are_read_by_their_index(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    the_slow_way_is_gone(monkeypatch)
    assert (
        len(read_log(record(tmp_path / "x.mcap", tumble(40, 100.0))).tables["/motion"].values) == 40
    )


def test_an_index_of_more_than_the_chunk_holds_is_not_kept() -> None:
    content = _Content(Path("x.mcap"), 1 << 20)
    content.add(MessageOffsets(1, np.zeros(1000, dtype=np.uint64)))  # of no chunk at all
    assert content._index == {}
