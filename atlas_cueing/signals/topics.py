"""The one table of what a log holds: topics, message names, fields with their units.

Every message is flat and all its fields are doubles (`/status` and `/tf` apart, which the recording
describes), so that plot tools draw one line a field and a message has a fixed layout on the wire.
`tick_row` gives the numbers of the first four topics in the order of the table; `/felt` is derived
from them.
"""

# mypyc: runs every tick

from dataclasses import dataclass

from .states import Tick, Timing

_VECTORS = {"w": "rad_s", "f": "m_s2", "alpha": "rad_s2", "p": "m", "v": "m_s", "a": "m_s2"}


@dataclass(frozen=True, slots=True)
class Topic:
    """A channel of flat double fields.

    frame: axes of its vectors; empty where it has none. other_frames: of vectors in other axes,
        by their name.
    """

    name: str
    schema: str
    fields: tuple[str, ...]
    frame: str = ""
    other_frames: tuple[tuple[str, str], ...] = ()


def _fields(quaternion: str, vectors: str) -> tuple[str, ...]:
    """time, a quaternion unless empty, and xyz of each named vector with its unit."""
    names = ["time_s"]
    names += [f"{quaternion}_{c}" for c in "wxyz"] if quaternion else []
    names += [f"{v}{c}_{_VECTORS[v]}" for v in vectors.split() for c in "xyz"]
    return tuple(names)


TOPICS = (
    Topic("/vehicle", "atlas.Vehicle", _fields("q_nb", "w f"), "B"),
    Topic("/cue", "atlas.Cue", _fields("q_ws", "w p v a"), "W"),
    Topic(
        "/motion",
        "atlas.Motion",
        (*_fields("q_ws", "w alpha p v a"), "wheels_limited", "stage_limited"),
        "W",
    ),
    Topic(
        "/wheels",
        "atlas.Wheels",
        ("time_s", "w1_rad_s", "w2_rad_s", "w3_rad_s", "a1_rad_s2", "a2_rad_s2", "a3_rad_s2"),
    ),
    Topic("/felt", "atlas.Felt", (*_fields("", "f w"), "direction_error_rad"), "S (FRD)"),
)


LIVE_STATES = (
    *("parked", "engaging", "running", "holding", "parking", "fault_stopping", "stopped"),
    "waiting",
)
"""States of the real-time loop; /timing has their place in this list, /status their name.

A new one is appended: logs and receivers know the others by their places.
"""

TIMING = Topic(
    "/timing",
    "atlas.Timing",
    (
        *(
            "time_s",
            "elapsed_s",
            "lateness_s",
            "cost_s",
            "input_age_s",
            "missed_deadlines",
            "state",
        ),
        *("wheel_difference_rad", "stage_difference_m"),
    ),
)
"""Live runs only, once a tick: the numbers of `states.Timing`."""

LIVE_TOPICS = (*TOPICS[:-1], TIMING, TOPICS[-1])
"""What a live log holds; as in TOPICS, all but the last come from the loop."""

LOADS = Topic(
    "/loads",
    "atlas.Loads",
    (
        "time_s",
        *(
            f"{name}{k}{unit}"
            for name, unit in (("f", "_n"), ("n", "_n"), ("t", "_n_m"), ("p", "_w"), ("use", ""))
            for k in (1, 2, 3)
        ),
    ),
)
"""Runs on a platform with masses only, once a tick; derived from the motion as /felt is.

Drive and normal force, torque, power and traction use of each wheel (`loads`)."""

PLANT = Topic(
    "/plant",
    "atlas.Plant",
    (
        *("time_s", "q_ws_w", "q_ws_x", "q_ws_y", "q_ws_z", "wx_rad_s", "wy_rad_s", "wz_rad_s"),
        *("fx_m_s2", "fy_m_s2", "fz_m_s2", "error_rad"),
        *("estimate_ws_w", "estimate_ws_x", "estimate_ws_y", "estimate_ws_z"),
        "estimate_error_rad",
        *(
            f"{name}{k}_{unit}"
            for name, unit in (("s", "m_s"), ("n", "n"), ("t", "n_m"), ("u", "rad_s"))
            for k in (1, 2, 3)
        ),
        *("residual1_rad_s", "residual2_rad_s", "residual3_rad_s"),
    ),
    "W",
    (("f", "S (FRD)"),),
)
"""Of `plant` only, once a tick: where the simulated sphere really is (frame W), what the rider
really feels (FRD, as /felt), how far that is from /motion, the observer's estimate; of each wheel
slip, normal force, torque, speed, and the slip that gyro and wheel tell."""

