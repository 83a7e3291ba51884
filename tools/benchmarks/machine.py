"""What it was measured on, and how much of it others took meanwhile."""

import os
import platform
import sys
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path

from atlas_cueing import rotation

_STAT = Path("/proc/stat")
_STOLEN = 7  # user, nice, system, idle, iowait, irq, softirq, steal


def build_kind() -> str:
    """`Python`, or `compiled` when the package's modules are shared objects."""
    return "Python" if str(rotation.__file__).endswith(".py") else "compiled"


def facts() -> dict[str, str | int]:
    """Build, versions, cores."""
    versions = {
        name: version(name) for name in ("atlas_cueing", "jsbsim", "ruckig", "numpy", "mcap")
    }
    return {
        "code": build_kind(),
        "python": platform.python_version(),
        "platform": f"{sys.platform} {platform.machine()}",
        "cores": os.cpu_count() or 1,
        **versions,
    }


class Stolen:
    """Share of the processors' time that the host gave to others since this was made.

    None where nothing tells it.
    """

    def __init__(self) -> None:
        self._begun = _times()

    def share(self) -> float | None:
        """From 0 to 1."""
        spent = [now - then for now, then in zip(_times(), self._begun, strict=True)]
        return spent[_STOLEN] / sum(spent) if len(spent) > _STOLEN and sum(spent) else None


def _times() -> list[int]:
    """Ticks of all processors together, by kind."""
    if not _STAT.exists():
        return []
    return [int(number) for number in _STAT.read_text().splitlines()[0].split()[1 : _STOLEN + 2]]


def described(told: Mapping[str, object]) -> str:
    """The facts on one line."""
    return ", ".join(f"{name} {value}" for name, value in told.items() if name != "code")
