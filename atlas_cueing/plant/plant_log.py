"""The log of a flight with what the plant did beside it."""

from dataclasses import replace
from pathlib import Path

from ..recording import Log, TopicColumns, rewrite_log
from ..signals import CORRECTION, PLANT
from .fly_plant import PlantRun


def write_plant_log(log: Log, run: PlantRun, output: Path) -> None:
    """Write `log` with /plant and /correction as the new log `output`; all else stays.

    Raises OutputError when it cannot be written; then nothing is left of it.
    """
    times = log.tables["/motion"].log_times
    tables = dict(log.tables)
    tables[PLANT.name] = TopicColumns(PLANT.fields, run.plant, times)
    tables[CORRECTION.name] = TopicColumns(CORRECTION.fields, run.correction, times)
    metadata = {**log.metadata, "plant_feedback": run.feedback}
    rewrite_log(replace(log, tables=tables), metadata, output)
