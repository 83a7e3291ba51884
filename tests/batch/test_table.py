import csv
from io import StringIO
from math import nan
from pathlib import Path

from atlas_cueing.batch.execute import fly_alone
from atlas_cueing.batch.fly_batch import Outcome
from atlas_cueing.batch.job_result import JobResult
from atlas_cueing.batch.table import METRIC_COLUMNS, columns, csv_of, ordered, rows
from atlas_cueing.run import Evaluation

from .sweeping import job_of, planned

METRIC = "force_rms_m_s2"


def outcomes(folder: Path) -> list[Outcome]:
    blend, attitude, force, classical = planned(folder)
    return [
        Outcome(
            blend,
            JobResult(
                "ok",
                log=Path("b.mcap"),
                ticks=31,
                duration=0.25,
                wall=0.1,
                evaluation=Evaluation(
                    metrics={METRIC: 2.0}, limit_use={"wheel_speed": 0.5}, violations=("x",)
                ),
                id=blend.id,
            ),
        ),
        Outcome(
            attitude,
            JobResult(
                "ok",
                log=Path("a.mcap"),
                ticks=31,
                duration=0.25,
                wall=0.1,
                evaluation=Evaluation(metrics={METRIC: 1.0}),
                id=attitude.id,
            ),
        ),
        Outcome(
            force,
            JobResult(
                "vehicle_failed",
                'it said "no",\ntwice',
                evaluation=Evaluation(metrics={METRIC: 0.0}),
                id=force.id,
            ),
        ),
        Outcome(classical, None),
    ]


def test_a_row_has_what_it_was_and_what_came_of_it(tmp_path: Path) -> None:
    first, _, failed, unflown = rows(outcomes(tmp_path))
    assert first["run"] == outcomes(tmp_path)[0].run.id
    assert (first["source"], first["scenario"], first["vehicle"]) == (
        "sweep.toml",
        "short",
        "c1722",
    )
    assert (first["method"], first["platform"], first["cueing.method"]) == (
        "blend",
        "atlas-2.9m",
        "blend",
    )
    assert (
        first["result"],
        first["violations"],
        first[METRIC],
        first["limit_use_wheel_speed"],
    ) == ("ok", 1, 2.0, 0.5)
    assert (first["ticks"], first["duration_s"], first["wall_s"]) == (31, 0.25, 0.1)
    assert failed["result"] == "vehicle_failed"
    assert unflown["result"] == "not_flown"
    assert METRIC not in unflown


def test_the_best_first_and_what_failed_last(tmp_path: Path) -> None:
    table = ordered(rows(outcomes(tmp_path)), METRIC)
    assert [row["method"] for row in table] == ["attitude", "blend", "force", "classical"]
    flawed = [{**table[0], METRIC: nan}, *table[1:]]
    assert [row["method"] for row in ordered(flawed, METRIC)] == [
        "blend",
        "attitude",
        "force",
        "classical",
    ]


def test_the_text_has_every_column_and_every_digit(tmp_path: Path) -> None:
    table = rows(outcomes(tmp_path))
    table[1][METRIC] = 1 / 3
    read = list(csv.DictReader(StringIO(csv_of(table), newline="")))
    assert list(read[0]) == columns(table)
    assert float(read[1][METRIC]) == 1 / 3
    assert read[2]["reason"] == 'it said "no",\ntwice'
    assert read[3][METRIC] == ""
    assert len(read) == 4


def test_metrics_are_known_before_anything_flies(tmp_path: Path) -> None:
    run = planned(tmp_path)[0]
    result = fly_alone(job_of(run, tmp_path), tmp_path)
    (row,) = rows([Outcome(run, result)])
    assert set(METRIC_COLUMNS) - {"mismatch_ratio"} <= row.keys()  # that one is to another run
    assert set(result.evaluation.metrics) <= set(METRIC_COLUMNS)
    assert METRIC in METRIC_COLUMNS
