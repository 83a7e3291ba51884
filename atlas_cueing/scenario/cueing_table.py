"""The `[cueing]` table: one class for each cueing method, built from its declaration.

Keys, ranges and defaults are those of `atlas_cueing.cueing`; here they only become pydantic's. So
a method is added there and nowhere else.
"""

from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, TypeAlias, Union

from pydantic import Discriminator, Tag, create_model

from ..cueing import DEFAULT_METHOD, METHODS, Method, MethodParameters, StageParameters
from ..cueing.parameter import Choice, Parameter
from ..cueing.stage.stage_parameters import FORCE_GAIN, STAGE
from .tables import ONE_OR_THREE, ScenarioTable, number


class MethodTable(ScenarioTable):
    """`[cueing]` of one method; `TABLES` has them all."""

    declaration: ClassVar[Method]
    if TYPE_CHECKING:
        method: str = ""  # the subclasses have the field, each at its place

    def parameters(self) -> MethodParameters:
        """Parameters of the method, SI."""
        return self.declaration.with_values(dict(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by the method's name: classes made at run time have none that imports."""
        return _unpickled, (self.declaration.name, self.model_dump(exclude_unset=True))

    def stage_parameters(self) -> StageParameters:
        """Parameters of the stage, SI, for a method that has one beside it."""
        values = dict(self)
        return self.declaration.stage_with_values(values | dict(values["stage"]))


def _method_table(method: Method) -> type[MethodTable]:
    """Build the table of a method, in the order of a written file.

    First the gains, which have no unit, and the stage's table with the last of them; then the name
    and the other keys.
    """
    keys = {p.key: _field(p, method.defaults) for p in method.parameters}
    fields: dict[str, Any] = {p.key: keys[p.key] for p in method.parameters if not p.unit.symbol}
    if not method.needs_flight:
        fields.setdefault(FORCE_GAIN.key, _field(FORCE_GAIN, method.stage))
        stage = _stage_table(method.stage)
        fields["stage"] = (stage, stage())
    fields["method"] = (Literal[method.name], method.name)
    table: type[MethodTable] = create_model(
        f"{method.name.capitalize()}Table",
        __base__=MethodTable,
        __doc__=method.reference(),
        __module__=__name__,
        **(fields | keys),
    )
    table.declaration = method
    return table


@lru_cache
def _stage_table(defaults: StageParameters) -> type[ScenarioTable]:
    """Build the table `[cueing.stage]` with these defaults."""
    fields: dict[str, Any] = {parameter.key: _field(parameter, defaults) for parameter in STAGE}
    return create_model("StageTable", __base__=ScenarioTable, __module__=__name__, **fields)


def _field(parameter: Parameter, defaults: object) -> tuple[Any, Any]:
    """Give the type and the default of a key, as pydantic takes them."""
    default, allowed = parameter.default(defaults), parameter.allowed
    if isinstance(allowed, Choice):
        return Literal[allowed.words], default
    kind: Any = Annotated[float, number(allowed.lower, allowed.upper, above=allowed.above)]
    if parameter.is_vector(defaults):
        kind = Annotated[tuple[kind, kind, kind], ONE_OR_THREE]
    return (kind | None if default is None else kind), default


TABLES: dict[str, type[MethodTable]] = {
    name: _method_table(method) for name, method in METHODS.items()
}


def _unpickled(method: str, values: dict[str, Any]) -> MethodTable:
    return TABLES[method].model_validate(values)


def _method_of(value: Any) -> Any:
    """Name the method of a table, as it was read or validated."""
    if isinstance(value, dict):
        return value.get("method", DEFAULT_METHOD)
    return getattr(value, "method", DEFAULT_METHOD)


if TYPE_CHECKING:
    CueingTable: TypeAlias = MethodTable
else:
    CueingTable = Annotated[
        Union[tuple(Annotated[table, Tag(name)] for name, table in TABLES.items())],  # noqa: UP007
        Discriminator(_method_of),
    ]
