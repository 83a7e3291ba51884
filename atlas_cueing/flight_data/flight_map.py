"""A map: which columns of a file are time, force, rates and attitude, in which units and axes.

format = "csv"                 # csv | ros | ulog | dataflash
[time]
column = "time_s"
unit = "s"
[force]                        # what an accelerometer reads
columns = ["fx", "fy", "fz"]   # x, y, z
unit = "m/s2"
frame = "FRD"                  # FRD | FLU of the body, NED | ENU of the place
gravity = true                 # false: acceleration alone, from which gravity was taken out
[rate]                         # left out: from the attitude
columns = ["wx", "wy", "wz"]
unit = "rad/s"
frame = "FRD"
[attitude]                     # left out: a complementary filter makes it
kind = "quaternion"            # columns w, x, y, z; or "euler": roll, pitch, yaw
columns = ["qw", "qx", "qy", "qz"]
frame = "FRD"
world = "NED"                  # NED | ENU | NWU
"""

from collections.abc import Collection
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, model_validator

from ..scenario.tables import THREE, Finite, ScenarioTable, number, object_to, refuse, text, whole
from ..signals import STANDARD_GRAVITY
from .column_units import UNITS, Quantity, factor

Format: TypeAlias = Literal["csv", "ros", "ulog", "dataflash"]
FORMATS: tuple[Format, ...] = ("csv", "ros", "ulog", "dataflash")
BodyFrame: TypeAlias = Literal["FRD", "FLU"]
Frame: TypeAlias = Literal["FRD", "FLU", "NED", "ENU"]
World: TypeAlias = Literal["NED", "ENU", "NWU"]

_LONGEST_NAME = 200  # characters of a column, a topic
_MOST_NAMES = 8  # that one column may have
MIN_RATE_HZ, MAX_RATE_HZ = 10.0, 1000.0  # as a scenario's


def _one_of(*words: str) -> BeforeValidator:
    def check(value: Any) -> str:
        """Return the word, or refuse it and name the allowed ones."""
        if not isinstance(value, str) or value not in words:
            raise refuse(", ".join(map(repr, words)))
        return value

    return BeforeValidator(check)


# on a command line a tab is typed as its two letters
_TAB = BeforeValidator(lambda value: "\t" if value == r"\t" else value)


def _unit(quantity: Quantity) -> BeforeValidator:
    def check(value: Any) -> str:
        """Return the unit, or refuse what is none of this quantity."""
        if not isinstance(value, str) or factor(value, quantity) is None:
            raise refuse(", ".join(UNITS[quantity]))
        return value

    return BeforeValidator(check)


def _names(value: Any) -> tuple[str, ...]:
    """A column by its name, or by a list of the names it may have."""
    names = value if isinstance(value, list | tuple) else [value]
    if not 0 < len(names) <= _MOST_NAMES or not all(map(_is_name, names)):
        raise refuse(f"the name of a column, or a list of up to {_MOST_NAMES} that it may have")
    return tuple(names)


def _is_name(value: Any) -> bool:
    return isinstance(value, str) and 0 < len(value) <= _LONGEST_NAME and value.isprintable()


def _list_of(value: Any, lengths: Collection[int]) -> tuple[Any, ...]:
    if not isinstance(value, list | tuple) or len(value) not in lengths:
        raise refuse(f"a list of {' or '.join(map(str, lengths))} columns")
    return tuple(value)


Name: TypeAlias = Annotated[str, text("a name", _is_name)]
Column: TypeAlias = Annotated[tuple[str, ...], BeforeValidator(_names)]
ThreeColumns: TypeAlias = Annotated[
    tuple[Column, ...], BeforeValidator(lambda value: _list_of(value, (3,)))
]
Columns: TypeAlias = Annotated[
    tuple[Column, ...], BeforeValidator(lambda value: _list_of(value, (3, 4)))
]
Vector: TypeAlias = Annotated[tuple[Finite, Finite, Finite], THREE]


class TimeTable(ScenarioTable):
    """`[time]`: the column of the time stamps, in every table of the file."""

    column: Column
    unit: Annotated[str, _unit("time")] | None = None


class SeriesTable(ScenarioTable):
    """What the tables of force, rate and attitude have in common.

    table: topic or type of a ROS message, name of a ULog or DataFlash message; not in a CSV file.
    instance: of several sensors that send it.
    """

    table: Name | None = None
    instance: Annotated[int, whole(0, 255)] = 0


