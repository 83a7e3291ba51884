"""Figures of a run, while it is recorded and from its log."""

import tracemalloc
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from short_scenario import Load

from atlas_cueing.evaluation import (
    BLOCK_TICKS,
    Consistency,
    ContactLoads,
    LimitUse,
    Metrics,
    RunColumns,
    gathered,
)
from atlas_cueing.recording import Log, McapRecorder, read_log
from atlas_cueing.review import review_log
from atlas_cueing.run import Evaluator, evaluate_log
from atlas_cueing.run.fly import run_scenario
from atlas_cueing.scenario import Scenario, load_platform
from atlas_cueing.signals import LIVE_TOPICS, TOPICS

LONG = 2 * BLOCK_TICKS + 1234  # ticks


@pytest.mark.parametrize("chunk", [1, 16, 1000])
def test_the_log_alone_gives_the_figures_of_the_run(load: Load, tmp_path: Path, chunk: int) -> None:
    scenario = load(f"recording.chunk_ticks={chunk}")
    result = run_scenario(scenario, tmp_path / "log.mcap")
    again = evaluate_log(result.log, scenario.platform)
    assert again == result.evaluation
    assert again.violations == ()
    assert 0.0 < again.limit_use["wheel_speed_logged"] < 1.0


def test_a_weaker_platform_would_have_been_violated(load: Load, tmp_path: Path) -> None:
    """The same log against a tenth of the limits: the check can fail."""
    log = run_scenario(load(), tmp_path / "log.mcap").log
    weaker = load(
        "platform.wheel_limits.jerk_rad_s3=0.001", "platform.stage_limits.travel_m=0.00001"
    ).platform
    found = evaluate_log(log, weaker).violations
    assert any(line.startswith("wheel_jerk_difference") for line in found)
    assert any(line.startswith("stage_travel_logged") for line in found)


def test_the_wheels_of_another_platform_do_not_fit(load: Load, tmp_path: Path) -> None:
    log = run_scenario(
        load("vehicle.script=c172_elevator_doublet", "duration_s=5"), tmp_path / "log.mcap"
    ).log
    right, wrong = (
        evaluate_log(log, load_platform(name)).metrics
        for name in ("atlas-2.9m", "atlas-orthogonal")
    )
    assert right["wheel_speed_residual_max_rad_s"] < 1e-12
    assert wrong["wheel_speed_residual_max_rad_s"] > 0.01
    assert wrong["orientation_drift_max_rad"] > 10.0 * right["orientation_drift_max_rad"]


def test_a_log_that_cannot_be_read_is_a_finding(load: Load, tmp_path: Path) -> None:
    (tmp_path / "log.mcap").write_bytes(b"no log")
    evaluation = evaluate_log(tmp_path / "log.mcap", load().platform)
    assert len(evaluation.violations) == 1
    assert evaluation.violations[0].startswith("not evaluated: ")
    assert evaluation.metrics == {}


def evaluated(ticks: np.ndarray, scenario: Scenario, chunk: int) -> Evaluator:
    evaluator = Evaluator(scenario.platform)
    for start in range(0, len(ticks), chunk):
        evaluator.add(ticks[start : start + chunk])
    return evaluator


def numbers(log: Log) -> np.ndarray:
    return np.hstack([log.tables[topic.name].values for topic in TOPICS])


@pytest.fixture
def long_log(load: Load, tmp_path: Path) -> Callable[[int], tuple[Scenario, Path]]:
    """Logs of so many ticks: a flight of a second over and over, with times that go on."""
    scenario = load("cueing.method=attitude")
    flown = read_log(run_scenario(scenario, tmp_path / "short.mcap").log)
    second = np.hstack([flown.tables[topic.name].values for topic in TOPICS[:4]])
    times = [
        k
        for k, name in enumerate(name for topic in TOPICS[:4] for name in topic.fields)
        if name == "time_s"
    ]

    def record(ticks: int) -> tuple[Scenario, Path]:
        rows = second[np.arange(ticks) % len(second)]
        rows[:, times] = (np.arange(ticks) / 1000.0)[:, None]
        log = tmp_path / f"{ticks}.mcap"
        recorder = McapRecorder(
            log, head_S=scenario.platform.head_S, metadata={}, attachments=scenario.attachments()
        )
        for start in range(0, ticks, 500):
            for row in rows[start : start + 500]:
                recorder.append_live(row.tobytes())
            recorder.flush()
        recorder.close("ok", "")
        return scenario, log

    return record


@pytest.mark.parametrize(
    ("ticks", "chunk"),
    [(500, 7), (BLOCK_TICKS, 512), (LONG, 512), (LONG, 16384), (2 * BLOCK_TICKS, 100)],
)
def test_run_and_review_agree_to_the_last_bit(
    long_log: Callable[[int], tuple[Scenario, Path]], ticks: int, chunk: int
) -> None:
    scenario, log = long_log(ticks)
    found, reviewed = (
        evaluated(numbers(read_log(log)), scenario, chunk).evaluation(),
        review_log(log),
    )
    assert found == evaluate_log(log, scenario.platform)
    assert found.metrics["ticks"] == ticks
    assert reviewed.metrics == found.metrics
    assert len(reviewed.metrics) > 110


