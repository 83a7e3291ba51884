"""Logs written again by another program, in every layout that MCAP allows.

Our own writer takes no part here.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mcap.reader import make_reader
from mcap.records import Channel, Message, Schema
from mcap.writer import CompressionType, IndexType, Writer
from mcap_protobuf.decoder import DecoderFactory

Item = tuple[Schema, Channel, Message]
Change = Callable[[Iterable[Item]], Iterator[Item]]


def as_they_are(items: Iterable[Item]) -> Iterator[Item]:
    yield from items


def without_zeros(items: Iterable[Item]) -> Iterator[Item]:
    """As every protobuf library writes messages of proto3."""
    factory = DecoderFactory()
    for schema, channel, message in items:
        decoder = factory.decoder_for("protobuf", schema)
        assert decoder is not None
        yield schema, channel, replace(message, data=decoder(message.data).SerializeToString())


def on_two_channels(items: Iterable[Item]) -> Iterator[Item]:
    """As two logs merged: what comes later lies on other channels of the same topics."""
    kept = list(items)
    for k, (schema, channel, message) in enumerate(kept):
        other = channel.id + 100 * (k > len(kept) // 2)
        yield schema, replace(channel, id=other), replace(message, channel_id=other)


def by_turns(items: Iterable[Item]) -> Iterator[Item]:
    """Each topic on two channels by turns."""
    counts: dict[int, int] = {}
    for schema, channel, message in items:
        counts[channel.id] = counts.get(channel.id, 0) + 1
        other = channel.id + 100 * (counts[channel.id] % 2)
        yield schema, replace(channel, id=other), replace(message, channel_id=other)


def topic_by_topic(items: Iterable[Item]) -> Iterator[Item]:
    """All messages of a channel, then all of the next: chunks that overlap in time."""
    yield from sorted(items, key=lambda item: item[1].id)


def second_half_first(items: Iterable[Item]) -> Iterator[Item]:
    kept = list(items)
    yield from kept[len(kept) // 2 :]
    yield from kept[: len(kept) // 2]


def beside_others(items: Iterable[Item]) -> Iterator[Item]:
    """Write messages of another program: JSON, no schema at all, protobuf of another kind."""
    json = Schema(id=90, name="note", encoding="jsonschema", data=b"{}")
    nothing = Schema(id=0, name="", encoding="", data=b"")
    other = Schema(id=91, name="other.Kind", encoding="protobuf", data=b"\xff no descriptors \xff")
    strangers = [
        (json, Channel(id=90, topic="/notes", message_encoding="json", metadata={}, schema_id=90)),
        (nothing, Channel(id=91, topic="/bytes", message_encoding="", metadata={}, schema_id=0)),
        (
            other,
            Channel(id=92, topic="/tf", message_encoding="protobuf", metadata={}, schema_id=91),
        ),
    ]
    for k, (schema, channel, message) in enumerate(items):
        yield schema, channel, message
        if k in (0, 7):
            for theirs, stranger in strangers:
                yield theirs, stranger, replace(message, channel_id=stranger.id, data=b"{}")


@dataclass(frozen=True)
class Layout:
    """Options of mcap's writer, and what is done to the messages."""

    options: dict[str, Any] = field(default_factory=dict)
    change: Change = as_they_are


ALL_CRCS = {"enable_crcs": True, "enable_data_crcs": True}
NO_CRCS = {"enable_crcs": False, "enable_data_crcs": False}
NO_SUMMARY = {
    "index_types": IndexType.NONE,
    "repeat_channels": False,
    "repeat_schemas": False,
    "use_statistics": False,
    "use_summary_offsets": False,
}
LAYOUTS = {
    "mcap's own": Layout(),
    "all checksums": Layout(ALL_CRCS),
    "no checksums": Layout(NO_CRCS),
    "lz4": Layout({"compression": CompressionType.LZ4}),
    "uncompressed": Layout({"compression": CompressionType.NONE}),
    "small chunks": Layout({"chunk_size": 5000}),
    "no chunks": Layout({"use_chunking": False, **ALL_CRCS}),
    "no chunks, no checksums": Layout({"use_chunking": False, **NO_CRCS}),
    "no summary": Layout(NO_SUMMARY),
    "zeros left out": Layout({}, without_zeros),
    "two channels": Layout({}, on_two_channels),
    "two channels by turns": Layout({"chunk_size": 5000}, by_turns),
    "topic by topic": Layout({"chunk_size": 5000}, topic_by_topic),
    "second half first": Layout({}, second_half_first),
    "beside others": Layout({}, beside_others),
}


def rewritten(source: Path, target: Path, layout: Layout) -> Path:
    """Copy every message, file and metadata record of `source` to `target` with `mcap`."""
    with source.open("rb") as stream, target.open("wb") as output:
        reader = make_reader(stream)
        writer = Writer(output, **layout.options)
        writer.start(profile="", library="another tool")
        for attachment in reader.iter_attachments():
            writer.add_attachment(
                0, attachment.log_time, attachment.name, attachment.media_type, attachment.data
            )
        _copy_messages(writer, layout.change(_items(reader)))
        for metadata in reader.iter_metadata():
            writer.add_metadata(metadata.name, metadata.metadata)
        writer.finish()
    assert target.read_bytes() != source.read_bytes()
    return target


def _items(reader: Any) -> Iterator[Item]:
    yield from reader.iter_messages(log_time_order=False)


def _copy_messages(writer: Writer, items: Iterable[Item]) -> None:
    """Ids are the writer's own; schemas and channels are told when their first message comes."""
    schemas: dict[int, int] = {0: 0}
    channels: dict[int, int] = {}
    for schema, channel, message in items:
        if schema and schema.id not in schemas:
            schemas[schema.id] = writer.register_schema(schema.name, schema.encoding, schema.data)
        if channel.id not in channels:
            number = schemas[channel.schema_id]
            channels[channel.id] = writer.register_channel(
                channel.topic, channel.message_encoding, number
            )
        to = channels[channel.id]
        writer.add_message(
            to, message.log_time, message.data, message.publish_time, message.sequence
        )
