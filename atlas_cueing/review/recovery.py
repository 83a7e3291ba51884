"""Recovery of a cut or damaged log: a finished one is written with all that is whole."""

from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from ..errors import InputError, LogError, OutputError, ScenarioError
from ..recording import Log
from ..recording.compression import CompressionError
from ..recording.salvage import contents, copied, rewrite, salvage
from ..recording.salvaged import Salvage
from ..scenario.reading import parse_toml
from .attachments import PLATFORM, SCENARIO
from .checks.timestamps import GAP
from .recorded_run import largest_content


@dataclass(frozen=True, slots=True)
class Recovered:
    """A recovered log and its losses.

    log: the log written; ticks, seconds: ticks in it and the time they cover; lost: a line for each
    loss.
    """

    log: Path
    ticks: int
    seconds: float
    lost: tuple[str, ...]

    def to_json(self) -> dict[str, object]:
        """The fields by name, the unit in the name."""
        return {
            "log": str(self.log),
            "ticks": self.ticks,
            "recovered_s": self.seconds,
            "lost": list(self.lost),
        }


def recover_log(broken: str | Path, output: str | Path) -> Recovered:
    """Write every complete chunk of the log `broken` into the finished log `output`.

    An existing `output` is replaced.

    Raises InputError when there is no file `broken`, LogError when it holds nothing to recover, and
    OutputError when `output` cannot be written.
    """
    found = salvage(Path(broken), largest_content(Path(broken)))
    log = contents(found)
    lost = (*_losses(found, log), *log.notes) if not copied(found) else _losses(found, log)
    reason = "; ".join(lost)
    try:
        rewrite(found, Path(output), _metadata(found, reason), log)
    except OSError as error:
        raise OutputError(f"log {output}: {error.strerror}") from error
    time = _times(log)[1]
    return Recovered(Path(output), len(time), float(np.ptp(time)) if len(time) else 0.0, lost)


def advice(broken: Path) -> str:
    """Advice on a log that cannot be read; "" when there is nothing in it to recover."""
    try:
        found = salvage(broken, largest_content(broken))
    except (LogError, InputError):
        return ""
    whole = len(found.chunks)
    if not whole:
        return f"messages outside of chunks are whole; try: {_remedy(broken)}"
    return f"{whole} chunk{' is' if whole == 1 else 's are'} whole; try: {_remedy(broken)}"


def _remedy(broken: Path) -> str:
    return f"atlas-cueing recover {broken} -o {broken.stem}_recovered.mcap"


def _losses(found: Salvage, log: Log) -> tuple[str, ...]:
    """A line for each interval that is missing, for a missing end, and for what is in doubt."""
    if found.complete:
        return ()
    topic, time = _times(log)
    if not len(time):
        return ("every tick",)
    step = float(np.median(np.diff(time))) if len(time) > 1 else 0.0
    lost = _missing(time, step, time[-1])
    for other, table in log.tables.items():
        if other != topic and "time_s" in table.fields:
            lines = _missing(log.column(other, "time_s"), step, time[-1])
            lost += [f"{other}: {line}" for line in lines if line not in lost]
    lost += [str(error) for error in found.objections if isinstance(error, CompressionError)]
    if found.doubtful:
        lost.append(
            "perhaps a number here and there: messages outside of chunks, and a wrong checksum of"
            " the data"
        )
    if not found.finished:
        lost.append(f"after {time[-1]:.6f} s: whatever there was; the log has no end")
    elif not lost:
        lost.append("no ticks; the damage is outside the complete chunks")
    return tuple(lost)


def _times(log: Log) -> tuple[str, np.ndarray]:
    """The topic with the most ticks, /motion if it is one of them, and their times (n,), s."""
    timed = [topic for topic, table in log.tables.items() if "time_s" in table.fields]
    if not timed:
        raise LogError(f"{log.path}: there is nothing to recover: no topic has ticks")
    topic = max(timed, key=lambda name: (len(log.tables[name].values), name == "/motion"))
    return topic, log.column(topic, "time_s")


def _missing(time: np.ndarray, step: float, end: float) -> list[str]:
    """A line for each interval that lacks ticks: `time` (n,), s, should go by `step` to `end`."""
    if not len(time):
        return ["everything"]
    lost = [f"before {time[0]:.6f} s: everything"] if time[0] > step else []
    gaps = [(time[k], time[k + 1]) for k in np.flatnonzero(np.diff(time) > GAP * step)]
    lost += [
        f"{last:.6f} to {first:.6f} s: {first - last - step:.6f} s of ticks" for last, first in gaps
    ]
    return lost + ([f"after {time[-1]:.6f} s: everything"] if time[-1] < end - 0.5 * step else [])


def _metadata(found: Salvage, reason: str) -> dict[str, str]:
    """The metadata of the new log: the old log's or, without them, those from its attachments.

    The result is `recovered` unless the old log was complete.
    """
    metadata = dict(found.metadata) or _from_files(found)
    if found.complete:
        return metadata
    before = metadata.get("result", "")
    why = f"{reason}; its result was {before!r}" if before else reason
    return {
        **metadata,
        "result": "recovered",
        "reason": why,
        "recovered_with": version("atlas_cueing"),
    }


def _from_files(found: Salvage) -> dict[str, str]:
    """Scenario, method and platform as the attachments name them.

    A log that was cut has no metadata: they are written at its end.
    """
    scenario, platform = (_table(found.attachments.get(name, b"")) for name in (SCENARIO, PLATFORM))
    cueing = scenario.get("cueing")
    method = cueing.get("method", "") if isinstance(cueing, dict) else ""
    return {
        "scenario": str(scenario.get("name", "")),
        "method": str(method),
        "platform": str(platform.get("name", "")),
    }


def _table(content: bytes) -> dict[str, object]:
    try:
        return parse_toml(content.decode(), "")
    except (ScenarioError, UnicodeDecodeError):
        return {}
