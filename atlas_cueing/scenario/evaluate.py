"""The figures of a finished log, from the log alone."""

from dataclasses import dataclass, field
from pathlib import Path

from ..errors import LogError
from ..evaluation import BLOCK_TICKS, TOPICS, Consistency, Flight, LimitUse, Metrics, ridden, violations
from ..recording import Log, read_blocks, read_log
from ..signals import TIMING
from .platform import Platform

_ANY_LENGTH = 1 << 60  # bytes of messages: block by block they take no memory


@dataclass(frozen=True, slots=True)
class Evaluation:
    """Metrics and limit use as `evaluation` names them, and one line for each violation."""

    metrics: dict[str, float] = field(default_factory=dict)
    limit_use: dict[str, float] = field(default_factory=dict)
    violations: tuple[str, ...] = ()


def evaluate(log: Path, platform: Platform) -> Evaluation:
    """Read the log once, block by block, and compute everything; a log that cannot be read back is itself a violation.

    Limits are looked at over the whole run, metrics of a live one over its longest stretch in state `running`; that is known
    only at the end, so a live log is read as a whole.
    """
    found = _Found(platform)
    try:
        for content in read_blocks(log, BLOCK_TICKS, TOPICS, _ANY_LENGTH):
            if TIMING.name in content.tables:
                found.add_live(read_log(log))
                break
            found.add(Flight.of(content))
    except LogError as error:
        return Evaluation(violations=(f"not evaluated: {error}",))
    return found.evaluation()


class _Found:
    """What has been found in the log so far."""

    def __init__(self, platform: Platform) -> None:
        geometry = platform.geometry()
        self._use = LimitUse(platform.wheel_speed_limits(), platform.stage_motion_limits())
        self._metrics = Metrics()
        self._consistency = (
            Consistency(geometry.wheels_from_sphere, geometry.sphere_from_wheels) if geometry.slip_free else None
        )

    def add(self, flight: Flight) -> None:
        """Take in the ticks that follow, all of them ridden."""
        for block in flight.blocks():
            self._metrics.add(block)
            self._check(block)

    def add_live(self, log: Log) -> None:
        """Take in the whole log of a live run."""
        flight = Flight.of(log)
        for block in ridden(flight, log.statuses).blocks():
            self._metrics.add(block)
        for block in flight.blocks():
            self._check(block)

    def _check(self, block: Flight) -> None:
        self._use.add(block)
        if self._consistency:
            self._consistency.add(block)

    def evaluation(self) -> Evaluation:
        """All figures, and the violations among them."""
        use = self._use.figures()
        trust = self._consistency.figures() if self._consistency else {}
        return Evaluation(self._metrics.figures() | trust, use, tuple(violations(use)))
