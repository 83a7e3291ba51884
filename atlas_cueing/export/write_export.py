"""The verb: a table into a file, in the format that its name ends with."""

from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO, Final, TypeAlias

from ..atomic_file import write_through
from ..errors import InputError, OutputError
from ..run import Kind
from . import export_csv, export_mat, export_npz, export_parquet
from .log_table import LogTable

Writer: TypeAlias = Callable[[LogTable, BinaryIO, Callable[[float], None]], None]

_WRITERS: Final[dict[str, Writer]] = {
    ".csv": export_csv.write_csv,
    ".npz": export_npz.write_npz,
    ".mat": export_mat.write_mat,
    ".parquet": export_parquet.write_parquet,
}
KINDS: Final = {  # by ending: what --force may replace
    ".csv": Kind("exported CSV file", export_csv.BEGINS),
    ".npz": Kind("exported npz file", f"{export_npz.FIRST}.npy".encode(), export_npz.NAME_AT),
    ".mat": Kind("exported mat file", export_mat.BEGINS),
    ".parquet": Kind("Parquet file", export_parquet.BEGINS),
}


def kind_of(file: Path) -> Kind:
    """Return the kind of file that a name asks for. Raises InputError for an unknown ending."""
    kind = KINDS.get(file.suffix.lower())
    if kind is None:
        raise InputError(f"-o {file}: allowed: a name that ends in {', '.join(KINDS)}")
    return kind


def write_export(
    table: LogTable, file: str | Path, progress: Callable[[float], None] = lambda _: None
) -> None:
    """Write a table into `file`, in the format that its name ends with, whole or not at all.

    progress: called now and then with the share that is written, 0 to 1.

    Raises InputError for an unknown ending, MissingExtraError for Parquet without pyarrow, and
    OutputError when the file cannot be written; what was there stays.
    """
    path = Path(file)
    kind_of(path)
    write = _WRITERS[path.suffix.lower()]
    try:
        write_through(path, lambda new: write(table, new, progress))
    except OSError as error:
        raise OutputError(f"file {file}: {error.strerror}") from error
