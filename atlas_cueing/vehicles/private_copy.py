"""Copies of JSBSim's input files that can neither write files nor open sockets.

A script or model may carry `<output>` (a file in the working directory or at any path, UDP or TCP) and `<input port>` (listens
on all interfaces). Switching them off after loading is too late: file and socket are open by then. So JSBSim is given copies
without them, in a private folder that is gone before the first step.
"""

import os
import xml.etree.ElementTree as ET
from pathlib import Path

from ..errors import InputError
from .library import own_aircraft, suggestion

MAX_FILE_BYTES = 20_000_000  # the largest own file has 0.4 MB
MAX_DEPTH = 100  # of nested elements; own files stay below 20, and JSBSim's parser overruns its stack at some 100,000
_PORTS = ("output", "input")  # as children of the root; deeper ones are names of signals in control systems


def copy_script(script: Path, folder: Path) -> tuple[ET.Element, Path]:
    """Write a quiet copy of the script and of its aircraft's folder; gives the script's tree and the copy's path.

    Raises InputError when the script is unreadable, not a script, or asks for an aircraft that JSBSim does not ship.
    """
    tree = _read(script, "runscript")
    use = tree.find("use")
    aircraft = use.get("aircraft", "") if use is not None else ""
    if use is None or aircraft not in own_aircraft():
        raise InputError(f"{script}: no aircraft {aircraft!r} in JSBSim{suggestion(aircraft, own_aircraft())}")
    beside = (script.parent / f"{use.get('initialize', '').removesuffix('.xml')}.xml").resolve()
    if beside.is_file():
        _read(beside, "initialize")
        use.set("initialize", str(beside))
    copy_aircraft(aircraft, folder)
    return tree, _write(tree, folder / "script.xml")


def copy_aircraft(aircraft: str, folder: Path) -> Path:
    """Write a quiet copy of an own aircraft's model, with links to the files beside it; gives the folder of all aircraft."""
    model = own_aircraft()[aircraft]
    copies = folder / "aircraft" / aircraft
    copies.mkdir(parents=True)
    for entry in model.parent.iterdir():
        if entry != model:
            (copies / entry.name).symlink_to(os.path.realpath(entry))
    _write(_read(model, "fdm_config"), copies / model.name)
    return copies.parent


def _write(tree: ET.Element, path: Path) -> Path:
    for element in [child for child in tree if child.tag in _PORTS]:
        tree.remove(element)
    ET.ElementTree(tree).write(path, encoding="utf-8", xml_declaration=True)
    return path


def _read(path: Path, root_tag: str) -> ET.Element:
    """Parse a file of the given root element; InputError says what is wrong with it otherwise."""
    try:
        if path.stat().st_size > MAX_FILE_BYTES:
            raise InputError(f"{path}: {path.stat().st_size} bytes; at most {MAX_FILE_BYTES}")
        parser = ET.XMLParser(target=_ShallowTree(path))  # noqa: S314  expat itself refuses entity bombs
        tree: ET.Element = ET.parse(path, parser).getroot()  # noqa: S314
    except (OSError, ET.ParseError, ValueError, LookupError) as error:
        raise InputError(f"{path}: not a readable XML file: {error}") from error
    if tree.tag != root_tag:
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
