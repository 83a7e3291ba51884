"""The `[sweep]` table: one scenario file that stands for many runs.

    [sweep]
    cueing.method = ["blend", "force"]  # a list: every value, with every value of the others
    vehicle.script = "c172*"  # a pattern: every name known here and now
    draws = 100  # so many draws from the ranges, for each of the above
    seed = 1
    cueing.align_rate_deg_s = { low = 0.5, high = 10.0, log = true }  # a range, of the logarithm

Keys are those of `--set`. Every range has a stream of random numbers of its own: another range
beside it changes nothing, and every point of the grid gets the same draws, so that they compare.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from itertools import product
from math import exp, log, prod
from pathlib import Path
from random import Random
from typing import Annotated, Any, TypeAlias

from pydantic import ValidationError

from ..cueing import CAUSAL_METHODS
from ..errors import Mistake, ScenarioError
from ..vehicles import own_aircraft, own_scripts
from .load import Known, resolve
from .mistakes import SET, FileNamer, Key, dotted, mistakes_of, more, nearest, shown
from .overrides import Overrides, apply_overrides, parse_overrides, with_own
from .platform_file import presets
from .reading import count_keys, read_toml
from .scenario import Scenario
from .tables import Finite, ScenarioTable, whole

# of one file; a grid of a few more keys than meant has millions, and all are checked before the
# first flies
MAX_RUNS = 10_000
MAX_KEYS_CHECKED = 500_000  # keys of the file times runs: up to 2 us and 130 bytes each
MAX_KEYS = 16  # of one sweep; each is a stream of random numbers as long as the draws
MAX_MISTAKES = 50  # of one sweep, where a single wrong value may spoil thousands of runs ...
MAX_SPOILT = 500  # ... and that many runs are looked at for other mistakes
_LONGEST_PATTERN = 200  # characters; names are shorter

_SWEEP = "sweep"
_LISTS = ("input", "signal")  # of a vehicle; all else in a file is small
_COUNTS = ("draws", "seed")
_NAMES: dict[Key, Callable[[], Collection[str]]] = {
    ("vehicle", "script"): own_scripts,
    ("vehicle", "aircraft"): own_aircraft,
    ("platform", "preset"): presets,
    ("cueing", "method"): lambda: CAUSAL_METHODS,
}
_ALLOWED = (
    "allowed: a list of values, or a range { low = ..., high = ... } together with sweep.draws"
)

Choices: TypeAlias = dict[Key, Sequence[Any]]


@dataclass(frozen=True, slots=True)
class Variant:
    """One run of a file: its scenario, and what the sweep set in it.

    The settings are dotted key to value; there are none without a sweep.
    """

    scenario: Scenario
    settings: dict[str, Any]


class _Range(ScenarioTable):
    low: Finite
    high: Finite
    log: bool = False


class _Counts(ScenarioTable):
    draws: Annotated[int, whole(1, MAX_RUNS)] | None = None
    seed: Annotated[int, whole(0, 2**63 - 1)] = 0


def scenario_files(folder: str | Path) -> list[Path]:
    """The scenario files of a folder, by name, without platform files among them.

    Raises ScenarioError if there are none.
    """
    files = [path for path in sorted(Path(folder).glob("*.toml")) if not _is_platform(path)]
    if not files:
        raise ScenarioError(
            [Mistake(str(folder), "folder", "", "no scenario files (*.toml) in it")]
        )
    return files


def _is_platform(path: Path) -> bool:
    try:
        data = read_toml(path)
    except ScenarioError:
        return False  # reported when it is loaded
    return "sphere" in data and "vehicle" not in data


def load_variants(
    path: str | Path, overrides: Sequence[str] = (), *, trust_models: bool = False
) -> list[Variant]:
    """Every run that a scenario file stands for: one, or as many as its sweep has.

    `overrides` are as for `load_scenario`; one of a swept key takes the key out of the sweep, and
    one below `sweep.` changes the sweep itself; `trust_models` is as there. Raises ScenarioError
    with every mistake of the sweep, or else of the runs, each once.
    """
    settings, path = parse_overrides(overrides), Path(path)
    of_sweep = {key: value for key, value in settings.items() if key[0] == _SWEEP}
    others = {key: value for key, value in settings.items() if key not in of_sweep}
    data = read_toml(path)
    mistakes = apply_overrides(data, of_sweep)
    if mistakes:
        raise ScenarioError(mistakes)
    table = data.pop(_SWEEP, None)
    if table is None:
        return [Variant(resolve(data, others, path, trust_models=trust_models), {})]
    points = _points(table, others, count_keys(data), FileNamer(str(path), of_sweep))
    return _resolved(data, others, points, path, trust_models)


def _resolved(
    data: dict[str, Any],
    others: Overrides,
    points: Iterable[Overrides],
    path: Path,
    trust_models: bool,
) -> list[Variant]:
    variants, spoilt = [], 0
    found: dict[Mistake, None] = {}  # an ordered set
    known = Known()
    for point in points:
        swept = {dotted(key): value for key, value in point.items()}
        try:
            settings = {**others, **point}
            scenario = resolve(
                with_own(data, settings), settings, path, trust_models=trust_models, known=known
            )
            variants.append(Variant(scenario, swept))
            _settle(data, scenario, settings)
        except ScenarioError as error:
            found |= dict.fromkeys(_of_sweep(mistake, swept, path) for mistake in error.mistakes)
            spoilt += 1
            if len(found) >= MAX_MISTAKES or spoilt >= MAX_SPOILT:
                break
    if found:
        raise ScenarioError(list(found)[:MAX_MISTAKES])
    return variants


def _settle(data: dict[str, Any], scenario: Scenario, settings: Overrides) -> None:
    """Put in place of long lists what has been made of them, when no run sets anything there.

    Checked once, and kept once.
    """
    for name in _LISTS:
        checked = getattr(scenario.file.vehicle, name, None)
        set_anew = any(key[:2] in (("vehicle",), ("vehicle", name)) for key in settings)
        if checked and not set_anew:
            data["vehicle"][name] = checked


def _of_sweep(mistake: Mistake, swept: Collection[str], path: Path) -> Mistake:
    """A mistake in a value that the sweep set, named as such."""
    mine = any(f"{mistake.key}.".startswith(f"{key}.") for key in swept)
    if mistake.file != SET or not mine:
        return mistake
    return Mistake(str(path), f"{_SWEEP}.{mistake.key}", mistake.value, mistake.allowed)


def _points(table: Any, others: Overrides, keys: int, name_file: FileNamer) -> Iterator[Overrides]:
    """What every run sets, in a file of so many keys."""
    if not isinstance(table, dict):
        raise ScenarioError(
            [Mistake(name_file((_SWEEP,)), _SWEEP, shown(table), "allowed: a table")]
        )
    counts, mistakes = _counts(table, name_file)
    grid: Choices = {}
    ranges: dict[Key, _Range] = {}
    for key, value in _leaves(
        {name: inner for name, inner in table.items() if name not in _COUNTS}
    ):
        choice = _choice(key, value)
        if isinstance(choice, str):
            full = (_SWEEP, *key)
            mistakes.append(Mistake(name_file(full), dotted(full), shown(value), choice))
        elif isinstance(choice, _Range):
            ranges[key] = choice
        else:
            grid[key] = choice
    mistakes += [
        Mistake(name_file((_SWEEP,)), _SWEEP, "", wrong)
        for wrong in _disagreement(grid, ranges, counts, keys)
    ]
    if mistakes:
        raise ScenarioError(
            mistakes[:MAX_MISTAKES] + more(len(mistakes) - MAX_MISTAKES, name_file((_SWEEP,)))
        )
    grid = {key: values for key, values in grid.items() if key not in others}
    ranges = {key: bounds for key, bounds in ranges.items() if key not in others}
    return _combined(grid, ranges, counts)


def _counts(table: dict[str, Any], name_file: FileNamer) -> tuple[_Counts, list[Mistake]]:
    given = {name: table[name] for name in _COUNTS if name in table}
    try:
        return _Counts.model_validate(given), []
    except ValidationError as error:
        wrong = mistakes_of(error, _Counts, given, name_file)
        return _Counts(draws=1), [
            Mistake(name_file((_SWEEP, m.key)), f"{_SWEEP}.{m.key}", m.value, m.allowed)
            for m in wrong
        ]


def _leaves(table: dict[str, Any], above: Key = ()) -> Iterator[tuple[Key, Any]]:
    """Keys and what they choose from; a table that is no range holds further keys."""
    for name, value in table.items():
        key: Key = (*above, int(name) if name.isdecimal() and name.isascii() else name)
        if isinstance(value, dict) and value and not ({"low", "high"} & value.keys()):
            yield from _leaves(value, key)
        else:
            yield key, value


def _choice(key: Key, value: Any) -> Sequence[Any] | _Range | str:
    """The values of a list or pattern, a range, or what is allowed instead."""
    if isinstance(value, list) and value:
        return value
    if isinstance(value, dict):
        return _range(value)
    if isinstance(value, str) and key in _NAMES:
        known = _NAMES[key]()
        if len(value) > _LONGEST_PATTERN:
            return f"a pattern is too long, allowed: length <= {_LONGEST_PATTERN}"
        return (
            sorted(name for name in known if fnmatchcase(name, value))
            or f"no such name; {nearest(value, known)}"
        )
    return _ALLOWED


def _range(value: dict[str, Any]) -> _Range | str:
    allowed = "allowed: { low = a number, high = a larger one }, with log = true also 0 < low"
    try:
        bounds = _Range.model_validate(value)
    except ValidationError:
        return allowed
    return (
        bounds if bounds.low < bounds.high and not (bounds.log and bounds.low <= 0.0) else allowed
    )


def _disagreement(
    grid: Choices, ranges: dict[Key, _Range], counts: _Counts, keys: int
) -> list[str]:
    if not grid and not ranges:
        return ["nothing to sweep; " + _ALLOWED]
    if bool(ranges) != (counts.draws is not None):
        return ["ranges and draws go together: draws = N takes N values out of every range"]
    if len(grid) + len(ranges) > MAX_KEYS:
        return [f"{len(grid) + len(ranges)} keys, allowed: keys <= {MAX_KEYS}"]
    runs = prod(map(len, grid.values())) * (counts.draws or 1)
    most = min(MAX_RUNS, MAX_KEYS_CHECKED // max(keys, 1))
    of_size = f" of a file of {keys} keys" if most < MAX_RUNS else ""
    return (
        [f"{runs} runs{of_size}, allowed: runs <= {most}; several files may share the rest"]
        if runs > most
        else []
    )


def _combined(grid: Choices, ranges: dict[Key, _Range], counts: _Counts) -> Iterator[Overrides]:
    drawn = {key: _drawn(bounds, counts, dotted(key)) for key, bounds in ranges.items()}
    for values in product(*grid.values()):
        fixed = dict(zip(grid, values, strict=True))
        for i in range(counts.draws or 1 if ranges else 1):
            yield {**fixed, **{key: numbers[i] for key, numbers in drawn.items()}}


def _drawn(bounds: _Range, counts: _Counts, name: str) -> list[float]:
    stream = Random(f"{counts.seed}:{name}")  # noqa: S311 - a sweep, not a secret
    shares = [stream.random() for _ in range(counts.draws or 1)]
    if bounds.log:
        least, most = log(bounds.low), log(bounds.high)
        return [
            min(max(exp(least + share * (most - least)), bounds.low), bounds.high)
            for share in shares
        ]
    return [bounds.low + share * (bounds.high - bounds.low) for share in shares]
