"""What a live page keeps: the ticks' own numbers, however they come in."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from live.riding import live_tick
from recording.flights import HEAD

from atlas_cueing.signals import LIVE_TOPICS, live_row
from atlas_cueing.viewer.history import SPAN, STEP, History, columns


def row(t: float, **timing: float) -> tuple[float, ...]:
    tick, usual = live_tick(t)
    return live_row(tick, replace(usual, **{"elapsed": t, **timing}))


def test_columns_are_those_of_the_table() -> None:
    fields = [f"{topic.name} {field}" for topic in LIVE_TOPICS for field in topic.fields]
    assert fields[columns("/wheels", "w1_rad_s", 3)] == [
        "/wheels w1_rad_s",
        "/wheels w2_rad_s",
        "/wheels w3_rad_s",
    ]
    assert fields[columns("/timing", "lateness_s", 2)] == ["/timing lateness_s", "/timing cost_s"]
    with pytest.raises(ValueError, match="topic '/nope', allowed: /vehicle, /cue"):
        columns("/nope", "time_s")


def test_the_pose_is_that_of_the_last_tick() -> None:
    history = History(HEAD)
    assert history.empty
    history.add([])
    assert history.empty
    history.add([row(0.1 * k) for k in range(8)])
    tick, _ = live_tick(0.1 * 7)
    pose = history.pose()
    assert not history.empty
    assert tuple(pose.q_WS) == tick.motion.q_WS
    assert tuple(pose.p_W) == tick.motion.p_WS_W
    assert tuple(pose.vehicle_f) == tick.vehicle.f_B
    assert history.time == pytest.approx(0.7)
    assert history.timing == (1e-5, 2e-4, 0.004, 3.0, 2)


def test_the_past_ends_after_its_span() -> None:
    history = History(HEAD)
    history.add([row(0.02 * k) for k in range(2000)])
    time = history.traces().time
    assert time[-1] == pytest.approx(39.98)
    assert time[-1] - time[0] == pytest.approx(SPAN, abs=2 * STEP)
    assert np.diff(time) == pytest.approx(STEP, abs=0.02 + 1e-9)


def test_the_latest_tick_of_a_step_is_seen() -> None:
    """One bad tick in a thousand has to show."""
    history = History(HEAD)
    history.add(
        [
            row(k / 1000.0, lateness=5e-3 if k == 513 else 1e-5, cost=9e-4 if k == 514 else 1e-4)
            for k in range(1000)
        ]
    )
    timing = history.traces().timing
    assert timing is not None
    assert timing[:, 0].max() == 5e-3
    assert timing[:, 1].max() == 9e-4
    assert np.sum(timing[:, 0] > 1e-3) == 1


@settings(max_examples=25)
@given(st.lists(st.integers(0, 60), min_size=1, max_size=12))
def test_it_is_the_same_in_whatever_portions_the_ticks_come(portions: list[int]) -> None:
    rows = [row(0.007 * k, lateness=1e-5 * (k % 13)) for k in range(sum(portions))]
    whole, parts = History(HEAD), History(HEAD)
    whole.add(rows)
    for end, size in zip(np.cumsum(portions), portions, strict=True):
        parts.add(rows[end - size : end])
    for name in ("time", "pilot_f", "felt_f", "felt_w", "wheel_speed", "p_W", "timing"):
        assert np.array_equal(getattr(whole.traces(), name), getattr(parts.traces(), name))
    turned = np.asarray(whole.pose().wheel_angle) - np.asarray(parts.pose().wheel_angle)
    assert np.abs((turned + np.pi) % (2.0 * np.pi) - np.pi).max() < 1e-9


def test_wheels_turn_with_their_speed() -> None:
    """The tumble's wheel speed is sin(t + 1.2) for wheel 1."""
    history = History(HEAD)
    for k in range(1001):
        history.add([row(k / 500.0)])
    exact = np.cos(1.2) - np.cos(2.0 + 1.2)
    assert history.pose().wheel_angle[0] == pytest.approx(exact % (2.0 * np.pi), abs=1e-5)
