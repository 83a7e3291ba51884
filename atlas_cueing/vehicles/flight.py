"""What a source of vehicle states has to say before it flies."""

from pathlib import Path
from typing import ClassVar, Protocol

from ..signals import Vehicle


class Flight(Protocol):
    """A flight to come: everything that is known of it before its vehicle is built.

    A new source is a class of this kind, a `SourceTable` in `scenario` that makes it from the
    keys of `[vehicle]`, and a line in `scenario.vehicle_table`.

    live_only: why it flies only in real time, and what to do instead; empty when it flies without
        a clock as well.
    ends_itself: whether its vehicle comes to an end of its own. Any other flies on until somebody
        ends the flight, after the scenario's duration or else after `length`.
    """

    live_only: ClassVar[str]
    ends_itself: ClassVar[bool]

    @property
    def name(self) -> str:
        """Name of what flies, for the name of the run."""
        ...

    def vehicle(self) -> Vehicle:
        """Build the vehicle, at its first state.

        Raises InputError for what can never fly, and VehicleError for a model that fails in its
        first state.
        """
        ...

    def length(self) -> float | None:
        """Return how long the flight is at most, s, by its files alone; None when unknown."""
        ...

    def step(self) -> float:
        """Return the time from one state to the next, s, as far as the files tell it."""
        ...

    def files(self) -> dict[str, Path]:
        """Return the user's files that make this flight: path in the log's attachments to file.

        None unless a source says otherwise. They are small, since each log and each run of a batch
        carries them. Raises InputError for one that cannot be read.
        """
        return {}

    def large_files(self) -> dict[str, Path]:
        """Return files that are too large to carry along, such as a recording: name to file.

        None unless a source says otherwise. A run is told from another by their content; it is
        read where it lies.
        """
        return {}

    def told(self) -> dict[str, str]:
        """Return what a log of this flight says of its origin, such as an attitude that was made.

        Nothing unless a source says otherwise. Raises InputError for a file that cannot be read.
        """
        return {}