CORRECTION = Topic(
    "/correction",
    "atlas.Correction",
    (
        "time_s",
        *(
            f"{name}{k}_{unit}"
            for name, unit in (("angle", "rad"), ("w", "rad_s"), ("a", "rad_s2"))
            for k in (1, 2, 3)
        ),
    ),
)
"""What the attitude loop adds to the schedule: angle, speed and acceleration of each wheel."""

ESTIMATE = Topic(
    "/estimate",
    "atlas.Estimate",
    ("time_s", "seen_s", "q_ws_w", "q_ws_x", "q_ws_y", "q_ws_z", "error_rad", "fix_age_s"),
    "W",
)
"""Live runs that correct the attitude, once a tick: where the cabin was at `seen_s`, the time of
the run at the newest status of the drives, how far that is from /motion of the same moment, and the
age of the newest fix then (-1 before the first; `seen_s` as well)."""

ALL_TOPICS = (*LIVE_TOPICS, LOADS, PLANT, CORRECTION, ESTIMATE)
"""Whatever topic of flat doubles a log may hold."""


ROW = sum(len(topic.fields) for topic in TOPICS[:-1])  # numbers in a row of `tick_row`
LIVE_ROW = ROW + len(TIMING.fields)  # in a row of `live_row`: the fields of /timing follow
# numbers of /correction and /estimate, without their times, that may follow a live row
ATTITUDE_ROW = len(CORRECTION.fields) + len(ESTIMATE.fields) - 2


def tick_row(tick: Tick) -> tuple[float, ...]:
    """All numbers of a tick in the order of the first four topics of `TOPICS`."""
    # Written out, since unpacking one vector after the other takes three times as long where the
    # code is compiled.
    vehicle, cue, motion, wheels = tick.vehicle, tick.cue, tick.motion, tick.wheels
    q_NB, w_NB, f = vehicle.q_NB, vehicle.w_NB_B, vehicle.f_B
    q_cue, w_cue, p_cue, v_cue, a_cue = cue.q_WS, cue.w_WS_W, cue.p_WS_W, cue.v_WS_W, cue.a_WS_W
    q, w, alpha, p, v, a = (
        motion.q_WS,
        motion.w_WS_W,
        motion.alpha_WS_W,
        motion.p_WS_W,
        motion.v_WS_W,
        motion.a_WS_W,
    )
    u, du, limited = wheels.speed, wheels.acceleration, motion.limited
    # fmt: off
    return (
        vehicle.time, q_NB[0], q_NB[1], q_NB[2], q_NB[3], w_NB[0], w_NB[1], w_NB[2],
        f[0], f[1], f[2],
        cue.time, q_cue[0], q_cue[1], q_cue[2], q_cue[3], w_cue[0], w_cue[1], w_cue[2],
        p_cue[0], p_cue[1], p_cue[2], v_cue[0], v_cue[1], v_cue[2], a_cue[0], a_cue[1], a_cue[2],
        motion.time, q[0], q[1], q[2], q[3], w[0], w[1], w[2], alpha[0], alpha[1], alpha[2],
        p[0], p[1], p[2], v[0], v[1], v[2], a[0], a[1], a[2], limited[0], limited[1],
        wheels.time, u[0], u[1], u[2], du[0], du[1], du[2],
    )
    # fmt: on


def live_row(tick: Tick, timing: Timing) -> tuple[float, ...]:
    """All numbers of a tick of a live run in the order of LIVE_TOPICS, without /felt."""
    t = timing
    return (
        *(*tick_row(tick), t.time, t.elapsed, t.lateness, t.cost, t.input_age, t.missed, t.state),
        *(t.wheel_difference, t.stage_difference),
    )
