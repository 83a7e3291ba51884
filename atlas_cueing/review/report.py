"""One self-contained HTML file of a review or a comparison.

It opens from disk, without any network.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..evaluation import DECLARED, Metric, Shown, shown
from ..evaluation.units import typeset
from ..printable import html_text
from .checks.deadlines import is_live
from .comparison import Comparison
from .sections import check_plotly, two_columns, write_sections
from .verdict import Review

if TYPE_CHECKING:
    from plotly.graph_objects import Figure as Plot

_ZOOM = "drag to zoom, double-click to see all"


def write_page(found: Review, file: str | Path) -> None:
    """Write the review with plots of everything into `file`.

    Raises MissingExtraError without plotly and OutputError when the file cannot be written; an old
    one is kept then.
    """
    check_plotly()
    from .plots.limit_bars import limit_bars
    from .plots.space import in_space
    from .plots.spectra import spectra
    from .plots.time_series import over_time

    run = found.run
    sections = [
        ("", _header(found)),
        ("", _findings(found)),
        (
            f"Over time, in the axes of the vehicle's body and of the cabin: {_ZOOM}",
            over_time(found),
        ),
        (
            (
                "In space, in the axes of the platform's base: drag to turn; a dot where each path"
                " begins"
            ),
            in_space(run),
        ),
        *_loads(found),
        *_punctuality(found),
        ("Use of the limits", limit_bars(run)),
        ("Power spectra, summed over the axes", spectra(run)),
        ("Every figure", _every_metric(["value"], [found.metrics])),
    ]
    write_sections(file, run.log.metadata.get("scenario", "") or run.log.path.name, sections)


def write_comparison(comparison: Comparison, file: str | Path) -> None:
    """Write the runs side by side into `file`. Raises as `write_page`."""
    check_plotly()
    from .plots.overlays import overlays

    runs = [each.run for each in comparison.reviews]
    heads = "".join(
        f"<tr><td>{html_text(name)}</td><td>{_verdict(each)}</td>"
        f"<td>{html_text(str(each.run.log.path))}</td></tr>"
        for name, each in zip(comparison.names, comparison.reviews, strict=True)
    )
    sections = [
        (
            "",
            (
                f"<h1>{' against '.join(html_text(name) for name in comparison.names)}</h1>"
                f"<table>{heads}</table>"
            ),
        ),
        ("Rider less pilot, net turns, and what was limited", _headlines(comparison)),
        (f"Over time: {_ZOOM}", overlays(comparison.names, runs)),
        (
            "Every figure",
            _every_metric(comparison.names, [each.metrics for each in comparison.reviews]),
        ),
    ]
    write_sections(file, " against ".join(comparison.names), sections)


def _punctuality(found: Review) -> "list[tuple[str, Plot]]":
    """The section of a live run's lateness; none for any other run."""
    if not is_live(found.run):
        return []
    from .plots.lateness import punctuality

    return [("Punctuality of the real-time loop", punctuality(found.run))]


def _loads(found: Review) -> "list[tuple[str, Plot]]":
    """The sections of the loads; none for a platform without masses."""
    if not found.run.platform.has_loads:
        return []
    from .plots.loads import loads_over_time, torque_and_speed

    return [
        (f"Loads of contacts and drives: {_ZOOM}", loads_over_time(found.run)),
        (
            "Torque against speed at the axles, in the envelope of a drive",
            torque_and_speed(found.run),
        ),
    ]


def _headlines(comparison: Comparison) -> str:
    """The metrics at the head of a comparison, one column a log."""
    return _columns(
        comparison.names, shown(Shown.HEADLINE), [each.metrics for each in comparison.reviews]
    ) + _meanings([each.metrics for each in comparison.reviews])


def _meanings(columns: Sequence[dict[str, float]]) -> str:
    """What the figures that need it say of a ride, beside a verdict that is on limits alone."""
    lines = [
        f"<dt>{html_text(metric.title)}</dt><dd>{html_text(metric.meaning)}</dd>"
        for metric in DECLARED.values()
        if metric.meaning and _has(metric, columns)
    ]
    return f"<dl class='meanings'>{''.join(lines)}</dl>" if lines else ""


def _header(found: Review) -> str:
    """The verdict first, then what was flown and the metrics at the head of a review."""
    metadata = found.run.log.metadata
    rows = [
        ("log", str(found.run.log.path)),
        ("flight", f"{found.duration:.2f} s, {len(found.run.flight.time)} ticks"),
        *((key.replace("_", " "), value) for key, value in metadata.items() if value),
    ]
    title = metadata.get("scenario", "") or found.run.log.path.name
    errors, others = (
        _columns([head], shown(place), [found.metrics])
        for head, place in (
            ("rider less pilot", Shown.ERROR_HEADLINE),
            ("whole run", Shown.RUN_HEADLINE),
        )
    )
    return (
        f"<h1>{html_text(title)} {_verdict(found)}</h1><div class='columns'>{two_columns(rows)}"
        f"{errors}{others}{_meanings([found.metrics])}</div>"
    )


def _verdict(found: Review) -> str:
    return (
        f"<span class='verdict{' clean' if found.clean else ''}'>{html_text(found.verdict)}</span>"
    )


def _findings(found: Review) -> str:
    lines = [f"<li class='finding'>{html_text(str(finding))}</li>" for finding in found.findings]
    lines += [f"<li>{html_text(note)}</li>" for note in found.notes]
    return f"<h2>Findings and notes</h2><ul>{''.join(lines)}</ul>" if lines else ""


def _every_metric(heads: Sequence[str], columns: Sequence[dict[str, float]]) -> str:
    """A table of all metrics, one column a log, folded away."""
    found = [metric for metric in DECLARED.values() if _has(metric, columns)]
    table = _columns(heads, found, columns)
    return f"<details><summary>{len(found)} figures</summary>{table}</details>"


def _has(metric: Metric, columns: Sequence[dict[str, float]]) -> bool:
    return any(metric.name in column for column in columns)


def _columns(
    heads: Sequence[str], metrics: Sequence[Metric], columns: Sequence[dict[str, float]]
) -> str:
    """A table of the metrics that any log has, a column for each; definitions are tooltips."""
    rows = [f"<tr><th></th>{''.join(f'<th>{html_text(head)}</th>' for head in heads)}</tr>"]
    for metric in metrics:
        if not _has(metric, columns):
            continue
        values = (metric.unit.text(column.get(metric.name)) for column in columns)
        cells = "".join(f"<td class='number'>{value}</td>" for value in values)
        head = f"<td title='{html_text(metric.definition)}'>{html_text(typeset(metric.line))}</td>"
        rows.append(f"<tr>{head}{cells}</tr>")
    return f"<table>{''.join(rows)}</table>"
