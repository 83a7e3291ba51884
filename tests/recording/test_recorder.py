"""Ticks, states and files of a run in the log, as anyone sees them.

Our own reader takes no part here.
"""

import os
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from itertools import accumulate
from math import floor
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader

from atlas_cueing.signals import TOPICS, Tick

from .flights import ATTACHMENTS, METADATA, any_ticks, append_all, record, tumble, tumbling_at
from .plain_reading import EPOCH_NS, decoded, open_recorder, quaternion, vector


def check_vehicle(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.vehicle.time
    assert quaternion(message, "q_nb") == tick.vehicle.q_NB
    assert vector(message, "w", "rad_s") == tick.vehicle.w_NB_B
    assert vector(message, "f", "m_s2") == tick.vehicle.f_B


def check_cue(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.cue.time
    assert quaternion(message, "q_ws") == tick.cue.q_WS
    assert vector(message, "w", "rad_s") == tick.cue.w_WS_W
    assert vector(message, "p", "m") == tick.cue.p_WS_W
    assert vector(message, "v", "m_s") == tick.cue.v_WS_W
    assert vector(message, "a", "m_s2") == tick.cue.a_WS_W


def check_motion(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.motion.time
    assert quaternion(message, "q_ws") == tick.motion.q_WS
    assert vector(message, "w", "rad_s") == tick.motion.w_WS_W
    assert vector(message, "alpha", "rad_s2") == tick.motion.alpha_WS_W
    assert vector(message, "p", "m") == tick.motion.p_WS_W
    assert vector(message, "v", "m_s") == tick.motion.v_WS_W
    assert vector(message, "a", "m_s2") == tick.motion.a_WS_W
    assert (message.wheels_limited, message.stage_limited) == tick.motion.limited


def check_wheels(message: Any, tick: Tick) -> None:
    assert message.time_s == tick.wheels.time
    assert (message.w1_rad_s, message.w2_rad_s, message.w3_rad_s) == tick.wheels.speed
    assert (message.a1_rad_s2, message.a2_rad_s2, message.a3_rad_s2) == tick.wheels.acceleration


CHECKS = {
    "/vehicle": check_vehicle,
    "/cue": check_cue,
    "/motion": check_motion,
    "/wheels": check_wheels,
}


@settings(max_examples=40, deadline=None)
@given(any_ticks(), st.integers(1, 6))
def test_every_field_is_read_back_as_it_was_put_in(
    tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick], chunk_ticks: int
) -> None:
    path = record(tmp_path_factory.getbasetemp() / "any.mcap", ticks, chunk_ticks=chunk_ticks)
    seen: Counter[str] = Counter()
    latest = 0
    for topic, log_time, message in decoded(path):
        assert log_time >= latest
        latest = log_time
        if topic in CHECKS:
            tick = ticks[seen[topic]]
            assert abs(log_time - EPOCH_NS - Fraction(tick.vehicle.time) * 10**9) <= Fraction(
                1, 2
            ) + Fraction(1, 10**6)
            CHECKS[topic](message, tick)
        seen[topic] += 1
    assert {topic: seen[topic] for topic in CHECKS} == dict.fromkeys(CHECKS, len(ticks))
    assert seen["/felt"] == len(ticks)
    assert seen["/status"] == 2


@settings(max_examples=40, deadline=None)
@given(any_ticks())
def test_transforms_carry_stage_position_and_cabin_orientation(
    tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick]
) -> None:
    path = record(tmp_path_factory.getbasetemp() / "tf.mcap", ticks)
    by_time = {}
    for topic, log_time, message in decoded(path):
        if topic == "/motion":
            by_time[log_time] = ticks[len(by_time)].motion
        if topic == "/tf":
            motion = by_time[log_time]  # a transform follows its tick
            stage, cabin = message.transforms
            assert [(t.parent_frame_id, t.child_frame_id) for t in (stage, cabin)] == [
                ("base", "stage"),
                ("stage", "cabin"),
            ]
            assert {t.timestamp.seconds * 10**9 + t.timestamp.nanos for t in (stage, cabin)} == {
                log_time
            }
            assert (stage.translation.x, stage.translation.y, stage.translation.z) == motion.p_WS_W
            assert (stage.rotation.w, stage.rotation.x, stage.rotation.y, stage.rotation.z) == (
                1.0,
                0.0,
                0.0,
                0.0,
            )
            assert (cabin.translation.x, cabin.translation.y, cabin.translation.z) == (
                0.0,
                0.0,
                0.0,
            )
            assert (
                cabin.rotation.w,
                cabin.rotation.x,
                cabin.rotation.y,
                cabin.rotation.z,
            ) == motion.q_WS


@pytest.mark.parametrize(
    ("rate_hz", "transforms"), [(1000.0, 60), (120.0, 60), (960.0, 60), (60.0, 60), (50.0, 50)]
)
def test_transforms_come_at_sixty_hertz_at_most(
    tmp_path: Path, rate_hz: float, transforms: int
) -> None:
    path = record(tmp_path / "rate.mcap", tumble(int(rate_hz), rate_hz), chunk_ticks=7)
    assert sum(topic == "/tf" for topic, _, _ in decoded(path)) == transforms


def test_no_transform_is_lost_where_time_is_summed_up(tmp_path: Path) -> None:
    """Sixtieths of a second added up fall short of k/60 by a rounding error now and then."""
    times = list(accumulate([0.0] + [1.0 / 60.0] * 599))
    assert any(floor(time * 60.0) < k for k, time in enumerate(times))
    path = record(tmp_path / "sum.mcap", [tumbling_at(time) for time in times])
    assert sum(topic == "/tf" for topic, _, _ in decoded(path)) == 600


def test_status_stands_after_the_ticks_up_to_its_time(tmp_path: Path) -> None:
    ticks = tumble(10, 10.0)
    recorder = open_recorder(tmp_path / "s.mcap")
    append_all(recorder, ticks)
    recorder.status(0.35, "limited", "wheels; größer")
    recorder.close("vehicle_failed", "NaN")
    messages = list(decoded(tmp_path / "s.mcap"))
    place = next(k for k, (topic, _, _) in enumerate(messages) if topic == "/status")
    status = messages[place][2]
    assert (status.time_s, status.state, status.reason) == (0.35, "limited", "wheels; größer")
    assert sum(topic == "/motion" for topic, _, _ in messages[:place]) == 4


def test_a_state_between_two_ticks_stands_between_them_and_after_the_transform(
    tmp_path: Path,
) -> None:
    recorder = open_recorder(tmp_path / "s.mcap", skip_topics=[topic.name for topic in TOPICS[1:]])
    append_all(recorder, tumble(3, 10.0))
    for time in (0.16, 0.14, 0.5):
        recorder.status(time, "", "")
    recorder.close("ok", "")
    times = [
        (topic, round((log_time - EPOCH_NS) / 1e9, 6))
        for topic, log_time, _ in decoded(tmp_path / "s.mcap")
    ]
    ticks = [[("/vehicle", 0.1 * k), ("/tf", 0.1 * k)] for k in range(3)]
    assert times == [
        *ticks[0],
        *ticks[1],
        ("/status", 0.14),
        ("/status", 0.16),
        *ticks[2],
        ("/status", 0.5),
    ]


def test_a_state_without_ticks_is_kept(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "s.mcap")
    recorder.status(0.0, "vehicle_failed", "no trim")
    recorder.close("vehicle_failed", "no trim")
    ((topic, _, status),) = decoded(tmp_path / "s.mcap")
    assert (topic, status.reason) == ("/status", "no trim")


def test_metadata_and_attachments(tmp_path: Path) -> None:
    path = record(tmp_path / "m.mcap", tumble(3, 10.0))
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        (metadata,) = reader.iter_metadata()
        attachments = list(reader.iter_attachments())
        assert reader.get_header().library == "atlas_cueing"
    assert (metadata.name, metadata.metadata) == (
        "atlas.run",
        {**METADATA, "result": "ok", "reason": "end of test"},
    )
    assert {a.name: (a.media_type, a.data) for a in attachments} == {
        k: ("application/toml", v) for k, v in ATTACHMENTS.items()
    }
    assert all(a.log_time == a.create_time == EPOCH_NS for a in attachments)


def test_topics_can_be_left_out(tmp_path: Path) -> None:
    path = record(
        tmp_path / "x.mcap", tumble(12, 100.0), skip_topics=("/cue", "/felt", "/tf", "/status")
    )
    assert Counter(topic for topic, _, _ in decoded(path)) == {
        "/vehicle": 12,
        "/motion": 12,
        "/wheels": 12,
    }


def test_bytes_are_on_the_disk_before_the_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    recorder, calls = open_recorder(tmp_path / "x.mcap"), []

    def watch(name: str) -> None:
        real = getattr(os, name)
        monkeypatch.setattr(os, name, lambda *arguments: (calls.append(name), real(*arguments))[1])

    for name in ("write", "fsync", "replace"):
        watch(name)
    recorder.close("ok", "")
    assert calls[-3:] == ["write", "fsync", "replace"]


def test_the_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    first, second = (
        record(tmp_path / f"{k}.mcap", tumble(40, 1000.0)).read_bytes() for k in range(2)
    )
    other = record(tmp_path / "other.mcap", tumble(41, 1000.0)).read_bytes()
    assert first == second
    assert first != other


def test_a_log_has_its_name_only_when_it_is_complete(tmp_path: Path) -> None:
    path, part = tmp_path / "x.mcap", tmp_path / "x.mcap.part"
    recorder = open_recorder(path)
    assert (path.exists(), part.exists()) == (False, True)
    recorder.close("ok", "")
    assert (path.exists(), part.exists()) == (True, False)


def test_values_that_overflowed_are_recorded_as_they_are(tmp_path: Path) -> None:
    tick = tumble(1, 1.0)[0]
    wild = Tick(
        tick.vehicle,
        tick.cue,
        replace(tick.motion, w_WS_W=(1e200, float("inf"), float("nan"))),
        tick.wheels,
    )
    path = record(tmp_path / "x.mcap", [wild])
    (motion,) = [message for topic, _, message in decoded(path) if topic == "/motion"]
    assert vector(motion, "w", "rad_s")[:2] == (1e200, float("inf"))
    assert motion.wz_rad_s != motion.wz_rad_s
