"""What the loop puts into its ring comes out of it as it was, and nothing is too long for it."""

from math import inf

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from recording.flights import tumbling_at

from atlas_cueing.signals import StateChange, Timing, live_row
from atlas_cueing.telemetry import LiveWriter, RingReader, live_ring
from atlas_cueing.telemetry.messages import END, LONGEST_TEXT, STATUS, TICK, numbers, status


def test_a_tick_is_all_its_numbers() -> None:
    ring = live_ring(1.0, 100.0)
    reader, writer = RingReader(ring), LiveWriter(ring)
    tick, timing = tumbling_at(1.25), Timing(1.25, 1.5, 1e-5, 2e-4, -1.0, 3.0, 2.0)
    writer.tick(tick, timing)
    ((kind, data),) = reader.messages()
    assert kind == TICK
    assert numbers(data) == live_row(tick, timing)


def round_trip(state: str, reason: str, time: float = 1.5) -> StateChange:
    """A change of state, there and back; an end is no different."""
    ring = live_ring(1.0, 100.0)
    reader, writer = RingReader(ring), LiveWriter(ring)
    writer.status(time, state, reason)
    writer.end(time, state, reason)
    (one, changed), (other, ended) = reader.messages()
    assert (one, other) == (STATUS, END)
    assert changed == ended
    assert len(changed) <= ring.size
    return status(changed)


def test_a_change_of_state() -> None:
    assert round_trip("holding", "no input for 0.10 s") == StateChange(
        1.5, "holding", "no input for 0.10 s"
    )
    assert round_trip("", "", 0.1 + 0.2) == StateChange(0.1 + 0.2, "", "")


@pytest.mark.parametrize(
    "text",
    [
        "x" * 100_000,
        "\x00" * 500,
        '"\\' * 400,
        "\U0001f6e9" * 500,
        "é" * 300,
        "\ud800" * 300,
        "\x7f\x1b[31m\n" * 90,
    ],
    ids=["long", "control", "escapes", "four bytes", "two bytes", "surrogates", "terminal"],
)
def test_odd_texts_keep_their_beginning(text: str) -> None:
    back = round_trip(text, text)
    for found in (back.state, back.reason):
        assert len(found) >= 50
        assert text.replace("\ud800", "?").startswith(found)


def test_what_fits_is_kept_whole() -> None:
    assert round_trip("fault", "y" * LONGEST_TEXT).reason == "y" * LONGEST_TEXT
    assert round_trip("fault", "z" * LONGEST_TEXT + "!").reason == "z" * LONGEST_TEXT


@settings(max_examples=60)
@given(
    st.text(st.characters(), max_size=600),
    st.text(st.characters(), max_size=600),
    st.floats(0.0, 1e9),
)
def test_any_text(state: str, reason: str, time: float) -> None:
    back = round_trip(state, reason, time)
    assert back.time == time
    for text, found in ((state, back.state), (reason, back.reason)):
        assert text.encode(errors="replace").decode().startswith(found)


def test_a_ring_holds_its_seconds_and_the_changes_among_them() -> None:
    for seconds, rate in ((10.0, 1000.0), (10.0, 100.0), (0.001, 100.0)):
        ring = live_ring(seconds, rate)
        assert ring.slots >= max(256, seconds * rate)
        LiveWriter(ring).tick(tumbling_at(0.0), Timing(0.0, 0.0, 0.0, 0.0, inf, 0.0, 0.0))
