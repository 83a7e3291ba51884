"""The runs of a batch beside the run by `still` of the same flight."""

from collections.abc import Iterable, Sequence
from typing import TypeAlias

from ..evaluation import mismatch_ratio
from .fly_batch import Outcome

STILL = "still"  # the method that a mismatch ratio is to
_OF_THE_STAGE = ("force_gain", "stage")  # keys of `[cueing]`
_Flight: TypeAlias = tuple[str, float | None, str]


def mismatch_ratios(outcomes: Sequence[Outcome]) -> dict[str, dict[str, float]]:
    """Give the mismatch_ratio of each run that has one, by its id.

    It is to the run by `still` of the same vehicle for as long on the same platform. Where a sweep
    has several of them, it is the one with the same stage, and none where that is not one. Runs
    that did not fly to their end have none.
    """
    flown = [outcome for outcome in outcomes if _mismatch(outcome) is not None]
    marks: dict[_Flight, list[Outcome]] = {}
    for outcome in flown:
        if outcome.run.scenario.file.cueing.method == STILL:
            marks.setdefault(_flight(outcome), []).append(outcome)
    return {
        outcome.run.id: {"mismatch_ratio": mismatch_ratio(mismatch, mark)}
        for outcome in flown
        for mismatch in _found(_mismatch(outcome))
        for mark in _found(_mark(outcome, marks.get(_flight(outcome), [])))
    }


def _mark(outcome: Outcome, marks: Sequence[Outcome]) -> float | None:
    """The mismatch of the one among the marks that this run is compared with."""
    alike = [mark for mark in marks if _stage(mark) == _stage(outcome)]
    chosen = marks if len(marks) == 1 else alike
    return _mismatch(chosen[0]) if len(chosen) == 1 else None


def _mismatch(outcome: Outcome) -> float | None:
    result = outcome.result
    if result is None or result.result != "ok":
        return None
    return result.evaluation.metrics.get("mismatch")


def _flight(outcome: Outcome) -> _Flight:
    file = outcome.run.scenario.file
    return repr(file.vehicle), file.duration_s, repr(outcome.run.scenario.platform)


def _stage(outcome: Outcome) -> str:
    keys = dict(outcome.run.scenario.file.cueing)
    return repr([keys.get(key) for key in _OF_THE_STAGE])


def _found(value: float | None) -> Iterable[float]:
    return () if value is None else (value,)
