"""What review says of the log of a live run.

Nothing, if nothing happened but what the states tell of.
"""

from collections.abc import Callable
from pathlib import Path

import pytest

from atlas_cueing.live.control.state_machine import State
from atlas_cueing.live.output.ring_recorder import RingRecorder
from atlas_cueing.recording import McapRecorder
from atlas_cueing.review import review_log
from atlas_cueing.telemetry import LiveWriter, live_ring

from .riding import STARTED_NS
from .rig import Rig

STEPS = 200  # ticks between two looks at the ring


def recorded(rig: Rig, path: Path) -> Path:
    """The log of all that the rig's tape has, as a live run writes it."""
    scenario, tape, ended = rig.scenario, rig.tape, rig.controller.outcome
    ring = live_ring(10.0, 1.0 / rig.dt)
    log = McapRecorder(
        path,
        head_S=scenario.platform.head_S,
        metadata={"scenario": scenario.name},
        attachments=scenario.attachments(),
        started_ns=STARTED_NS,
    )
    recorder, writer, statuses = RingRecorder(ring, log), LiveWriter(ring), list(tape.statuses)
    for k, (tick, timing) in enumerate(zip(tape.ticks, tape.timings, strict=True)):
        while statuses and statuses[0][0] <= timing.time:
            writer.status(*statuses.pop(0))
        writer.tick(tick, timing)
        if k % STEPS == 0:
            recorder.step(1.0 * k)
    writer.end(tape.timings[-1].time, ended.result, ended.reason)
    assert recorder.step(1e9) is not None
    return path


def parked_and_again(rig: Rig) -> None:
    rig.bring_to(State.RUNNING)
    rig.press("park")
    rig.tick()
    rig.until(State.PARKED, 60.0)
    rig.bring_to(State.RUNNING)


def held(rig: Rig) -> None:
    rig.bring_to(State.RUNNING)
    rig.source.jumps = True
    rig.fly(4.0)
    rig.source.quiet = True
    rig.fly(0.15)
    rig.source.quiet = False
    rig.fly(4.0)


def never_engaged(rig: Rig) -> None:
    rig.fly(0.5)


@pytest.mark.parametrize("ride", [parked_and_again, held, never_engaged])
@pytest.mark.parametrize("method", ["attitude", "classical"])
def test_a_good_run_is_clean(ride: Callable[[Rig], None], method: str, tmp_path: Path) -> None:
    stage = () if method == "classical" else ("cueing.stage.planner=onset",)
    rig = Rig(settings=(f"cueing.method={method}", *stage))
    ride(rig)
    found = review_log(recorded(rig, tmp_path / "run.mcap"))
    assert found.clean, [str(finding) for finding in found.findings]


def test_a_fault_is_found_with_its_reason(tmp_path: Path) -> None:
    rig = Rig(settings=("cueing.method=classical",))
    rig.bring_to(State.STOPPED)
    found = review_log(recorded(rig, tmp_path / "run.mcap"))
    faults = [finding for finding in found.findings if finding.check == "fault"]
    assert len(faults) == 2
    assert "a tick came 18.0 ms too late for its slot" in str(faults[0])
    assert "stopped" in str(faults[1])
    # the stop keeps every limit
    assert {finding.check for finding in found.findings} == {"fault", "result"}