def test_the_figures_in_blocks_are_those_of_the_whole(
    long_log: Callable[[int], tuple[Scenario, Path]],
) -> None:
    """And all of them are there."""
    scenario, log = long_log(LONG)
    platform, geometry = scenario.platform, scenario.platform.geometry()
    found, flight = evaluate_log(log, platform), RunColumns.of(read_log(log))
    expected = gathered(Metrics(), flight) | gathered(
        Consistency(geometry.wheels_from_sphere, geometry.sphere_from_wheels), flight
    )
    expected |= gathered(ContactLoads(platform.load_model()), flight)
    assert found.metrics == expected
    assert list(found.metrics) == list(expected)
    assert found.limit_use == gathered(
        LimitUse(platform.wheel_limit_values(), platform.stage_limit_values()), flight
    )


def test_a_live_log_is_judged_where_it_was_running(load: Load, tmp_path: Path) -> None:
    """Its limits everywhere: the wheels turn fastest while it is parked."""
    scenario, ticks = load("cueing.method=attitude"), 2 * BLOCK_TICKS
    time, names = (
        np.arange(ticks) / 1000.0,
        [(topic.name, field) for topic in LIVE_TOPICS[:-1] for field in topic.fields],
    )
    rows = np.zeros((ticks, len(names)))
    for k, (topic, field) in enumerate(names):
        if field in ("time_s", "elapsed_s"):
            rows[:, k] = time
        elif field in ("q_nb_w", "q_ws_w"):
            rows[:, k] = 1.0
        elif (topic, field) == ("/wheels", "w1_rad_s"):
            rows[:, k] = np.where(time < 3.0, 7.0, 0.5)
    log = tmp_path / "live.mcap"
    recorder = McapRecorder(
        log,
        head_S=(0.0, 0.0, 0.0),
        metadata={},
        attachments=scenario.attachments(),
        started_ns=1_700_000_000 * 10**9,
    )
    for at, state in ((0.0, "parked"), (4.0, "running"), (12.0, "parking")):
        recorder.status(at, state, "")
    recorder.append_live(rows.tobytes())
    recorder.close("ok", "")
    found = evaluate_log(log, scenario.platform)
    assert (found.metrics["ticks"], found.metrics["wheel_speed_max_rad_s"]) == (8000.0, 0.5)
    assert found.metrics["wheel_speed_residual_max_rad_s"] == 7.0
    assert (
        found.limit_use["wheel_speed_logged"]
        == 7.0 / scenario.platform.wheel_limit_values().speed[0]
    )
    assert review_log(log).metrics == found.metrics


def test_a_log_that_breaks_off_has_no_figures(
    long_log: Callable[[int], tuple[Scenario, Path]],
) -> None:
    scenario, log = long_log(500)
    log.write_bytes(log.read_bytes()[:-100])
    evaluation = evaluate_log(log, scenario.platform)
    assert (evaluation.metrics, evaluation.limit_use, len(evaluation.violations)) == ({}, {}, 1)


def test_a_log_without_ticks(load: Load, tmp_path: Path) -> None:
    scenario, log = load(), tmp_path / "none.mcap"
    McapRecorder(log, head_S=(0.0, 0.0, 0.0), metadata={}, attachments={}).close("ok", "")
    evaluation = evaluate_log(log, scenario.platform)
    assert set(evaluation.metrics.values()) == set(evaluation.limit_use.values()) == {0.0}
    assert Evaluator(scenario.platform).evaluation() == evaluation


def test_a_log_without_a_topic_is_told(load: Load, tmp_path: Path) -> None:
    log = tmp_path / "log.mcap"
    McapRecorder(
        log, head_S=(0.0, 0.0, 0.0), metadata={}, attachments={}, skip_topics=("/felt",)
    ).close("ok", "")
    found = evaluate_log(log, load().platform)
    assert found.metrics == {}
    assert (
        "the log has no topic '/felt'; topics: /vehicle, /cue, /motion, /wheels"
        in found.violations[0]
    )


def test_memory_grows_by_the_quantiles_only(
    long_log: Callable[[int], tuple[Scenario, Path]],
) -> None:
    """33 bytes a tick, not the 560 of its columns."""
    peaks = {}
    for ticks in (3 * BLOCK_TICKS, 6 * BLOCK_TICKS):
        scenario, log = long_log(ticks)
        flown = numbers(read_log(log))
        tracemalloc.start()
        try:
            evaluated(flown, scenario, 512).evaluation()
            peaks[ticks] = tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()
    assert peaks[6 * BLOCK_TICKS] - peaks[3 * BLOCK_TICKS] < 60 * 3 * BLOCK_TICKS
