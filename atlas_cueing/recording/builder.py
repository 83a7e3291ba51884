"""Builds a log in memory from descriptions, files and messages, in the order of an MCAP file."""

from collections.abc import Callable, Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import TypeVar

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, Schema
from numpy.typing import NDArray

from ..errors import LogError
from ..signals import StateChange
from .container import LIBRARY
from .decoding import FIELDS, Decoder, NumberDecoder, PoseDecoder, StateDecoder, decoder_of
from .log import Growing, Log, TopicColumns
from .merging import States, common_fields, merged, merged_states
from .message_starts import Starts, message_starts
from .recorder import RUN_METADATA
from .schemas import STATUS, TF
from .wire import Times

T = TypeVar("T")
OURS = (*FIELDS, STATUS)  # topics that only a log of this program has


class LogBuilder:
    """The content of a log up to the present record, by any writer; columns are by topic.

    library: that wrote the log, by its header.
    data_checked: whether a checksum of the whole data section was right.
    """

    def __init__(self, path: Path, max_bytes: int) -> None:
        """Start with nothing of the log at `path`; `max_bytes` bounds what is kept."""
        self.library = ""
        self.data_checked = False
        self._path, self._left = path, max_bytes
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}
        self._decoders: dict[int, Decoder | str] = {}
        self._tables: dict[int, Growing] = {}
        self._states: dict[int, States] = {}
        self._counts: dict[int, int] = {}
        self._unchecked = False
        self._metadata: dict[str, dict[str, str]] = {}
        self._attachments: dict[str, bytes] = {}

    def charge(self, size: int) -> None:
        """Count bytes that are kept in memory. Raises LogError when there are too many."""
        self._left -= size
        if self._left < 0:
            raise LogError("the content of the log is larger than allowed")

    def add_schema(self, schema: Schema) -> None:
        """Keep a schema. Raises LogError when the log has another one of the same number."""
        if self._schemas.setdefault(schema.id, schema) != schema:
            raise LogError(f"schema {schema.id} is described twice, and not as the same")

    def add_channel(self, channel: Channel) -> None:
        """Keep a channel. Raises LogError when the log has another one of the same number."""
        if channel.id in self._channels:
            if _description(channel) != _description(self._channels[channel.id]):
                raise LogError(f"channel {channel.id} is described twice, and not as the same")
            return
        self._channels[channel.id] = channel
        schema = self._schemas.get(channel.schema_id)
        decoder = decoder_of(channel.topic, channel.message_encoding, schema)
        self._decoders[channel.id] = decoder
        if isinstance(decoder, StateDecoder):
            self._states[channel.id] = ([], [])
        elif isinstance(decoder, NumberDecoder | PoseDecoder):
            self._tables[channel.id] = Growing(decoder.fields)

    def add_attachment(self, name: str, data: bytes) -> None:
        """Keep a file."""
        self._attachments[name] = data

    def add_metadata(self, name: str, pairs: Mapping[str, str]) -> None:
        """Keep a record of metadata."""
        self._metadata[name] = dict(pairs)

    def add_messages(
        self, data: bytes, index: Starts, *, checked: bool = False, all_or_none: bool = False
    ) -> None:
        """Read the records of a chunk, or of a stretch of messages outside of chunks.

        Args:
            data: the records.
            index: offsets of the messages by channel, as the log has them; may be empty or wrong.
            checked: whether a checksum of their own was right.
            all_or_none: whether nothing is kept where a message cannot be read; otherwise what came
                before it may be.

        Raises LogError where a message cannot be read.
        """
        found = {
            channel: starts
            for channel, starts in message_starts(data, index, self._describe).items()
            if len(starts)
        }
        decoded = (self._decoded(channel, data, starts) for channel, starts in found.items())
        for keep in list(decoded) if all_or_none else decoded:
            keep()
        for channel, starts in found.items():
            self._counts[channel] = self._counts.get(channel, 0) + len(starts)
        self._unchecked = self._unchecked or not checked

    def check_counts(self, expected: Mapping[int, int]) -> None:
        """Compare with the log's own statistics. Raises LogError when messages are missing."""
        for channel, count in expected.items():
            found = self._counts.get(channel, 0)
            if found < count and channel in self._channels:
                topic = self._channels[channel].topic
                raise LogError(
                    f"its statistics have {count} messages of {topic} (channel {channel}); it holds"
                    f" {found}"
                )

    def log(self) -> Log:
        """Return the whole log.

        Raises LogError when nothing of it is of this program, or none of its messages can be read.
        """
        notes = [*self._unread(), *_left_out(self._by_topic(self._tables))]
        if self._unchecked and not self.data_checked:
            notes.append(
                "the messages have no checksum, so that damage to their numbers cannot be found"
            )
        if RUN_METADATA not in self._metadata and not self._is_ours():
            raise LogError(
                f"this is no log of atlas_cueing: it has no metadata record {RUN_METADATA!r}"
            )
        tables = {
            topic: self._table(of_topic) for topic, of_topic in self._by_topic(self._tables).items()
        }
        poses = tables.pop(TF, None)
        metadata = self._metadata.get(RUN_METADATA, {})
        states = merged_states(list(self._states.values()))
        return Log(self._path, tables, metadata, self._attachments, states, poses, tuple(notes))

    def _is_ours(self) -> bool:
        read = {self._channels[channel].topic for channel in self._tables}
        return any(topic in FIELDS for topic in read)

    def _describe(self, opcode: int, body: bytes) -> None:
        """Keep the description in a record of a chunk that is no message."""
        if opcode == Opcode.SCHEMA:
            self.add_schema(Schema.read(ReadDataStream(BytesIO(body))))
        elif opcode == Opcode.CHANNEL:
            self.add_channel(Channel.read(ReadDataStream(BytesIO(body))))

    def _decoded(self, channel: int, data: bytes, starts: NDArray[np.int64]) -> Callable[[], None]:
        """Decode messages of one channel; return a function that keeps them."""
        decoder = self._decoders.get(channel)
        match decoder:
            case None:
                raise LogError(
                    f"there are messages of channel {channel}, which the log does not describe"
                )
            case StateDecoder():
                states, when = decoder.decode(data, starts)
                return lambda: self._keep_states(channel, states, when)
            case NumberDecoder() | PoseDecoder():
                values, times = decoder.decode(data, starts)
                return lambda: self._tables[channel].add(values, times)
        return lambda: None

    def _keep_states(self, channel: int, states: list[StateChange], times: Times) -> None:
        kept, when = self._states[channel]
        kept += states
        when += times.tolist()

    def _table(self, channels: Sequence[Growing]) -> TopicColumns:
        """Return the columns of one topic.

        The recorder of this program writes ticks in order; if they are not, review has to see it.
        """
        plain = len(channels) == 1 and self.library == LIBRARY
        return channels[0].table() if plain else merged(channels)

    def _by_topic(self, of_channels: Mapping[int, T]) -> dict[str, list[T]]:
        by_topic: dict[str, list[T]] = {}
        for channel, of_channel in of_channels.items():
            by_topic.setdefault(self._channels[channel].topic, []).append(of_channel)
        return by_topic

    def _unread(self) -> list[str]:
        """Return a line for each channel with messages that are not read.

        Raises LogError when a topic of this program has no others.
        """
        read = {self._channels[channel].topic for channel in (*self._tables, *self._states)}
        lines = []
        for number, why in self._decoders.items():
            topic, count = self._channels[number].topic, self._counts.get(number, 0)
            if isinstance(why, str) and count:
                if topic in OURS and topic not in read:
                    raise LogError(f"{topic}: none of its {count} messages can be read: {why}")
                lines.append(f"{topic}: {count} message{'s' * (count > 1)} not read: {why}")
        return lines


def _description(channel: Channel) -> tuple[str, str, int]:
    return channel.topic, channel.message_encoding, channel.schema_id


def _left_out(by_topic: Mapping[str, Sequence[Growing]]) -> list[str]:
    """Return a line for each topic with fields that only some of its channels have."""
    lines = []
    for topic, channels in by_topic.items():
        common = common_fields(channels)
        rest = dict.fromkeys(
            name for each in channels for name in each.fields if name not in common
        )
        if rest:
            lines.append(
                f"{topic}: only some of its channels have {', '.join(rest)}, which is left out"
            )
    return lines
