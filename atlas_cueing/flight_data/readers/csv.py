"""Text with a header and columns of numbers: CSV, and JSBSim's own output.

An empty cell is a sample that the file does not have, as where sensors of several rates share a
file.
"""

import csv
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...rotations import Array
from ..flight_map import FlightMap
from ..samples import Part, Progress, Samples, Wanted, chosen, missing, wanted

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
        if part.optional and _has_none(path, part, header):
            continue
        places[part.part] = tuple(
            _column(path, f"{part.part}.columns", column, header) for column in part.columns
        )
    names += [name for columns in places.values() for name in columns if name not in names]
    written = _Written(header, delimiter, flight_map.csv.decimal, flight_map.csv.header_line)
    rows, table = _numbers(path, written, names, progress)
    if not len(rows):
        raise InputError(f"{path}: no numbers below the header (line {flight_map.csv.header_line})")
    return {part: _samples(columns, names, rows, table) for part, columns in places.items()}


def _has_none(path: Path, part: Wanted, header: list[str]) -> bool:
    """Whether the file has no column of a part. Raises InputError where it has only some."""
    found = [chosen(column, header) for column in part.columns]
    there = [name for name in found if name is not None]
    if there and None in found:
        lacking = " or ".join(map(repr, part.columns[found.index(None)]))
        raise InputError(
            f"{path}: has {', '.join(map(repr, there))} of {part.part}.columns of the map, but not"
            f" {lacking}, allowed: all {len(found)} of them, or none"
        )
    return not there


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
            delimiter = flight_map.csv.delimiter or _parting(text, flight_map.csv.decimal)
            names = [name.strip() for name in _cells(path, line, text, delimiter)]
            return names, delimiter
    raise InputError(f"{path}: line {number}: missing, where the header should be")


def _parting(header: str, decimal: str) -> str:
    """What parts a header: the decimal mark only where nothing else does, and then blanks."""
    marks = [mark for mark in _DELIMITERS if mark not in (decimal, " ")]
    most = max(marks, key=header.count)
    return most if most in header else decimal if decimal in header else " "


def _column(path: Path, key: str, names: tuple[str, ...], header: Sequence[str]) -> str:
    found = chosen(names, header)
    if found is None:
        raise missing(path, key, names, header)
    if header.count(found) > 1:
        raise InputError(
            f"{path}: {header.count(found)} columns are called {found!r}, allowed: one"
        )
    return found


@dataclass(frozen=True, slots=True)
class _Written:
    """How a file is written: names of its columns, what parts them, and its decimal mark."""

    header: list[str]
    delimiter: str
    decimal: str
    header_line: int


def _numbers(
    path: Path, written: _Written, names: list[str], progress: Progress
) -> tuple[NDArray[Any], Array]:
    """Read these columns: line of each row (n,), and numbers (n, names)."""
    places = [(name, written.header.index(name)) for name in names]
    rows, numbers = array("q"), array("d")
    for line, text in _lines(path, progress):
        if line <= written.header_line or not text.strip() or text.lstrip().startswith("#"):
            continue
        cells = _cells(path, line, text, written.delimiter)
        if len(cells) > len(written.header):
            _check_rest(path, line, cells, written)
        rows.append(line)
        numbers.extend(_row(path, line, cells, places, written))
        if len(rows) > _MOST_ROWS:
            raise InputError(f"{path}: line {line}: more samples than allowed: {_MOST_ROWS}")
    return np.array(rows), np.array(numbers).reshape(-1, len(names))


def _cells(path: Path, line: int, text: str, delimiter: str) -> list[str]:
    """Part a line at its delimiters, those within quotes left out. Raises InputError."""
    if '"' not in text:
        return text.split(delimiter)
    try:
        # quotes count behind a blank as well, as in `1, "2,5"`
        return next(csv.reader([text], delimiter=delimiter, skipinitialspace=delimiter != " "))
    except csv.Error as error:
        raise InputError(f"{path}: line {line}: {error}, allowed: a line of CSV") from error


def _check_rest(path: Path, line: int, cells: list[str], written: _Written) -> None:
    """Refuse more cells than the header has, but for empty ones, as after a last delimiter."""
    most = len(written.header)
    if not any(cell.strip() for cell in cells[most:]):
        return
    hint = ""
    if written.delimiter == ",":
        hint = (
            "; are its decimals commas? then another delimiter and csv.decimal of the map, or"
            " quotes around each number"
        )
    raise InputError(
        f"{path}: line {line}: {len(cells)} columns, allowed: the {most} of the header{hint}"
    )


def _row(
    path: Path, line: int, cells: list[str], wanted: list[tuple[str, int]], written: _Written
) -> list[float]:
    """Return the numbers of a line, NaN for an empty cell. Raises InputError for anything else."""
    if written.decimal == ".":
        try:
            values = [float(cells[place]) for _, place in wanted]
        except (ValueError, IndexError):
            values = [float("nan")]
        if all(map(isfinite, values)):
            return values
    return [_number(path, line, name, cells, place, written.decimal) for name, place in wanted]


def _number(path: Path, line: int, name: str, cells: list[str], place: int, decimal: str) -> float:
    """Return the number in a cell, NaN for an empty one. Raises InputError for anything else."""
    if place >= len(cells):
        raise InputError(
            f"{path}: line {line}: {len(cells)} columns, so none called {name!r} (column"
            f" {place + 1}), allowed: as many as in the header"
        )
    text = cells[place].strip()
    if not text:
        return float("nan")
    value = _value(text, decimal)
    if not isfinite(value):
        shown = text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."
        hint = "; for decimal commas: csv.decimal of the map" if _has_comma(text, decimal) else ""
        raise InputError(
            f"{path}: line {line}, column {name!r} = {shown!r}, allowed: a finite number or"
            f" nothing{hint}"
        )
    return value


def _value(text: str, decimal: str) -> float:
    """Return the number that is written so, NaN for none; no marks between thousands."""
    if decimal != ".":
        text = "none" if "." in text else text.replace(decimal, ".")
    try:
        return float(text)
    except ValueError:
        return float("nan")


def _has_comma(text: str, decimal: str) -> bool:
    return decimal == "." and isfinite(_value(text, ","))


def _lines(path: Path, progress: Progress) -> Iterator[tuple[int, str]]:
    """Yield number and text of each line. Raises InputError where the file cannot be read."""
    line = 0
    try:
        size = max(path.stat().st_size, 1)
        read = 0
        with path.open("rb") as file:
            for raw in _raw_lines(file):
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


def _raw_lines(file: BinaryIO) -> Iterator[bytes]:
    """Yield the lines with their ends: LF, CR LF, or CR alone as old spreadsheets write it."""
    begin = file.read(_LONGEST_LINE)
    file.seek(0)
    if b"\n" in begin or b"\r" not in begin:
        while raw := file.readline(_LONGEST_LINE + 1):
            yield raw
        return
    rest = b""
    while block := file.read(_LONGEST_LINE):
        *whole, rest = (rest + block).split(b"\r")
        yield from (line + b"\r" for line in whole)
        if len(rest) > _LONGEST_LINE:
            break  # too long for any reader
    if rest:
        yield rest
