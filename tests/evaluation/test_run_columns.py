"""A flight is read from anything with columns."""

from dataclasses import fields

import numpy as np
import pytest

from atlas_cueing.evaluation import BLOCK_TICKS, RunColumns, gathered
from atlas_cueing.evaluation.run_columns import Tail
from atlas_cueing.signals import TOPICS

from .flights import still


class Counted:
    """A log in which every field holds its own place in the table of topics."""

    def __init__(self) -> None:
        names = [(topic.name, field) for topic in TOPICS for field in topic.fields]
        self.place = {name: float(k) for k, name in enumerate(names)}

    def column(self, topic: str, field: str) -> np.ndarray:
        return np.full(2, self.place[topic, field])

    def vector(self, topic: str, name: str) -> np.ndarray:
        """As recording.Log does, in another way: by the full names."""
        units = {"w": "rad_s", "f": "m_s2", "alpha": "rad_s2", "p": "m", "v": "m_s", "a": "m_s2"}
        if topic == "/wheels":
            found = [f"{name}{k}_{'rad_s' if name == 'w' else 'rad_s2'}" for k in (1, 2, 3)]
        elif name.startswith("q"):
            found = [f"{name}_{c}" for c in "wxyz"]
        else:
            found = [f"{name}{c}_{units[name]}" for c in "xyz"]
        return np.column_stack([self.column(topic, field) for field in found])


def test_every_field_comes_from_its_own_column() -> None:
    log = Counted()
    flight = RunColumns.of(log)
    found = {}
    for field in fields(flight):
        values = getattr(flight, field.name)
        assert values.shape[0] == 2
        found[field.name] = values[0] if values.ndim > 1 else values[:1]
    assert found["time"].tolist() == [log.place["/motion", "time_s"]]
    topics = {
        "vehicle": "/vehicle",
        "cue": "/cue",
        "motion": "/motion",
        "wheel": "/wheels",
        "felt": "/felt",
    }
    symbols = {"q_NB": "q_nb_w", "q_WS": "q_ws_w", "speed": "w1_rad_s", "acceleration": "a1_rad_s2"}
    units = {
        "w": "wx_rad_s",
        "f": "fx_m_s2",
        "alpha": "alphax_rad_s2",
        "p": "px_m",
        "v": "vx_m_s",
        "a": "ax_m_s2",
    }
    for name, values in found.items():
        prefix, _, symbol = name.partition("_")
        if prefix in topics:
            first = symbols.get(symbol) or units[symbol.split("_")[0]]
            start = log.place[topics[prefix], first]
            assert values.tolist() == [start + k for k in range(len(values))], name
    assert found["limited"].tolist() == [
        log.place["/motion", f"{part}_limited"] for part in ("wheels", "stage")
    ]
    assert len(found) == 20


@pytest.mark.parametrize("count", [0, 1, BLOCK_TICKS, BLOCK_TICKS + 1, 20_000])
def test_blocks_are_the_flight(count: int) -> None:
    """Blocks are counted from the start, and contiguous for any layout of the flight."""
    values = np.random.default_rng(count).normal(size=(count, 3))
    flight = still(count, felt_w=values, vehicle_q_NB=np.arange(4.0 * count).reshape(count, 4))
    blocks = list(flight.blocks())
    assert [len(block.time) for block in blocks[:-1]] == [BLOCK_TICKS] * (len(blocks) - 1)
    assert sum(len(block.time) for block in blocks) == count
    for field in fields(flight):
        columns = [getattr(block, field.name) for block in blocks]
        assert all(column.flags.f_contiguous for column in columns)
        whole = getattr(flight, field.name)
        np.testing.assert_array_equal(np.concatenate([whole[:0], *columns]), whole)


def test_a_block_of_columns_is_not_copied() -> None:
    flight = next(still(100).blocks())
    assert np.shares_memory(next(flight.blocks()).felt_w, flight.felt_w)


def test_figures_get_every_tick_once() -> None:
    class Times:
        def __init__(self) -> None:
            self.seen: list[float] = []

        def add(self, block: RunColumns) -> None:
            self.seen += block.time.tolist()

        def figures(self) -> dict[str, float]:
            return {"ticks": float(len(self.seen))}

    times, flight = Times(), still(17_000)
    assert gathered(times, flight) == {"ticks": 17_000.0}
    assert times.seen == flight.time.tolist()


@pytest.mark.parametrize("rows", [1, 2])
@pytest.mark.parametrize("cuts", [[], [1], [3, 4, 5], [1, 2, 9]])
def test_a_tail_joins_what_was_cut(rows: int, cuts: list[int]) -> None:
    time, v = np.arange(10.0), np.asfortranarray(np.arange(30.0).reshape(10, 3))
    tail, start = Tail(rows), 0
    for end in (*cuts, 10):
        joined_time, joined_v = tail.joined(time[start:end], v[start:end])
        first = max(start - rows, 0)
        assert joined_time.tolist() == time[first:end].tolist()
        assert joined_v.tolist() == v[first:end].tolist()
        start = end


def test_what_a_tail_joined_is_in_columns_too() -> None:
    tail, v = Tail(2), np.asfortranarray(np.ones((100, 3)))
    for _ in range(3):
        assert tail.joined(v)[0].flags.f_contiguous
