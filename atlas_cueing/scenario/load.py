"""Files to scenarios: everything is checked, and all mistakes are reported at once."""

import os
import pickle
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from ..cueing import DEFAULT_METHOD
from ..errors import InputError, Mistake, ScenarioError
from ..printable import is_name
from .cueing_table import TABLES
from .jsbsim_table import unsettable_inputs
from .mistakes import MOST_SHOWN, SET, FileNamer, Key, dotted, mistakes_of, more, nearest
from .overrides import Overrides, apply_overrides, parse_overrides, with_own
from .own_method_table import from_here, is_own, own_table
from .platform_file import Platform, presets
from .reading import TomlFiles, read_toml
from .scenario import Scenario, ScenarioFile
from .tables import ScenarioTable
from .vehicle_table import vehicle_rules

T = TypeVar("T", bound=ScenarioTable)

_CHOICE = ("preset", "file")


def load_scenario(
    path: str | Path, overrides: Sequence[str] = (), *, trust_models: bool = False
) -> Scenario:
    """Read a scenario file and its platform, with `KEY=VALUE` overrides put on top.

    Keys below `platform.` other than `preset` and `file` are those of the platform file, as in
    `platform.wheel_limits.speed_rad_s=20`. A value is TOML, or else a bare string. Raises
    ScenarioError with every mistake of both files and of the overrides.

    trust_models: whether a script or aircraft beside the scenario may be flown; it can be read and
        cued anew in any case. A cueing method in a file beside it is not even read without.

    Example:
        >>> from atlas_cueing import load_scenario
        >>> scenario = load_scenario("scenarios/f16_rolls.toml", ["cueing.method=force"])
        >>> scenario.name, scenario.platform.name, scenario.file.cueing.method
        ('f16_rolls', 'atlas-2.9m', 'force')

    """
    if os.path.isdir(path):
        batch = f"to fly all scenarios in it: atlas-cueing batch {path} -o RESULTS"
        allowed = f"is a folder, not a regular file; {batch}"
        raise ScenarioError([Mistake(str(path), "file", "", allowed)])
    settings, path = parse_overrides(overrides), Path(path)
    return resolve(read_toml(path), settings, path, trust_models=trust_models)


class Known:
    """What the scenarios of one file are made of, by overrides.

    Read and checked once, however many have it.
    """

    def __init__(self) -> None:
        self._files = TomlFiles()
        self._platforms: dict[tuple[Path, bytes], tuple[Platform | None, list[Mistake]]] = {}
        self._tables: dict[bytes, tuple[ScenarioFile | None, list[Mistake]]] = {}

    def platform(self, path: Path, overrides: Overrides) -> tuple[Platform | None, list[Mistake]]:
        """The platform, or none and what is wrong with it."""
        key = path, _exactly(overrides)
        if key not in self._platforms:
            self._platforms[key] = _read_platform(path, overrides, self._files)
        return self._platforms[key]

    def table(
        self, data: dict[str, Any], overrides: Overrides, path: Path, trusted: bool
    ) -> tuple[ScenarioFile | None, list[Mistake]]:
        """The scenario's own table, or none and what is wrong with it.

        The overrides are in `data` already.
        """
        key = _exactly(overrides)
        if key not in self._tables:
            self._tables[key] = _read_table(data, overrides, path, trusted)
        return self._tables[key]


def resolve(
    data: dict[str, Any],
    settings: Overrides,
    path: Path,
    *,
    trust_models: bool = False,
    known: Known | None = None,
) -> Scenario:
    """Resolve the table that `path` holds, as `load_scenario` does; the table is changed.

    The overrides have been read already.

    known: of the scenarios before this one of the same file, when there are many.
    """
    known = known or Known()
    deep = {
        key[1:]: value
        for key, value in settings.items()
        if key[0] == "platform" and len(key) > 1 and key[1] not in _CHOICE
    }
    flat = {
        key: value for key, value in settings.items() if key[0] != "platform" or key[1:] not in deep
    }
    if ("cueing", "method") in flat:
        flat["cueing", "method"] = from_here(flat["cueing", "method"], path.parent)
        _leave_method(data, flat["cueing", "method"], path.parent, trust_models)
    mistakes = apply_overrides(data, flat)
    file, found = known.table(data, flat, path, trust_models)
    mistakes += found
    platform, found = _chosen_platform(data.get("platform"), path.parent, deep, known)
    mistakes += found
    if mistakes or file is None or platform is None:
        raise ScenarioError(mistakes)
    return Scenario(
        file,
        platform,
        path.parent,
        trust_models,
        str(path),
        _platform_namer(file, path.parent, deep),
    )


