"""The declaration of one metric, from which everything that shows it is built."""

from dataclasses import dataclass
from enum import Flag, auto

from .units import Unit, in_words


class Shown(Flag):
    """Places that show a metric, beside those that show every metric.

    Every metric is in `--json`, in `compare`, in the tables of a batch and under "Every figure" of
    a page.
    """

    LISTS_ONLY = 0
    """In the lists of every metric only."""
    ERROR_HEADLINE = auto()
    """At the head of a review and of a comparison: the rider's motion less the pilot's."""
    RUN_HEADLINE = auto()
    """At the head of a review and of a comparison: the run as a whole."""
    BATCH = auto()
    """In the table that `batch` prints, and on its page."""
    HEADLINE = ERROR_HEADLINE | RUN_HEADLINE


@dataclass(frozen=True, slots=True)
class Cell:
    """A place in the table of errors that `run` prints: the row's title and the column."""

    row: str
    column: str


@dataclass(frozen=True, slots=True)
class Phrase:
    """A part of a line that `run` prints, joined by commas with the others of the same line.

    row: the line's title; text: a format of the value times `factor`.
    """

    row: str
    text: str
    factor: float = 1.0


@dataclass(frozen=True, slots=True)
class Metric:
    """A figure of a run: its name, unit and definition, and where it is shown.

    quantity: the name without its unit, in snake case; unit: of the value as it is computed;
    definition: a sentence; shown: places beside those that show every metric;
    summary: place in what `run` prints, None for none; meaning: what it says of a ride, in words
        for those who have not read the definition, "" for a figure whose name says it.
    """

    quantity: str
    unit: Unit
    definition: str
    shown: Shown = Shown.LISTS_ONLY
    summary: Cell | Phrase | None = None
    meaning: str = ""

    @property
    def name(self) -> str:
        """Name in `--json` and in the columns of a batch: the quantity, then the unit."""
        return f"{self.quantity}_{self.unit.ending}" if self.unit.ending else self.quantity

    @property
    def title(self) -> str:
        """The quantity in words."""
        return in_words(self.quantity)

    @property
    def line(self) -> str:
        """Title and unit shown, for a line of text."""
        return f"{self.title} {self.unit.shown}".strip()
