"""ArduPilot's DataFlash logs, binary (.bin) and text (.log), by pymavlink.

A table is a message (`IMU`), time `TimeUS` in whole us. Messages with a field `I` are those of
several sensors, of which one is chosen by its instance.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from dataclasses import replace
from io import StringIO
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any, BinaryIO

import numpy as np

from ...errors import InputError, MissingExtraError
from ..flight_map import FlightMap
from ..samples import Part, Progress, Samples, Wanted, chosen, missing, wanted

_HEAD = b"\xa3\x95"  # of every binary message
_TEXT = (b"FMT,", b"FMT ")
_LAST = "unknown msg type"  # behind which pymavlink reads no more
_DAMAGE = ("bad header", _LAST)  # how its lines begin
_OFTEN = 2000  # messages between two reports


def read_dataflash(path: Path, flight_map: FlightMap, progress: Progress) -> dict[Part, Samples]:
    """Read a DataFlash log, see `Reader`."""
    try:
        from pymavlink import DFReader
    except ImportError as error:
        raise MissingExtraError("reading a DataFlash log", "pymavlink", "logs") from error
    kind = DFReader.DFReader_binary if _is_binary(path) else DFReader.DFReader_text
    log = kind.__new__(kind)  # made in two steps, so that its file is closed whatever happens
    try:
        with redirect_stdout(StringIO()), redirect_stderr(StringIO()):  # it prints what is wrong
            notes = _opened(path, log)
            found = _parts(path, log, flight_map, progress)
        return {part: replace(samples, notes=notes) for part, samples in found.items()}
    except InputError:
        raise
    except Exception as error:
        told = " ".join(str(error).split())[:300]
        raise InputError(
            f"{path}: no DataFlash log that can be read: {type(error).__name__}: {told}"
        ) from error
    finally:
        for name in ("data_map", "filehandle"):
            if hasattr(log, name):
                with suppress(BufferError):  # an error that is on its way still looks at the map
                    getattr(log, name).close()


def _opened(path: Path, log: Any) -> tuple[str, ...]:
    """Read where the messages are, and say where the file is damaged, if it is."""
    with _printed() as told:
        log.__init__(str(path))
        told.seek(0)
        lines = told.read().decode(errors="replace").splitlines()
    places = [line for line in lines if line.startswith(_DAMAGE)]
    if not places:
        return ()
    more = f" and at {len(places) - 1} more places" if len(places) > 1 else ""
    end = "; what comes after it is left out" if any(_LAST in line for line in places) else ""
    return (f"the file is damaged, {places[0]}{more}{end}",)


@contextmanager
def _printed() -> Iterator[BinaryIO]:
    """A file with what is printed on stderr meanwhile, also by compiled code."""
    with TemporaryFile() as told:
        sys.stderr.flush()
        before = os.dup(2)
        os.dup2(told.fileno(), 2)
        try:
            yield told
        finally:
            os.dup2(before, 2)
            os.close(before)


def _parts(path: Path, log: Any, flight_map: FlightMap, progress: Progress) -> dict[Part, Samples]:
    parts = wanted(flight_map)
    kinds = {part.table for part in parts}
    collected: dict[Part, _Rows] = {
        part.part: _Rows(path, part, flight_map.time.column) for part in parts
    }
    counts = dict.fromkeys(kinds, 0)
    read = 0
    while (message := log.recv_match(type=list(kinds))) is not None:
        kind = message.get_type()
        counts[kind] += 1
        for part in parts:
            if part.table == kind:
                collected[part.part].add(message, counts[kind])
        read += 1
        if read % _OFTEN == 0:
            progress(min(float(log.percent) / 100.0, 1.0))
    found = {part.part: _samples(path, log, part, collected[part.part]) for part in parts}
    return {part: samples for part, samples in found.items() if samples is not None}


class _Rows:
    """The messages of one part so far."""

    def __init__(self, path: Path, part: Wanted, time: tuple[str, ...]) -> None:
        self.rows: list[int] = []
        self.stamps: list[int] = []
        self.values: list[list[float]] = []
        self.columns: tuple[str, ...] = ()
        self.time = ""
        self._path, self._part, self._times = path, part, time

    def add(self, message: Any, count: int) -> None:
        """Keep a message, if it is of the sensor that is wanted."""
        if not self.columns:
            self._find(list(message.get_fieldnames()))
        if getattr(message, "I", self._part.instance) != self._part.instance:
            return
        self.rows.append(count)
        self.stamps.append(getattr(message, self.time))
        self.values.append([float(getattr(message, name)) for name in self.columns])

    def _find(self, known: list[str]) -> None:
        where = f"message {self._part.table}: "
        names = []
        for column in (self._times, *self._part.columns):
            found = chosen(column, known)
            if found is None:
                key = "time.column" if column is self._times else f"{self._part.part}.columns"
                raise missing(self._path, key, column, known, where)
            names.append(found)
        self.time, self.columns = names[0], tuple(names[1:])


def _samples(path: Path, log: Any, part: Wanted, rows: _Rows) -> Samples | None:
    if not rows.rows and part.optional:
        return None
    if not rows.rows:
        there = ", ".join(sorted(log.name_to_id)) if hasattr(log, "name_to_id") else ""
        raise InputError(
            f"{path}: no message {part.table!r} of instance {part.instance} ({part.part}.table of"
            f" the map){'; messages: ' if there else ''}{there}"
        )
    return Samples(
        part.table,
        "message",
        np.array(rows.rows),
        np.array(rows.stamps),
        np.array(rows.values, dtype=np.float64),
        rows.columns,
        rows.time,
    )


def _is_binary(path: Path) -> bool:
    """Whether a log is binary. Raises InputError for what is neither binary nor text."""
    try:
        with path.open("rb") as file:
            begin = file.read(4)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    if not begin.startswith((_HEAD, *_TEXT)):
        raise InputError(
            f"{path}: is no DataFlash log: it begins with {begin!r}, allowed: {_HEAD!r} or"
            f" {_TEXT[0]!r}"
        )
    return begin.startswith(_HEAD)
