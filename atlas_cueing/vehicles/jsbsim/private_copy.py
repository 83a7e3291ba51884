"""Copies of JSBSim's input files that can neither write files nor open sockets.

A script or model may carry `<output>` (a file in the working directory or at any path, UDP or TCP)
and `<input port>` (listens on all interfaces). Switching them off after loading is too late: file
and socket are open by then. So JSBSim is given copies without them, in a private folder that is
gone before the first step. A script names files only by plain names: its aircraft is one of
JSBSim's own or the user's, its initial conditions lie beside it or with the aircraft, and no
element refers to any other file. An aircraft of the user's own is copied with the files that it
names, none of which lead out of the user's folder.
"""

import os
import re
import xml.etree.ElementTree as ET
from pathlib import Path

from ...errors import InputError
from .library import own_aircraft, root
from .user_models import (
    MAX_USERS_BYTES,
    SHARED,
    aircraft_objection,
    beside,
    is_plain_reference,
    plain_name,
    user_files,
    user_model,
)

MAX_FILE_BYTES = 20_000_000  # the largest own file has 0.4 MB
# of nested elements; own files stay below 20, and JSBSim's parser overruns its stack at some
# 100,000
MAX_DEPTH = 100
# as children of the root; deeper ones are names of signals in control systems
_PORTS = ("output", "input")
SCRIPT_COPY = "script copy.xml"  # with a space, which no file of initial conditions has
_PLAIN_NAME = re.compile(r"[\w.-]+", re.ASCII)


def copy_script(script: Path, folder: Path, models: Path | None = None) -> tuple[ET.Element, Path]:
    """Write a quiet copy of the script and of its aircraft.

    Gives the script's tree and the copy's path.

    models: folder of a user's own aircraft. Raises InputError when the script is unreadable, not a
    script, or asks for an aircraft that is neither JSBSim's nor there.
    """
    tree = _read(script, "runscript")
    _leave_out_ports(tree)
    _refuse_files(tree, script)
    use = _use(tree, script)
    aircraft, initial = use.get("aircraft", ""), use.get("initialize", "")
    objection = aircraft_objection(aircraft, models)
    if objection:
        raise InputError(f"{script}: {objection}")
    if initial and not _PLAIN_NAME.fullmatch(initial):
        raise InputError(
            f"{script}: initialize = {initial!r}, allowed: a file's name of letters, digits, '.',"
            " '_', '-'"
        )
    own_initial = beside(script, initial)
    copy_aircraft(aircraft, folder, models, initial)
    use.set("aircraft", plain_name(aircraft))
    if own_initial:
        conditions = _read(own_initial, "initialize")
        _refuse_files(conditions, own_initial)
        use.set("initialize", str(_write(conditions, folder / own_initial.name)))
    return tree, _write(tree, folder / SCRIPT_COPY)


def copy_aircraft(
    aircraft: str, folder: Path, models: Path | None = None, initialize: str = ""
) -> Path:
    """Write a quiet copy of an aircraft's model and of what it needs.

    Gives the folder of all aircraft.

    It is one of JSBSim's own, or the user's in `models`, with the initial conditions that a script
    asks for.
    """
    if models and user_model(aircraft, models):
        _copy_users(aircraft, folder, models, initialize)
    else:
        _copy_own(own_aircraft()[aircraft], folder)
    return folder / "aircraft"


def _copy_own(model: Path, folder: Path) -> None:
    """The model, with links to the files beside it."""
    copies = folder / "aircraft" / model.stem
    copies.mkdir(parents=True)
    for entry in model.parent.iterdir():
        if entry != model:
            (copies / entry.name).symlink_to(os.path.realpath(entry))
    tree = _read(model, "fdm_config")
    _leave_out_ports(tree)
    _write(tree, copies / model.name)


def _copy_users(aircraft: str, folder: Path, models: Path, initialize: str) -> None:
    """The user's files, and links to JSBSim's engines and systems that the user has not."""
    model = user_model(aircraft, models)
    for relative, path in user_files(aircraft, models, initialize).items():
        tree = _read(path, "fdm_config" if path == model else "")
        _leave_out_ports(tree)
        _check_references(tree, path)
        (folder / relative).parent.mkdir(parents=True, exist_ok=True)
        _write(tree, folder / relative)
    for shared in SHARED:
        (folder / shared).mkdir(exist_ok=True)
        for entry in (root() / shared).iterdir():
            if not (folder / shared / entry.name).exists():
                (folder / shared / entry.name).symlink_to(os.path.realpath(entry))


def _check_references(tree: ET.Element, path: Path) -> None:
    for element in tree.iter():
        reference = element.attrib.get("file", "").strip()
        if reference and not is_plain_reference(reference):
            raise InputError(
                f"{path}: <{element.tag} file={reference!r}>, allowed: a path of plain names that"
                " leads nowhere else, of letters, digits, ' ', '.', '_', '-'"
            )


def _leave_out_ports(tree: ET.Element) -> None:
    for element in [child for child in tree if child.tag in _PORTS]:
        tree.remove(element)


def _refuse_files(tree: ET.Element, path: Path) -> None:
    """A script needs no files but those of its `use`.

    Models, which JSBSim ships, are made of many.
    """
    for element in tree.iter():
        if "file" in element.attrib:
            raise InputError(
                f"{path}: <{element.tag} file={element.attrib['file']!r}>, allowed: no references"
                " to files"
            )


def _use(tree: ET.Element, script: Path) -> ET.Element:
    found = tree.findall("use")
    if len(found) != 1:  # or JSBSim might look at another than we do
        raise InputError(
            f"{script}: {len(found)} elements <use>, allowed: one, with an aircraft of JSBSim's own"
        )
    return found[0]


def _write(tree: ET.Element, path: Path) -> Path:
    ET.ElementTree(tree).write(path, encoding="utf-8", xml_declaration=True)
    return path


def _read(path: Path, root_tag: str) -> ET.Element:
    """Parse a file of the given root element (of any, if it is empty).

    InputError says what is wrong with it otherwise.
    """
    try:
        size, most = (
            path.stat().st_size,
            (MAX_FILE_BYTES if path.is_relative_to(root()) else MAX_USERS_BYTES),
        )
        if size > most:
            raise InputError(f"{path}: {size} bytes; at most {most}")
        # expat itself refuses entity bombs
        parser = ET.XMLParser(target=_ShallowTree(path))  # noqa: S314
        tree: ET.Element = ET.parse(path, parser).getroot()  # noqa: S314
    except (OSError, ET.ParseError, ValueError, LookupError) as error:
        raise InputError(f"{path}: not a readable XML file: {error}") from error
    if root_tag and tree.tag != root_tag:
        raise InputError(f"{path}: root element is <{tree.tag}>, must be <{root_tag}>")
    return tree


class _ShallowTree(ET.TreeBuilder):
    """A tree that refuses nesting beyond MAX_DEPTH."""

    def __init__(self, path: Path) -> None:
        super().__init__(insert_comments=True)  # so that JSBSim's complaints name the right lines
        self._path = path
        self._depth = 0

    def start(self, tag: str, attrs: dict[str, str], /) -> ET.Element:
        """Open an element."""
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise InputError(f"{self._path}: elements nested deeper than {MAX_DEPTH}")
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> ET.Element:
        """Close an element."""
        self._depth -= 1
        return super().end(tag)
