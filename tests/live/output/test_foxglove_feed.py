"""What Foxglove's server shows of the loop: the newest tick and every state."""

from pathlib import Path

import pytest
from recording.flights import HEAD

from atlas_cueing.live.output.foxglove_server import REPEAT_S, Feed
from atlas_cueing.recording.schemas import message_class, schema_of
from atlas_cueing.signals import ATTITUDE_ROW, LIVE_TOPICS
from atlas_cueing.telemetry import LiveWriter, Ring, live_ring

from ..riding import STARTED_NS, live_recorder, live_tick

TOPICS = [*(topic.name for topic in LIVE_TOPICS), "/tf", "/status"]


@pytest.fixture
def ring() -> Ring:
    return live_ring(2.0, 500.0)


class Corrected:
    """An attitude that is corrected."""

    def row(self) -> tuple[float, ...]:
        return tuple(float(k) for k in range(ATTITUDE_ROW))


def test_it_shows_the_newest_tick_and_every_state(ring: Ring) -> None:
    feed, writer = Feed(ring, HEAD, STARTED_NS), LiveWriter(ring)
    assert feed.new(0.0) == []
    for k in range(5):
        writer.tick(*live_tick(k))
        writer.status(k, "running", str(k))
    shown = feed.new(1.0)
    assert sorted(topic for topic, _, _ in shown) == sorted([*TOPICS[:-1], *["/status"] * 5])
    assert {at for _, at, _ in shown} == {STARTED_NS + 4_250_000_000}
    assert feed.new(1.5) == []


@pytest.mark.parametrize("corrected", [False, True])
def test_the_messages_are_those_of_the_log(ring: Ring, tmp_path: Path, *, corrected: bool) -> None:
    """Byte for byte, read from a log by mcap's own reader."""
    from mcap.reader import make_reader

    feed = Feed(ring, HEAD, STARTED_NS, corrected)
    writer = LiveWriter(ring, Corrected() if corrected else None)
    recorder = live_recorder(tmp_path / "run.mcap", attitude=corrected)
    written = {}
    for k in range(5):
        tick, timing = live_tick(0.1 * k)
        writer.tick(tick, timing)
        recorder.append_live(ring.read(ring.written - 1)[1])  # type: ignore[index]
        writer.status(0.1 * k, "running", "x")
        recorder.status(0.1 * k, "running", "x")
        written |= {(topic, at): content for topic, at, content in feed.new(float(k))}
    recorder.close("ok", "")
    with (tmp_path / "run.mcap").open("rb") as stream:
        messages = make_reader(stream).iter_messages()
        logged = {
            (channel.topic, message.log_time): message.data for _, channel, message in messages
        }
    assert written == logged
    assert len(written) == 5 * (len(TOPICS) + 2 * corrected)


def test_the_state_is_said_again_for_those_who_came_later(ring: Ring) -> None:
    feed, writer = Feed(ring, HEAD, STARTED_NS), LiveWriter(ring)
    writer.status(0.0, "parked", "")
    writer.status(0.0, "running", "")
    assert len(feed.new(10.0)) == 2
    assert feed.new(10.0 + 0.99 * REPEAT_S) == []
    (again,) = feed.new(10.0 + REPEAT_S)
    state = message_class(*schema_of("/status")).FromString(again[2])
    assert state.state == "running"
    assert feed.new(10.1 + REPEAT_S) == []


def test_of_a_backlog_only_the_newest_half_is_looked_at(ring: Ring) -> None:
    """A server that was held up has no use for what is old.

    And the writer is about to overwrite it.
    """
    feed, writer = Feed(ring, HEAD, STARTED_NS), LiveWriter(ring)
    for k in range(ring.slots - 2):
        writer.status(k, "running", str(k))
    assert len(feed.new(0.0)) == ring.slots // 2


def test_the_end_is_seen(ring: Ring) -> None:
    feed, writer = Feed(ring, HEAD, STARTED_NS), LiveWriter(ring)
    feed.new(0.0)
    assert not feed.over
    writer.end(1.0, "ok", "")
    feed.new(1.0)
    assert feed.over
