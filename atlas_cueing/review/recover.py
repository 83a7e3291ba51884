"""From a cut or damaged log to a finished one with all that is whole."""

from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from ..errors import InputError, LogError, OutputError, ScenarioError
from ..recording.salvage import Salvage, rewrite, salvage
from ..scenario.reading import parse_toml
from .attachments import PLATFORM, SCENARIO
from .clock import GAP
from .recorded_run import largest_content, open_log


@dataclass(frozen=True, slots=True)
class Recovered:
    """What came back: `ticks` over `seconds` of flight, `lost` says what did not, one line for each loss."""

    log: Path
    ticks: int
    seconds: float
    lost: tuple[str, ...]

    def to_json(self) -> dict[str, object]:
        """Everything by name, the unit in the name."""
        return {"log": str(self.log), "ticks": self.ticks, "recovered_s": self.seconds, "lost": list(self.lost)}


def recover(broken: Path, output: Path) -> Recovered:
    """Write every complete chunk of `broken` into the finished log `output`, which is replaced if it exists.

    Raises InputError when there is no file `broken`, LogError when it holds nothing to recover, and OutputError when `output`
    cannot be written.
    """
    found = salvage(broken, largest_content(broken))
    try:
        rewrite(found, output, _metadata(found, ""))  # what is lost is known when the ticks can be read
        time = open_log(output).column("/motion", "time_s")
        lost = _losses(found, time)
        if lost:
            rewrite(found, output, _metadata(found, "; ".join(lost)))
    except OSError as error:
        raise OutputError(f"log {output}: {error.strerror}") from error
    return Recovered(output, len(time), float(np.ptp(time)) if len(time) else 0.0, lost)


def advice(broken: Path) -> str:
    """What to do about a log that cannot be read: empty when there is nothing in it to recover."""
    try:
        found = salvage(broken, largest_content(broken))
    except (LogError, InputError):
        return ""
    whole = len(found.chunks)
    remedy = f"atlas-cueing recover {broken} -o {broken.stem}_recovered.mcap"
    return f"{whole} chunk{' is' if whole == 1 else 's are'} whole; try: {remedy}"


def _losses(found: Salvage, time: np.ndarray) -> tuple[str, ...]:
    """One line for each stretch of time that is missing between chunks, and one for an end that is missing."""
    if found.complete or not len(time):
        return ()
    step = float(np.median(np.diff(time))) if len(time) > 1 else 0.0
    lost = [f"before {time[0]:.6f} s: everything"] if time[0] > step else []
    gaps = [(time[k], time[k + 1]) for k in np.flatnonzero(np.diff(time) > GAP * step)]
    lost += [f"{last:.6f} to {first:.6f} s: {first - last - step:.6f} s of ticks" for last, first in gaps]
    if not found.finished:
        lost.append(f"after {time[-1]:.6f} s: whatever there was; the log has no end")
    elif not lost:
        lost.append("no ticks; the damage is outside the complete chunks")
    return tuple(lost)


def _metadata(found: Salvage, reason: str) -> dict[str, str]:
    """The log's own account, or what its files tell of it; its result is `recovered` unless nothing was amiss."""
    told = dict(found.metadata) or _from_files(found)
    if found.complete:
        return told
    before = told.get("result", "")
    why = f"{reason}; its result was {before!r}" if before else reason
    return {**told, "result": "recovered", "reason": why, "recovered_with": version("atlas_cueing")}


def _from_files(found: Salvage) -> dict[str, str]:
    """Scenario, method and platform as the attachments name them; a log gets its metadata only at its end."""
    scenario, platform = (_table(found.attachments.get(name, b"")) for name in (SCENARIO, PLATFORM))
    cueing = scenario.get("cueing")
    method = cueing.get("method", "") if isinstance(cueing, dict) else ""
    return {"scenario": str(scenario.get("name", "")), "method": str(method), "platform": str(platform.get("name", ""))}


def _table(content: bytes) -> dict[str, object]:
    try:
        return parse_toml(content.decode(), "")
    except (ScenarioError, UnicodeDecodeError):
        return {}
