"""The fixed layout against the official protobuf library."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.recording.schemas import flat_schema, message_class
from atlas_cueing.recording.wire import (
    EPOCH_NS,
    LATEST_S,
    flat_dtype,
    flat_template,
    live_log_times,
    log_times,
    put,
    record_content,
    record_template,
    repeat,
    take,
)
from atlas_cueing.signals import TOPICS, Topic

WIDE = Topic("/wide", "atlas.Wide", tuple(f"field_{i}" for i in range(40)))


@settings(deadline=None)
@given(st.lists(st.floats(0.0, LATEST_S), min_size=1, max_size=20))
def test_log_times_are_the_nearest_nanosecond(times: list[float]) -> None:
    for time, found in zip(times, log_times(np.array(times)).tolist(), strict=True):
        assert abs(found - EPOCH_NS - Fraction(time) * 10**9) <= Fraction(1, 2) + Fraction(1, 10**6)


def test_log_times_do_not_lose_nanoseconds_late_in_a_flight() -> None:
    time = 86_400.0 + 0.123456789
    assert int(log_times(np.array([time]))[0]) == EPOCH_NS + round(Fraction(time) * 10**9)


@settings(deadline=None)
@given(
    st.lists(st.floats(0.0, LATEST_S), min_size=1, max_size=20),
    st.integers(1_600_000_000 * 10**9, 2_000_000_000 * 10**9),
)
def test_live_log_times_count_from_the_start(elapsed: list[float], started: int) -> None:
    for time, found in zip(
        elapsed, live_log_times(np.array(elapsed), started).tolist(), strict=True
    ):
        assert abs(found - started - Fraction(time) * 10**9) <= Fraction(1, 2) + Fraction(1, 10**6)


@given(st.binary(max_size=100), st.binary(max_size=100))
def test_the_content_of_a_record_is_found(before: bytes, content: bytes) -> None:
    data = before + record_template(3, content, 7) + b"after"
    start, end = record_content(data, len(before))
    assert data[start:end] == content


@pytest.mark.parametrize("topic", [*TOPICS, WIDE], ids=lambda topic: topic.name)
def test_records_are_what_protobuf_writes(topic: Topic) -> None:
    values = np.random.default_rng(1).normal(size=(3, len(topic.fields)))
    records = repeat(flat_template(7, len(topic.fields)), 3)
    put(records, values)
    message = message_class(topic.schema, flat_schema(topic))
    for record, row in zip(records, values, strict=True):
        body = message(**dict(zip(topic.fields, row.tolist(), strict=True))).SerializeToString()
        assert record.tobytes()[31:] == body
        assert (record["opcode"], record["length"], record["channel"]) == (5, 22 + len(body), 7)


def test_zeros_are_written_and_read_by_protobuf() -> None:
    topic = TOPICS[1]
    message = message_class(topic.schema, flat_schema(topic))
    body = flat_template(1, len(topic.fields)).tobytes()[31:]
    assert all(getattr(message.FromString(body), name) == 0.0 for name in topic.fields)


@settings(deadline=None)
@given(st.integers(1, 40), st.integers(1, 5))
def test_take_gives_back_what_was_put(fields: int, count: int) -> None:
    values = np.random.default_rng(fields).normal(size=(count, fields))
    records = repeat(flat_template(3, fields), count)
    put(records, values)
    found = take(records, fields)
    assert found is not None
    np.testing.assert_array_equal(found, values)


@pytest.mark.parametrize("fields", [1, 15, 16, 40])
def test_take_refuses_any_other_tag(fields: int) -> None:
    dtype = flat_dtype(fields)
    for part in dtype.names[6:]:
        for tag in range(dtype[part].shape[0]):
            records = repeat(flat_template(3, fields), 2)
            assert take(records, fields) is not None
            records[part]["tag"][1, tag] ^= 8
            assert take(records, fields) is None


def test_copies_of_a_template_do_not_share_memory() -> None:
    template = flat_template(1, 3)
    records = repeat(template, 2)
    put(records[:1], np.ones((1, 3)))
    assert records[1] == template
    assert records[0] != template
