"""The `[cueing]` table: that of one of the package's methods, or of somebody else's."""

from typing import TYPE_CHECKING, Annotated, Any, Final, TypeAlias, Union

from pydantic import BeforeValidator, Discriminator, SerializeAsAny, Tag

from ..cueing import DEFAULT_METHOD, METHODS
from .method_table import MethodTable, method_table
from .own_method_table import is_own, validated_own

OWN: Final = "own"  # tag of the methods that are not in TABLES; no method has this name


class PackageMethodTable(MethodTable):
    """`[cueing]` of a method of the package."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by the method's name: classes made at run time have none that imports."""
        return _unpickled, (self.declaration.name, self.model_dump(exclude_unset=True))


TABLES: dict[str, type[MethodTable]] = {
    name: method_table(method, name, PackageMethodTable) for name, method in METHODS.items()
}


def _unpickled(method: str, values: dict[str, Any]) -> MethodTable:
    return TABLES[method].model_validate(values)


def _method_of(value: Any) -> Any:
    """Name the method of a table, as it was read or validated."""
    if isinstance(value, dict):
        method = value.get("method", DEFAULT_METHOD)
        return OWN if is_own(method) else method
    method = getattr(value, "method", DEFAULT_METHOD)
    return method if method in TABLES else OWN


if TYPE_CHECKING:
    CueingTable: TypeAlias = MethodTable
else:
    _OWN_TABLE = Annotated[SerializeAsAny[MethodTable], BeforeValidator(validated_own), Tag(OWN)]
    CueingTable = Annotated[
        Union[(*(Annotated[table, Tag(name)] for name, table in TABLES.items()), _OWN_TABLE)],
        Discriminator(_method_of),
    ]
