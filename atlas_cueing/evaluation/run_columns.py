"""The columns of one run, whole or block by block."""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Protocol

import numpy as np

from ..rotations import Array

BLOCK_TICKS = 7168
"""Ticks a block: its temporaries of 57 kB stay in the cache, they fill whole rows of
`vestibular.Sensing`, and a product of matrices of them is small enough for BLAS not to wake a
thread for each core."""


class Columns(Protocol):
    """A source of logged columns by topic and name, such as `recording.Log`."""

    def column(self, topic: str, field: str) -> Array:
        """One field (n,) of a topic."""

    def vector(self, topic: str, name: str) -> Array:
        """A vector (n, 3) or quaternion (n, 4) of a topic."""


@dataclass(frozen=True, slots=True)
class RunColumns:
    """All ticks of a run, one row each; SI and rad, names and frames as in `signals.states`.

    `felt_f` and `felt_w` are what the rider's head feels, in cabin FRD axes; `limited` is (n, 2) of
    0 or 1: wheels, stage.
    """

    time: Array
    vehicle_q_NB: Array
    vehicle_w_B: Array
    vehicle_f_B: Array
    cue_q_WS: Array
    cue_w_W: Array
    cue_p_W: Array
    cue_v_W: Array
    cue_a_W: Array
    motion_q_WS: Array
    motion_w_W: Array
    motion_alpha_W: Array
    motion_p_W: Array
    motion_v_W: Array
    motion_a_W: Array
    limited: Array
    wheel_speed: Array
    wheel_acceleration: Array
    felt_f: Array
    felt_w: Array

    @classmethod
    def of(cls, log: Columns) -> "RunColumns":
        """The columns of a log."""
        return cls(
            time=log.column("/motion", "time_s"),
            vehicle_q_NB=log.vector("/vehicle", "q_nb"),
            vehicle_w_B=log.vector("/vehicle", "w"),
            vehicle_f_B=log.vector("/vehicle", "f"),
            cue_q_WS=log.vector("/cue", "q_ws"),
            cue_w_W=log.vector("/cue", "w"),
            cue_p_W=log.vector("/cue", "p"),
            cue_v_W=log.vector("/cue", "v"),
            cue_a_W=log.vector("/cue", "a"),
            motion_q_WS=log.vector("/motion", "q_ws"),
            motion_w_W=log.vector("/motion", "w"),
            motion_alpha_W=log.vector("/motion", "alpha"),
            motion_p_W=log.vector("/motion", "p"),
            motion_v_W=log.vector("/motion", "v"),
            motion_a_W=log.vector("/motion", "a"),
            limited=np.stack(
                [log.column("/motion", f"{part}_limited") for part in ("wheels", "stage")]
            ).T,
            wheel_speed=log.vector("/wheels", "w"),
            wheel_acceleration=log.vector("/wheels", "a"),
            felt_f=log.vector("/felt", "f"),
            felt_w=log.vector("/felt", "w"),
        )

    def rows(self, rows: slice) -> "RunColumns":
        """The rows of a slice, without a copy."""
        return RunColumns(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})

    def blocks(self, ticks: int = BLOCK_TICKS) -> Iterator["RunColumns"]:
        """The run in blocks of so many ticks, counted from its start.

        Each component of each column of a block is contiguous.
        """
        for start in range(0, len(self.time), ticks):
            block = self.rows(slice(start, start + ticks))
            yield RunColumns(
                **{
                    field.name: np.asfortranarray(getattr(block, field.name))
                    for field in fields(self)
                }
            )


class Figures(Protocol):
    """Figures of a run that comes block by block, as `evaluation` explains."""

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks, at least one."""

    def figures(self) -> dict[str, float]:
        """The figures of all ticks so far by name, the unit in the name."""


def gathered(figures: Figures, flight: RunColumns) -> dict[str, float]:
    """Take in a whole run in the blocks of `BLOCK_TICKS` and give its figures.

    They are to the last bit those that a recorder gets, which takes in the same blocks.
    """
    for block in flight.blocks():
        figures.add(block)
    return figures.figures()


def mean_step(time: Array) -> float:
    """Mean time from tick to tick of the times (n,), s; 1 for a single tick."""
    return float(time[-1] - time[0]) / (len(time) - 1) if len(time) > 1 else 1.0


class Tail:
    """The last rows of a block, kept to be put in front of the next one.

    So differences between ticks go on across the cut.
    """

    def __init__(self, rows: int) -> None:
        """Begin without a block; `rows` is how many are kept."""
        self._rows = rows
        self._kept: tuple[Array, ...] | None = None

    def joined(self, *columns: Array) -> tuple[Array, ...]:
        """The columns with the last rows of the block before in front; none at the start."""
        if self._kept is not None:
            columns = tuple(np.concatenate(pair) for pair in zip(self._kept, columns, strict=True))
        self._kept = tuple(column[-self._rows :].copy("K") for column in columns)
        return columns
