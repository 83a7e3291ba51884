"""A run known in closed form: the rate of the sphere turns as well, the stage swings."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from atlas_cueing.evaluation import RunColumns
from atlas_cueing.recording import Log, TopicColumns
from atlas_cueing.review import RecordedRun
from atlas_cueing.scenario import load_platform
from atlas_cueing.signals import TOPICS, StateChange

G = 9.80665


def coning(count: int = 601, dt: float = 0.01, platform: str = "atlas-2.9m") -> RecordedRun:
    """A cabin that cones: q = Rz(n t) Rx(s t), whose base rate is s (cos n t, sin n t, 0) + n z.

    A stage on a slow sine.

    The vehicle does just the same, felt at a head in the centre.
    """
    n, s, t = 0.8, 0.6, dt * np.arange(count)
    zero, one = np.zeros(count), np.ones(count)
    a, b = 0.5 * n * t, 0.5 * s * t
    q = np.column_stack(
        [np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a) * np.sin(b), np.sin(a) * np.cos(b)]
    )
    w = np.column_stack([s * np.cos(n * t), s * np.sin(n * t), n * one])
    alpha = np.column_stack([-s * n * np.sin(n * t), s * n * np.cos(n * t), zero])
    p, v, acceleration = (
        np.column_stack([value, zero, zero])
        for value in (
            0.2 * np.sin(t) - 0.1 * np.sin(2 * t),
            0.2 * np.cos(t) - 0.2 * np.cos(2 * t),
            -0.2 * np.sin(t) + 0.4 * np.sin(2 * t),
        )
    )
    felt_f, felt_w = _felt(t, n, s, acceleration)
    flu = np.array([1.0, 1.0, -1.0, -1.0])
    run = RecordedRun(
        _log(),
        load_platform(platform),
        _flight(t, q * flu, felt_w, felt_f, q, w, alpha, p, v, acceleration),
    )
    inverse = run.wheels_from_sphere().T
    flight = replace(run.flight, wheel_speed=w @ inverse, wheel_acceleration=alpha @ inverse)
    return with_flight(run, flight)


def with_flight(run: RecordedRun, flight: RunColumns) -> RecordedRun:
    """The run with another flight in it, and in its log."""
    columns = {
        "/vehicle": (flight.time, flight.vehicle_q_NB, flight.vehicle_w_B, flight.vehicle_f_B),
        "/cue": (
            flight.time,
            flight.cue_q_WS,
            flight.cue_w_W,
            flight.cue_p_W,
            flight.cue_v_W,
            flight.cue_a_W,
        ),
        "/motion": (
            *(flight.time, flight.motion_q_WS, flight.motion_w_W, flight.motion_alpha_W),
            *(flight.motion_p_W, flight.motion_v_W, flight.motion_a_W, flight.limited),
        ),
        "/wheels": (flight.time, flight.wheel_speed, flight.wheel_acceleration),
        "/felt": (flight.time, flight.felt_f, flight.felt_w, np.zeros(len(flight.time))),
    }
    tables = {
        topic.name: TopicColumns(topic.fields, np.column_stack(columns[topic.name]))
        for topic in TOPICS
    }
    return replace(run, log=replace(run.log, tables=tables), flight=flight)


def with_states(run: RecordedRun, *states: tuple[float, str, str]) -> RecordedRun:
    """The run with other states."""
    return replace(
        run, log=replace(run.log, statuses=tuple(StateChange(*state) for state in states))
    )


def _felt(t: np.ndarray, n: float, s: float, a_W: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Force and rate in cabin FRD; its axes in W are the columns of Rz(n t) Rx(s t)."""
    cn, sn, cs, ss = np.cos(n * t), np.sin(n * t), np.cos(s * t), np.sin(s * t)
    x, z = a_W[:, 0], a_W[:, 2] + G
    force = np.column_stack([cn * x, -(-sn * cs * x + ss * z), -(sn * ss * x + cs * z)])
    rate = np.column_stack([s * np.ones_like(t), -n * ss, -n * cs])
    return force, rate


def _flight(
    t: np.ndarray,
    q_NB: np.ndarray,
    w_B: np.ndarray,
    f_B: np.ndarray,
    q: np.ndarray,
    w: np.ndarray,
    alpha: np.ndarray,
    p: np.ndarray,
    v: np.ndarray,
    a: np.ndarray,
) -> RunColumns:
    none = np.zeros((len(t), 3))
    return RunColumns(
        t,
        q_NB,
        w_B,
        f_B,
        q,
        w,
        p,
        v,
        a,
        q,
        w,
        alpha,
        p,
        v,
        a,
        np.zeros((len(t), 2)),
        none,
        none,
        f_B,
        w_B,
    )


def _log() -> Log:
    return Log(Path("coning.mcap"), {}, {"result": "ok"}, {}, (StateChange(0.0, "running", ""),))
