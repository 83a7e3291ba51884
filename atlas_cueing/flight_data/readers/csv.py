"""Text with a header and columns of numbers: CSV, and JSBSim's own output.

An empty cell is a sample that the file does not have, as where sensors of several rates share a
file.
"""

import csv
from array import array
from collections.abc import Iterator, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...rotations import Array
from ..flight_map import FlightMap
from ..samples import Part, Progress, Samples, chosen, missing, wanted

_DELIMITERS = (",", ";", "\t", "|", " ")
_LONGEST_LINE = 1 << 20  # characters
_MOST_ROWS = 10_000_000  # some 0.6 GB of memory
_OFTEN = 5000  # lines between two reports
_LONGEST_SHOWN = 40  # characters of a value that a message repeats


def read_csv(path: Path, flight_map: FlightMap, progress: Progress) -> dict[Part, Samples]:
    """Read a CSV file (UTF-8), see `Reader`.

    Raises InputError with line and column for what is no number.
    """
    header, delimiter = _header(path, flight_map)
    parts = wanted(flight_map)
    names = [_column(path, "time.column", flight_map.time.column, header)]
    places: dict[Part, tuple[str, ...]] = {}
    for part in parts:
        found = [chosen(column, header) for column in part.columns]
        if part.optional and None in found:
            continue
        places[part.part] = tuple(
            _column(path, f"{part.part}.columns", column, header) for column in part.columns
        )
    names += [name for columns in places.values() for name in columns if name not in names]
    rows, table = _numbers(path, flight_map.csv.header_line, delimiter, header, names, progress)
    if not len(rows):
        raise InputError(f"{path}: no numbers below the header (line {flight_map.csv.header_line})")
    return {part: _samples(columns, names, rows, table) for part, columns in places.items()}


def _samples(
    columns: tuple[str, ...], names: list[str], rows: NDArray[Any], table: Array
) -> Samples:
    values = table[:, [names.index(column) for column in columns]]
    there = ~np.isnan(values).all(axis=1) & ~np.isnan(table[:, 0])
    return Samples("", "line", rows[there], table[there, 0], values[there], columns, names[0])


def _header(path: Path, flight_map: FlightMap) -> tuple[list[str], str]:
    """Read the header; return names of columns, and what parts them."""
    number = flight_map.csv.header_line
    for line, text in _lines(path, lambda _: None):
        if line == number:
            delimiter = flight_map.csv.delimiter or max(_DELIMITERS, key=text.count)
            names = [name.strip() for name in next(csv.reader([text], delimiter=delimiter))]
            return names, delimiter
    raise InputError(f"{path}: line {number}: missing, where the header should be")


def _column(path: Path, key: str, names: tuple[str, ...], header: Sequence[str]) -> str:
    found = chosen(names, header)
    if found is None:
        raise missing(path, key, names, header)
    if header.count(found) > 1:
        raise InputError(
            f"{path}: {header.count(found)} columns are called {found!r}, allowed: one"
        )
    return found


def _numbers(
    path: Path,
    header_line: int,
    delimiter: str,
    header: list[str],
    names: list[str],
    progress: Progress,
) -> tuple[NDArray[Any], Array]:
    """Read these columns: line of each row (n,), and numbers (n, names)."""
    places = [header.index(name) for name in names]
    rows, numbers = array("q"), array("d")
    for line, text in _lines(path, progress):
        if line <= header_line or not text.strip() or text.lstrip().startswith("#"):
            continue
        cells = (
            next(csv.reader([text], delimiter=delimiter)) if '"' in text else text.split(delimiter)
        )
        try:
            values = [float(cells[place]) for place in places]
            usable = all(map(isfinite, values))
        except (ValueError, IndexError):
            usable = False
        if not usable:
            values = [
                _number(path, line, name, cells, place)
                for name, place in zip(names, places, strict=True)
            ]
        rows.append(line)
        numbers.extend(values)
        if len(rows) > _MOST_ROWS:
            raise InputError(f"{path}: line {line}: more samples than allowed: {_MOST_ROWS}")
    return np.array(rows), np.array(numbers).reshape(-1, len(names))


def _number(path: Path, line: int, name: str, cells: list[str], place: int) -> float:
    """Return the number in a cell, NaN for an empty one. Raises InputError for anything else."""
    if place >= len(cells):
        raise InputError(
            f"{path}: line {line}: {len(cells)} columns, so none called {name!r} (column"
            f" {place + 1}), allowed: as many as in the header"
        )
    text = cells[place].strip()
    if not text:
        return float("nan")
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        shown = text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."
        raise InputError(
            f"{path}: line {line}, column {name!r} = {shown!r}, allowed: a finite number or nothing"
        )
    return value


def _lines(path: Path, progress: Progress) -> Iterator[tuple[int, str]]:
    """Yield number and text of each line. Raises InputError where the file cannot be read."""
    line = 0
    try:
        size = max(path.stat().st_size, 1)
        read = 0
        with path.open("rb") as file:
            while raw := file.readline(_LONGEST_LINE + 1):
                line += 1
                read += len(raw)
                if len(raw) > _LONGEST_LINE:
                    raise InputError(f"{path}: line {line}: longer than {_LONGEST_LINE} characters")
                if b"\0" in raw:
                    raise InputError(f"{path}: line {line}: a zero byte, allowed: text (CSV)")
                if line % _OFTEN == 0:
                    progress(read / size)
                yield line, raw.decode("utf-8-sig" if line == 1 else "utf-8").rstrip("\r\n")
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: line {line}: not UTF-8 text: byte {error.start + 1}") from error
