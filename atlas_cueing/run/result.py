"""The result of a run, the same for every way to fly."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from .evaluate import Evaluation

METHOD_FAILED: Final = "method_failed"  # result of a run whose own cueing method failed


@dataclass(frozen=True, slots=True)
class LiveFigures:
    """What only a run in real time has.

    faults: changes of state into a fault. dropped: samples of the input that were refused.
    lost: messages that the recorder could not keep.
    timing: punctuality of the loop by name, the unit in the name.
    realtime: `granted` and `refused`, what the operating system was asked for.
    drives: `drive_status` (none, one-way or monitored) and what the drives told, by name.
    plant: where a simulated platform was, by name; empty without one.
    """

    faults: int
    dropped: int
    lost: int
    timing: Mapping[str, float]
    realtime: Mapping[str, list[str]]
    drives: Mapping[str, float | str] = field(default_factory=dict)
    plant: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RunResult:
    """How a run ended, where its log is, and what was found in it.

    result: ok, vehicle_failed, method_failed, interrupted or recording_failed; of a live run also
        input_lost, viewer_died, fault, stopped, setpoints_unsent, pose_unkept or recorder_died.
        `reason` says why it is not ok.
    log: the finished log; after recording_failed the .part with what could be written; None when
        nothing was written.
    ticks: number of ticks recorded. duration: time of the last one, s.
    wall: time from loading the vehicle to the last tick recorded, s; 0 of a live run.
    live: figures of a run in real time; None of any other.
    """

    result: str
    reason: str = ""
    log: Path | None = None
    ticks: int = 0
    duration: float = 0.0
    wall: float = 0.0
    evaluation: Evaluation = field(default_factory=Evaluation)
    live: LiveFigures | None = None

    @property
    def clean(self) -> bool:
        """Whether nothing failed and every limit was kept."""
        return self.result == "ok" and not self.evaluation.violations

    def to_json(self) -> dict[str, object]:
        """Return everything by name, the unit in the name; a metric may be infinite or NaN."""
        return {
            "result": self.result,
            "reason": self.reason,
            "log": str(self.log or ""),
            "ticks": self.ticks,
            "duration_s": self.duration,
            **(_live_json(self.live) if self.live else {"wall_s": self.wall}),
            "violations": list(self.evaluation.violations),
            "remarks": list(self.evaluation.remarks),
            "metrics": self.evaluation.metrics,
            "limit_use": self.evaluation.limit_use,
        }


def _live_json(live: LiveFigures) -> dict[str, object]:
    return {
        "faults": live.faults,
        "dropped_samples": live.dropped,
        "messages_not_recorded": live.lost,
        "timing": dict(live.timing),
        "realtime": dict(live.realtime),
        "drives": dict(live.drives),
        **({"plant": dict(live.plant)} if live.plant else {}),
    }
