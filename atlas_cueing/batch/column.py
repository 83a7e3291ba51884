"""Columns of the overview: head, unit and values as people read them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..evaluation.units import in_words, is_number, key_in_words, setting_text, typeset
from .table import METRIC_COLUMNS

_NONE = "–"


@dataclass(frozen=True, slots=True)
class Column:
    """A column: its head in words, the unit shown ("" for none), and what explains it.

    text: gives the text of a value that is there.
    """

    words: str
    unit: str = ""
    tip: str = ""
    text: Callable[[Any], str] = str

    @classmethod
    def of_metric(cls, name: str) -> "Column":
        """The column of a metric in `METRIC_COLUMNS`, in the unit that people are shown."""
        metric = METRIC_COLUMNS[name]
        return cls(
            metric.title,
            typeset(metric.unit.shown),
            f"{name}: {metric.definition}",
            metric.unit.text,
        )

    @classmethod
    def of_key(cls, key: str) -> "Column":
        """The column of a scenario's dotted key, with its values as they were set."""
        words, unit = key_in_words(key)
        return cls(words, typeset(unit), key, setting_text)

    @classmethod
    def of_field(cls, name: str) -> "Column":
        """The column of a text that every run has, such as its result."""
        return cls(in_words(name), tip=name)

    @property
    def line(self) -> str:
        """Words and unit in one line."""
        return f"{self.words}, {self.unit}" if self.unit else self.words

    def cell(self, value: Any) -> str:
        """The text of a value; a dash for none and for a number that is not finite."""
        missing = value is None or (isinstance(value, float) and not is_number(value))
        return _NONE if missing else self.text(value)
