"""Everything the project raises on purpose.

    AtlasError
    |-- InputError              a file, option or value is wrong; nothing was written (exit status 2)
    |   |-- ScenarioError       every mistake of a scenario or platform file at once
    |   |-- StartError          a flight that cannot begin as it is told: no such model, no trim, in the ground
    |   |-- SlipConditionError  a geometry whose wheels cannot turn the sphere about every axis
    |   `-- OutputError         the log cannot be written where it was asked for
    |-- VehicleError            the vehicle model failed in mid-run; what came before is good (exit status 1)
    |-- PlanningError           the trajectory generator refused a state; the certified stop takes over
    |-- LogError                a log is damaged or not one of ours (exit status 1)
    |-- PacketError             a simulator's packet is not one, or cannot be believed; it is dropped (in `vehicles.flightgear`)
    `-- SetPointError           a set-point packet is damaged, forged or not one of ours; it is not followed

Messages carry evidence: what, which value, which bounds (written `lower <= value <= upper`), when and where.
"""

from dataclasses import dataclass
from math import isinf


class AtlasError(Exception):
    """Root of all errors of this project; its text is ready to be shown to the user."""


class InputError(AtlasError):
    """Input or usage is wrong and nothing was written."""


@dataclass(frozen=True, slots=True)
class Mistake:
    """One mistake in a file: where it is, what was found and what is allowed."""

    file: str
    key: str
    value: str
    allowed: str

    def __str__(self) -> str:
        found = f" = {self.value}" if self.value else ""
        return f"{self.file}: {self.key}{found}: {self.allowed}"


class ScenarioError(InputError):
    """All mistakes of a scenario or platform file, in the order of the file."""

    def __init__(self, mistakes: list[Mistake]) -> None:
        self.mistakes = tuple(mistakes)
        super().__init__("\n".join(str(mistake) for mistake in mistakes))


class StartError(InputError):
    """A flight cannot begin as it is told; the text starts with the key below `[vehicle]`."""


class SlipConditionError(InputError):
    """The induced rows are not independent, so the kinematic slip condition fails (paper, section 3.1)."""

    def __init__(self, name: str, determinant: float, condition_number: float, bound: float) -> None:
        self.determinant = determinant
        self.condition_number = condition_number
        super().__init__(
            f"platform {name!r} violates the kinematic slip condition: its three induced rows are not independent "
            f"(determinant {determinant:.3g}, condition number {_number(condition_number)}, allowed: at most {bound:.0e}); "
            "move a contact point or turn a drive direction"
        )


def _number(value: float) -> str:
    return "infinite" if isinf(value) else f"{value:.3g}"


class OutputError(InputError):
    """The log cannot be written where it was asked for."""


class VehicleError(AtlasError):
    """The vehicle model failed at `time` (s) for `reason`; ticks before it are valid."""

    def __init__(self, time: float, reason: str) -> None:
        self.time = time
        self.reason = reason
        super().__init__(f"vehicle failed at {time:.3f} s: {reason}")


class PlanningError(AtlasError):
    """The trajectory generator refused a state or a target."""


class LogError(AtlasError):
    """A log is damaged, cut or not one of ours."""


class SetPointError(AtlasError):
    """A set-point packet is damaged, forged or not one of ours."""
