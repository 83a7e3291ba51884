"""The fixed layout of /tf against the protobuf library and the published foxglove fields."""

import numpy as np
import pytest

from atlas_cueing.recording.schemas import TF_SCHEMA, message_class, transforms_schema
from atlas_cueing.recording.transforms import put_transforms, transform_template
from atlas_cueing.recording.wire import EPOCH_NS, Records, repeat

MESSAGE = message_class(TF_SCHEMA, transforms_schema())


def records_at(times: list[int]) -> Records:
    records = repeat(transform_template(6), len(times))
    q_WS = np.arange(4.0 * len(times)).reshape(-1, 4)
    p_WS_W = 100.0 + np.arange(3.0 * len(times)).reshape(-1, 3)
    put_transforms(records, np.array(times, dtype=np.uint64), q_WS, p_WS_W)
    return records


@pytest.mark.parametrize("nanoseconds", [0, 1, 127, 128, 16_384, 999_999_999])
@pytest.mark.parametrize("seconds", [0, 1, 127, 946_684_800, 2**34])
def test_padded_time_stamps_are_read_as_the_same_numbers(seconds: int, nanoseconds: int) -> None:
    record = records_at([seconds * 10**9 + nanoseconds])[0]
    for transform in MESSAGE.FromString(record.tobytes()[31:]).transforms:
        assert (transform.timestamp.seconds, transform.timestamp.nanos) == (seconds, nanoseconds)
    assert record["log_time"] == record["publish_time"] == seconds * 10**9 + nanoseconds


def test_every_field_is_read_by_protobuf() -> None:
    times = [EPOCH_NS + 999_999_999, EPOCH_NS + 10**9 + 888_888_888]
    for k, record in enumerate(records_at(times)):
        expected = MESSAGE()
        for parent, child in (("base", "stage"), ("stage", "cabin")):
            transform = expected.transforms.add(parent_frame_id=parent, child_frame_id=child)
            transform.timestamp.FromNanoseconds(times[k])
        found = MESSAGE.FromString(record.tobytes()[31:])
        stage, cabin = expected.transforms
        stage.translation.x, stage.translation.y, stage.translation.z = (
            100.0 + 3 * k + i for i in range(3)
        )
        stage.rotation.w = 1.0
        cabin.translation.SetInParent()
        cabin.rotation.w, cabin.rotation.x, cabin.rotation.y, cabin.rotation.z = (
            4.0 * k + i for i in range(4)
        )
        assert found == expected


def test_field_numbers_are_foxgloves() -> None:
    transform = MESSAGE.DESCRIPTOR.fields_by_name["transforms"].message_type
    numbers = {field.name: field.number for field in transform.fields}
    assert transform.full_name == "foxglove.FrameTransform"
    assert numbers == {
        "timestamp": 1,
        "parent_frame_id": 2,
        "child_frame_id": 3,
        "translation": 4,
        "rotation": 5,
    }
    quaternion = transform.fields_by_name["rotation"].message_type
    assert {field.name: field.number for field in quaternion.fields} == {
        "x": 1,
        "y": 2,
        "z": 3,
        "w": 4,
    }
