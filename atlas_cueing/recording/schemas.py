"""Protobuf schemas of the log, built at run time from the table in `signals.topics`.

A schema record of an MCAP file holds a serialised FileDescriptorSet with the message type and
everything it imports (https://mcap.dev/spec/registry#protobuf), so that any reader can decode the
messages without the sources of this program.
"""

from typing import Any

from google.protobuf import descriptor_pool, message_factory, timestamp_pb2
from google.protobuf.descriptor_pb2 import (
    FieldDescriptorProto,
    FileDescriptorProto,
    FileDescriptorSet,
)

from ..errors import LogError
from ..signals import ALL_TOPICS, Topic

STATUS = "/status"
TF = "/tf"
STATUS_SCHEMA = "atlas.Status"
TF_SCHEMA = "foxglove.FrameTransforms"
MAX_FILES = 200  # that a schema may import; they are added one inside the other
_STAMP = "google/protobuf/timestamp.proto"


def flat_schema(topic: Topic) -> bytes:
    """Return the FileDescriptorSet of a message of doubles; field i has number i + 1."""
    return _bundle(_file(topic.schema, [(name, "double") for name in topic.fields]))


def status_schema() -> bytes:
    """Return the FileDescriptorSet of atlas.Status: time_s (double), state, reason (strings)."""
    return _bundle(
        _file(STATUS_SCHEMA, [("time_s", "double"), ("state", "string"), ("reason", "string")])
    )


def transforms_schema() -> bytes:
    """Return the FileDescriptorSet of foxglove.FrameTransforms.

    https://docs.foxglove.dev/docs/sdk/schemas/frame-transforms
    """
    stamp = FileDescriptorProto.FromString(timestamp_pb2.DESCRIPTOR.serialized_pb)
    vector = _file("foxglove.Vector3", [(c, "double") for c in "xyz"])
    quaternion = _file("foxglove.Quaternion", [(c, "double") for c in "xyzw"])
    fields = [
        ("timestamp", ".google.protobuf.Timestamp"),
        ("parent_frame_id", "string"),
        ("child_frame_id", "string"),
        ("translation", ".foxglove.Vector3"),
        ("rotation", ".foxglove.Quaternion"),
    ]
    transform = _file("foxglove.FrameTransform", fields, [_STAMP, vector.name, quaternion.name])
    transforms = _file(TF_SCHEMA, [("transforms", ".foxglove.FrameTransform")], [transform.name])
    transforms.message_type[0].field[0].label = FieldDescriptorProto.LABEL_REPEATED
    return _bundle(stamp, vector, quaternion, transform, transforms)


def schema_of(topic: str) -> tuple[str, bytes]:
    """Return name and FileDescriptorSet of any topic of the log.

    Raises KeyError for an unknown topic.
    """
    if topic == STATUS:
        return STATUS_SCHEMA, status_schema()
    if topic == TF:
        return TF_SCHEMA, transforms_schema()
    table = {t.name: t for t in ALL_TOPICS}
    return table[topic].schema, flat_schema(table[topic])


def message_class(name: str, schema: bytes) -> Any:
    """Return the message type `name` of a serialised FileDescriptorSet.

    Its type is Any, because its fields are known at run time only.

    Raises LogError when the schema has more than MAX_FILES files.
    """
    pool = descriptor_pool.DescriptorPool()
    files = {file.name: file for file in FileDescriptorSet.FromString(schema).file}
    if len(files) > MAX_FILES:
        raise LogError(f"the schema {name!r} has {len(files)} files, allowed: at most {MAX_FILES}")
    while files:
        _add_file(pool, next(iter(files)), files)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(name))


def _add_file(
    pool: descriptor_pool.DescriptorPool, name: str, files: dict[str, FileDescriptorProto]
) -> None:
    """Move a file into the pool, after those it imports, which other writers may put behind it."""
    file = files.pop(name)
    for imported in file.dependency:
        if imported in files:
            _add_file(pool, imported, files)
    pool.Add(file)


def flat_fields(name: str, schema: bytes) -> tuple[str, ...] | None:
    """Return the field names of the message `name` if it has the layout of `wire`, else None.

    The layout is doubles only, with numbers from 1 on.
    """
    fields = _fields_of(name, schema)
    flat = all(f.number == i and _is_double(f) for i, f in enumerate(fields, 1))
    return tuple(f.name for f in fields) if flat and fields else None


def number_fields(name: str, schema: bytes) -> tuple[str, ...]:
    """Return the fields of the message `name` that hold one number each, of any type."""
    return tuple(field.name for field in _fields_of(name, schema) if _is_number(field))


def _fields_of(name: str, schema: bytes) -> list[FieldDescriptorProto]:
    for file in FileDescriptorSet.FromString(schema).file:
        for message in file.message_type:
            if f"{file.package}.{message.name}".lstrip(".") == name:
                return list(message.field)
    return []


def _is_double(field: FieldDescriptorProto) -> bool:
    return (
        field.type == FieldDescriptorProto.TYPE_DOUBLE
        and field.label == FieldDescriptorProto.LABEL_OPTIONAL
    )


_NO_NUMBERS = (
    FieldDescriptorProto.TYPE_STRING,
    FieldDescriptorProto.TYPE_BYTES,
    FieldDescriptorProto.TYPE_MESSAGE,
    FieldDescriptorProto.TYPE_GROUP,
)


def _is_number(field: FieldDescriptorProto) -> bool:
    return field.type not in _NO_NUMBERS and field.label != FieldDescriptorProto.LABEL_REPEATED


def _file(
    name: str, fields: list[tuple[str, str]], imports: list[str] | None = None
) -> FileDescriptorProto:
    """Describe a .proto file with one message; a type that starts with a dot is a message."""
    package, _, short = name.rpartition(".")
    file = FileDescriptorProto(
        name=name.replace(".", "/") + ".proto", package=package, syntax="proto3", dependency=imports
    )
    message = file.message_type.add(name=short)
    for number, (field, kind) in enumerate(fields, 1):
        added = message.field.add(
            name=field, number=number, label=FieldDescriptorProto.LABEL_OPTIONAL
        )
        if kind.startswith("."):
            added.type, added.type_name = FieldDescriptorProto.TYPE_MESSAGE, kind
        else:
            added.type = (
                FieldDescriptorProto.TYPE_DOUBLE
                if kind == "double"
                else FieldDescriptorProto.TYPE_STRING
            )
    return file


def _bundle(*files: FileDescriptorProto) -> bytes:
    return FileDescriptorSet(file=files).SerializeToString(deterministic=True)
