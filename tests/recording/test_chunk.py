"""/felt in the log, derived again from the logged motion with scipy's rotations."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.spatial.transform import Rotation

from atlas_cueing.recording.chunk import ROW, ChunkEncoder, Extra, with_felt
from atlas_cueing.recording.wire import log_times
from atlas_cueing.signals import TOPICS, Tick, tick_row

from .flights import HEAD, any_ticks, record, tumble
from .test_recorder import decoded, quaternion, vector

FLU_FROM_FRD = np.diag([1.0, -1.0, -1.0])


@settings(max_examples=40, deadline=None)
@given(any_ticks(most=6))
def test_felt_is_what_the_motion_makes_a_head_feel(
    tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick]
) -> None:
    path = record(tmp_path_factory.getbasetemp() / "felt.mcap", ticks)
    messages = list(decoded(path))
    vehicles, motions, felts = (
        [message for topic, _, message in messages if topic == name]
        for name in ("/vehicle", "/motion", "/felt")
    )
    assert len(felts) == len(ticks)
    for vehicle, motion, felt in zip(vehicles, motions, felts, strict=True):
        cabin = Rotation.from_quat(quaternion(motion, "q_ws"), scalar_first=True)
        w, alpha = (
            np.array(vector(motion, "w", "rad_s")),
            np.array(vector(motion, "alpha", "rad_s2")),
        )
        r = cabin.apply(HEAD)
        acceleration = (
            np.array(vector(motion, "a", "m_s2")) + np.cross(alpha, r) + np.cross(w, np.cross(w, r))
        )
        force = FLU_FROM_FRD @ cabin.inv().apply(acceleration + np.array([0.0, 0.0, 9.80665]))
        scale = 1.0 + np.linalg.norm(w) ** 2 + np.linalg.norm(alpha) + np.linalg.norm(acceleration)
        logged = np.array(vector(felt, "f", "m_s2"))
        assert felt.time_s == motion.time_s
        np.testing.assert_allclose(logged, force, atol=1e-13 * scale)
        np.testing.assert_allclose(
            vector(felt, "w", "rad_s"), FLU_FROM_FRD @ cabin.inv().apply(w), atol=1e-13 * scale
        )
        pilot = np.array(vector(vehicle, "f", "m_s2"))
        size = np.linalg.norm(pilot) * np.linalg.norm(logged)
        if size > 1e-150:  # squares of less are rounded to zero
            assert np.cos(felt.direction_error_rad) == pytest.approx(
                pilot @ logged / size, abs=1e-9
            )


def test_extra_messages_stand_where_they_belong() -> None:
    ticks = with_felt(np.array([tick_row(tick) for tick in tumble(3, 10.0)]), HEAD)
    encoder = ChunkEncoder({"/wheels": 4})
    tick_size = len(encoder.encode(ticks, log_times(ticks[:, 0]), []).data) // 3
    chunk = encoder.encode(
        ticks, log_times(ticks[:, 0]), [Extra(2, 9, 7, b"second"), Extra(0, 9, 5, b"first")]
    )
    assert chunk.data[:5] == b"first"
    assert chunk.data[5 + 2 * tick_size : 11 + 2 * tick_size] == b"second"
    assert chunk.index[4][:, 1].tolist() == [5, 5 + tick_size, 11 + 2 * tick_size]
    assert chunk.index[9].tolist() == [[5, 0], [7, 5 + 2 * tick_size]]


def test_the_row_is_the_first_four_topics() -> None:
    assert sum(len(topic.fields) for topic in TOPICS[:4]) == ROW
    assert len(tick_row(tumble(1, 1.0)[0])) == ROW
    assert TOPICS[4].name == "/felt"


def test_a_transform_is_not_repeated_in_the_next_chunk(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(34, 1000.0), chunk_ticks=1)
    times = [log_time for topic, log_time, _ in decoded(path) if topic == "/tf"]
    assert [(t - times[0]) // 10**6 for t in times] == [0, 17]
