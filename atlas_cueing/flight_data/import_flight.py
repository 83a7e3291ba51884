"""The verb: a file of others becomes flights that this program plays."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..rotations import Array
from ..scenario.recorded import MAX_RECORDING
from .column_units import UNITS, Quantity, factor, unit_in
from .flight_map import FlightMap
from .grid import lay_grid, natural_step
from .gridded_flight import (
    MEASURED,
    GriddedFlight,
    check_believable,
    flight_on,
    unexplained,
    upright_share,
    vertical_share,
)
from .readers import READERS
from .samples import Part, Progress, Samples
from .stamps import GAP, Series, in_order, origin

_LEAST_S = 1.0  # of a piece between two gaps; a shorter one is left out
_STATE_BYTES = 150  # of a log, unpacked
_READING = 0.7  # share of the work, about
_UNEXPLAINED = 0.05  # rad/s; from here on rates and attitude do not seem to be of one vehicle
_UPWARD = 0.3  # of g, on average; below it the force hardly holds the vehicle up
_QUANTITIES: Mapping[Part, Quantity] = {"force": "force", "rate": "rate", "attitude": "angle"}


@dataclass(frozen=True, slots=True)
class ImportedFlights:
    """The flights of a file, one or, split at its gaps, several.

    path: of the file. flights: in order. notes: what was found and done, a line each. damage: those
        of them that say where the file is damaged, so that something may be missing.
    """

    path: Path
    map_name: str
    flights: tuple[GriddedFlight, ...]
    notes: tuple[str, ...]
    damage: tuple[str, ...] = ()


def import_flight(
    path: str | Path,
    flight_map: FlightMap,
    *,
    split: bool = False,
    progress: Progress = lambda _: None,
) -> ImportedFlights:
    """Read a file that others have recorded, and bring it onto a grid k dt.

    Args:
        path: the file, or the folder of a bag.
        flight_map: what its columns are.
        split: make a flight of each piece between two gaps; without it a gap is refused.
        progress: called now and then with the share that is done, 0 to 1.

    Returns:
        The flights, their time beginning at 0.

    Raises:
        InputError: the file is not what the map says, has gaps, or numbers that no vehicle has; the
            message names line or message, column and value.
        MissingExtraError: the package that decodes it is not installed.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(f"{path}: no such file")
    if not path.is_dir() and not path.is_file():  # opening a pipe would wait for ever
        raise InputError(f"{path}: not a regular file")
    if path.is_dir() and flight_map.format != "ros":
        raise InputError(
            f"{path}: is a folder, allowed for the format {flight_map.format!r}: a file"
        )
    read = READERS[flight_map.format](path, flight_map, lambda share: progress(_READING * share))
    damage = tuple(dict.fromkeys(note for samples in read.values() for note in samples.notes))
    notes = [*damage]
    notes += [f"{part}: not in the file" for part in ("attitude",) if _is_lacking(flight_map, read)]
    parts = _series(str(path), read, flight_map)
    notes += _stamp_notes(parts)
    factors = {part: _factors(path, part, samples, flight_map) for part, samples in read.items()}
    pieces = _pieces(path, parts, split, notes)
    flights = []
    for k, piece in enumerate(pieces):
        share = _share(progress, k, len(pieces))
        flights.append(_flight(path, piece, factors, flight_map, share))
    progress(1.0)
    notes += _doubts(flights, flight_map)
    return ImportedFlights(path, flight_map.name, tuple(flights), tuple(notes), damage)


def _share(progress: Progress, k: int, count: int) -> Progress:
    return lambda share: progress(_READING + (1.0 - _READING) * (k + share) / count)


def _is_lacking(flight_map: FlightMap, read: Mapping[Part, Samples]) -> bool:
    return flight_map.attitude is not None and "attitude" not in read


def _series(path: str, read: Mapping[Part, Samples], flight_map: FlightMap) -> dict[Part, Series]:
    """Put the samples of each part in the order of time, from the file's first stamp on."""
    if flight_map.attitude is not None and "attitude" not in read:
        _check_without_attitude(path, flight_map)
    for samples in read.values():
        if not len(samples.stamps):
            raise InputError(f"{path}: no samples of {', '.join(samples.columns)}")
    start = origin(list(read.values()))
    unit = flight_map.time.unit or unit_in(next(iter(read.values())).time) or "s"
    size = factor(unit, "time")
    if size is None:
        raise InputError(
            f"{path}: the time column is in {unit!r}, allowed: {', '.join(UNITS['time'])}; set"
            " time.unit of the map"
        )
    return {part: in_order(path, samples, start, size) for part, samples in read.items()}


def _check_without_attitude(path: str, flight_map: FlightMap) -> None:
    if not flight_map.force.gravity or flight_map.force.frame not in ("FRD", "FLU"):
        raise InputError(
            f"{path}: has no attitude, without which gravity cannot be put back into the force"
        )
    if flight_map.rate is None:
        raise InputError(f"{path}: has neither rates nor an attitude")


