"""What a batch will fly: every run of every file, checked before anything runs."""

import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

from ..errors import InputError, ScenarioError
from ..run import build_pipeline
from ..scenario import Scenario, Variant, load_variants, scenario_files
from ..vehicles import own_scripts
from .run_id import run_id

MANY = 1000  # runs; to check as many takes seconds
MOST_REFUSED = 500  # runs of a file; what is wrong with that many is mostly one thing
_LARGEST_SCRIPT = 20_000_000  # bytes; what JSBSim is given at most
_NUMBER = rb"""\s*=\s*["']\s*([0-9.eE+-]+)\s*["']"""


@dataclass(frozen=True, slots=True)
class PlannedRun:
    """One run: `settings` is what its sweep set, dotted key to value.

    duration: of the flight as far as the files tell, s; None when unknown. step: of the vehicle, s.
    """

    id: str
    source: Path
    scenario: Scenario
    settings: dict[str, Any]
    duration: float | None
    step: float

    @property
    def ticks(self) -> float:
        """How much work it is at most; infinite when unknown."""
        return inf if self.duration is None else self.duration / self.step


def plan(
    paths: Iterable[Path],
    overrides: Sequence[str] = (),
    *,
    trust_models: bool = False,
    checking: Callable[[Path, int], object] = lambda _file, _runs: None,
) -> list[PlannedRun]:
    """All runs of scenario files, sweeps and folders of them; of runs that are the same the first.

    Raises InputError with the mistakes of all files at once, also when a platform cannot be driven
    or does not fit the step, and for a user's script without `trust_models`; a file's runs are
    looked at up to MOST_REFUSED that are wrong. `checking` is called with a file of MANY runs or
    more, and their number, before they are.
    """
    runs: dict[str, PlannedRun] = {}
    wrong: dict[str, None] = {}  # an ordered set
    for file in _files(paths, wrong):
        try:
            variants = load_variants(file, overrides, trust_models=trust_models)
        except ScenarioError as error:
            wrong |= dict.fromkeys(error.lines)
            continue
        if len(variants) >= MANY:
            checking(file, len(variants))
        _add(runs, wrong, file, variants)
    if wrong:
        raise InputError(*wrong)
    return list(runs.values())


def _files(paths: Iterable[Path], wrong: dict[str, None]) -> Iterator[Path]:
    """The files, and those of folders."""
    for path in paths:
        try:
            # Path.is_dir raises when a name is too long
            yield from scenario_files(path) if os.path.isdir(path) else [path]
        except ScenarioError as error:
            wrong |= dict.fromkeys(error.lines)


def _add(
    runs: dict[str, PlannedRun], wrong: dict[str, None], file: Path, variants: Sequence[Variant]
) -> None:
    """Put the runs of a file with those of the files before, or what is wrong with them."""
    refused = 0
    for variant in variants:
        duration, step = _course(variant.scenario)
        try:
            _check(variant.scenario, step)
            name = run_id(variant.scenario)
        except InputError as error:
            wrong |= dict.fromkeys(f"{file}: {line}" for line in str(error).splitlines())
            refused += 1
            if refused == MOST_REFUSED:
                break
            continue
        runs.setdefault(
            name, PlannedRun(name, file, variant.scenario, variant.settings, duration, step)
        )


def _check(scenario: Scenario, step: float) -> None:
    """Raises InputError for what flies only live, or on no platform at this step."""
    _ = scenario.flight
    if not scenario.needs_whole_flight:
        build_pipeline(scenario, step)


def _course(scenario: Scenario) -> tuple[float | None, float]:
    """Length of the flight and its step, s, as far as the files tell.

    A script may end earlier, or not load at all.
    """
    file = scenario.file
    rate = file.vehicle.rate_hz or 120.0
    if file.vehicle.script is None:
        return file.duration_s, 1.0 / rate
    script = file.vehicle.user_script(scenario.folder) or own_scripts()[file.vehicle.script]
    start, end, dt = _script_course(script)
    length = None if end is None else max(end - (start or 0.0), 0.0)
    known = [time for time in (length, file.duration_s) if time is not None]
    step = (
        dt if dt is not None and 1e-4 <= dt <= 0.1 and file.vehicle.rate_hz is None else 1.0 / rate
    )
    return min(known, default=None), step


def _script_course(script: Path) -> tuple[float | None, float | None, float | None]:
    """Start, end and step that a script states, s."""
    try:
        with script.open("rb") as file:
            run = re.search(rb"<run\b([^>]*)>", file.read(_LARGEST_SCRIPT))
    except OSError:  # said in words when its content is asked for
        run = None
    text = run[1] if run else b""
    return _number(b"start", text), _number(b"end", text), _number(b"dt", text)


def _number(name: bytes, text: bytes) -> float | None:
    found = re.search(rb"\b" + name + _NUMBER, text)
    try:
        return float(found[1]) if found else None
    except ValueError:
        return None
