"""A JSBSim instance with a script or an aircraft loaded, or an InputError that says why not."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree.ElementTree import Element

import jsbsim

from ...errors import InputError, OutputError, StartError
from ...printable import utf8
from .flights import (
    DEFAULT_RATE_HZ,
    MAX_RATE_HZ,
    MIN_RATE_HZ,
    AircraftFlight,
    InitialConditions,
    ScriptFlight,
)
from .ground import has_flat_gear
from .jsbsim_log import JsbsimLog, capture
from .library import (
    FORBIDDEN,
    JSBSIM_ERRORS,
    TRIM,
    is_property_name,
    one_line,
    property_objection,
    root,
    suggestion,
    writable_names,
)
from .private_copy import copy_aircraft, copy_script
from .user_models import SHARED, aircraft_objection, plain_name

LATEST_END = 1e6  # s, of a script; the longest own one, a balloon's, goes on for a week (6e5 s)
AIRCRAFT_KEY = "aircraft"  # of a scenario, for messages
# properties of the outputs that were left out; scripts may go on setting them
_OUTPUT = "simulation/output/"
_SILENT = 0  # debug level: no reports on what was loaded


def load(flight: ScriptFlight | AircraftFlight) -> jsbsim.FGFDMExec:
    """Load what the flight asks for into a new instance, with its step set.

    A used instance is not bitwise the same.

    Raises InputError when it does not load or the step is out of bounds.
    """
    log = capture()
    rate_hz = flight.rate_hz
    with TemporaryDirectory(prefix="atlas_cueing_") as folder:
        _refuse_names(folder, str(root()))
        fdm = jsbsim.FGFDMExec(str(root()))
        fdm.set_debug_level(_SILENT)
        fdm.set_aircraft_path(str(Path(folder) / "aircraft"))
        if isinstance(flight, ScriptFlight):
            _load_script(fdm, flight, Path(folder), log)
        else:
            with naming_aircraft(flight):
                _load_aircraft(fdm, flight, Path(folder), log)
            rate_hz = DEFAULT_RATE_HZ if rate_hz is None else rate_hz
    _disarm(fdm)
    if rate_hz is not None:
        fdm.set_dt(1.0 / _checked(rate_hz))
    return fdm


def _refuse_names(*folders: str) -> None:
    """Refuse folders that JSBSim cannot be told of: it takes only names that are UTF-8."""
    for folder in folders:
        if utf8(folder) != folder:
            raise OutputError(
                f"folder {folder}: its name is not UTF-8, which JSBSim needs; set TMPDIR"
            )


@contextmanager
def naming_aircraft(flight: AircraftFlight) -> Iterator[None]:
    """Around what needs the model: an InputError gets the key that names it."""
    try:
        yield
    except InputError as error:
        raise StartError(f"{AIRCRAFT_KEY} = {flight.aircraft!r}: {error}") from error


def _load_script(fdm: jsbsim.FGFDMExec, flight: ScriptFlight, folder: Path, log: JsbsimLog) -> None:
    script = flight.script
    tree, copy = copy_script(script, folder, flight.models)
    for run in tree.iter("run"):
        _check_step(run.get("dt", ""), script)
        _check_end(run.get("end", ""), script)
    originals = {str(copy): str(script), **_point_to_copies(fdm, folder, flight.models)}
    originals[str(folder)] = str(script.parent)
    _try(lambda: fdm.load_script(str(copy)), str(script), originals, log)
    _check_names(tree, script, fdm)


def _load_aircraft(
    fdm: jsbsim.FGFDMExec, flight: AircraftFlight, folder: Path, log: JsbsimLog
) -> None:
    objection = aircraft_objection(flight.aircraft, flight.models)
    if objection:
        raise InputError(objection)
    copy_aircraft(flight.aircraft, folder, flight.models)
    originals = _point_to_copies(fdm, folder, flight.models)
    name = plain_name(flight.aircraft)
    _try(lambda: fdm.load_model(name), f"aircraft {flight.aircraft!r}", originals, log)


def _point_to_copies(fdm: jsbsim.FGFDMExec, folder: Path, models: Path | None) -> dict[str, str]:
    """Let JSBSim look at copies of a user's engines and systems.

    Gives what each folder is a copy of.
    """
    if not (folder / SHARED[0]).exists():
        return {f"{folder}/aircraft": f"{root()}/aircraft"}
    fdm.set_engine_path(str(folder / SHARED[0]))
    fdm.set_systems_path(str(folder / SHARED[1]))
    return {f"{folder}/{name}": f"{models}/{name}" for name in ("aircraft", *SHARED)}


def _try(load: Callable[[], bool], what: str, originals: dict[str, str], log: JsbsimLog) -> None:
    """Load, or say why not, with the names of the original files in place of the copies."""
    try:
        complaint = "" if load() else log.complaint or "no reason given"
    except JSBSIM_ERRORS as error:
        complaint = one_line(error)
    for copy, original in originals.items():
        complaint = complaint.replace(copy, original)
    if complaint:
        raise InputError(f"{what}: JSBSim cannot load it: {complaint}")


def _disarm(fdm: jsbsim.FGFDMExec) -> None:
    """Make JSBSim ignore what would write a file, never end, or end the process."""
    for name in FORBIDDEN if has_flat_gear(fdm) else [name for name in FORBIDDEN if name != TRIM]:
        node = fdm.get_property_manager().get_node(name)
        if node:
            node.set_attribute(jsbsim.Attribute.WRITE, False)


def _check_step(dt: str, script: Path) -> None:
    """Refuse a step out of bounds before JSBSim sees it: a negative one kills the process.

    What is no number it refuses.
    """
    try:
        step = float(dt)
    except ValueError:
        return
    if not 1.0 / MAX_RATE_HZ <= step <= 1.0 / MIN_RATE_HZ:
        raise InputError(
            f"{script}: dt = {dt} s, allowed: {1.0 / MAX_RATE_HZ:g} <= dt <= {1.0 / MIN_RATE_HZ:g}"
        )


def _check_end(end: str, script: Path) -> None:
    """Refuse an end that is none, or never comes. What is no number JSBSim refuses."""
    try:
        time = float(end)
    except ValueError:
        return
    if not 0.0 <= time <= LATEST_END:
        raise InputError(f"{script}: end = {end} s, allowed: 0 <= end <= {LATEST_END:g}")


def _check_names(tree: Element, script: Path, fdm: jsbsim.FGFDMExec) -> None:
    """Refuse a script that sets a property which nothing defines.

    JSBSim would stop there in mid-run.
    """
    manager = fdm.get_property_manager()
    for name in sorted({element.get("name", "").strip() for element in tree.iter("set")}):
        if name.startswith(_OUTPUT) and is_property_name(name):
            manager.get_node(name, create=True)
        elif not (is_property_name(name) and manager.hasNode(name)):
            raise InputError(
                f"{script}: unknown JSBSim property {name!r}{suggestion(name, writable_names(fdm))}"
            )


def _checked(rate_hz: float) -> float:
    """A rate inside its bounds: JSBSim itself takes a step of 0, below 0 or NaN."""
    if not MIN_RATE_HZ <= rate_hz <= MAX_RATE_HZ:
        raise InputError(
            f"rate {rate_hz:g} Hz, allowed: {MIN_RATE_HZ:g} <= rate_hz <= {MAX_RATE_HZ:g}"
        )
    return rate_hz


def input_objections(aircraft: str, models: Path | None, names: Iterable[str]) -> dict[str, str]:
    """Properties of an aircraft that cannot be set: name to the reason.

    Raises StartError when the aircraft does not load.
    """
    fdm = _loaded(aircraft, models)
    return {
        name: objection
        for name in dict.fromkeys(names)
        if (objection := property_objection(name, fdm))
    }


def properties(aircraft: str) -> list[str]:
    """Properties of one of JSBSim's own aircraft in order, each with (R) for read, (W) for set.

    Raises StartError when it does not load.
    """
    catalog = _loaded(aircraft, None).get_property_catalog()
    return sorted(entry.replace("[0] (", " (") for entry in catalog)


@lru_cache(maxsize=4)  # the runs of a sweep have one aircraft, or a few
def _loaded(aircraft: str, models: Path | None) -> jsbsim.FGFDMExec:
    return load(AircraftFlight(aircraft, InitialConditions(0.0, 0.0), models=models))