def _factors(path: Path, part: Part, samples: Samples, flight_map: FlightMap) -> Array:
    """Return what turns each column into SI and rad, by the map's unit or that in the header."""
    quantity = _QUANTITIES[part]
    table = getattr(flight_map, part)
    if part == "attitude" and table.kind == "quaternion":
        return np.ones(len(samples.columns))
    found = []
    for column in samples.columns:
        unit = table.unit or unit_in(column)
        size = None if unit is None else factor(unit, quantity)
        if size is None:
            told = f"is in {unit!r}" if unit else "names no unit"
            raise InputError(
                f"{path}: column {column!r} {told}; set {part}.unit of the map, allowed:"
                f" {', '.join(UNITS[quantity])}"
            )
        found.append(size)
    return np.array(found)


def _stamp_notes(parts: Mapping[Part, Series]) -> list[str]:
    notes = []
    for part, series in parts.items():
        if series.repeated:
            notes.append(
                f"{part}: {series.repeated} repeated time stamps; samples of one time are averaged"
            )
        if series.late:
            notes.append(f"{part}: {series.late} samples came late and are put in order")
    return notes


def _pieces(
    path: Path, parts: Mapping[Part, Series], split: bool, notes: list[str]
) -> list[dict[Part, Series]]:
    """Cut the parts where one of them has a gap, and to the time that all of them cover.

    Raises InputError for a gap without `split`, and where nothing long enough is left.
    """
    begin = max(series.time[0] for series in parts.values())
    end = min(series.time[-1] for series in parts.values())
    gaps = sorted(
        (float(series.time[k]), float(series.time[n]), part, series.place(k))
        for part, series in parts.items()
        for k, n in series.gaps()
        if series.time[n] > begin and series.time[k] < end
    )
    told = [
        f"{part}: nothing from {a:.6f} to {b:.6f} s ({b - a:.3f} s), after {place}"
        for a, b, part, place in gaps
    ]
    if gaps and not split:
        raise InputError(
            *(f"{path}: {line}" for line in told[:10]),
            f"{path}: {len(gaps)} gap{'s' * (len(gaps) > 1)}, allowed: less than {GAP:g} s between"
            " two samples; --split makes a flight of each piece",
        )
    notes += told
    edges, last = [], float(begin)
    for a, b, _, _ in gaps:
        edges.append((last, a))
        last = max(last, b)
    edges.append((last, float(end)))
    pieces = []
    for a, b in edges:
        if b - a >= _LEAST_S:
            pieces.append({part: series.between(a, b) for part, series in parts.items()})
        elif gaps and b > a:
            notes.append(f"left out: {a:.6f} to {b:.6f} s, shorter than {_LEAST_S:g} s")
    if not pieces:
        raise InputError(
            f"{path}: force, rate and attitude have {max(end - begin, 0.0):.3f} s in common without"
            f" a gap, allowed: {_LEAST_S:g} s or more"
        )
    return pieces


def _flight(
    path: Path,
    piece: Mapping[Part, Series],
    factors: Mapping[Part, Array],
    flight_map: FlightMap,
    progress: Callable[[float], None],
) -> GriddedFlight:
    rate = flight_map.grid.rate_hz
    step = 1.0 / rate if rate else natural_step(piece["force"])
    force = piece["force"]
    grid = lay_grid(list(piece.values()), force, step)
    most = MAX_RECORDING // _STATE_BYTES
    if not 2 <= grid.count <= most:
        raise InputError(
            f"{path}: {grid.count} states of {step:.6g} s, allowed: 2 <= states <= {most}; set"
            " grid.rate_hz of the map"
        )
    flight = flight_on(grid, piece, factors, flight_map, progress)

    def place(time: float) -> str:
        """Where a time is, by the sample of the force next to it."""
        k = min(int(np.searchsorted(force.time, time - 1e-9)), len(force.time) - 1)
        return f"{time:.6f} s, near {force.place(k)}"

    check_believable(flight, str(path), place)
    return flight


def _doubts(flights: list[GriddedFlight], flight_map: FlightMap) -> list[str]:
    """Say what looks as if the map were wrong."""
    notes = []
    for flight in flights:
        rate = unexplained(flight) if flight.attitude == MEASURED == flight.rate else 0.0
        if rate > _UNEXPLAINED:
            notes.append(
                f"rates and attitude differ by {rate:.3g} rad/s (rms); do frame and unit of both"
                " fit in the map?"
            )
        if flight.attitude != MEASURED and (up := upright_share(flight)) < _UPWARD:
            notes.append(
                "without an attitude the vehicle hangs by its force, which begins with"
                f" {up:.2f} g upwards in its own axes, where 1 is upright; do force.frame and scale"
                " fit, or is the sensor mounted another way?"
            )
        share = vertical_share(flight)
        if share < _UPWARD:
            notes.append(
                f"the force holds the vehicle up by {share:.2f} g on average, where 1 is usual; do"
                f" force.frame, force.gravity ({str(flight_map.force.gravity).lower()}) and scale"
                " fit?"
            )
    return notes
