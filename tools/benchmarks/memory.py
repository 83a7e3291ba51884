"""Peak memory of a run, flight and evaluation, in a process of its own."""

import sys
from collections.abc import Iterator
from pathlib import Path

from .effort import Bench
from .flights import signal_file
from .rows import Asked, Row
from .timing import fresh

ASKED = Asked(300.0)  # MB, of an hour at 1 kHz
_HOUR = 3600.0
# The child tells its own peak: what the parent of a process sees (ru_maxrss of wait4) begins with
# the parent's own.
_CODE = """
import resource, sys
from pathlib import Path
from atlas_cueing.__main__ import main
status = main()
proc = Path("/proc/self/status")
unit = 1 if sys.platform == "darwin" else 1024
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit
if proc.exists():
    peak = 1024 * int(proc.read_text().split("VmHWM:")[1].split()[0])
Path("peak").write_text(str(peak))
sys.exit(status)
"""


def measure(bench: Bench) -> Iterator[Row]:
    """Each flight's peak, and the slope between the shortest and the longest of a rate."""
    peaks: dict[float, list[tuple[float, float]]] = {}
    for rate, length in bench.effort.memory:
        bench.say(f"memory: {length:g} s at {rate:g} Hz")
        peak = peak_memory(bench.folder, rate, length)
        peaks.setdefault(rate, []).append((length, peak))
        asked = ASKED if (rate, length) == (1000.0, _HOUR) else None
        note = f"{length * rate:.0f} ticks"
        yield Row(
            "memory",
            f"run of {length / 60.0:.3g} min at {rate:g} Hz, peak",
            peak,
            "MB",
            [peak],
            asked=asked,
            note=note,
        )
    for rate, points in peaks.items():
        (short, low), (long, high) = min(points), max(points)
        if long > short:
            slope = (high - low) / (long - short) * _HOUR
            note = f"from {short:g} s to {long:g} s of flight"
            yield Row("memory", f"run at {rate:g} Hz, growth an hour", slope, "MB", note=note)


def peak_memory(folder: Path, rate: float, length: float) -> float:
    """Peak resident memory of `atlas-cueing run`, MB (10^6 bytes)."""
    log = folder / "memory.mcap"
    fresh(
        ["run", signal_file(folder, rate, length), "-o", log, "--force"],
        folder,
        (sys.executable, "-c", _CODE),
    )
    log.unlink()
    return int((folder / "peak").read_text()) / 1e6
