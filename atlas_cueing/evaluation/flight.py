"""The columns of one run."""

from dataclasses import dataclass, fields
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Columns(Protocol):
    """Whatever gives logged columns by topic and name, as `recording.Log` does."""

    def column(self, topic: str, field: str) -> Array:
        """One field, (n,)."""

    def vector(self, topic: str, name: str) -> Array:
        """The fields of a vector (n, 3) or quaternion (n, 4)."""


@dataclass(frozen=True, slots=True)
class Flight:
    """All ticks of a run, one row each; SI and rad, names and frames as in `signals.states`.

    `felt_f` and `felt_w` are what the rider's head feels, in cabin FRD axes; `limited` is (n, 2) of 0 or 1: wheels, stage.
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
    def of(cls, log: Columns) -> "Flight":
        """The flight in a log."""
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
            limited=np.column_stack([log.column("/motion", f"{part}_limited") for part in ("wheels", "stage")]),
            wheel_speed=log.vector("/wheels", "w"),
            wheel_acceleration=log.vector("/wheels", "a"),
            felt_f=log.vector("/felt", "f"),
            felt_w=log.vector("/felt", "w"),
        )

    def rows(self, rows: slice) -> "Flight":
        """A part of the flight."""
        return Flight(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})
