"""What JSBSim ships: scripts and aircraft by name."""

import re
from collections.abc import Iterable
from difflib import get_close_matches
from functools import cache
from pathlib import Path

import jsbsim

# What JSBSim's C++ exceptions become in Python; its own jsbsim.BaseError is a RuntimeError.
JSBSIM_ERRORS = (RuntimeError, ValueError, IndexError, ArithmeticError, MemoryError, OSError)
TRIM = "simulation/do_simple_trim"
# Properties that nobody may set, and why; a trim by property only where it is so.
FORBIDDEN = {
    TRIM: "on gear without three points that make a triangle a trim ends the process",
    "simulation/do_linearization": "it writes a file",
    "simulation/write-state-file": "it writes a file",
    "atmosphere/updownburst/number-of-cells": "it takes memory and time without bound",
}
_ROOT_NODE = "/fdm/jsbsim/"  # full names of JSBSim's properties begin with it
_NODE = r"[A-Za-z_][\w.-]*(\[[0-9]{1,6}\])?"
_PROPERTY = re.compile(rf"/?{_NODE}(/{_NODE})*", re.ASCII)  # the root may be named


def root() -> Path:
    """Folder of JSBSim's aircraft, engines, systems and scripts."""
    return Path(jsbsim.get_default_root_dir())


@cache
def own_scripts() -> dict[str, Path]:
    """JSBSim's own scripts: name to file. Some of them end badly, and three do not load."""
    return {path.stem: path for path in sorted((root() / "scripts").glob("*.xml"))}


@cache
def own_aircraft() -> dict[str, Path]:
    """JSBSim's own aircraft: name to the file of the model."""
    folders = sorted((root() / "aircraft").iterdir())
    models = {folder.name: folder / f"{folder.name}.xml" for folder in folders}
    return {name: model for name, model in models.items() if model.is_file()}


def is_property_name(name: str) -> bool:
    """Whether a text can name a property.

    Asked for one that cannot, JSBSim ends the process, and `..` it takes in silence.
    """
    return _PROPERTY.fullmatch(name) is not None


def suggestion(name: str, known: Iterable[str]) -> str:
    """`; did you mean 'x'?` with the nearest of the known names, or nothing when none is near."""
    near = get_close_matches(name, known, n=1, cutoff=0.5)
    return f"; did you mean {near[0]!r}?" if near else ""


def writable_names(fdm: jsbsim.FGFDMExec) -> list[str]:
    """Names of the loaded model's properties that can be set, without their index when it is 0."""
    entries = (entry.rsplit(" ", 1) for entry in fdm.get_property_catalog())
    return [name.removesuffix("[0]") for name, access in entries if "W" in access]


def property_objection(name: str, fdm: jsbsim.FGFDMExec) -> str:
    """Why nothing can be set by this name in the loaded model; else nothing.

    JSBSim itself creates a missing property in silence, so that a misspelt control does nothing.
    """
    node = fdm.get_property_manager().get_node(name) if is_property_name(name) else None
    if not node:
        return f"unknown JSBSim property {name!r}{suggestion(name, writable_names(fdm))}"
    if node.get_attribute(jsbsim.Attribute.WRITE):
        return ""
    reason = FORBIDDEN.get(node.get_fully_qualified_name().removeprefix(_ROOT_NODE))
    wrong = f"must not be set: {reason}" if reason else "can be read but not set"
    return f"JSBSim property {name!r} {wrong}"


def one_line(error: BaseException) -> str:
    """An exception's text on one line."""
    return " ".join(str(error).split())
