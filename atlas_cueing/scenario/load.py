"""Files to scenarios: everything is checked, and all mistakes are reported at once."""

import os
import pickle
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from ..errors import Mistake, ScenarioError
from .cueing import ALL_METHODS, DEFAULT_METHOD
from .mistakes import MOST_SHOWN, SET, FileNamer, Key, dotted, mistakes_of, more, nearest
from .overrides import Overrides, apply_overrides, parse_overrides, with_own
from .platform import Platform, presets
from .reading import TomlFiles, read_toml
from .scenario import Scenario, ScenarioFile, is_path
from .table import Table
from .vehicle import vehicle_rules

T = TypeVar("T", bound=Table)

_CHOICE = ("preset", "file")


def load_scenario(path: Path, overrides: Sequence[str] = (), *, trust_models: bool = False) -> Scenario:
    """Read a scenario file and its platform, with `KEY=VALUE` overrides put on top.

    Keys below `platform.` other than `preset` and `file` are those of the platform file, as in
    `platform.wheel_limits.speed_rad_s=20`.
    A value is TOML, or else a bare string. Raises ScenarioError with every mistake of both files and of the overrides.

    trust_models: whether a script beside the scenario may be flown; it can be read and cued anew in any case.
    """
    settings = parse_overrides(overrides)
    return resolve(read_toml(path), settings, path, trust_models=trust_models)


class Platforms:
    """Platforms by file and overrides, each read and checked once, however many scenarios have it."""

    def __init__(self) -> None:
        self._files = TomlFiles()
        self._known: dict[tuple[Path, bytes], tuple[Platform | None, list[Mistake]]] = {}

    def get(self, path: Path, overrides: Overrides) -> tuple[Platform | None, list[Mistake]]:
        """The platform, or none and what is wrong with it."""
        key = path, pickle.dumps(overrides)  # tells 1, 1.0 and true apart, which are equal
        if key not in self._known:
            self._known[key] = _read_platform(path, overrides, self._files)
        return self._known[key]


def resolve(
    data: dict[str, Any],
    settings: Overrides,
    path: Path,
    *,
    trust_models: bool = False,
    platforms: Platforms | None = None,
) -> Scenario:
    """As `load_scenario` for the table that `path` holds, which is changed, and overrides read already.

    platforms: of the scenarios before this one, when there are many.
    """
    deep = {
        key[1:]: value for key, value in settings.items() if key[0] == "platform" and len(key) > 1 and key[1] not in _CHOICE
    }
    flat = {key: value for key, value in settings.items() if key[0] != "platform" or key[1:] not in deep}
    if ("cueing", "method") in flat:
        _leave_method(data, flat["cueing", "method"])
    mistakes = apply_overrides(data, flat)
    file, found = _validate(ScenarioFile, data, FileNamer(str(path), flat), path.parent)
    broken = _broken_rules(data, FileNamer(str(path), flat))
    mistakes += found + broken[:MOST_SHOWN] + more(len(broken) - MOST_SHOWN, str(path))
    platform, found = _chosen_platform(data.get("platform"), path.parent, deep, platforms or Platforms())
    mistakes += found
    if mistakes or file is None or platform is None:
        raise ScenarioError(mistakes)
    return Scenario(file, platform, path.parent, trust_models)


def load_platform(name_or_path: str) -> Platform:
    """A platform of the package by name, or a platform file by path. Raises ScenarioError with every mistake."""
    path = presets().get(name_or_path, Path(name_or_path))
    if not os.path.exists(path):  # Path.exists raises when a name is too long
        raise ScenarioError(
            [Mistake(name_or_path, "file", "", f"no such file or platform; {nearest(name_or_path, presets())}")]
        )
    platform, mistakes = Platforms().get(path, {})
    if platform is None:
        raise ScenarioError(mistakes)
    return platform


def _read_platform(path: Path, overrides: Overrides, files: TomlFiles) -> tuple[Platform | None, list[Mistake]]:
    try:
        data = with_own(files.read(path), overrides)
    except ScenarioError as error:
        return None, list(error.mistakes)
    mistakes = apply_overrides(data, overrides)
    platform, found = _validate(
        Platform, data, FileNamer(path.name if path in presets().values() else str(path), overrides), path
    )
    return platform, [replace(m, key=f"platform.{m.key}") if m.file == SET else m for m in mistakes + found]


def _chosen_platform(
    choice: Any, folder: Path, overrides: Overrides, platforms: Platforms
) -> tuple[Platform | None, list[Mistake]]:
    """The platform of a `[platform]` table; none, and no mistake either, when the table itself is wrong."""
    if not isinstance(choice, dict):
        return None, []
    preset, file = (choice.get(key) for key in _CHOICE)
    if isinstance(preset, str) and preset in presets() and file is None:
        return platforms.get(presets()[preset], overrides)
    if isinstance(file, str) and is_path(file) and preset is None:
        return platforms.get(folder / file, overrides)
    return None, []


def _validate(table: type[T], data: dict[str, Any], name_file: FileNamer, folder: Path) -> tuple[T | None, list[Mistake]]:
    try:
        return table.model_validate(data, context={"folder": folder}), []
    except ValidationError as error:
        return None, mistakes_of(error, table, data, name_file)


def _broken_rules(data: dict[str, Any], name_file: FileNamer) -> list[Mistake]:
    """Keys that must or must not go together."""
    broken: list[tuple[Key, str]] = [*vehicle_rules(data)]
    choice = data.get("platform")
    if isinstance(choice, dict) and ("preset" in choice) == ("file" in choice):
        broken.append((("platform",), "exactly one of preset and file"))
    return [Mistake(name_file(key), dotted(key), "", allowed) for key, allowed in broken]


def _leave_method(data: dict[str, Any], method: Any) -> None:
    """When another method is set from the command line, leave out what only the file's own method knows."""
    table = data.get("cueing")
    if not isinstance(table, dict) or not isinstance(method, str) or method not in ALL_METHODS:
        return
    old = ALL_METHODS.get(str(table.get("method", DEFAULT_METHOD)))
    for key in [key for key in table if old and key in old.model_fields and key not in ALL_METHODS[method].model_fields]:
        del table[key]
