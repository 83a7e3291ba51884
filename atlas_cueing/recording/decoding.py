"""Decodes message records as numbers and states, in the fixed layout or any that protobuf allows.

Messages of this program are read thousands at a time (`wire`, `transforms`). Other writers leave
zeros out, use other field numbers or narrower types, or add fields: their messages are decoded one
by one with the schema that the log brings, and fields are found by name.
"""

from collections.abc import Callable
from operator import attrgetter
from typing import Any, TypeAlias

import numpy as np
from google.protobuf.message import DecodeError
from google.protobuf.unknown_fields import UnknownFieldSet
from mcap.records import Schema
from numpy.typing import NDArray

from ..errors import LogError
from ..rotations import Array
from ..signals import ALL_TOPICS, StateChange
from .message_starts import windows
from .schemas import STATUS, TF, flat_fields, message_class, number_fields
from .transforms import POSE, pose_of, take_transforms, transform_template
from .wire import HEAD, RECORD_HEAD, Records, Times, flat_dtype, record_content, take

Starts: TypeAlias = NDArray[np.int64]
FIELDS = {topic.name: topic.fields for topic in ALL_TOPICS}
OUR_SCHEMAS = "atlas."  # what the names of our schemas begin with
_HEAD = np.dtype(HEAD)


class NumberDecoder:
    """Decodes messages of numbers.

    fields: their names, in the order of this program's schemas, then in the schema's own.
    """

    def __init__(self, topic: str, schema: Schema, fields: tuple[str, ...]) -> None:
        """Prepare to decode messages of `topic`, whose numbers are `fields` in its schema."""
        known = [name for name in FIELDS.get(topic, ()) if name in fields]
        self.fields = (*known, *(name for name in fields if name not in known))
        self._flat = flat_fields(schema.name, schema.data) == self.fields
        self._message = _Messages(topic, schema)
        self._row = attrgetter(*self.fields)

    def decode(self, data: bytes, starts: Starts) -> tuple[Array, Times]:
        """Return values (n, fields) and log times (n,), ns, of the records of `data` at `starts`.

        Raises LogError where a message is not of its schema.
        """
        records = _records(data, starts, flat_dtype(len(self.fields))) if self._flat else None
        if records is not None:
            values = take(records, len(self.fields))  # after a look at every tag
            if values is not None and np.all(records["length"] == records.itemsize - RECORD_HEAD):
                return values, records["log_time"].copy()
        numbers = [self._row(message) for message in self._message.all(data, starts)]
        return np.array(numbers, dtype=np.float64).reshape(-1, len(self.fields)), log_times_of(
            data, starts
        )


class PoseDecoder:
    """Decodes the poses of stage and cabin in /tf; messages of other frames are passed over."""

    fields = POSE

    def __init__(self, schema: Schema) -> None:
        """Prepare to decode messages of foxglove.FrameTransforms."""
        self._message = _Messages(TF, schema)

    def decode(self, data: bytes, starts: Starts) -> tuple[Array, Times]:
        """Return poses (n, 7) and log times (n,), ns, of the records of `data` at `starts`.

        Raises LogError as `NumberDecoder`, and for other poses.
        """
        records = _records(data, starts, transform_template(0).dtype)
        values = take_transforms(records) if records is not None else None
        if records is not None and values is not None:
            return values, records["log_time"].copy()
        found = [pose_of(message) for message in self._message.all(data, starts)]
        ours = np.array([pose is not None for pose in found], dtype=np.bool_)
        return (
            np.array([pose for pose in found if pose]).reshape(-1, len(POSE)),
            log_times_of(data, starts)[ours],
        )


class StateDecoder:
    """Decodes changes of state."""

    def __init__(self, schema: Schema) -> None:
        """Prepare to decode messages of a time, a state and a reason."""
        self._message = _Messages(STATUS, schema)
        self._message.prepare()  # a description that makes no sense is found before any message

    def decode(self, data: bytes, starts: Starts) -> tuple[list[StateChange], Times]:
        """Return states and log times (n,), ns, of the records of `data` at `starts`.

        Raises LogError as `NumberDecoder`, and for other types.
        """
        found = [_status(message) for message in self._message.all(data, starts)]
        return found, log_times_of(data, starts)


