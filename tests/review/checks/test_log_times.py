"""Log times and /tf: right as recorded, and each fault found."""

from dataclasses import replace

import numpy as np
import pytest
from recording.flights import HEAD, tumble

from atlas_cueing.recording import McapRecorder, TopicColumns
from atlas_cueing.review import RecordedRun
from atlas_cueing.review.checks.log_times import check_log_times
from atlas_cueing.review.recorded_run import open_run
from atlas_cueing.scenario import load_platform
from atlas_cueing.signals import Timing
from atlas_cueing.telemetry import LiveWriter, live_ring
from atlas_cueing.telemetry.messages import TICK
from atlas_cueing.telemetry.ring import RingReader

STARTED = 1_800_000_000_123_456_789  # ns; more than a double holds
LATE = 40  # tick after which the clock has lost three deadlines


@pytest.fixture(scope="module", params=["batch", "live"])
def run(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    path = tmp_path_factory.mktemp("stamps") / "x.mcap"
    ticks = tumble(120, 100.0)
    live = request.param == "live"
    recorder = McapRecorder(
        path,
        head_S=HEAD,
        metadata={},
        attachments=_platform(),
        chunk_ticks=17,
        started_ns=STARTED if live else None,
    )
    ring = live_ring(10.0, 100.0)
    reader, writer = RingReader(ring), LiveWriter(ring)
    for k, tick in enumerate(ticks):
        if live:
            time = tick.vehicle.time
            writer.tick(
                tick, Timing(time, time + 0.03 * (k > LATE), 1e-5, 1e-4, 0.0, 3.0 * (k > LATE), 2.0)
            )
        else:
            recorder.append(tick)
    for kind, data in reader.messages():
        assert kind == TICK
        recorder.append_live(data)
    recorder.close("ok", "")
    return open_run(path)


def _platform() -> dict[str, bytes]:
    import tomli_w

    return {
        "platform.toml": (
            tomli_w.dumps(load_platform("atlas-2.9m").model_dump(exclude_none=True)).encode()
        )
    }


def test_a_log_as_recorded(run: RecordedRun) -> None:
    assert check_log_times(run) == []
    assert run.log.transforms is not None
    assert len(run.log.transforms.values) > 60


@pytest.mark.parametrize("topic", ["/vehicle", "/motion", "/felt"])
def test_a_log_time_that_is_off_by_two_nanoseconds(run: RecordedRun, topic: str) -> None:
    table = run.log.tables[topic]
    times = table.log_times.copy()
    times[7] += np.uint64(2)
    found = check_log_times(with_tables(run, **{topic: replace(table, log_times=times)}))
    # the motion's are what /tf is found by
    assert [f.place for f in found][:1] == [f"{topic} log_time"]
    assert "difference = 2 ns" in found[0].text
    assert found[0].time == run.flight.time[7]


def test_log_times_of_another_epoch(run: RecordedRun) -> None:
    """All of them an hour later: wrong for simulated time, and another start of a live run."""
    shifted = {
        t: replace(x, log_times=x.log_times + np.uint64(3600 * 10**9))
        for t, x in run.log.tables.items()
    }
    found = {
        finding.place
        for finding in check_log_times(
            with_tables(replace(run, log=replace(run.log, transforms=None)), **shifted)
        )
    }
    live = "/timing" in run.log.tables
    assert found == (set() if live else {f"{topic} log_time" for topic in run.log.tables})


def test_a_transform_that_is_not_the_motion(run: RecordedRun) -> None:
    poses = run.log.transforms
    assert poses is not None
    values = poses.values.copy()
    values[5, 0] += 1e-12
    values[6, 4] = np.nextafter(values[6, 4], 2.0)
    found = check_log_times(with_transforms(run, replace(poses, values=values)))
    assert [(f.check, f.place) for f in found] == [
        ("differs from /motion", "/tf px_m"),
        ("differs from /motion", "/tf q_ws_x"),
    ]


def test_a_transform_of_no_tick(run: RecordedRun) -> None:
    poses = run.log.transforms
    assert poses is not None
    times = poses.log_times.copy()
    times[9] += np.uint64(1)
    found = check_log_times(with_transforms(run, replace(poses, log_times=times)))
    assert [f.check for f in found] == ["no tick has this log time"]


@pytest.mark.parametrize("cut", [slice(4, None), slice(None, -4)])
def test_transforms_that_are_missing(run: RecordedRun, cut: slice) -> None:
    poses = run.log.transforms
    assert poses is not None
    found = check_log_times(
        with_transforms(run, TopicColumns(poses.fields, poses.values[cut], poses.log_times[cut]))
    )
    assert [f.check for f in found] == ["no /tf for too long"]


def test_a_log_without_transforms_is_no_fault(run: RecordedRun) -> None:
    assert check_log_times(replace(run, log=replace(run.log, transforms=None))) == []


def with_tables(run: RecordedRun, **tables: TopicColumns) -> RecordedRun:
    return replace(run, log=replace(run.log, tables={**run.log.tables, **tables}))


def with_transforms(run: RecordedRun, transforms: TopicColumns) -> RecordedRun:
    return replace(run, log=replace(run.log, transforms=transforms))
