"""The texts printed about a run and about a platform."""

from collections.abc import Mapping, Sequence
from math import isinf
from typing import TYPE_CHECKING, Any

import typer

from ..wheels import headroom
from .text import aligned, say

if TYPE_CHECKING:  # loaded already when there is something to print
    from ..run import LiveFigures, RunResult
    from ..scenario import Platform

_PERCENTILES = (
    ("p50", "half within"),
    ("p99", "99 % within"),
    ("p999", "99.9 % within"),
    ("max", "all within"),
)


def run_summary(result: "RunResult") -> str:
    """Return what people are shown of a run; `--json` has every figure.

    Result, punctuality of a live run, what was felt, and the use of the limits.
    """
    timing = _timing_rows(result.live) if result.live else []
    return "\n".join([*aligned(_head(result), ""), *aligned(timing, ""), *_evaluation(result)])


def end(result: "RunResult") -> None:
    """Say on stderr what was found. Raises Exit(1) if anything was."""
    if not result.clean:
        for finding in ([f"{result.result}: {result.reason}"] if result.reason else []) + list(
            result.evaluation.violations
        ):
            say(finding)
        raise typer.Exit(1)


def _evaluation(result: "RunResult") -> list[str]:
    """What was felt, what moved, and the use of the limits."""
    metrics, use = result.evaluation.metrics, result.evaluation.limit_use
    if metrics.get("ticks") == 0.0:
        never = "none of rider and pilot: the ride never came to running"
        return aligned([("figures", never), *_limit_rows(use)], "")
    return [
        *_error_table(metrics),
        *aligned(_phrase_rows(metrics), ""),
        *aligned(_limit_rows(use), ""),
    ]


def _timing_rows(live: "LiveFigures") -> list[tuple[str, str]]:
    timing, realtime = live.timing, live.realtime
    rows = [
        (
            title,
            ", ".join(f"{label} {timing[f'{name}_{key}_us']:.0f}" for key, label in _PERCENTILES)
            + " us",
        )
        for title, name in (("lateness", "lateness"), ("tick cost", "tick_cost"))
    ]
    missed = (
        f"{timing['missed_deadlines']:.0f}, at most {timing['most_missed_in_a_row']:.0f} in a row"
    )
    rows.append(("missed deadlines", missed))
    rows += _drive_rows(live.drives)
    rows += _plant_rows(live.plant)
    granted, refused = realtime["granted"], realtime["refused"]
    if granted or refused:
        denied = f"; refused: {'; '.join(refused)}" if refused else ""
        rows.append(("real time", f"{', '.join(granted) or 'nothing granted'}{denied}"))
    return rows


def _plant_rows(told: Mapping[str, float]) -> list[tuple[str, str]]:
    """The line on the simulated platform; none without one."""
    if not told:
        return []
    end, most = told["orientation_error_end_deg"], told["orientation_error_max_deg"]
    slip = told["slip_max_m_s"]
    return [("plant", f"off by {most:.3g} deg at most, {end:.3g} at the end; slip {slip:.3g} m/s")]


def _drive_rows(told: Mapping[str, float | str]) -> list[tuple[str, str]]:
    """The line on the drives; none when no set points were sent, or nothing was heard."""
    if told.get("drive_status") == "one-way":
        return [("drives", "one-way: they were not asked what they do")]
    if not told.get("statuses"):
        return []
    wheels, stage = told["wheel_difference_deg"], told["stage_difference_mm"]
    text = f"{told['statuses']} statuses, off by {wheels:.3f} deg of a wheel and {stage:.3f} mm"
    if "least_margin_ms" in told:
        text += f", set points at least {told['least_margin_ms']:.1f} ms early"
    return [("drives", text)]


def _head(result: "RunResult") -> list[tuple[str, str]]:
    return [
        ("result", f"{result.result}  {result.reason}".rstrip()),
        ("log", str(result.log)),
        _flown_row(result),
        ("violations", str(len(result.evaluation.violations))),
        *(("remark", remark) for remark in result.evaluation.remarks),
    ]


def _flown_row(result: "RunResult") -> tuple[str, str]:
    flown, live = f"{result.duration:.2f} s, {result.ticks} ticks", result.live
    if live:
        return "flown", f"{flown}, {live.faults} faults, {live.dropped} samples dropped"
    speed = result.duration / result.wall if result.wall > 0.0 else 0.0
    return "flight", f"{flown}, flown at {speed:.1f} times real time"


