"""The figures of a finished log, from the log alone."""

from dataclasses import dataclass, field
from pathlib import Path

from ..errors import LogError
from ..evaluation import Flight, consistency, limit_use, metrics, ridden, violations
from ..recording import read_log
from ..signals import TIMING
from .platform import Platform


@dataclass(frozen=True, slots=True)
class Evaluation:
    """Metrics and limit use as `evaluation` names them, and one line for each violation."""

    metrics: dict[str, float] = field(default_factory=dict)
    limit_use: dict[str, float] = field(default_factory=dict)
    violations: tuple[str, ...] = ()


def evaluate(log: Path, platform: Platform) -> Evaluation:
    """Read the log and compute everything; a log that cannot be read back is itself a violation.

    Limits are looked at over the whole run, metrics of a live one over its longest stretch in state `running`.
    """
    try:
        content = read_log(log)
        flight = Flight.of(content)
    except LogError as error:
        return Evaluation(violations=(f"not evaluated: {error}",))
    geometry = platform.geometry()
    use = limit_use(flight, platform.wheel_speed_limits(), platform.stage_motion_limits())
    figures = metrics(ridden(flight, content.statuses) if TIMING.name in content.tables else flight)
    if geometry.slip_free:
        figures |= consistency(flight, geometry.wheels_from_sphere, geometry.sphere_from_wheels)
    return Evaluation(figures, use, tuple(violations(use)))
