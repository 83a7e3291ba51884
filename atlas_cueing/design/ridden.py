"""What flights ask of a platform, whatever its wheels: moment and force on the sphere, its motion.

The sphere's motion (q_WS, w, alpha, a of the log's /motion) is held fixed: what another layout has
to carry and to turn follows from it. Moment and force, equations (1) and (2) of `loads.balance`,
depend on the body alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, LogError
from ..loads import LoadModel
from ..loads.balance import required_wrench
from ..recording import Log
from ..review import advice, is_flight_alone, open_log
from ..rotations import Array


@dataclass(frozen=True, slots=True)
class Ridden:
    """n ticks of flights, or some of them: all (n, 3), frame W.

    moment, N m, and force, N, that contacts have to put on the sphere, about its centre. w, rad/s,
    alpha, rad/s^2: of the sphere.
    """

    moment: Array
    force: Array
    w: Array
    alpha: Array

    def __len__(self) -> int:
        return len(self.moment)

    def at(self, ticks: NDArray[np.intp]) -> "Ridden":
        """Return some of the ticks."""
        return Ridden(self.moment[ticks], self.force[ticks], self.w[ticks], self.alpha[ticks])


@dataclass(frozen=True, slots=True)
class FlightName:
    """A flight of a design: the log's path, number of ticks, scenario, method and platform."""

    log: str
    ticks: int
    scenario: str
    method: str
    platform: str


def log_files(paths: Sequence[Path]) -> list[Path]:
    """The logs themselves and those in the folders, each once, sorted by name.

    Raises InputError for a path that is not there, and for a folder without logs.
    """
    found: dict[Path, Path] = {}
    for path in paths:
        if not path.exists():
            raise InputError(f"--flights {path}: no such file or folder")
        logs = sorted(path.glob("*.mcap")) if path.is_dir() else [path]
        if not logs:
            raise InputError(f"--flights {path}: is a folder without logs (*.mcap); fly some first")
        found |= {log.resolve(): log for log in logs}
    return [found[key] for key in sorted(found)]


def read_flights(model: LoadModel, logs: Sequence[Path]) -> tuple[Ridden, list[FlightName]]:
    """Read the motion of all logs, and say what it asks of the body of `model`.

    Raises InputError for a log that holds a flight alone or numbers that are not finite, and for
    one that is damaged or not ours.
    """
    pieces, names = [], []
    for path in logs:
        states, name = _motion(path)
        M, F = required_wrench(model, *states)
        pieces.append((M, F, states[1], states[2]))
        names.append(name)
    return Ridden(*(np.vstack(columns) for columns in zip(*pieces, strict=True))), names


def _opened(path: Path) -> Log:
    try:
        return open_log(path)
    except LogError as error:
        todo = advice(path)
        raise InputError(f"{error}; {todo}" if todo else str(error)) from error


def _motion(path: Path) -> tuple[tuple[Array, Array, Array, Array], FlightName]:
    log = _opened(path)
    if is_flight_alone(log):
        raise InputError(
            f"log {path}: holds a flight alone, which no platform has flown; cue it first:"
            f" atlas-cueing recue {path} --set platform.preset=NAME -o NEW.mcap"
        )
    q, w, alpha, a = (log.vector("/motion", name) for name in ("q_ws", "w", "alpha", "a"))
    if not len(q) or not all(np.all(np.isfinite(each)) for each in (q, w, alpha, a)):
        raise InputError(
            f"log {path}: /motion is empty or has numbers that are not finite, allowed: a motion"
        )
    named = {key: log.metadata.get(key, "") for key in ("scenario", "method", "platform")}
    return (q, w, alpha, a), FlightName(log=str(path), ticks=len(q), **named)
