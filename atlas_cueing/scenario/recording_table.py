"""The `[vehicle]` table of a log that is played."""

from pathlib import Path
from typing import Annotated, Any, Literal

from ..printable import is_name
from .mistakes import Key
from .recorded import RecordedFlight
from .source_table import SourceTable
from .tables import text

_LONGEST_PATH = 4096  # characters


class RecordedFlightTable(SourceTable):
    """`[vehicle]` of a log (MCAP), at a path from the scenario's folder.

    It may lie anywhere, for it is data, as a platform file is.
    """

    source: Literal["recording"] = "recording"
    log: (
        Annotated[
            str, text("path of a log", lambda path: is_name(path) and len(path) <= _LONGEST_PATH)
        ]
        | None
    ) = None

    def flight(self, folder: Path) -> RecordedFlight:
        """Return the log as a flight."""
        assert self.log is not None  # noqa: S101 - rules
        return RecordedFlight(folder / self.log)

    @classmethod
    def rules(cls, vehicle: dict[str, Any], data: dict[str, Any]) -> list[tuple[Key, str]]:
        """Find out whether the log is named."""
        _ = data
        return [] if "log" in vehicle else [(("vehicle", "log"), "missing, the log that is played")]