def load_platform(name_or_path: str) -> Platform:
    """A platform of the package by name, or a platform file by path.

    Raises ScenarioError with every mistake.

    Example:
        >>> from atlas_cueing import load_platform
        >>> platform = load_platform("atlas-2.9m")
        >>> platform.wheel_limit_values().speed  # rad/s
        (31.0, 31.0, 31.0)

    """
    path = presets().get(name_or_path, Path(name_or_path))
    if not os.path.exists(path):  # Path.exists raises when a name is too long
        raise ScenarioError(
            [
                Mistake(
                    name_or_path,
                    "file",
                    "",
                    f"no such file or platform; {nearest(name_or_path, presets())}",
                )
            ]
        )
    platform, mistakes = Known().platform(path, {})
    if platform is None:
        raise ScenarioError(mistakes)
    return platform


def _exactly(overrides: Overrides) -> bytes:
    """A key that tells 1, 1.0 and true apart, which are equal."""
    return pickle.dumps(overrides)


def _read_table(
    data: dict[str, Any], overrides: Overrides, path: Path, trusted: bool
) -> tuple[ScenarioFile | None, list[Mistake]]:
    name_file = FileNamer(str(path), overrides)
    file, mistakes = _validate(ScenarioFile, data, name_file, path.parent, trusted=trusted)
    broken = _broken_rules(data, name_file)
    for key, value, wrong in unsettable_inputs(data, path.parent, trusted):
        broken.append(Mistake(name_file(key), dotted(key), value, wrong))
    return file, [*mistakes, *broken[:MOST_SHOWN], *more(len(broken) - MOST_SHOWN, str(path))]


def _read_platform(
    path: Path, overrides: Overrides, files: TomlFiles
) -> tuple[Platform | None, list[Mistake]]:
    try:
        data = with_own(files.read(path), overrides)
    except ScenarioError as error:
        return None, list(error.mistakes)
    mistakes = apply_overrides(data, overrides)
    platform, found = _validate(
        Platform,
        data,
        FileNamer(path.name if path in presets().values() else str(path), overrides),
        path,
    )
    return platform, [
        replace(m, key=f"platform.{m.key}") if m.file == SET else m for m in mistakes + found
    ]


def _platform_namer(file: ScenarioFile, folder: Path, overrides: Overrides) -> FileNamer:
    """Which file a key of the platform came from, for what is found wrong with it later."""
    preset, other = file.platform.preset, file.platform.file
    return FileNamer(presets()[preset].name if preset else str(folder / (other or "")), overrides)


def _chosen_platform(
    choice: Any, folder: Path, overrides: Overrides, known: Known
) -> tuple[Platform | None, list[Mistake]]:
    """The platform of a `[platform]` table.

    None, and no mistake either, when the table itself is wrong.
    """
    if not isinstance(choice, dict):
        return None, []
    preset, file = (choice.get(key) for key in _CHOICE)
    if isinstance(preset, str) and preset in presets() and file is None:
        return known.platform(presets()[preset], overrides)
    if isinstance(file, str) and is_name(file) and preset is None:
        return known.platform(folder / file, overrides)
    return None, []


def _validate(
    table: type[T],
    data: dict[str, Any],
    name_file: FileNamer,
    folder: Path,
    *,
    trusted: bool = False,
) -> tuple[T | None, list[Mistake]]:
    context = {"folder": folder, "trusted": trusted}
    try:
        return table.model_validate(data, context=context), []
    except ValidationError as error:
        return None, mistakes_of(error, table, data, name_file)


def _broken_rules(data: dict[str, Any], name_file: FileNamer) -> list[Mistake]:
    """Keys that must or must not go together."""
    broken: list[tuple[Key, str]] = [*vehicle_rules(data)]
    choice = data.get("platform")
    if isinstance(choice, dict) and ("preset" in choice) == ("file" in choice):
        broken.append((("platform",), "exactly one of preset and file"))
    return [Mistake(name_file(key), dotted(key), "", allowed) for key, allowed in broken]


def _leave_method(data: dict[str, Any], method: Any, folder: Path, trusted: bool) -> None:
    """Leave out the keys of the file's own method when another one is set."""
    table = data.get("cueing")
    if not isinstance(table, dict):
        return
    old = _keys_of(table.get("method", DEFAULT_METHOD), folder, trusted)
    new = _keys_of(method, folder, trusted)
    for key in [key for key in table if new and key in old and key not in new]:
        del table[key]


def _keys_of(method: Any, folder: Path, trusted: bool) -> Collection[str]:
    """Keys of a method's table; none of what is no method, or cannot be had."""
    if is_own(method):
        try:
            return own_table(method, folder, trusted).model_fields
        except InputError:  # reported where the table is checked
            return ()
    return TABLES[method].model_fields if isinstance(method, str) and method in TABLES else ()
