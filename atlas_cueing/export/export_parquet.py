"""Parquet: a column for each field, with its unit and frame as metadata (extra `parquet`)."""

from collections.abc import Callable
from typing import BinaryIO, Final

from ..errors import MissingExtraError
from .log_table import TIME, LogTable

BEGINS: Final = b"PAR1"


def write_parquet(table: LogTable, file: BinaryIO, progress: Callable[[float], None]) -> None:
    """Write a table as Parquet. Raises OSError, and MissingExtraError without pyarrow.

    Each field has the metadata `unit` and `frame`; the file has those of the run.
    """
    try:
        import pyarrow
        from pyarrow import parquet
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "pyarrow":
            raise
        raise MissingExtraError("a Parquet file", "pyarrow", "parquet") from error

    fields = [pyarrow.field(TIME, pyarrow.float64(), False, {"unit": "s", "frame": ""})]
    arrays = [pyarrow.array(table.time)]
    for column in table.columns:
        told = {"unit": column.unit, "frame": column.frame}
        fields.append(pyarrow.field(column.name, pyarrow.float64(), metadata=told))
        arrays.append(pyarrow.array(column.values))
    if table.statuses:
        told = {"unit": "", "frame": "", "meaning": "the state that holds at this time"}
        fields.append(pyarrow.field("status.state", pyarrow.string(), metadata=told))
        arrays.append(pyarrow.array(table.states().tolist()))
    run = {f"atlas_cueing.{key}": value for key, value in table.metadata.items()}
    schema = pyarrow.schema(fields, metadata=run)
    parquet.write_table(pyarrow.Table.from_arrays(arrays, schema=schema), file)
    progress(1.0)
