"""Ticks to record: any at all for hypothesis, and a smooth tumbling flight."""

from math import cos, sin
from pathlib import Path

from hypothesis import strategies as st

from atlas_cueing.recording import McapRecorder
from atlas_cueing.rotation import Vec3, exp
from atlas_cueing.signals import Cue, Motion, Tick, VehicleState, WheelSpeeds

HEAD: Vec3 = (0.1, -0.2, 0.4)
ATTACHMENTS = {"scenario.toml": b'name = "test"\n', "platform.toml": 'name = "Größe"\n'.encode()}
METADATA = {"scenario": "test", "method": "attitude"}

_number = st.floats(-1e6, 1e6)
_vec3 = st.tuples(_number, _number, _number)
_quat = st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(exp)
_flag = st.sampled_from((0.0, 1.0))


@st.composite
def any_ticks(draw: st.DrawFn, most: int = 12) -> list[Tick]:
    """Ticks at increasing times of any spacing, with any values."""
    steps = draw(st.lists(st.floats(1e-4, 10.0), min_size=1, max_size=most))
    times = [sum(steps[: i + 1]) - steps[0] for i in range(len(steps))]
    return [draw(any_tick(time)) for time in times]


@st.composite
def any_tick(draw: st.DrawFn, time: float) -> Tick:
    """A tick with any values at `time`."""
    cue = Cue(time, draw(_quat), *(draw(_vec3) for _ in range(4)))
    motion = Motion(
        time, draw(_quat), *(draw(_vec3) for _ in range(5)), limited=(draw(_flag), draw(_flag))
    )
    vehicle = VehicleState(time, draw(_quat), draw(_vec3), draw(_vec3))
    return Tick(vehicle, cue, motion, WheelSpeeds(time, draw(_vec3), draw(_vec3)))


def tumble(count: int, rate_hz: float) -> list[Tick]:
    """A smooth flight in which every field has a value of its own."""
    return [tumbling_at(k / rate_hz) for k in range(count)]


def tumbling_at(t: float) -> Tick:
    """The tick of `tumble` at time t."""

    def vector(phase: float) -> Vec3:
        return (sin(t + phase), cos(1.3 * t + phase), sin(0.7 * t - phase))

    q_NB, q_cue, q_WS = exp((t, 0.3, 0.1)), exp((t, 0.2, 0.1)), exp((t, 0.2, 0.0))
    cue = Cue(t, q_cue, vector(0.1), vector(0.2), vector(0.3), vector(0.4))
    motion = Motion(
        t, q_WS, vector(0.5), vector(0.6), vector(0.7), vector(0.8), vector(0.9), (1.0, 0.0)
    )
    return Tick(
        VehicleState(t, q_NB, vector(1.0), vector(1.1)),
        cue,
        motion,
        WheelSpeeds(t, vector(1.2), vector(1.3)),
    )


def append_all(recorder: McapRecorder, ticks: list[Tick]) -> None:
    for tick in ticks:
        recorder.append(tick)


def record(
    path: Path, ticks: list[Tick], *, chunk_ticks: int = 5, skip_topics: tuple[str, ...] = ()
) -> Path:
    """A complete log of `ticks`, with a state at the start and one at the end."""
    recorder = McapRecorder(
        path,
        head_S=HEAD,
        metadata=METADATA,
        attachments=ATTACHMENTS,
        chunk_ticks=chunk_ticks,
        skip_topics=skip_topics,
    )
    recorder.status(0.0, "running", "")
    append_all(recorder, ticks)
    recorder.status(ticks[-1].vehicle.time, "done", "end of test")
    recorder.close("ok", "end of test")
    return path
