"""A log opened for review: its columns, and its platform with matrices derived here again."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import InputError, LogError
from ..evaluation import RunColumns
from ..recording import Log, read_log
from ..rotations import Array
from ..scenario import Platform
from ..signals import LOADS
from .attachments import platform_of
from .flight_alone import is_flight_alone

# A log packs to four fifths of its size in flight and to a sixth standing still. What it may unpack
# to is bounded by its own size: else 30 kB could fill the memory.
LARGEST_RATIO = 16
SMALLEST_BOUND = 32 << 20  # bytes
TOPICS = ("/vehicle", "/cue", "/motion", "/wheels", "/felt")


@dataclass(frozen=True, slots=True)
class RecordedRun:
    """A log with its platform and its columns.

    flight: the columns, all cut to the length of the shortest topic of `log`.
    """

    log: Log
    platform: Platform
    flight: RunColumns

    @property
    def step(self) -> float:
        """Median time from one tick to the next, s; 0 for fewer than two ticks."""
        return float(np.median(np.diff(self.flight.time))) if len(self.flight.time) > 1 else 0.0

    def wheels_from_sphere(self) -> Array:
        """J^-1 (3, 3), frame W, from the platform file (Eq. 11, 22).

        Row i is R / r_i (contact_i x drive_i), with both directions of unit length and the drive
        tangent to the sphere.
        """
        radius, rows = self.platform.sphere.radius_m, []
        for wheel in self.platform.wheel:
            contact = np.array(wheel.contact) / np.linalg.norm(wheel.contact)
            drive = np.array(wheel.drive) - np.dot(wheel.drive, contact) * contact
            effective = wheel.radius_m * np.cos(np.radians(wheel.roller_deg or 0.0))
            rows.append(radius / effective * np.cross(contact, drive / np.linalg.norm(drive)))
        return np.array(rows)

    def sphere_from_wheels(self) -> Array:
        """J (3, 3), frame W, the inverse of `wheels_from_sphere` (Eq. 18)."""
        inverse: Array = np.linalg.inv(self.wheels_from_sphere()).astype(np.float64)
        return inverse


def open_run(path: str | Path) -> RecordedRun:
    """Read a log with its platform.

    Raises InputError when there is no such file or it holds a flight alone, and LogError when it is
    damaged, not a log of ours, or lacks a topic or the platform that it was flown on.
    """
    return run_of(open_log(path))


def run_of(log: Log) -> RecordedRun:
    """Return a log with its platform. Raises as `open_run`."""
    path = log.path
    if is_flight_alone(log):
        raise InputError(
            f"log {path}: holds a flight alone, which nobody has cued yet; cue it first:"
            f" atlas-cueing recue {path} --set platform.preset=NAME -o NEW.mcap"
        )
    flight = RunColumns.of(_even(log))
    platform = platform_of(log)
    if len(platform.wheel) != 3:
        raise LogError(f"{log.path}: its platform has {len(platform.wheel)} wheels, allowed: 3")
    return RecordedRun(log, platform, flight)


def open_log(path: str | Path) -> Log:
    """Read a log.

    Raises InputError when there is no such file or a scenario, and LogError when it is damaged or
    not ours.
    """
    path = Path(path)
    try:
        return read_log(path, largest_content(path))
    except LogError as error:
        if path.suffix == ".toml":
            raise InputError(
                f"log {path}: is a TOML file, not a log; to fly a scenario: atlas-cueing run {path}"
            ) from error
        raise


def largest_content(path: Path) -> int:
    """Bytes that a file may unpack to at most. Raises InputError when it is no file."""
    try:
        if not path.is_file():
            there = "not a regular file" if path.exists() else "no such file"
            hint = "is a folder; name one of the logs in it"
            raise InputError(f"log {path}: {hint if path.is_dir() else there}")
        return max(SMALLEST_BOUND, LARGEST_RATIO * path.stat().st_size)
    except (OSError, ValueError) as error:  # a name that is too long; a NUL in it
        raise InputError(f"log {path}: {error}") from error


def _even(log: Log) -> Log:
    """The log with all topics cut to the length of the shortest."""
    present = [*TOPICS, LOADS.name] if LOADS.name in log.tables else TOPICS
    lengths = {topic: len(log.column(topic, "time_s")) for topic in present}
    if len(set(lengths.values())) == 1:
        return log
    shortest = min(lengths.values())
    tables = {t: replace(log.tables[t], values=log.tables[t].values[:shortest]) for t in present}
    return replace(log, tables=tables)
