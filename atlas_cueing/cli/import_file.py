"""`atlas-cueing import`: recorded data of others become a flight of ours."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from ..errors import InputError
from .options import AsJson, Force

if TYPE_CHECKING:
    from ..flight_data import FlightMap, ImportedFlights

EPILOG = """
Examples:

  atlas-cueing import --list-maps

  atlas-cueing import drive.csv -o drive.mcap --map csv

  atlas-cueing import flight.ulg -o flight.mcap --map px4 --set grid.rate_hz=200 --split

  atlas-cueing import bag_folder -o ride.mcap --map ros-imu --set force.table=/imu/data

  atlas-cueing import car.csv -o car.mcap --map my_map.toml

  atlas-cueing import auto.csv -o auto.mcap --map csv --set csv.delimiter=';' --set csv.decimal=','
"""

_SHOWN = 20  # notes printed; --json has all


File: TypeAlias = Annotated[
    Path | None,
    typer.Argument(help="CSV file, ROS bag, ULog or DataFlash log.", metavar="FILE"),
]
NewFlight: TypeAlias = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FLIGHT", help="Log to write.")
]
MapName: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--map",
        metavar="NAME|MAP.toml",
        help="What the columns are: a map of the package, or one of your own.",
    ),
]
MapSettings: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="KEY=VALUE", help="Set any key of the map, as force.frame; repeatable."
    ),
]
Split: TypeAlias = Annotated[
    bool,
    typer.Option(
        "--split", help="Write a flight of each piece between two gaps: FLIGHT_1.mcap, ..."
    ),
]
ListMaps: TypeAlias = Annotated[
    bool, typer.Option("--list-maps", help="List the maps of the package, and their files.")
]


def import_command(
    file: File = None,
    output: NewFlight = None,
    map_name: MapName = None,
    settings: MapSettings = None,
    split: Split = False,
    list_maps: ListMaps = False,
    as_json: AsJson = False,
    force: Force = False,
) -> None:
    """Import recorded data of others as a flight.

    Units, axes and time become ours, and an attitude is made where there is none. Time stamps that
    jitter are brought onto an even grid; gaps of 0.2 s or more are refused, or split. The flight
    is played with source = "recording", or cued by recue.

    Exit status 0: written. 1: written, but the file is damaged, and what could be read of it may
    not be all. 2: bad input; file, line or message, and column are named, and nothing was written.
    """
    from ..flight_data import load_map, write_flight
    from ..run import check_output
    from .text import aligned, one_json, say

    if list_maps:
        typer.echo(one_json({"maps": _maps()}) if as_json else "\n".join(_map_lines()))
        return
    if file is None or output is None or map_name is None:
        raise InputError(
            "allowed: atlas-cueing import FILE -o FLIGHT.mcap --map NAME|MAP.toml; maps of the"
            " package: atlas-cueing import --list-maps"
        )
    flight_map = load_map(map_name, settings or ())
    read = _read_files(file, map_name)
    if not split:
        check_output(output, inputs=read, force=force)
    found = _imported(file, flight_map, split)
    logs = _logs(output, len(found.flights), split)
    real = [check_output(log, inputs=read, force=force) for log in logs]
    for number, log in enumerate(real):
        write_flight(log, found, flight_map, number)
    if as_json:
        typer.echo(one_json(_as_json(found, flight_map, logs)))
    else:
        typer.echo("\n".join(aligned(_rows(found, flight_map, logs), "")))
    for each in found.damage:
        say(f"{file}: {each}")
    if found.damage:
        raise typer.Exit(1)


def _read_files(file: Path, map_name: str) -> list[Path]:
    """Files that are read, and so never replaced: those of a bag's folder, a map of one's own."""
    own_map = [Path(map_name)] if Path(map_name).suffix == ".toml" else []
    return [file, *(file.iterdir() if file.is_dir() else ()), *own_map]


def _imported(file: Path, flight_map: "FlightMap", split: bool) -> "ImportedFlights":
    from ..flight_data import import_flight
    from .progress import shown_share

    with shown_share(file.name) as progress:
        return import_flight(file, flight_map, split=split, progress=progress)


def _logs(output: Path, count: int, split: bool) -> list[Path]:
    """Return the logs to write: one, or with `split` one for each flight, numbered."""
    if not split or count == 1:
        return [output]
    return [output.with_name(f"{output.stem}_{k}{output.suffix}") for k in range(1, count + 1)]


def _maps() -> list[dict[str, str]]:
    """The maps of the package: name, format, description, file."""
    from ..flight_data import known_maps, load_map

    return [
        {
            "name": name,
            "format": (found := load_map(name)).format,
            "description": found.description,
            "file": str(path),
        }
        for name, path in known_maps().items()
    ]


def _map_lines() -> Iterator[str]:
    for each in _maps():
        yield f"{each['name']:<18} {each['format']:<10} {each['description']}"
        yield f"{'':<29} {each['file']}"


def _rows(
    found: "ImportedFlights", flight_map: "FlightMap", logs: list[Path]
) -> list[tuple[str, str]]:
    from ..flight_data import metadata_of

    rows = []
    for flight, log in zip(found.flights, logs, strict=True):
        told = metadata_of(found, flight, flight_map)
        rows += [
            ("log", str(log)),
            ("flight", f"{flight.time[-1]:.2f} s, {len(flight.time)} states"),
            *((name, told[name]) for name in ("origin", "map", "grid", "rate", "attitude")),
        ]
    notes = [("note", note) for note in found.notes[:_SHOWN]]
    left = len(found.notes) - _SHOWN
    return [*rows, *notes, *([("note", f"and {left} more; --json has all")] if left > 0 else [])]


def _as_json(found: "ImportedFlights", flight_map: "FlightMap", logs: list[Path]) -> dict[str, Any]:
    from ..flight_data import metadata_of

    return {
        "result": "damaged" if found.damage else "ok",
        "origin": str(found.path),
        "map": found.map_name,
        "flights": [
            {
                "log": str(log),
                "states": len(flight.time),
                "duration_s": float(flight.time[-1]),
                "begin_s": flight.begin,
                "step_s": flight.step,
                "resampled": not flight.exact,
                **{
                    key: value
                    for key, value in metadata_of(found, flight, flight_map).items()
                    if key in ("attitude", "rate", "force_at", "grid")
                },
            }
            for flight, log in zip(found.flights, logs, strict=True)
        ],
        "notes": list(found.notes),
    }