Decoder: TypeAlias = NumberDecoder | PoseDecoder | StateDecoder


def decoder_of(topic: str, encoding: str, schema: Schema | None) -> Decoder | str:
    """Return a decoder for the messages of a channel, or in short why they are not read."""
    if schema is None or encoding != "protobuf" or schema.encoding != "protobuf":
        both = encoding
        if schema is not None and schema.encoding not in ("", encoding):
            both = f"{encoding}, {schema.encoding}"
        return f"encoding {both!r}, allowed: 'protobuf'"
    if topic == TF:
        return (
            PoseDecoder(schema)
            if schema.name.endswith("FrameTransforms")
            else f"schema {schema.name!r}"
        )
    if topic == STATUS:
        return StateDecoder(schema)
    known = set(FIELDS.get(topic, ()))
    if not (known or schema.name.startswith(OUR_SCHEMAS)):
        return f"schema {schema.name!r}"
    fields = number_fields(schema.name, schema.data)
    if not fields or not (schema.name.startswith(OUR_SCHEMAS) or known <= set(fields)):
        return f"schema {schema.name!r}"
    return NumberDecoder(topic, schema, fields)


def log_times_of(data: bytes, starts: Starts) -> Times:
    """Return the log times (n,), ns, of the message records at `starts`."""
    return windows(data, _HEAD)[starts].view(_HEAD)["log_time"].copy()


class _Messages:
    """Decodes messages one by one, by a class that is made when the first one comes."""

    def __init__(self, topic: str, schema: Schema) -> None:
        self._topic, self._schema = topic, schema
        self._parse: Callable[[bytes], Any] | None = None
        self._known: frozenset[int] = frozenset()

    def all(self, data: bytes, starts: Starts) -> list[Any]:
        """Decode every message at `starts`. Raises LogError."""
        return [
            self._decoded(data[slice(*record_content(data, start))]) for start in starts.tolist()
        ]

    def prepare(self) -> Callable[[bytes], Any]:
        """What parses a message."""
        if self._parse is None:
            kind = message_class(self._schema.name, self._schema.data)
            self._parse = kind.FromString
            self._known = frozenset(field.number for field in kind.DESCRIPTOR.fields)
        return self._parse

    def _decoded(self, content: bytes) -> Any:
        parse = self.prepare()
        try:
            message = parse(content)
        except DecodeError as error:
            raise LogError(f"a message of {self._topic} is damaged: {error}") from error
        # a known field of another type is unknown to protobuf, and would pass for a zero
        unknown: Any = UnknownFieldSet(message)  # its types lack the iteration it has
        if any(field.field_number in self._known for field in unknown):
            raise LogError(f"a message of {self._topic} is not of its schema {self._schema.name!r}")
        return message


def _status(message: Any) -> StateChange:
    """Check the types: the log's own description of the message may call anything a time."""
    names = message.DESCRIPTOR.fields_by_name
    if not set(names) >= _STATE:
        raise LogError(f"a message of {STATUS} is not a time, a state and a reason")
    time, state, reason = attrgetter("time_s", "state", "reason")(message)
    if not (isinstance(time, float | int) and isinstance(state, str) and isinstance(reason, str)):
        raise LogError(f"a message of {STATUS} is not a time, a state and a reason")
    return StateChange(float(time), state, reason)


_STATE = {"time_s", "state", "reason"}


def _records(data: bytes, starts: Starts, dtype: np.dtype[np.void]) -> Records | None:
    """Return the records of one layout at `starts`; None when the last one does not fit in."""
    if starts[-1] + dtype.itemsize > len(data):
        return None
    return windows(data, dtype)[starts].view(dtype)