class ForceTable(SeriesTable):
    """`[force]`: x, y, z of the specific force, or of the acceleration without gravity."""

    columns: ThreeColumns
    unit: Annotated[str, _unit("force")] | None = None
    frame: Annotated[Frame, _one_of("FRD", "FLU", "NED", "ENU")] = "FRD"
    scale: Vector = (1.0, 1.0, 1.0)
    gravity: bool = True


class RateTable(SeriesTable):
    """`[rate]`: x, y, z of the angular velocity."""

    columns: ThreeColumns
    unit: Annotated[str, _unit("rate")] | None = None
    frame: Annotated[Frame, _one_of("FRD", "FLU", "NED", "ENU")] = "FRD"
    scale: Vector = (1.0, 1.0, 1.0)


class AttitudeTable(SeriesTable):
    """`[attitude]`: from body to world; with `inverse` from world to body.

    optional: whether the complementary filter helps out where the file has none.
    """

    kind: Annotated[Literal["quaternion", "euler"], _one_of("quaternion", "euler")]
    columns: Columns
    unit: Annotated[str, _unit("angle")] | None = None
    frame: Annotated[BodyFrame, _one_of("FRD", "FLU")] = "FRD"
    world: Annotated[World, _one_of("NED", "ENU", "NWU")] = "NED"
    inverse: bool = False
    optional: bool = False

    @model_validator(mode="after")
    def _fits(self) -> "AttitudeTable":
        if len(self.columns) != (4 if self.kind == "quaternion" else 3):
            wanted = "4 columns, w, x, y, z" if self.kind == "quaternion" else "3: roll, pitch, yaw"
            raise object_to(f"{len(self.columns)} columns, allowed with {self.kind}: {wanted}")
        return self


class FilterTable(ScenarioTable):
    """`[filter]`: the complementary filter that makes an attitude.

    time_s: in which it comes to hang by the specific force. Long against the manoeuvres, short
        against the drift of the rate sensors (assumed).
    """

    time_s: Annotated[float, number(0.5, 3600.0)] = 10.0


class SensorTable(ScenarioTable):
    """`[sensor]`: place of the accelerometer, from the pilot's eye, m, forward, right, down."""

    position_m: Vector = (0.0, 0.0, 0.0)


class GravityTable(ScenarioTable):
    """`[gravity]`: where it was recorded; the platform's riders shall feel the standard one."""

    m_s2: Annotated[float, number(1.0, 30.0)] = STANDARD_GRAVITY


class GridTable(ScenarioTable):
    """`[grid]`: states a second; left out: as many as the force has samples."""

    rate_hz: Annotated[float, number(MIN_RATE_HZ, MAX_RATE_HZ)] | None = None


class CsvTable(ScenarioTable):
    """`[csv]`: how the file is written.

    delimiter: by default what parts the header. decimal: a comma beside commas as delimiters has to
    be within quotes.
    """

    delimiter: Annotated[str, _one_of(",", ";", "\t", " ", "|"), _TAB] | None = None
    decimal: Annotated[str, _one_of(".", ",")] = "."
    header_line: Annotated[int, whole(1, 10_000)] = 1


class FlightMap(ScenarioTable):
    """A whole map."""

    name: Name = "map"
    description: str = ""
    format: Annotated[Format, _one_of(*FORMATS)]
    time: TimeTable
    force: ForceTable
    rate: RateTable | None = None
    attitude: AttitudeTable | None = None
    filter: FilterTable = FilterTable()
    sensor: SensorTable = SensorTable()
    gravity: GravityTable = GravityTable()
    grid: GridTable = GridTable()
    csv: CsvTable = CsvTable()

    @model_validator(mode="after")
    def _fits(self) -> "FlightMap":
        parts = [part for part in (self.force, self.rate, self.attitude) if part is not None]
        if self.format != "csv" and any(part.table is None for part in parts):
            raise object_to(f"force, rate and attitude of a {self.format} file need a table")
        if self.rate is None and (self.attitude is None or self.attitude.optional):
            raise object_to("neither rate nor an attitude to take it from; one of them is needed")
        if self.attitude is None and not (self.force.gravity and self.force.frame in _OF_BODY):
            raise object_to(
                "without an attitude the force has to be in axes of the body, with gravity in it"
            )
        return self


_OF_BODY = ("FRD", "FLU")
