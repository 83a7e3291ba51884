"""Which run a mismatch ratio is to."""

from dataclasses import replace
from pathlib import Path

from atlas_cueing.batch.beside_still import mismatch_ratios
from atlas_cueing.batch.fly_batch import Outcome
from atlas_cueing.batch.job_result import JobResult
from atlas_cueing.batch.table import rows
from atlas_cueing.run import Evaluation

from .sweeping import SWEEP, planned

METHODS = '["blend", "classical", "still"]'


def outcomes(folder: Path, sweep: str, *mismatches: float) -> list[Outcome]:
    """Runs of a sweep with these mismatches."""
    text = SWEEP.partition("cueing.method")[0] + sweep
    runs = planned(folder, text=text)
    assert len(runs) == len(mismatches)
    return [
        Outcome(run, JobResult("ok", evaluation=Evaluation({"mismatch": m}), id=run.id))
        for run, m in zip(runs, mismatches, strict=True)
    ]


def ratios(found: list[Outcome]) -> list[float | None]:
    by_id = mismatch_ratios(found)
    table = [row.get("mismatch_ratio") for row in rows(found)]
    assert table == [by_id.get(each.run.id, {}).get("mismatch_ratio") for each in found]
    return table


def test_all_methods_beside_still(tmp_path: Path) -> None:
    """Also `classical`, whose stage has defaults of its own."""
    found = outcomes(tmp_path, f"cueing.method = {METHODS}", 2.0, 8.0, 4.0)
    assert ratios(found) == [0.5, 2.0, 1.0]


def test_without_still_there_is_none(tmp_path: Path) -> None:
    found = outcomes(tmp_path, 'cueing.method = ["blend", "force"]', 2.0, 8.0)
    assert ratios(found) == [None, None]


def test_a_mark_that_failed_is_none(tmp_path: Path) -> None:
    blend, classical, still = outcomes(tmp_path, f"cueing.method = {METHODS}", 2.0, 8.0, 4.0)
    failed = Outcome(still.run, replace(still.result, result="vehicle_failed"))  # type: ignore[type-var]
    assert ratios([blend, classical, failed, Outcome(still.run, None)]) == [None] * 4
    failed = Outcome(blend.run, replace(blend.result, result="vehicle_failed"))  # type: ignore[type-var]
    assert ratios([failed, classical, still]) == [None, 2.0, 1.0]


def test_every_vehicle_and_platform_has_its_own_mark(tmp_path: Path) -> None:
    sweep = 'cueing.method = ["blend", "still"]\nvehicle.script = ["c1722", "c1723"]\n'
    sweep += 'platform.preset = ["atlas-2.9m", "atlas-1.5m"]'
    found = outcomes(tmp_path, sweep, 2.0, 3.0, 4.0, 5.0, 10.0, 10.0, 10.0, 20.0)
    assert ratios(found) == [0.2, 0.3, 0.4, 0.25, 1.0, 1.0, 1.0, 1.0]


def test_of_several_marks_that_with_the_same_stage(tmp_path: Path) -> None:
    sweep = 'cueing.method = ["blend", "still"]\ncueing.force_gain = [0.5, 1.0]'
    assert ratios(outcomes(tmp_path, sweep, 2.0, 2.0, 4.0, 8.0)) == [0.5, 0.25, 1.0, 1.0]
    sweep = 'cueing.method = ["classical", "still"]\ncueing.force_gain = [0.5, 1.0]'
    assert ratios(outcomes(tmp_path, sweep, 2.0, 2.0, 4.0, 8.0)) == [None, None, 1.0, 1.0]
