"""The schemas, as text and through protobuf."""

import pytest
from google.protobuf.descriptor_pb2 import FieldDescriptorProto, FileDescriptorSet

from atlas_cueing.recording.schemas import (
    STATUS,
    TF,
    flat_fields,
    flat_schema,
    message_class,
    schema_of,
    status_schema,
    transforms_schema,
)
from atlas_cueing.signals import TOPICS, Topic

WHEELS = """\
name: "atlas/Wheels.proto"
package: "atlas"
message_type {
  name: "Wheels"
"""


def test_schema_of_the_wheels_as_text() -> None:
    (file,) = FileDescriptorSet.FromString(schema_of("/wheels")[1]).file
    names = ("time_s", "w1_rad_s", "w2_rad_s", "w3_rad_s", "a1_rad_s2", "a2_rad_s2", "a3_rad_s2")
    fields = "".join(
        f'  field {{\n    name: "{name}"\n    number: {number}\n    label: LABEL_OPTIONAL\n   '
        " type: TYPE_DOUBLE\n  }\n"
        for number, name in enumerate(names, 1)
    )
    assert str(file) == f'{WHEELS}{fields}}}\nsyntax: "proto3"\n'


@pytest.mark.parametrize("topic", TOPICS, ids=lambda topic: topic.name)
def test_fields_of_a_flat_schema(topic: Topic) -> None:
    assert schema_of(topic.name) == (topic.schema, flat_schema(topic))
    assert flat_fields(topic.schema, flat_schema(topic)) == topic.fields


def test_status_has_strings_and_round_trips() -> None:
    name, schema = schema_of(STATUS)
    kinds = {
        f.name: f.type for f in FileDescriptorSet.FromString(schema).file[0].message_type[0].field
    }
    assert kinds == {
        "time_s": FieldDescriptorProto.TYPE_DOUBLE,
        "state": FieldDescriptorProto.TYPE_STRING,
        "reason": FieldDescriptorProto.TYPE_STRING,
    }
    status = message_class(name, schema)
    assert (
        status.FromString(status(time_s=1.5, state="a", reason="ü").SerializeToString()).reason
        == "ü"
    )


def test_messages_that_are_not_flat_doubles_are_told_apart() -> None:
    assert flat_fields("atlas.Status", status_schema()) is None
    assert flat_fields("foxglove.FrameTransforms", transforms_schema()) is None
    assert flat_fields("atlas.Other", flat_schema(TOPICS[0])) is None


@pytest.mark.parametrize(
    "change", [{"number": 9}, {"type": FieldDescriptorProto.TYPE_FLOAT}, {"label": 3}]
)
def test_a_field_out_of_the_ordinary_is_not_flat(change: dict[str, int]) -> None:
    files = FileDescriptorSet.FromString(flat_schema(TOPICS[3]))
    field = files.file[0].message_type[0].field[2]
    for name, value in change.items():
        setattr(field, name, value)
    assert flat_fields("atlas.Wheels", files.SerializeToString()) is None


def test_imports_come_before_what_imports_them() -> None:
    seen: set[str] = set()
    for file in FileDescriptorSet.FromString(schema_of(TF)[1]).file:
        assert set(file.dependency) <= seen
        seen.add(file.name)
    assert "google/protobuf/timestamp.proto" in seen


def test_an_unknown_topic_is_a_key_error() -> None:
    with pytest.raises(KeyError):
        schema_of("/nothing")
