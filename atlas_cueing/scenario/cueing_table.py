"""The `[cueing]` table: that of one of the package's methods, or of somebody else's."""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, Final, TypeAlias, Union

from pydantic import (
    BeforeValidator,
    Discriminator,
    SerializeAsAny,
    Tag,
    TypeAdapter,
    ValidationInfo,
)

from ..cueing import DEFAULT_METHOD, METHODS
from .method_table import MethodTable, method_table
from .own_method_table import OwnMethodTable, is_own, validated_own
from .tables import ScenarioTable

OWN: Final = "own"  # tag of the methods that are not in TABLES; no method has this name


class PackageMethodTable(MethodTable):
    """`[cueing]` of a method of the package."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by the method's name: classes made at run time have none that imports."""
        return _unpickled, (self.declaration.name, self.model_dump(exclude_unset=True))

    @classmethod
    def kinds(cls) -> list[type[ScenarioTable]]:
        """List the tables of all methods."""
        return [*TABLES.values()]


class _Tables(Mapping[str, type[MethodTable]]):
    """The tables of the package's methods, by name; each is built when it is first asked for."""

    def __getitem__(self, name: str) -> type[MethodTable]:
        return _table(name)

    def __iter__(self) -> Iterator[str]:
        return iter(METHODS)

    def __len__(self) -> int:
        return len(METHODS)


@cache
def _table(name: str) -> type[MethodTable]:
    return method_table(METHODS[name], name, PackageMethodTable)


TABLES: Final = _Tables()


def _unpickled(method: str, values: dict[str, Any]) -> MethodTable:
    return TABLES[method].model_validate(values)


def _method_of(value: Any) -> Any:
    """Name the method of a table, as it was read or validated."""
    if isinstance(value, dict):
        method = value.get("method", DEFAULT_METHOD)
        return OWN if is_own(method) else method
    method = getattr(value, "method", DEFAULT_METHOD)
    return method if method in METHODS else OWN


def _of_its_method(value: Any, info: ValidationInfo) -> MethodTable:
    """Check the table by its method, whose table alone is built; for a wrong one, by all."""
    method = _method_of(value)
    known = isinstance(method, str) and method in METHODS
    return _adapter(*([method] if known else METHODS)).validate_python(value, context=info.context)


@cache
def _adapter(*methods: str) -> TypeAdapter[MethodTable]:
    """Make what checks the table of one of these methods, or of somebody else's."""
    own = Annotated[SerializeAsAny[MethodTable], BeforeValidator(validated_own), Tag(OWN)]
    tables = (Annotated[TABLES[name], Tag(name)] for name in methods)
    choice: Any = Annotated[Union[(*tables, own)], Discriminator(_method_of)]
    return TypeAdapter(choice)


if TYPE_CHECKING:
    CueingTable: TypeAlias = MethodTable
else:
    CueingTable = Annotated[
        SerializeAsAny[PackageMethodTable | OwnMethodTable], BeforeValidator(_of_its_method)
    ]
