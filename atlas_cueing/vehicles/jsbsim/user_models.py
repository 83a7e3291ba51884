"""Aircraft of a user's own, in folders as JSBSim has them.

`aircraft/NAME/NAME.xml`, `engine`, `systems`.

What a model names by `file="..."` is looked for with the model first, then in the user's `engine`
and `systems`, and last among JSBSim's own. Nothing outside the user's folder is read.
"""

import re
from pathlib import Path

from ...errors import InputError
from .library import own_aircraft, suggestion

MAX_FILES = 100  # of one aircraft; the largest of JSBSim's own is made of 24
# of a user's file, which goes along with the log; the largest own script has 11 kB
MAX_USERS_BYTES = 1 << 20
_PREFIX = "./"  # of a name: the user's aircraft, also where JSBSim has one of that name
_NAME = re.compile(r"[\w-][\w.-]*")
_REFERENCE = re.compile(rb"""\bfile\s*=\s*(?:"([^"<]*)"|'([^'<]*)')""")
_PLAIN_REFERENCE = re.compile(r"[\w -][\w .-]*(/[\w -][\w .-]*)*")  # no part begins with a dot
# where JSBSim looks, and a little more
_BESIDE_MODEL = ("", "Engines/", "engines/", "Systems/", "systems/")
SHARED = ("engine", "systems")  # folders beside `aircraft`


def user_model(name: str, folder: Path) -> Path | None:
    """The model of the user's aircraft, if it lies within `folder` when all links are resolved."""
    plain = plain_name(name)
    return within(folder, f"aircraft/{plain}/{plain}.xml") if _NAME.fullmatch(plain) else None


def plain_name(name: str) -> str:
    """The aircraft's name, without what says that it is the user's."""
    return name.removeprefix(_PREFIX)


def aircraft_objection(name: str, folder: Path | None) -> str:
    """Why no aircraft is had by this name, JSBSim's own or the user's in `folder`; else nothing."""
    mine = user_model(name, folder) if folder else None
    if mine and name in own_aircraft():
        return (
            f"JSBSim ships an aircraft {name!r}, and there is one in {mine.parent}; "
            f"allowed: {_PREFIX + name!r} for the latter, or another name for its folder"
        )
    if mine or name in own_aircraft():
        return ""
    beside = " nor in aircraft/NAME/NAME.xml beside the scenario" if folder else ""
    return f"no aircraft {name!r} in JSBSim{beside}{suggestion(name, own_aircraft())}"


def user_files(name: str, folder: Path, initialize: str = "") -> dict[str, Path]:
    """The user's files that an aircraft is made of, by their path from `folder`.

    They are the model, what it names, and what that names in turn.
    initialize: name of a file of initial conditions beside the model, which a script asks for.
    Files are looked through as bytes, not parsed. Raises InputError for too many, and for one that
    cannot be read.
    """
    home = f"aircraft/{plain_name(name)}"
    wanted = [f"{home}/{plain_name(name)}.xml"]
    wanted += [f"{home}/{initialize.removesuffix('.xml')}.xml"] if initialize else []
    found: dict[str, Path] = {}
    while wanted:
        relative = wanted.pop()
        path = within(folder, relative)
        if path is None or relative in found:
            continue
        found[relative] = path
        if len(found) > MAX_FILES:
            raise InputError(
                f"{folder / home}: the aircraft names too many files, allowed: at most {MAX_FILES}"
            )
        for reference in _references(read_users(path)):
            wanted += [f"{home}/{place}{reference}" for place in _BESIDE_MODEL]
            wanted += [f"{place}/{reference}" for place in SHARED]
    return dict(sorted(found.items()))


def is_plain_reference(reference: str) -> bool:
    """Whether a file is named from where it is looked for, and leads nowhere else."""
    return _PLAIN_REFERENCE.fullmatch(reference) is not None


def within(folder: Path, relative: str) -> Path | None:
    """The file, if it lies within the folder when all links are resolved."""
    try:
        path = (folder / relative).resolve()
        return path if path.is_file() and path.is_relative_to(folder.resolve()) else None
    except (OSError, ValueError, RuntimeError):
        # ValueError: a NUL in the name; RuntimeError: links in a circle
        return None


def beside(script: Path, initialize: str) -> Path | None:
    """Return the file of initial conditions in the script's own folder, links resolved.

    None when it is not there.
    """
    folder = script.parent.resolve()
    try:
        path = (folder / f"{initialize.removesuffix('.xml')}.xml").resolve()
        return (
            path if path.is_file() and path.parent == folder and path != script.resolve() else None
        )
    except (OSError, RuntimeError):  # a name that is too long, links in a circle
        return None


def read_users(path: Path) -> bytes:
    """A user's file as it is.

    Raises InputError when it cannot be read or is larger than MAX_USERS_BYTES.
    """
    try:
        with path.open("rb") as file:
            content = file.read(MAX_USERS_BYTES + 1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    if len(content) > MAX_USERS_BYTES:
        raise InputError(f"{path}: too large, allowed: size <= {MAX_USERS_BYTES} bytes")
    return content


def _references(content: bytes) -> list[str]:
    """Names of files, with their ending, that lead nowhere else."""
    named = [
        (double or single).decode("utf-8", "replace").strip()
        for double, single in _REFERENCE.findall(content)
    ]
    return [
        f"{name.removesuffix('.xml')}.xml"
        for name in dict.fromkeys(named)
        if is_plain_reference(name)
    ]
