"""CSV: comments that tell units and frames, a line of names, a line for each tick."""

from collections.abc import Callable, Iterator
from typing import BinaryIO, Final

from .log_table import TIME, LogTable

BEGINS: Final = b"# atlas_cueing"  # what --force may replace
_ROWS = 2000  # at a time
_STATE = "status.state"


def write_csv(table: LogTable, file: BinaryIO, progress: Callable[[float], None]) -> None:
    """Write a table as CSV (UTF-8), its numbers with all digits that a double has.

    Lines that begin with `#` are comments: unit and frame of each column. A cell without a number
    is empty. Raises OSError.
    """
    names = [TIME, *(column.name for column in table.columns)]
    names += [_STATE] if table.statuses else []
    head = [*_comments(table), ",".join(names)]
    file.write("".join(f"{line}\n" for line in head).encode())
    for begin in range(0, len(table.time), _ROWS):
        lines = _lines(table, slice(begin, begin + _ROWS))
        file.write("".join(f"{line}\n" for line in lines).encode())
        progress(min(begin + _ROWS, len(table.time)) / len(table.time))


def _comments(table: LogTable) -> Iterator[str]:
    version = table.metadata.get("atlas_cueing_version", "")
    yield f"{BEGINS.decode()} {version}".rstrip()
    yield "# W: platform base, forward-left-up; S: cabin; B: vehicle, forward-right-down;"
    yield "# N: north-east-down; S (FRD): cabin, forward-right-down"
    yield "# column, unit, frame"
    yield f"# {TIME}, s,"
    for column in table.columns:
        yield f"# {column.name}, {column.unit}, {column.frame}".rstrip()
    if table.statuses:
        yield f"# {_STATE}, text, the state that holds at this time"


def _lines(table: LogTable, rows: slice) -> Iterator[str]:
    columns = [table.time[rows], *(column.values[rows] for column in table.columns)]
    cells = [map(_cell, column.tolist()) for column in columns]
    if table.statuses:
        cells.append(map(_text, table.states()[rows].tolist()))
    return map(",".join, zip(*cells, strict=True))


def _cell(number: float) -> str:
    return repr(number) if number == number else ""


def _text(text: str) -> str:
    plain = text.replace('"', '""')
    return plain if plain.isidentifier() or not plain else f'"{plain}"'
