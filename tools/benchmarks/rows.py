"""One line of the table: what was measured, beside what, and what was asked."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Self


@dataclass(frozen=True, slots=True)
class Asked:
    """A bound on the measured value, or on its ratio to the reference.

    `goal` is what would be better still.
    """

    bound: float
    of_ratio: bool = False
    at_least: bool = False
    goal: float | None = None

    def met(self, value: float) -> bool:
        """Whether a value is on the right side of the bound."""
        return value >= self.bound if self.at_least else value <= self.bound

    def text(self, unit: str) -> str:
        """For people."""
        sign, unit = "≥" if self.at_least else "≤", "x" if self.of_ratio else f" {unit}".rstrip()
        goal = f" (goal {self.goal:g}{unit})" if self.goal is not None else ""
        return f"{sign} {self.bound:g}{unit}{goal}"


@dataclass(frozen=True, slots=True)
class Row:
    """A measurement.

    value: in `unit`, a median; `samples` are what it is the median of, in the same unit.
    reference: name and value (same unit) of what it is put beside.
    note: anything else, in words.
    """

    section: str
    what: str
    value: float
    unit: str
    samples: Sequence[float] = ()
    reference: str = ""
    reference_value: float | None = None
    asked: Asked | None = None
    note: str = ""

    @property
    def ratio(self) -> float | None:
        """Value over reference."""
        return self.value / self.reference_value if self.reference_value else None

    @property
    def verdict(self) -> str:
        """`met` or `short`; empty where nothing was asked."""
        judged = self.ratio if self.asked and self.asked.of_ratio else self.value
        return (
            ""
            if self.asked is None or judged is None
            else "met"
            if self.asked.met(judged)
            else "short"
        )

    def noted(self, note: str) -> Self:
        """The same with more words."""
        return replace(self, note="; ".join(filter(None, (self.note, note))))

    def to_json(self) -> dict[str, Any]:
        """Everything, the ratio and the verdict too."""
        return asdict(self) | {"ratio": self.ratio, "verdict": self.verdict}
