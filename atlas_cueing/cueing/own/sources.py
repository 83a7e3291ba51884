"""Where own methods come from: a class in a file, or an installed package.

A file is `my_method.py:Mine`. It is one file: what it imports is installed, not beside it, for it
travels alone (into logs, to the workers of a batch). A package has an entry point of group
`atlas_cueing.methods`, and is called by its name.
"""

import sys
from collections.abc import Collection
from functools import cache, lru_cache
from hashlib import sha256
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from types import ModuleType
from typing import Any, Final

from ...errors import InputError
from .own_method import OwnMethod, told

GROUP: Final = "atlas_cueing.methods"
LARGEST_FILE: Final = 256 * 1024  # bytes of source; a method here has 3 kB
_BROKEN = (Exception, SystemExit)  # what running a stranger's module may raise


def is_file_reference(method: str) -> bool:
    """Whether a method is called as a class in a file."""
    file, colon, name = method.rpartition(":")
    return bool(colon) and file.endswith(".py") and name.isidentifier()


def installed_methods() -> dict[str, EntryPoint]:
    """Give the entry points of installed methods by name; nothing is loaded."""
    return {point.name: point for point in _points()}


@cache
def _points() -> Collection[EntryPoint]:
    return tuple(entry_points(group=GROUP))


def method_of_file(path: Path, class_name: str) -> OwnMethod:
    """Run the file, a program, and declare its class; the same object for the same content.

    Raises InputError when it cannot be read or run, or the class is no method.
    """
    try:
        with path.open("rb") as file:
            source = file.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise InputError(f"{path} cannot be read: {reason}") from error
    if len(source) > LARGEST_FILE:
        raise InputError(f"{path} is too large, allowed: {LARGEST_FILE} bytes")
    return _of_source(source, path.name, class_name)


@lru_cache(maxsize=64)
def _of_source(source: bytes, file: str, class_name: str) -> OwnMethod:
    digest = sha256(source).hexdigest()
    module = _run(source, file, f"atlas_cueing_own_{digest[:16]}")
    made_by = getattr(module, class_name, None)
    if made_by is None:
        raise InputError(f"has no class {class_name!r}; {_classes(module)}")
    name = f"{file}:{class_name}"
    return OwnMethod.of_class(made_by, name, digest=digest, files={file: source})


def _run(source: bytes, file: str, name: str) -> ModuleType:
    """Run the very bytes that go into the log; sys.modules has the module, for its type hints."""
    module = ModuleType(name)
    module.__file__ = file
    sys.modules[name] = module
    try:
        exec(compile(source, file, "exec"), module.__dict__)  # noqa: S102 - trusted by the user
    except _BROKEN as error:
        del sys.modules[name]
        raise InputError(f"does not load: {told(error)}") from error
    return module


def _classes(module: ModuleType) -> str:
    names = [n for n, c in vars(module).items() if isinstance(c, type) and hasattr(c, "step")]
    return f"allowed: {', '.join(names)}" if names else "there is none with a method step"


@cache
def method_of_package(name: str) -> OwnMethod:
    """Load the installed method of this name and declare it. Raises InputError where it fails."""
    point = installed_methods()[name]
    try:
        made_by: Any = point.load()
    except _BROKEN as error:
        raise InputError(f"{point.value} does not load: {told(error)}") from error
    package = point.dist
    return OwnMethod.of_class(
        made_by,
        name,
        version=package.version if package else "",
        package=package.name if package else "",
        digest=_code_digest(made_by.__module__),
    )


def _code_digest(module: str) -> str:
    """SHA-256 of all code below the top package of a module, or of the module where it has none."""
    top = sys.modules[module.partition(".")[0]]
    if not hasattr(top, "__path__"):
        return sha256(Path(top.__file__ or "").read_bytes()).hexdigest()
    total = sha256()
    for folder in map(Path, top.__path__):
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".py", ".so", ".pyd"):
                total.update(f"{path.relative_to(folder)}\0{path.stat().st_size}\0".encode())
                total.update(path.read_bytes())
    return total.hexdigest()
