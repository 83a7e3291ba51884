"""The `[vehicle]` table of a source: what all of them have in common."""

from pathlib import Path
from typing import Any

from pydantic import BeforeValidator

from ..vehicles import Flight
from .mistakes import Key
from .tables import ScenarioTable, object_to, refuse

MOST_TABLES = 5000  # of one kind; as many inputs as the largest file holds


class SourceTable(ScenarioTable):
    """`[vehicle]`: a source of vehicle states with its own keys.

    A source is a class below this one, in a file of its own, and one name in `vehicle_table`. Its
    `source` has a literal as type and default; `rules` check what belongs together.
    """

    source: str

    @property
    def flown(self) -> str:
        """What flies, as the file names it."""
        return self.source

    def flight(self, folder: Path) -> Flight:
        """Return what to fly; the user's files are looked for in the scenario's `folder`."""
        raise NotImplementedError

    def program(self, folder: Path) -> tuple[str, Path] | None:
        """Return the kind of program that a user's file is, and the file; None without one.

        It is flown only when the user trusts whoever wrote it.
        """
        _ = folder
        return None

    def portable(self, folder: Path) -> dict[str, Any]:
        """Return the table as the scenario in a log has it, beside the files of its flight.

        It names them as `Flight.files` and `Flight.large_files` do.
        """
        _ = folder
        return self.model_dump(exclude_none=True)

    @classmethod
    def rules(cls, vehicle: dict[str, Any], data: dict[str, Any]) -> list[tuple[Key, str]]:
        """Find what does not go together in a table as it is written: key, and what is allowed.

        vehicle: the table. data: the whole file.
        """
        _ = vehicle, data
        return []


def tables(name: str) -> BeforeValidator:
    """Return a check for a list of tables, `[[vehicle.name]]`."""

    def check(value: Any) -> Any:
        """Return the tables, or raise what says how they are written."""
        if not isinstance(value, list | tuple):
            raise refuse(f"tables, written [[vehicle.{name}]]")
        if len(value) > MOST_TABLES:
            raise object_to(
                f"{len(value)} tables [[vehicle.{name}]], allowed: at most {MOST_TABLES}"
            )
        return tuple(value)

    return BeforeValidator(check)
