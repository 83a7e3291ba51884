"""An imported flight as a log of ours that has `/vehicle` alone."""

from importlib.metadata import version
from pathlib import Path

import numpy as np
import tomli_w

from ..atomic_file import write_whole
from ..errors import OutputError
from ..recording import write_vehicle_log
from .flight_map import FlightMap
from .gridded_flight import GriddedFlight
from .import_flight import ImportedFlights


def write_flight(
    output: str | Path, imported: ImportedFlights, flight_map: FlightMap, number: int = 0
) -> None:
    """Write flight `number` of a file as the log `output`, which is replaced if it is there.

    Its metadata tell where it is from, by which map, and what attitude, rates and times are. Raises
    OutputError when it cannot be written; what was there stays.
    """
    flight = imported.flights[number]
    rows = np.column_stack([flight.time, flight.q_NB, flight.w_NB_B, flight.f_B])
    table = tomli_w.dumps(flight_map.model_dump(mode="json", exclude_none=True))
    content = write_vehicle_log(
        rows, metadata_of(imported, flight, flight_map), {"map.toml": table.encode()}
    )
    try:
        write_whole(output, content)
    except OSError as error:
        raise OutputError(f"log {output}: {error.strerror}") from error


def metadata_of(
    imported: ImportedFlights, flight: GriddedFlight, flight_map: FlightMap
) -> dict[str, str]:
    """Return what the log tells of a flight's origin."""
    sensor = flight_map.sensor.position_m
    moved = f"; the sensor lies at {', '.join(f'{x:g}' for x in sensor)} m (FRD) from it"
    grid = "samples as they are" if flight.exact else "resampled by a quintic least-squares spline"
    begin = f", from {flight.begin:.6f} s on" if flight.begin else ""
    return {
        "result": "ok",
        "reason": "",
        "kind": "flight",
        "origin": f"{imported.path.name}{begin}",
        "map": imported.map_name,
        "attitude": flight.attitude,
        "rate": flight.rate,
        "force_at": f"the pilot's eye{moved if any(sensor) else ''}",
        "grid": f"{1.0 / flight.step:.9g} Hz, {grid}",
        "notes": "; ".join(imported.notes),
        "atlas_cueing_version": version("atlas_cueing"),
    }
