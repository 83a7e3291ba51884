"""The table `[cueing]` of one method, built from its declaration.

Keys, ranges and defaults are those of `atlas_cueing.cueing`; here they only become pydantic's. So
a method is added there and nowhere else.
"""

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, TypeVar

from pydantic import create_model

from ..cueing import Method, MethodParameters, StageParameters
from ..cueing.parameter import Choice, Parameter, Switch
from ..cueing.stage.stage_parameters import FORCE_GAIN, STAGE
from .tables import ONE_OR_THREE, ScenarioTable, number

T = TypeVar("T", bound="MethodTable")


class MethodTable(ScenarioTable):
    """`[cueing]` of one method; `cueing_table.TABLES` has those of the package."""

    declaration: ClassVar[Method]
    if TYPE_CHECKING:
        method: str = ""  # the subclasses have the field, each at its place

    def parameters(self) -> MethodParameters:
        """Parameters of the method, SI."""
        return self.declaration.with_values(dict(self))

    def files(self) -> list[Path]:
        """Return the user's file that the method comes from; none of the package's own."""
        return []

    def stage_parameters(self) -> StageParameters:
        """Parameters of the stage, SI, for a method that has one beside it."""
        values = dict(self)
        return self.declaration.stage_with_values(values | dict(values["stage"]))


def method_table(method: Method, name: str, base: type[T]) -> type[T]:
    """Build the table of a method, called `name` in the file, in the order of a written file.

    First the gains, which have no unit, and the stage's table with the last of them; then the name
    and the other keys.
    """
    keys = {p.key: _field(p, method.defaults) for p in method.parameters}
    fields: dict[str, Any] = {p.key: keys[p.key] for p in method.parameters if not p.unit.symbol}
    if not method.needs_flight:
        fields.setdefault(FORCE_GAIN.key, _field(FORCE_GAIN, method.stage))
        stage = _stage_table(method.stage)
        fields["stage"] = (stage, stage())
    fields["method"] = (Literal[name], name)
    table: type[T] = create_model(
        f"{method.name.capitalize()}Table",
        __base__=base,
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
    if isinstance(allowed, Switch):
        return bool, default
    kind: Any = Annotated[float, number(allowed.lower, allowed.upper, above=allowed.above)]
    if parameter.is_vector(defaults):
        kind = Annotated[tuple[kind, kind, kind], ONE_OR_THREE]
    return (kind | None if default is None else kind), default
