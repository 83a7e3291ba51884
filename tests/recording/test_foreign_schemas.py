"""Messages of other writers are read by the schema that their log brings.

What cannot be read is named.
"""

import io
from pathlib import Path

import pytest
from google.protobuf.descriptor_pb2 import (
    FieldDescriptorProto,
    FileDescriptorProto,
    FileDescriptorSet,
)
from mcap.writer import Writer

from atlas_cueing.errors import LogError
from atlas_cueing.recording import read_log
from atlas_cueing.recording.schemas import MAX_FILES, message_class, schema_of
from atlas_cueing.signals import TOPICS

KINDS = FieldDescriptorProto
FELT = TOPICS[-1].fields


def written(
    path: Path, *channels: tuple[str, str, str, str, bytes, list[bytes]], metadata: bool = True
) -> Path:
    """Write a file with messages of each channel.

    A channel has a topic, an encoding, its schema's name, encoding and data, and contents.
    """
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        for topic, encoding, name, kind, data, contents in channels:
            channel = writer.register_channel(
                topic, encoding, writer.register_schema(name, kind, data)
            )
            for k, content in enumerate(contents):
                writer.add_message(channel, k, content, k)
        if metadata:
            writer.add_metadata("atlas.run", {"result": "ok"})
        writer.finish()
    return path


def described(name: str, fields: list[tuple[str, int, int]]) -> bytes:
    """A schema of fields with number and type."""
    file = FileDescriptorProto(name="any.proto", package=name.rpartition(".")[0], syntax="proto3")
    message = file.message_type.add(name=name.rpartition(".")[2])
    for field, number, kind in fields:
        message.field.add(name=field, number=number, type=kind, label=KINDS.LABEL_OPTIONAL)  # type: ignore[arg-type]
    return FileDescriptorSet(file=[file]).SerializeToString()


@pytest.mark.parametrize("name", ["atlas.Felt", "Felt", "other.robot.Felt"])
def test_fields_go_by_their_names(tmp_path: Path, name: str) -> None:
    """Fields in reverse order, with other numbers, narrower types, and unknown fields between."""
    types = [KINDS.TYPE_FLOAT, KINDS.TYPE_INT32, KINDS.TYPE_DOUBLE, KINDS.TYPE_BOOL]
    fields = [(field, 40 - 3 * k, types[k % 4]) for k, field in enumerate(FELT)]
    schema = described(
        name,
        [("remark", 1, KINDS.TYPE_STRING), *reversed(fields), ("humidity", 77, KINDS.TYPE_DOUBLE)],
    )
    message = message_class(name, schema)(
        remark="windy", humidity=0.5, **{field: k % 2 for k, field in enumerate(FELT)}
    )
    path = written(
        tmp_path / "x.mcap",
        ("/felt", "protobuf", name, "protobuf", schema, [message.SerializeToString()] * 2),
    )
    table = read_log(path).tables["/felt"]
    assert table.fields == (*FELT, "humidity")
    assert table.values.tolist() == [[0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.5]] * 2
    assert read_log(path).vector("/felt", "f").tolist() == [[1.0, 0.0, 1.0]] * 2


def test_a_field_that_is_missing_is_named_when_it_is_needed(tmp_path: Path) -> None:
    schema = described(
        "atlas.Felt",
        [(field, k + 1, KINDS.TYPE_DOUBLE) for k, field in enumerate(FELT) if field != "fy_m_s2"],
    )
    log = read_log(
        written(tmp_path / "x.mcap", ("/felt", "protobuf", "atlas.Felt", "protobuf", schema, [b""]))
    )
    assert log.column("/felt", "time_s").tolist() == [0.0]
    with pytest.raises(
        LogError, match="/felt has no field 'fy_m_s2'; fields: time_s, fx_m_s2, fz_m_s2"
    ):
        log.column("/felt", "fy_m_s2")
    with pytest.raises(LogError, match="/felt has no vector 'f'"):
        log.vector("/felt", "f")


def test_fields_that_only_one_channel_has_are_left_out_with_a_word(tmp_path: Path) -> None:
    name, flat = schema_of("/felt")
    more = described(
        name,
        [
            *((field, k + 1, KINDS.TYPE_DOUBLE) for k, field in enumerate(FELT)),
            ("x", 30, KINDS.TYPE_DOUBLE),
        ],
    )
    own, other = (
        ("/felt", "protobuf", name, "protobuf", schema, [b"", b""]) for schema in (flat, more)
    )
    log = read_log(written(tmp_path / "x.mcap", own, other))
    assert (log.tables["/felt"].fields, log.tables["/felt"].values.shape) == (FELT, (4, 8))
    assert log.tables["/felt"].log_times.tolist() == [0, 0, 1, 1]
    assert log.notes == ("/felt: only some of its channels have x, which is left out",)


def test_our_channels_without_a_message_that_can_be_read(tmp_path: Path) -> None:
    path = written(
        tmp_path / "x.mcap", ("/motion", "json", "atlas.Motion", "jsonschema", b"{}", [b"{}"] * 3)
    )
    with pytest.raises(
        LogError, match="/motion: none of its 3 messages can be read: encoding 'json, jsonschema'"
    ):
        read_log(path)


def test_a_log_without_our_metadata(tmp_path: Path) -> None:
    """It is ours by its topics; a file of nobody's topics is not."""
    felt = ("protobuf", *schema_of("/felt"))
    channel = ("/felt", felt[0], felt[1], "protobuf", felt[2], [b""])
    assert read_log(written(tmp_path / "x.mcap", channel, metadata=False)).metadata == {}
    with pytest.raises(LogError, match="this is no log of atlas_cueing"):
        read_log(
            written(
                tmp_path / "x.mcap",
                ("/pose", "json", "pose", "jsonschema", b"{}", [b"{}"]),
                metadata=False,
            )
        )


def test_a_schema_of_too_many_files_is_refused(tmp_path: Path) -> None:
    names = [f"{k}.proto" for k in range(2000)]
    chain = [
        FileDescriptorProto(name=name, dependency=names[k + 1 : k + 2])
        for k, name in enumerate(names)
    ]
    bundle = FileDescriptorSet(file=chain).SerializeToString()
    with pytest.raises(LogError, match=f"has 2000 files, allowed: at most {MAX_FILES}"):
        read_log(
            written(
                tmp_path / "x.mcap",
                ("/status", "protobuf", "atlas.Status", "protobuf", bundle, [b""]),
            )
        )


def test_an_empty_file_of_another_writer(tmp_path: Path) -> None:
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start()
    writer.finish()
    (tmp_path / "x.mcap").write_bytes(stream.getvalue())
    with pytest.raises(LogError, match="no log of atlas_cueing"):
        read_log(tmp_path / "x.mcap")