def _error_table(metrics: Mapping[str, float]) -> list[str]:
    """Felt by the rider less felt by the pilot: one line a quantity, one column a statistic.

    A quantity without any metric in `metrics` is left out.
    """
    from ..evaluation import DECLARED, Cell, Metric

    rows: dict[str, dict[str, Metric]] = {}
    for metric in DECLARED.values():
        if isinstance(metric.summary, Cell):
            rows.setdefault(metric.summary.row, {})[metric.summary.column] = metric
    rows = {
        title: row
        for title, row in rows.items()
        if any(metric.name in metrics for metric in row.values())
    }
    columns = list(dict.fromkeys(column for row in rows.values() for column in row))
    head = f"{'rider less pilot':<23}" + "".join(f"{column:>10}" for column in columns)
    lines = [
        f"{title:<17}{row[columns[0]].unit.shown:<6}"
        + "".join(
            f"{row[column].unit.text(metrics.get(row[column].name)):>10}" for column in columns
        )
        for title, row in rows.items()
    ]
    return [head, *lines] if lines else []


def _phrase_rows(metrics: Mapping[str, float]) -> list[tuple[str, str]]:
    """Lines made of several metrics each, such as the net turns about all axes."""
    from ..evaluation import DECLARED, Phrase

    rows: dict[str, list[str]] = {}
    for name, metric in DECLARED.items():
        if isinstance(metric.summary, Phrase) and name in metrics:
            phrase = metric.summary
            rows.setdefault(phrase.row, []).append(
                phrase.text.format(phrase.factor * metrics[name])
            )
    return [(row, ", ".join(parts)) for row, parts in rows.items()]


def _limit_rows(use: Mapping[str, float]) -> list[tuple[str, str]]:
    """Largest use of each limit, by logged values or their differences, whichever is larger."""
    from ..evaluation import by_limit

    return [
        (limit.replace("_", " "), f"{100.0 * most:.4f} % of its limit")
        for limit, most in by_limit(use).items()
    ]


def kinematics(platform: "Platform") -> dict[str, Any]:
    """Kinematics of a platform by name, unit in the name.

    `sphere_from_wheels` is None for a singular geometry.
    """
    geometry = platform.geometry()
    room = headroom(geometry, platform.limits_of_each_wheel())
    return {
        "name": platform.name,
        "induced_rows": geometry.induced_rows,
        "wheels_from_sphere": geometry.wheels_from_sphere,
        "sphere_from_wheels": geometry.sphere_from_wheels if geometry.slip_free else None,
        "determinant": geometry.determinant,
        "condition_number": geometry.condition_number,
        "slip_free": geometry.slip_free,
        "sphere_rate_about_axes_rad_s": room.rate,
        "sphere_rate_about_worst_axis_rad_s": room.worst_rate,
        "sphere_acceleration_about_axes_rad_s2": room.acceleration,
        "sphere_acceleration_about_worst_axis_rad_s2": room.worst_acceleration,
    }


def platform_summary(figures: dict[str, Any]) -> str:
    """The text printed about a platform, from its figures by `kinematics`."""
    inverse: tuple[tuple[float, ...], ...] | None = figures["sphere_from_wheels"]
    numbers = [(name, _number(value)) for name, value in figures.items() if not _is_matrix(name)]
    return "\n".join(
        [
            *aligned(numbers, ""),
            "induced rows, frame W (Eq. 11)",
            *_rows(figures["induced_rows"]),
            "wheels from sphere, J^-1 (Eq. 22)",
            *_rows(figures["wheels_from_sphere"]),
            "sphere from wheels, J (Eq. 18)",
            *(_rows(inverse) if inverse else ["  none: the geometry is singular"]),
        ]
    )


def _is_matrix(name: str) -> bool:
    return name in ("induced_rows", "wheels_from_sphere", "sphere_from_wheels")


def _rows(matrix: Sequence[Sequence[float]]) -> list[str]:
    return [_row(row) for row in matrix]


def _row(row: Sequence[float]) -> str:
    # Adding zero takes the sign off a negative zero.
    return "  " + " ".join(f"{x + 0.0:12.6f}" for x in row)


def _number(value: Any) -> str:
    if isinstance(value, tuple):
        return "  ".join(_number(x) for x in value)
    if isinstance(value, float) and isinf(value):
        return "unbounded"  # of a singular geometry: no wheel turns with that axis
    return f"{value:.6g}" if isinstance(value, float) else str(value)
