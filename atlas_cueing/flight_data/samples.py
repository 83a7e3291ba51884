"""What a reader gives: samples of force, rate and attitude as they stand in the file."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Protocol, TypeAlias

from numpy.typing import NDArray

from ..errors import InputError
from ..rotations import Array
from .flight_map import Column, FlightMap

Part: TypeAlias = Literal["force", "rate", "attitude"]
Progress: TypeAlias = Callable[[float], None]  # called now and then with the share that is read
Stamps: TypeAlias = NDArray[Any]  # whole numbers, or floats


@dataclass(frozen=True, slots=True)
class Samples:
    """Samples of one part, in the order of the file.

    table: topic or message they are from; empty in a CSV file. row: what one is called in messages,
        `line` or `message`.
    rows: (n,) number of each, from 1 on. stamps: (n,) in the unit of the time column; whole numbers
        lose nothing however large they are. values: (n, columns), NaN where the file has none.
    columns: names as the file has them. time: name of the time column. notes: what is wrong with
        the file as a whole.
    """

    table: str
    row: str
    rows: NDArray[Any]
    stamps: Stamps
    values: Array
    columns: tuple[str, ...]
    time: str
    notes: tuple[str, ...] = ()

    def place(self, index: int) -> str:
        """Where a sample stands in the file, for messages."""
        table = f" of {self.table}" if self.table else ""
        return f"{self.row} {int(self.rows[index])}{table}"


@dataclass(frozen=True, slots=True)
class Wanted:
    """What a reader looks for: one part, its table, and the names that its columns may have."""

    part: Part
    table: str
    instance: int
    columns: tuple[Column, ...]
    optional: bool


class Reader(Protocol):
    """Reads a file of one format."""

    def __call__(
        self, path: Path, flight_map: FlightMap, progress: Progress
    ) -> dict[Part, Samples]:
        """Return the samples of each part that the map names.

        Only an attitude that is optional may be missing. Raises InputError for a file that is not
        of this format, or lacks a table or column; MissingExtraError without the decoder.
        """
        ...


def wanted(flight_map: FlightMap) -> list[Wanted]:
    """Return what a map wants of a file."""
    parts: list[Wanted] = []
    for part in ("force", "rate", "attitude"):
        table = getattr(flight_map, part)
        if table is not None:
            optional = bool(getattr(table, "optional", False))
            parts.append(Wanted(part, table.table or "", table.instance, table.columns, optional))
    return parts


def chosen(names: Column, known: Sequence[str]) -> str | None:
    """Return the first of the names that a column may have and the file knows."""
    return next((name for name in names if name in known), None)


def missing(
    path: Path, key: str, names: Column, known: Sequence[str], where: str = ""
) -> InputError:
    """Return the error for a column that is not there; `key` is that of the map."""
    asked = " or ".join(map(repr, names))
    there = ", ".join(known[:40]) + (", ..." if len(known) > 40 else "")
    return InputError(f"{path}: {where}no column {asked} ({key} of the map); columns: {there}")
