"""What a batch will fly: every run of every file, checked before anything runs."""

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

from ..errors import InputError, ScenarioError
from ..run import build_pipeline, flight_length
from ..scenario import Scenario, Variant, load_variants, scenario_files
from .run_id import flight_id, run_id

MANY = 1000  # runs; to check as many takes seconds
MOST_REFUSED = 500  # runs of a file; what is wrong with that many is mostly one thing


@dataclass(frozen=True, slots=True)
class PlannedRun:
    """One run: `settings` is what its sweep set, dotted key to value.

    duration: of the flight as far as the files tell, s; None when unknown. step: of the vehicle, s.
    flight: the same for runs in which the vehicle does the same.
    """

    id: str
    source: Path
    scenario: Scenario
    settings: dict[str, Any]
    duration: float | None
    step: float
    flight: str

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
        try:
            run = _planned(file, variant)
        except InputError as error:
            wrong |= dict.fromkeys(f"{file}: {line}" for line in str(error).splitlines())
            refused += 1
            if refused == MOST_REFUSED:
                break
            continue
        runs.setdefault(run.id, run)


def _planned(file: Path, variant: Variant) -> PlannedRun:
    """Check a run of a file as far as that goes without flying it.

    Raises InputError for what flies only live, or on no platform at this step.
    """
    scenario = variant.scenario
    flight = scenario.flight
    step = flight.step()
    if not scenario.needs_whole_flight:
        build_pipeline(scenario, step)
    length = flight_length(flight, scenario.file.duration_s)
    names = run_id(scenario), file, scenario, variant.settings
    return PlannedRun(*names, length, step, flight_id(scenario))
