"""A log as a table for other programs: CSV, npz, MATLAB's mat, Parquet; all topics on one time."""

from .log_table import Column, LogTable, log_table
from .write_export import kind_of, write_export

__all__ = ["Column", "LogTable", "kind_of", "log_table", "write_export"]
