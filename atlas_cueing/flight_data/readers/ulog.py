"""PX4's ULog, by pyulog. A table is a message (`sensor_combined`), time in whole us."""

from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InputError, MissingExtraError
from ..flight_map import FlightMap
from ..samples import Part, Progress, Samples, Wanted, chosen, missing, wanted

_MAGIC = b"ULog\x01\x12\x35"  # https://docs.px4.io/main/en/dev_log/ulog_file_format.html


def read_ulog(path: Path, flight_map: FlightMap, progress: Progress) -> dict[Part, Samples]:
    """Read a ULog file, see `Reader`."""
    try:
        from pyulog import ULog
    except ImportError as error:
        raise MissingExtraError("reading a ULog", "pyulog", "logs") from error
    _check_begin(path)
    parts = wanted(flight_map)
    progress(0.0)
    try:
        # opened here, so that it is closed whatever happens; and it prints what it finds wrong
        with path.open("rb") as file, redirect_stdout(StringIO()):
            log: Any = ULog(file)
    except Exception as error:
        told = " ".join(str(error).split())[:300]
        raise InputError(
            f"{path}: no ULog that can be read: {type(error).__name__}: {told}"
        ) from error
    found = {part.part: _samples(path, log, part, flight_map) for part in parts}
    progress(1.0)
    return {part: samples for part, samples in found.items() if samples is not None}


def _samples(path: Path, log: Any, part: Wanted, flight_map: FlightMap) -> Samples | None:
    tables = {(data.name, data.multi_id): data.data for data in log.data_list}
    table = tables.get((part.table, part.instance))
    if table is None and part.optional:
        return None
    if table is None:
        there = ", ".join(sorted({f"{name} ({number})" for name, number in tables})) or "none"
        raise InputError(
            f"{path}: no message {part.table!r} of instance {part.instance} ({part.part}.table of"
            f" the map); messages: {there}"
        )
    known = list(table)
    where = f"message {part.table}: "
    names = [_name(path, f"{part.part}.columns", names, known, where) for names in part.columns]
    time = _name(path, "time.column", flight_map.time.column, known, where)
    stamps = np.asarray(table[time])
    return Samples(
        part.table,
        "message",
        np.arange(1, len(stamps) + 1),
        stamps.astype(np.int64) if stamps.dtype.kind in "ui" else stamps.astype(np.float64),
        np.column_stack([np.asarray(table[name], dtype=np.float64) for name in names]),
        tuple(names),
        time,
    )


def _name(path: Path, key: str, names: tuple[str, ...], known: list[str], where: str) -> str:
    found = chosen(names, known)
    if found is None:
        raise missing(path, key, names, known, where)
    return found


def _check_begin(path: Path) -> None:
    try:
        with path.open("rb") as file:
            begin = file.read(len(_MAGIC))
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    if begin != _MAGIC:
        raise InputError(f"{path}: is no ULog: it begins with {begin!r}, allowed: {_MAGIC!r}")
