"""The page of a flight on the simulated platform."""

from math import degrees
from pathlib import Path

from ..plant import DEFINITIONS, PlantRun, plant_figures
from ..printable import html_text
from ..recording import Log
from .sections import check_plotly, two_columns, write_sections

_ZOOM = "drag to zoom, double-click to see all"
_ANGLE = "_rad"


def write_plant_page(
    log: Log, run: PlantRun, file: str | Path, opened: PlantRun | None = None
) -> None:
    """Write what the plant did with the schedule of `log` into `file`.

    opened: the same by an open loop, shown beside `run`.

    Raises MissingExtraError without plotly and OutputError when the file cannot be written; an old
    one is kept then.
    """
    check_plotly()
    from .plots.plant import plant_over_time

    name = log.metadata.get("scenario", "") or log.path.name
    title = f"{name} on the simulated platform"
    runs = [run] if opened is None else [opened, run]
    sections = [
        ("", f"<h1>{html_text(title)}</h1>{_head(log, run)}"),
        ("Figures; every number that is not of the log is assumed", _figures(log, runs)),
        (f"Over time: {_ZOOM}", plant_over_time(log, run, opened)),
    ]
    write_sections(file, title, sections)


def _head(log: Log, run: PlantRun) -> str:
    kept = ("method", "platform")
    rows = [("log", str(log.path)), ("feedback", run.feedback)]
    return two_columns([*rows, *((key, log.metadata.get(key, "")) for key in kept)])


def _figures(log: Log, runs: list[PlantRun]) -> str:
    """A table of all figures, a column for each feedback; definitions are tooltips."""
    heads = "".join(f"<th>{html_text(run.feedback)}</th>" for run in runs)
    columns = [plant_figures(run, log) for run in runs]
    rows = [f"<tr><th></th>{heads}</tr>"]
    for name, meaning in DEFINITIONS.items():
        angle = name.endswith(_ANGLE)
        shown = f"{name.removesuffix(_ANGLE)}_deg" if angle else name
        values = (degrees(c[name]) if angle else c[name] for c in columns)
        cells = "".join(f"<td class='number'>{value:.4g}</td>" for value in values)
        rows.append(f"<tr><td title='{html_text(meaning)}'>{html_text(shown)}</td>{cells}</tr>")
    return f"<table>{''.join(rows)}</table>"
