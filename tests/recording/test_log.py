"""Access to the columns of a log."""

from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import LogError
from atlas_cueing.recording import Log, read_log
from atlas_cueing.recording.log import Growing

from .flights import record, tumble

TICKS = tumble(12, 100.0)


@pytest.fixture
def log(tmp_path: Path) -> Log:
    return read_log(record(tmp_path / "x.mcap", TICKS))


@pytest.mark.parametrize(
    ("topic", "name", "values"),
    [
        ("/vehicle", "q_nb", [t.vehicle.q_NB for t in TICKS]),
        ("/vehicle", "w", [t.vehicle.w_NB_B for t in TICKS]),
        ("/vehicle", "f", [t.vehicle.f_B for t in TICKS]),
        ("/cue", "q_ws", [t.cue.q_WS for t in TICKS]),
        ("/cue", "a", [t.cue.a_WS_W for t in TICKS]),
        ("/motion", "w", [t.motion.w_WS_W for t in TICKS]),
        ("/motion", "alpha", [t.motion.alpha_WS_W for t in TICKS]),
        ("/motion", "p", [t.motion.p_WS_W for t in TICKS]),
        ("/motion", "v", [t.motion.v_WS_W for t in TICKS]),
        ("/motion", "a", [t.motion.a_WS_W for t in TICKS]),
        ("/wheels", "w", [t.wheels.speed for t in TICKS]),
        ("/wheels", "a", [t.wheels.acceleration for t in TICKS]),
    ],
)
def test_vectors(log: Log, topic: str, name: str, values: list[tuple[float, ...]]) -> None:
    np.testing.assert_array_equal(log.vector(topic, name), values)


def test_columns(log: Log) -> None:
    np.testing.assert_array_equal(
        log.column("/motion", "wheels_limited"), [t.motion.limited[0] for t in TICKS]
    )
    np.testing.assert_array_equal(
        log.column("/vehicle", "fy_m_s2"), [t.vehicle.f_B[1] for t in TICKS]
    )


def test_names_that_do_not_exist_are_refused_with_those_that_do(log: Log) -> None:
    with pytest.raises(LogError, match=r"no topic '/wheel'; topics: /vehicle, .*/wheels"):
        log.column("/wheel", "w1_rad_s")
    with pytest.raises(LogError, match=r"/wheels has no field 'w1'; fields: time_s, w1_rad_s"):
        log.column("/wheels", "w1")
    with pytest.raises(LogError, match=r"/wheels has no vector 'q'; fields: time_s, w1_rad_s"):
        log.vector("/wheels", "q")


def test_a_log_cannot_be_changed(log: Log) -> None:
    with pytest.raises(ValueError, match="read-only"):
        log.column("/motion", "time_s")[0] = 1.0


def test_a_table_grows() -> None:
    growing = Growing(("a", "b"))
    assert growing.table().values.shape == (0, 2)
    growing.add(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([5, 6], np.uint64))
    growing.add(np.array([[7.0, 8.0, 9.0]])[:, ::2], np.array([7], np.uint64))
    table = growing.table()
    assert (table.fields, table.values.tolist()) == (
        ("a", "b"),
        [[1.0, 2.0], [3.0, 4.0], [7.0, 9.0]],
    )
    assert table.log_times.tolist() == [5, 6, 7]
    assert not table.values.flags.writeable
    assert not table.log_times.flags.writeable
