"""Maps by name, from the package, or by path."""

from collections.abc import Sequence
from pathlib import Path

from pydantic import ValidationError

from ..errors import Mistake, ScenarioError
from ..scenario.mistakes import FileNamer, mistakes_of, nearest
from ..scenario.overrides import apply_overrides, parse_overrides
from ..scenario.reading import read_toml
from .flight_map import FlightMap


def known_maps() -> dict[str, Path]:
    """Return the maps that come with the package: name to file."""
    folder = Path(__file__).parent / "maps"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def load_map(name_or_path: str, overrides: Sequence[str] = ()) -> FlightMap:
    """Read a map of the package by its name, or a file, with `KEY=VALUE` overrides put on top.

    Raises ScenarioError with every mistake in it.
    """
    known = known_maps()
    path = known.get(name_or_path, Path(name_or_path))
    if name_or_path not in known and path.suffix != ".toml":
        wrong = f"no such map; {nearest(name_or_path, known)}; or a file of your own, MAP.toml"
        raise ScenarioError([Mistake("--map", name_or_path, "", wrong)])
    settings = parse_overrides(overrides)
    data = read_toml(path)
    mistakes = apply_overrides(data, settings)
    data.setdefault("name", path.stem)
    namer = FileNamer(path.name if path in known.values() else str(path), settings)
    try:
        found = FlightMap.model_validate(data)
    except ValidationError as error:
        mistakes += mistakes_of(error, FlightMap, data, namer)
    if mistakes:
        raise ScenarioError(mistakes)
    return found
