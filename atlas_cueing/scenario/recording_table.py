"""The `[vehicle]` table of a log that is played."""

from pathlib import Path
from typing import Annotated, Any, Literal

from ..printable import is_name
from .mistakes import Key
from .recorded import RecordedFlight
from .source_table import SourceTable
from .tables import says, text

_LONGEST_PATH = 4096  # characters
_LOG = "path of a log (MCAP)"


def _is_path_of_log(path: str) -> bool:
    """Whether a text may be the path of a log; a name of TOML would hide a file of the run."""
    return is_name(path) and len(path) <= _LONGEST_PATH and not path.endswith((".toml", "/"))


class RecordedFlightTable(SourceTable):
    """`[vehicle]` of a log (MCAP), at a path from the scenario's folder.

    It may lie anywhere, for it is data, as a platform file is.
    """

    source: Annotated[Literal["recording"], says("plays a flight that was recorded")] = "recording"
    log: Annotated[
        Annotated[str, text(_LOG, _is_path_of_log)] | None, says("log with the flight")
    ] = None

    @property
    def flown(self) -> str:
        """What flies: the log, by its name."""
        return Path(self.log or "").name

    def flight(self, folder: Path) -> RecordedFlight:
        """Return the log as a flight."""
        assert self.log is not None  # noqa: S101 - rules
        return RecordedFlight(folder / self.log)

    def portable(self, folder: Path) -> dict[str, Any]:
        """Return the table with the log beside the scenario, by its name alone."""
        return super().portable(folder) | {"log": Path(self.log or "").name}

    @classmethod
    def rules(cls, vehicle: dict[str, Any], data: dict[str, Any]) -> list[tuple[Key, str]]:
        """Find out whether the log is named."""
        _ = data
        return [] if "log" in vehicle else [(("vehicle", "log"), "missing, the log that is played")]
