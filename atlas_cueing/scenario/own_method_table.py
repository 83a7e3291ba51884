"""The `[cueing]` table of a method of somebody else, made when a file names it."""

from pathlib import Path
from typing import Any, ClassVar

from pydantic import ValidationError, ValidationInfo, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

from ..cueing.methods import METHODS
from ..cueing.own.own_method import OwnMethod
from ..cueing.own.sources import (
    installed_methods,
    is_file_reference,
    method_of_file,
    method_of_package,
)
from ..errors import InputError
from ..vehicles.jsbsim.user_models import within
from .method_table import MethodTable, method_table
from .mistakes import nearest
from .tables import object_to

TRUST = "is a program; if you trust whoever wrote it, fly it with --trust-models"


class OwnMethodTable(MethodTable):
    """`[cueing]` of a method of somebody else; `folder`: where its file was looked for."""

    declaration: ClassVar[OwnMethod]
    folder: ClassVar[Path]

    @model_validator(mode="after")
    def _accepted(self) -> "OwnMethodTable":
        try:
            self.parameters()
        except InputError as error:
            raise object_to("; ".join(error.lines)) from error
        return self

    def files(self) -> list[Path]:
        """Return the file that the method comes from; none of an installed one."""
        file = self.method.rpartition(":")[0]
        return [self.folder / file] if self.declaration.files else []

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by what the file names, which is loaded again."""
        values = self.model_dump(exclude_unset=True)
        return _unpickled, (self.method, self.folder, values)


def _unpickled(reference: str, folder: Path, values: dict[str, Any]) -> OwnMethodTable:
    return own_table(reference, folder, trusted=True).model_validate(values)


def is_own(method: Any) -> bool:
    """Whether a method is one of somebody else: an installed one, or a class in a file."""
    return (
        isinstance(method, str)
        and method not in METHODS
        and (is_file_reference(method) or method in installed_methods())
    )


def from_here(method: Any, folder: Path) -> Any:
    """Name a method of the command line by its absolute path where it lies in this directory.

    As any file of a scenario it is looked for in the scenario's `folder` first.
    """
    if not isinstance(method, str) or not is_file_reference(method):
        return method
    file, _, name = method.rpartition(":")
    beside = within(folder, file)
    here = Path(file)
    elsewhere = not (beside and beside.is_file()) and here.is_file()
    return f"{here.resolve()}:{name}" if elsewhere else method


def own_method(reference: str, folder: Path, trusted: bool) -> OwnMethod:
    """Load the method that a file or package has.

    A file lies in the scenario's `folder`, links resolved, or is named by its absolute path. Raises
    InputError for one that is not there, not `trusted`, or no method.
    """
    if not is_file_reference(reference):
        return method_of_package(reference)
    file, _, name = reference.rpartition(":")
    path = Path(file) if Path(file).is_absolute() else within(folder, file)
    if path is None or not path.is_file():
        raise InputError(f"no such file; allowed: one in the scenario's folder {folder}")
    if not trusted:
        raise InputError(f"{path} {TRUST}")
    return method_of_file(path, name)


def own_table(reference: str, folder: Path, trusted: bool) -> type["OwnMethodTable"]:
    """Make the table of an own method. Raises InputError as `own_method`."""
    table = method_table(own_method(reference, folder, trusted), reference, OwnMethodTable)
    table.folder = folder
    return table


def validated_own(value: Any, info: ValidationInfo) -> MethodTable:
    """Check a table `[cueing]` by the method that it names."""
    if isinstance(value, MethodTable):
        return value
    context = info.context or {}
    reference = str(value["method"])
    try:
        table = own_table(reference, context["folder"], bool(context.get("trusted")))
    except InputError as error:
        raise _mistakes([("method", reference, object_to("; ".join(error.lines)))]) from error
    known = list(table.model_fields)
    unknown = [key for key in value if key not in known]
    if unknown:
        reasons = (object_to(f"unknown key; {nearest(key, known)}") for key in unknown)
        rows = zip(unknown, (value[key] for key in unknown), reasons, strict=True)
        raise _mistakes(list(rows))
    return table.model_validate(value)


def _mistakes(rows: list[tuple[str, Any, PydanticCustomError]]) -> ValidationError:
    details: list[InitErrorDetails] = [
        {"type": kind, "loc": (key,), "input": value} for key, value, kind in rows
    ]
    return ValidationError.from_exception_data("cueing", details)
