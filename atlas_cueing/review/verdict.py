"""The review of a log: all checks and all metrics."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..run import evaluate_flight
from .checks.actuators import check_actuators
from .checks.deadlines import check_deadlines, punctuality_notes
from .checks.felt_force import check_felt_force
from .checks.finite import check_finite
from .checks.limited_flags import check_limited_flags
from .checks.log_times import check_log_times
from .checks.logged_loads import check_contact_loads, traction_notes
from .checks.orientation import check_orientation
from .checks.plant_topics import check_plant, plant_notes
from .checks.run_status import check_status, state_notes
from .checks.timestamps import check_timestamps
from .finding import Finding
from .recorded_run import RecordedRun, open_run

MEASURED = "measured"  # what the log of an imported flight says of its attitude


@dataclass(frozen=True, slots=True)
class Review:
    """A reviewed log: its findings in order of time (those of the whole log first), and metrics."""

    run: RecordedRun
    findings: tuple[Finding, ...]
    notes: tuple[str, ...]
    metrics: dict[str, float]

    @property
    def clean(self) -> bool:
        """Whether nothing was found."""
        return not self.findings

    @property
    def verdict(self) -> str:
        """The verdict as text: clean, or how many findings."""
        return (
            "clean"
            if self.clean
            else f"{len(self.findings)} finding{'s' if len(self.findings) > 1 else ''}"
        )

    @property
    def duration(self) -> float:
        """Time from the first tick to the last, s; 0 without ticks."""
        time = self.run.flight.time
        return float(time[-1] - time[0]) if len(time) else 0.0

    def to_json(self) -> dict[str, object]:
        """The review as JSON, units in the names; a metric may be infinite or NaN."""
        metadata = self.run.log.metadata
        return {
            "verdict": self.verdict,
            "result": metadata.get("result", ""),
            "reason": metadata.get("reason", ""),
            "log": str(self.run.log.path),
            "ticks": len(self.run.flight.time),
            "duration_s": self.duration,
            "step_s": self.run.step,
            "violations": [str(finding) for finding in self.findings if finding.check == "limit"],
            "findings": [finding.to_json() for finding in self.findings],
            "notes": list(self.notes),
            "metadata": dict(metadata),
            "metrics": self.metrics,
        }


def review_log(path: str | Path) -> Review:
    """Read a log and judge it by its own numbers.

    The checks share no arithmetic with what wrote the log.

    Raises InputError when there is no such file, and LogError when it is damaged, not a log of
    ours, or has no platform.

    Example:
        >>> from atlas_cueing import load_scenario, review_log, run_scenario
        >>> scenario = load_scenario("scenarios/signal_sway.toml", ["duration_s=1"])
        >>> found = review_log(run_scenario(scenario, "sway.mcap").log)
        >>> found.verdict, found.findings
        ('clean', ())

    """
    return judge(open_run(path))


def judge(run: RecordedRun) -> Review:
    """Review a run whose log is open already."""
    found = [
        *check_status(run),
        *check_timestamps(run),
        *check_finite(run),
        *check_log_times(run),
        *check_deadlines(run),
    ]
    remarks: tuple[str, ...] = ()
    with np.errstate(all="ignore"):  # numbers out of range have been found by now
        if not any(finding.check == "ticks lost" for finding in found):
            found += [
                *check_orientation(run),
                *check_actuators(run),
                *check_felt_force(run),
                *check_limited_flags(run),
                *check_contact_loads(run),
                *check_plant(run),
            ]
            remarks = traction_notes(run)
        figures = evaluate_flight(run.log, run.flight, run.platform).metrics
    found.sort(key=lambda finding: -1.0 if finding.time is None else finding.time)
    lines = (
        *run.log.notes,
        *_origin_notes(run),
        *plant_notes(run),
        *state_notes(run),
        *punctuality_notes(run),
        *remarks,
    )
    return Review(run, tuple(found), lines, figures)


def _origin_notes(run: RecordedRun) -> tuple[str, ...]:
    """Say where the vehicle's attitude was made and not measured, as of an imported flight."""
    told = run.log.metadata.get("attitude", MEASURED)
    made = f"the vehicle's attitude was not measured: {told}; figures of direction depend on it"
    return () if told == MEASURED else (made,)
