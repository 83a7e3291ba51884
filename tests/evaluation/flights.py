"""Flights: one in which nothing happens, to be changed field by field, and random ones."""

from dataclasses import fields, replace

import numpy as np

from atlas_cueing.evaluation import RunColumns

G = 9.80665


def still(count: int, dt: float = 0.01, **changes: np.ndarray) -> RunColumns:
    """At rest, upright, heading north, `count` ticks.

    Arrays in `changes` replace fields and are stretched to all ticks.
    """
    zero, unit = np.zeros((count, 3)), np.tile([1.0, 0.0, 0.0, 0.0], (count, 1))
    weight = np.tile([0.0, 0.0, -G], (count, 1))
    flight = RunColumns(
        time=np.arange(count) * dt,
        vehicle_q_NB=unit,
        vehicle_w_B=zero,
        vehicle_f_B=weight,
        cue_q_WS=unit,
        cue_w_W=zero,
        cue_p_W=zero,
        cue_v_W=zero,
        cue_a_W=zero,
        motion_q_WS=unit,
        motion_w_W=zero,
        motion_alpha_W=zero,
        motion_p_W=zero,
        motion_v_W=zero,
        motion_a_W=zero,
        limited=np.zeros((count, 2)),
        wheel_speed=zero,
        wheel_acceleration=zero,
        felt_f=weight,
        felt_w=zero,
    )
    return replace(
        flight,
        **{
            name: np.broadcast_to(v, getattr(flight, name).shape).copy()
            for name, v in changes.items()
        },
    )


def sine(count: int, amplitude: float, periods: int) -> np.ndarray:
    """Whole periods of a sine, (count,): its rms is amplitude / sqrt(2), whatever the sampling."""
    return amplitude * np.sin(2.0 * np.pi * periods * np.arange(count) / count)


def column(values: np.ndarray, axis: int) -> np.ndarray:
    """A vector (n, 3) with `values` (n,) along one axis."""
    vector = np.zeros((len(values), 3))
    vector[:, axis] = values
    return vector


def smooth(random: np.random.Generator, count: int, width: int) -> np.ndarray:
    """A slow wander with some noise on it."""
    return np.cumsum(random.normal(size=(count, width)), axis=0) * 0.05 + 0.02 * random.normal(
        size=(count, width)
    )


def any_flight(count: int, seed: int) -> RunColumns:
    """Everything moves, the platform after the vehicle; limits come and go."""
    random = np.random.default_rng(seed)
    vectors = {
        field.name: smooth(random, count, 3)
        for field in fields(RunColumns)
        if field.name not in ("time", "limited") and "_q_" not in field.name
    }
    vectors["felt_w"] = np.roll(vectors["vehicle_w_B"], 4, axis=0) + 0.1 * vectors["felt_w"]
    vectors["felt_f"] = (
        np.roll(vectors["vehicle_f_B"], 7, axis=0)
        + 0.1 * vectors["felt_f"]
        - np.array([0.0, 0.0, G])
    )
    quaternions = {}
    for name in ("vehicle_q_NB", "cue_q_WS", "motion_q_WS"):
        q = smooth(random, count, 4) + np.array([1.0, 0.0, 0.0, 0.0])
        quaternions[name] = q / np.linalg.norm(q, axis=1, keepdims=True)
    limited = (smooth(random, count, 2) > 0.1).astype(np.float64)
    return still(count, 0.01, limited=limited, **vectors, **quaternions)
