"""The one table of what a log holds: topics, message names, fields with their units.

Every message is flat and all its fields are doubles (`/status` and `/tf` apart, which the recording describes), so that plot
tools draw one line a field and a message has a fixed layout on the wire. `tick_row` gives the numbers of the first four
topics in the order of the table; `/felt` is derived from them.
"""

from dataclasses import dataclass

from .states import Cue, Motion, Tick, Timing, VehicleState, WheelSpeeds

_VECTORS = {"w": "rad_s", "f": "m_s2", "alpha": "rad_s2", "p": "m", "v": "m_s", "a": "m_s2"}


@dataclass(frozen=True, slots=True)
class Topic:
    """A channel of flat double fields."""

    name: str
    schema: str
    fields: tuple[str, ...]


def _fields(quaternion: str, vectors: str) -> tuple[str, ...]:
    """time, a quaternion unless empty, and xyz of each named vector with its unit."""
    names = ["time_s"]
    names += [f"{quaternion}_{c}" for c in "wxyz"] if quaternion else []
    names += [f"{v}{c}_{_VECTORS[v]}" for v in vectors.split() for c in "xyz"]
    return tuple(names)


TOPICS = (
    Topic("/vehicle", "atlas.Vehicle", _fields("q_nb", "w f")),
    Topic("/cue", "atlas.Cue", _fields("q_ws", "w p v a")),
    Topic("/motion", "atlas.Motion", (*_fields("q_ws", "w alpha p v a"), "wheels_limited", "stage_limited")),
    Topic("/wheels", "atlas.Wheels", ("time_s", "w1_rad_s", "w2_rad_s", "w3_rad_s", "a1_rad_s2", "a2_rad_s2", "a3_rad_s2")),
    Topic("/felt", "atlas.Felt", (*_fields("", "f w"), "direction_error_rad")),
)


LIVE_STATES = ("parked", "engaging", "running", "holding", "parking", "fault_stopping", "stopped")
"""States of the real-time loop; /timing has their place in this list, /status their name."""

TIMING = Topic(
    "/timing",
    "atlas.Timing",
    ("time_s", "elapsed_s", "lateness_s", "cost_s", "input_age_s", "missed_deadlines", "state"),
)
"""Live runs only, once a tick: the numbers of `states.Timing`."""

LIVE_TOPICS = (*TOPICS[:-1], TIMING, TOPICS[-1])
"""What a live log holds; as in TOPICS, all but the last come from the loop."""


def tick_row(tick: Tick) -> tuple[float, ...]:
    """All numbers of a tick in the order of the first four topics of `TOPICS`."""
    motion = tick.motion
    return _vehicle_row(tick.vehicle) + _cue_row(tick.cue) + _turn_row(motion) + _stage_row(motion) + _wheel_row(tick.wheels)


# Written out, since unpacking one vector after the other takes three times as long where the code is compiled.


def _vehicle_row(vehicle: VehicleState) -> tuple[float, ...]:
    q, w, f = vehicle.q_NB, vehicle.w_NB_B, vehicle.f_B
    return (vehicle.time, q[0], q[1], q[2], q[3], w[0], w[1], w[2], f[0], f[1], f[2])


def _cue_row(cue: Cue) -> tuple[float, ...]:
    q, w, p, v, a = cue.q_WS, cue.w_WS_W, cue.p_WS_W, cue.v_WS_W, cue.a_WS_W
    return (cue.time, q[0], q[1], q[2], q[3], w[0], w[1], w[2], p[0], p[1], p[2], v[0], v[1], v[2], a[0], a[1], a[2])


def _turn_row(motion: Motion) -> tuple[float, ...]:
    q, w, alpha = motion.q_WS, motion.w_WS_W, motion.alpha_WS_W
    return (motion.time, q[0], q[1], q[2], q[3], w[0], w[1], w[2], alpha[0], alpha[1], alpha[2])


def _stage_row(motion: Motion) -> tuple[float, ...]:
    p, v, a, limited = motion.p_WS_W, motion.v_WS_W, motion.a_WS_W, motion.limited
    return (p[0], p[1], p[2], v[0], v[1], v[2], a[0], a[1], a[2], limited[0], limited[1])


def _wheel_row(wheels: WheelSpeeds) -> tuple[float, ...]:
    u, a = wheels.speed, wheels.acceleration
    return (wheels.time, u[0], u[1], u[2], a[0], a[1], a[2])


def live_row(tick: Tick, timing: Timing) -> tuple[float, ...]:
    """All numbers of a tick of a live run in the order of LIVE_TOPICS, without /felt."""
    t = timing
    return (*tick_row(tick), t.time, t.elapsed, t.lateness, t.cost, t.input_age, t.missed, t.state)
