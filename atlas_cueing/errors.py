"""Everything the project raises on purpose.

    AtlasError
    |-- InputError              a file, option or value is wrong; nothing was written (status 2)
    |   |-- ScenarioError       every mistake of a scenario or platform file at once
    |   |-- MissingExtraError   a package of an extra is not installed
    |   |-- StartError          a flight cannot begin: no such model, no trim, in the ground
    |   |-- SlipConditionError  a geometry whose wheels cannot turn the sphere about every axis
    |   `-- OutputError         the log cannot be written where it was asked for
    |-- PrintError              standard output takes no more; the recording is kept (status 1)
    |-- VehicleError            the vehicle failed in mid-run; earlier ticks are good (status 1)
    |-- MethodError             an own cueing method failed in mid-run; likewise (status 1)
    |-- PlanningError           the trajectory generator refused a state; the certified stop follows
    |-- LogError                a log is damaged or not one of ours (status 1)
    |-- PacketError             a simulator's packet is damaged or not believable; it is dropped
    |                           (in `vehicles.bounds`)
    `-- SetPointError           a set-point packet is damaged, forged or not one of ours; it is not
                                followed

Statuses are the exit statuses of the program. Messages carry evidence: what, which value, which
bounds (written `lower <= value <= upper`), when and where.
"""

import sys
from dataclasses import dataclass
from math import isinf
from shlex import quote

from .printable import printable

PIP = f"{quote(sys.executable)} -m pip"  # of the environment that this program runs in


class AtlasError(Exception):
    """Root of all errors of this project. Each argument is a line for the user."""

    def __str__(self) -> str:
        return "\n".join(self.lines)

    @property
    def lines(self) -> tuple[str, ...]:
        """Lines of the message; a line break inside one of them comes from a name."""
        return tuple(map(str, self.args))


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
        return f"{printable(self.file)}: {self.key}{found}: {self.allowed}"


class ScenarioError(InputError):
    """All mistakes of a scenario or platform file, in the order of the file."""

    def __init__(self, mistakes: list[Mistake]) -> None:
        self.mistakes = tuple(mistakes)
        super().__init__(*map(str, mistakes))


class MissingExtraError(InputError):
    """A package that comes with an extra is not installed.

    The text has the command that installs it where this one runs.
    """

    def __init__(self, what: str, package: str, extra: str) -> None:
        super().__init__(
            f"{what} needs {package}; install it with: {PIP} install 'atlas_cueing[{extra}]'"
        )


class StartError(InputError):
    """A flight cannot begin as asked; the text starts with the key below `[vehicle]`."""


class SlipConditionError(InputError):
    """The kinematic slip condition fails: induced rows are dependent (paper, section 3.1)."""

    def __init__(
        self, name: str, determinant: float, condition_number: float, bound: float
    ) -> None:
        self.determinant = determinant
        self.condition_number = condition_number
        super().__init__(
            f"platform {name!r} violates the kinematic slip condition: its three induced rows are"
            f" not independent (determinant {determinant:.3g}, condition number"
            f" {_number(condition_number)}, allowed: at most {bound:.0e}); move a contact point or"
            " turn a drive direction"
        )


def _number(value: float) -> str:
    return "infinite" if isinf(value) else f"{value:.3g}"


class OutputError(InputError):
    """The log cannot be written where it was asked for."""


class PrintError(AtlasError):
    """Standard output takes nothing more: its disk is full, or it is closed."""


class MethodError(AtlasError):
    """The cueing method `name` of somebody else failed at `time` (s); ticks before it are valid."""

    def __init__(self, name: str, time: float, reason: str) -> None:
        self.name, self.time, self.reason = name, time, reason
        super().__init__(f"method {name!r} at {time:.6f} s: {reason}")


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
