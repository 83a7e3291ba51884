"""`atlas-cueing export`: a log as a table for other programs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import InputError
from .input_log import input_log
from .options import AsJson

if TYPE_CHECKING:
    from ..export import LogTable

EPILOG = """
Examples:

  atlas-cueing export f16_rolls.mcap -o f16_rolls.csv

  atlas-cueing export f16_rolls.mcap -o f16_rolls.mat --topics vehicle,felt

  atlas-cueing export f16_rolls.mcap -o f16_rolls.parquet

Read them:

  pandas.read_csv("f16_rolls.csv", comment="#")

  numpy.load("f16_rolls.npz")["vehicle.fz_m_s2"]

  log = load("f16_rolls.mat"); plot(log.time_s, log.felt.fz_m_s2)

  pandas.read_parquet("f16_rolls.parquet")
"""


def export_command(
    log: Annotated[Path, typer.Argument(help="Log (MCAP) of atlas-cueing.", metavar="LOG")],
    output: Annotated[
        Path,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="File to write: .csv, .npz, .mat (MATLAB) or .parquet.",
        ),
    ],
    topics: Annotated[
        str | None,
        typer.Option("--topics", metavar="A,B", help="Topics to write; by default all."),
    ] = None,
    as_json: AsJson = False,
    force: Annotated[
        bool, typer.Option("--force", help="Replace a file that was exported earlier.")
    ] = False,
) -> None:
    """Write a log as a table for other programs.

    All topics stand on one time, time_s: a row is a tick, a column a field, as vehicle.wx_rad_s;
    a topic without a message at a tick is empty (NaN) there. Units and frames are told in the file:
    comments of CSV, arrays of npz, structs of mat, metadata of the columns of Parquet.

    Exit status 0: written. 2: bad input, also a log that is damaged, and nothing was written.
    """
    from ..export import kind_of, write_export
    from ..run import check_output
    from .progress import shown_share
    from .text import aligned, one_json

    real = check_output(output, kind_of(output), inputs=[log], force=force)
    table = _table(log, _named(topics))
    with shown_share(output.name) as progress:
        write_export(table, real, progress)
    if as_json:
        typer.echo(one_json(_as_json(table, output)))
        return
    rows = [
        ("file", str(output)),
        ("table", f"{len(table.time)} rows, {len(table.columns) + 1} columns of numbers"),
        ("topics", ", ".join(table.topics)),
    ]
    typer.echo("\n".join(aligned(rows, "")))


def _named(topics: str | None) -> list[str]:
    """Topics of the option, none of which stands for all."""
    if topics is None:
        return []
    named = [topic for topic in topics.split(",") if topic.strip()]
    if not named:
        raise InputError(f"--topics {topics!r}: names no topic; leave it out for all")
    return named


def _table(log: Path, topics: list[str]) -> "LogTable":
    """The log as a table. Raises InputError for whatever cannot be exported."""
    from ..export import log_table
    from ..review import open_log

    with input_log(log):
        return log_table(open_log(log), topics)


def _as_json(table: "LogTable", output: Path) -> dict[str, object]:
    return {
        "result": "ok",
        "file": str(output),
        "rows": len(table.time),
        "columns": [
            {"name": "time_s", "unit": "s", "frame": ""},
            *({"name": c.name, "unit": c.unit, "frame": c.frame} for c in table.columns),
        ],
    }
