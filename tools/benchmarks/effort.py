"""How much is flown and how often."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

Say: TypeAlias = Callable[[str], None]  # takes a line on what is being measured


@dataclass(frozen=True, slots=True)
class Effort:
    """Sizes of all measurements; flights in s of flight.

    rounds: of what is measured in this process; `processes`: fresh processes of each kind.
    rides: live ones, of `ride` s each.
    memory: rate (Hz) and length (s) of each flight whose peak memory is measured, the shortest
        first.
    """

    rounds: int
    processes: int
    flight: float
    log: float
    batch_runs: int
    batch_flight: float
    batch_rounds: int
    rides: int
    ride: float
    memory: tuple[tuple[float, float], ...]


FULL = Effort(9, 5, 60.0, 600.0, 16, 180.0, 3, 3, 60.0, ((120.0, 60.0), (120.0, 600.0)))
QUICK = Effort(5, 3, 10.0, 60.0, 4, 10.0, 1, 2, 12.0, ((120.0, 10.0), (120.0, 120.0)))
HOURS = ((120.0, 3600.0), (1000.0, 60.0), (1000.0, 600.0), (1000.0, 3600.0))  # --long adds them


@dataclass(frozen=True, slots=True)
class Bench:
    """What a section is given: its effort, a folder for its files, and a way to report progress."""

    effort: Effort
    folder: Path
    say: Say
