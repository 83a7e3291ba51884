"""The ring: order, loss, and a reader in another process that is overtaken while it reads."""

import os
from multiprocessing import get_context
from struct import pack, unpack

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.telemetry.ring import Ring, RingReader


def test_a_reader_gets_every_message_in_order_and_once() -> None:
    ring = Ring(8, 16)
    reader = RingReader(ring)
    for k in range(20):
        ring.write(k % 3, bytes([k]) * (k % 17))
        assert list(reader.messages()) == [(k % 3, bytes([k]) * (k % 17))]
    assert list(reader.messages()) == []
    assert reader.lost == 0
    assert ring.written == 20


def test_a_reader_begins_with_what_comes_after_it() -> None:
    ring = Ring(8, 8)
    ring.write(1, b"before")
    reader = RingReader(ring)
    ring.write(2, b"after")
    assert list(reader.messages()) == [(2, b"after")]


def test_a_message_that_does_not_fit_is_refused_and_harms_nothing() -> None:
    ring = Ring(4, 8)
    reader = RingReader(ring)
    with pytest.raises(ValueError, match="message of 9 bytes, allowed: at most 8"):
        ring.write(0, bytes(9))
    ring.write(0, bytes(8))
    assert list(reader.messages()) == [(0, bytes(8))]


@given(st.lists(st.integers(0, 30), max_size=20), st.integers(2, 9))
def test_what_is_not_read_is_counted_as_lost(bursts: list[int], slots: int) -> None:
    ring = Ring(slots, 8)
    reader = RingReader(ring)
    sent, got = 0, []
    for burst in bursts:
        for _ in range(burst):
            ring.write(7, pack("=Q", sent))
            sent += 1
        got += [unpack("=Q", data)[0] for _, data in reader.messages()]
    assert len(got) + reader.lost == sent
    assert got == sorted(set(got))
    if all(burst < slots for burst in bursts):
        assert reader.lost == 0
    else:
        assert reader.lost > 0


def test_newest_passes_over_the_old() -> None:
    ring = Ring(8, 8)
    reader = RingReader(ring)
    for k in range(100):
        ring.write(0, bytes([k]))
    assert [data[0] for _, data in reader.newest()] == [96, 97, 98, 99]
    assert reader.lost == 0
    ring.write(0, b"x")
    assert [data for _, data in reader.newest()] == [b"x"]


def test_a_message_that_is_being_written_is_not_read() -> None:
    ring = Ring(4, 8)
    ring.write(0, b"whole")
    at = ring._place(0)
    ring._memory[at : at + 8] = bytes(8)  # as between the first and the last line of `write`
    assert ring.read(0) is None


def test_a_reader_in_another_process_never_sees_a_torn_message() -> None:
    """The writer laps a small ring as fast as it can.

    Every message holds one number, over and over.
    """
    ring = Ring(16, 512)
    process = get_context("fork").Process(target=_write_all, args=(ring, 50_000))
    reader = RingReader(ring)
    process.start()
    got = 0
    while process.is_alive() or ring.written < 50_000:
        for _, data in reader.messages():
            assert len(set(unpack("=64Q", data))) == 1
            got += 1
        assert process.is_alive() or process.exitcode == 0
    for _, data in reader.messages():
        assert len(set(unpack("=64Q", data))) == 1
        got += 1
    process.join()
    assert got + reader.lost == 50_000
    assert got > 0


def _write_all(ring: Ring, count: int) -> None:
    for k in range(count):
        ring.write(0, pack("=64Q", *([k] * 64)))
    os._exit(0)
