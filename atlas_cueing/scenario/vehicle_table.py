"""The `[vehicle]` table: one of the tables of all sources, chosen by its key `source`."""

from typing import Annotated, Any, Final, TypeAlias, get_args

from pydantic import BeforeValidator, ValidationError, ValidationInfo
from pydantic_core import InitErrorDetails

from .flightgear_table import FlightgearTable
from .jsbsim_table import JsbsimTable
from .mistakes import Key
from .packet_table import PacketTable
from .recording_table import RecordedFlightTable
from .rigid_body_table import RigidBodyTable
from .signal_table import SignalFlightTable
from .source_table import SourceTable
from .tables import refuse
from .track_table import TrackTable

# The one place where sources are named.
AnySource: TypeAlias = (
    JsbsimTable
    | SignalFlightTable
    | FlightgearTable
    | PacketTable
    | RecordedFlightTable
    | RigidBodyTable
    | TrackTable
)

SOURCES: Final[dict[str, type[SourceTable]]] = {
    table.model_fields["source"].default: table for table in get_args(AnySource)
}
DEFAULT_SOURCE = "jsbsim"
_KEYS = {
    name: tuple(key for key in table.model_fields if key != "source")
    for name, table in SOURCES.items()
}


def _of_its_source(value: Any, info: ValidationInfo) -> SourceTable:
    """Check the table by its source; keys of other sources are left to `vehicle_rules`."""
    if isinstance(value, SourceTable):
        return value
    if not isinstance(value, dict):
        raise refuse("a table")
    source = value.get("source", DEFAULT_SOURCE)
    if not _is_known(source):
        unknown = refuse(", ".join(repr(name) for name in SOURCES))
        error: InitErrorDetails = {"type": unknown, "loc": ("source",), "input": source}
        raise ValidationError.from_exception_data("vehicle", [error])
    others = {key for keys in _KEYS.values() for key in keys} - {*_KEYS[source]}
    own = {key: inner for key, inner in value.items() if key not in others}
    return SOURCES[source].model_validate(own, context=info.context)


VehicleTable: TypeAlias = Annotated[AnySource, BeforeValidator(_of_its_source)]


def vehicle_rules(data: dict[str, Any]) -> list[tuple[Key, str]]:
    """Find what does not go together in a scenario's tables: key, and what is allowed."""
    vehicle = data.get("vehicle")
    if not isinstance(vehicle, dict):
        return []
    source = vehicle.get("source", DEFAULT_SOURCE)
    if not _is_known(source):
        return []  # a mistake of its own, without which nobody knows what belongs together
    return [*_keys_of_others(vehicle, source), *SOURCES[source].rules(vehicle, data)]


def _is_known(source: Any) -> bool:
    return isinstance(source, str) and source in SOURCES


def _keys_of_others(vehicle: dict[str, Any], source: str) -> list[tuple[Key, str]]:
    """Find keys that belong to other sources.

    The message names their source where it is the only one that has them, and the table's own
    source is the default; else the table's own source.
    """
    mistakes: list[tuple[Key, str]] = []
    for key in dict.fromkeys(key for keys in _KEYS.values() for key in keys):
        if key not in vehicle or key in _KEYS[source]:
            continue
        owners = [owner for owner, keys in _KEYS.items() if key in keys]
        only = source == DEFAULT_SOURCE and len(owners) == 1
        allowed = f"only with source = {owners[0]!r}" if only else f"not with source = {source!r}"
        mistakes.append((("vehicle", key), allowed))
    return mistakes
