"""A cueing method of somebody else: a class that becomes a `Method` as the package's own are.

    class HalfTurn:
        "Turns half as far as the vehicle."          # one line, shown as the summary

        version = "1.0"                              # optional, goes into logs

        @dataclass(frozen=True)
        class Parameters:                            # optional; a pydantic model will do, too
            gain: Annotated[float, Field(ge=0, le=1, description="share of the turn")] = 0.5

        def __init__(self, dt, parameters): ...      # dt in s; without Parameters: (self, dt)

        def step(self, vehicle): ...                 # VehicleState -> (q_WS, w_WS_W)

A new object is made for each flight. `step` gives orientation q_WS (unit, scalar first) and rate
w_WS_W (rad/s, in W) of the cue for the next state; tuples, lists and arrays will do. The keys of
Parameters are those of `[cueing]`, end with their units as ours do, and have values in these
units. The stage moves beside the method as beside any other.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import hypot, isfinite
from pathlib import Path
from traceback import extract_tb
from types import TracebackType
from typing import Any, Final, Protocol, Self, cast

from ...errors import InputError, MethodError
from ...rotation import Quat, Vec3, continuous, normalise
from ...signals import VehicleState
from ..method import Method
from ..parameter import Value
from ..stage.stage_parameters import FORCE_GAIN
from .parameters import Values, declared_parameters, validated

UNIT: Final = 1e-3  # how far the norm of a method's quaternion may be from 1; it is made 1 then
LARGEST_RATE: Final = 1000.0  # rad/s, about each axis; beyond it felt forces lose all digits
_HERE: Final = str(Path(__file__).parents[2])
RESERVED: Final = ("method", "stage", FORCE_GAIN.key)  # keys of `[cueing]` with any method


class OwnRotation(Protocol):
    """What the class makes: how the sphere follows the vehicle, tick by tick."""

    def step(self, vehicle: VehicleState) -> Any:
        """Give orientation q_WS and rate w_WS_W (rad/s), whatever their type."""


@dataclass(frozen=True, slots=True)
class OwnParameters:
    """The class of a method, and values of its parameters; None where it has none."""

    name: str
    made_by: Any
    values: Values | None

    def rotation(self, dt: float) -> "CheckedRotation":
        """Make the rotation that begins at the first state; dt in s.

        Raises InputError for whatever the class raises.
        """
        arguments = (dt,) if self.values is None else (dt, self.values)
        try:
            return CheckedRotation(self.name, self.made_by(*arguments))
        except (Exception, SystemExit) as error:
            raise InputError(f"method {self.name!r}: does not begin: {told(error)}") from error


@dataclass(frozen=True, slots=True)
class OwnMethod(Method):
    """Declaration of a method of somebody else.

    version: by its class or package, "" without. digest: SHA-256 (hex) of its code.
    package: the distribution it came with, "" of a file.
    `files` has the file it came from, which can fly again from a log.
    """

    version: str = ""
    digest: str = ""
    package: str = ""

    @classmethod
    def of_class(cls, made_by: Any, name: str, **origin: Any) -> Self:
        """Declare the class as method `name`; origin: of the fields above.

        Raises InputError for what is no such class.
        """
        if not isinstance(made_by, type) or not callable(getattr(made_by, "step", None)):
            raise InputError("allowed: a class with a method step(vehicle)")
        model = getattr(made_by, "Parameters", None)
        parameters = declared_parameters(model, RESERVED) if model else ()
        defaults = OwnParameters(name, made_by, validated(model, {}) if model else None)
        summary = (made_by.__doc__ or "own method").strip().splitlines()[0].rstrip(".")
        version = origin.pop("version", "") or str(getattr(made_by, "version", ""))
        return cls(name, summary, defaults, parameters, version=version, **origin)

    def with_values(self, values: Mapping[str, Value | None]) -> OwnParameters:
        """Set the parameters from values by key. Raises InputError for what their class refuses."""
        own = cast(OwnParameters, self.defaults)
        if own.values is None:
            return own
        mine = {parameter.key: values[parameter.key] for parameter in self.parameters}
        return replace(own, values=validated(type(own.values), mine))

    def metadata(self) -> dict[str, str]:
        """What a log says of the method, beside its name."""
        told = {"version": self.version, "sha256": self.digest, "package": self.package}
        return {f"method_{key}": value for key, value in told.items() if value}


class CheckedRotation:
    """An own method's rotation: its answers are checked, and what it raises gets its name.

    After the first failure it fails for good, with the same words.
    """

    def __init__(self, name: str, own: OwnRotation) -> None:
        self._name, self._own = name, own
        self._before: Quat | None = None
        self._failure: MethodError | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state.

        Raises MethodError.
        """
        if self._failure:
            raise self._failure
        try:
            q_WS, w_WS_W = _checked(self._own.step(vehicle))
        except (Exception, SystemExit) as error:
            self._failure = MethodError(self._name, vehicle.time, told(error))
            raise self._failure from error
        self._before = continuous(q_WS, self._before) if self._before else q_WS
        return self._before, w_WS_W


class _BadAnswerError(ValueError):
    """What `step` gave is no cue."""


def _checked(answer: Any) -> tuple[Quat, Vec3]:
    """Give orientation and rate as the pipeline has them."""
    try:
        q_WS, w_WS_W = answer
        w, x, y, z = map(float, q_WS)
        p, q, r = map(float, w_WS_W)
    except (TypeError, ValueError) as error:
        allowed = "allowed: q_WS of four numbers and w_WS_W of three"
        raise _BadAnswerError(f"step gave {_short(answer)}, {allowed}") from error
    if not isfinite(hypot(w, x, y, z, p, q, r)):
        raise _BadAnswerError(f"step gave {_short(answer)}, which is not finite")
    if not abs(hypot(w, x, y, z) - 1.0) <= UNIT:
        norm = f"q_WS of norm {hypot(w, x, y, z):.6g}"
        raise _BadAnswerError(f"step gave {norm}, allowed: 1 within {UNIT:g}")
    if max(abs(p), abs(q), abs(r)) > LARGEST_RATE:
        rate = f"w_WS_W = {_short((p, q, r))}"
        raise _BadAnswerError(f"step gave {rate}, allowed: at most {LARGEST_RATE:g} rad/s")
    return normalise((w, x, y, z)), (p, q, r)


def told(error: BaseException) -> str:
    """Say in one line what was raised and, of foreign code, where."""
    if isinstance(error, _BadAnswerError):
        return str(error)
    text = " ".join(f"{type(error).__name__}: {error}".split())[:300]
    return text + _where(error.__traceback__)


def _where(traceback: TracebackType | None) -> str:
    """Name file and line where the method's own code was left."""
    frames = (f for f in extract_tb(traceback) if not f.filename.startswith((_HERE, "<frozen")))
    first = next(frames, None)
    return f" ({Path(first.filename).name}, line {first.lineno})" if first else ""


def _short(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 100 else f"{text[:100]}..."
