"""Plot of what a simulated platform made of a log's schedule."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...plant import PlantRun
from ...recording import Log
from ...rotations import Array
from ...signals import CORRECTION, PLANT
from .downsample import thinned
from .style import AXES, DEGREES, FELT, ROW, VEHICLE, coloured, line, styled, time_rows

_OPEN, _ESTIMATE = "#5f6b7a", "#2e8b57"
_WHEELS = ("wheel 1", "wheel 2", "wheel 3")
_FORCES = ("x (forward)", "y (right)", "z (down)")


def plant_over_time(log: Log, run: PlantRun, opened: PlantRun | None) -> Any:
    """Orientation, slip, what the rider feels, correction and power over one time axis.

    log: what was flown; opened: the same by an open loop, to be drawn beside `run`.
    """
    time = run.plant[:, 0]
    titles = _titles(run, opened)
    figure = time_rows(titles)
    _draw(figure, 1, time, _errors(run, opened))
    for row, (name, unit) in enumerate((("s", "m_s"), ("n", "n")), start=2):
        _draw(figure, row, time, _by_wheel(run.plant, PLANT.fields, name, unit))
    said = log.vector("/felt", "f")
    for k, axis in enumerate("xyz"):
        really = _column(run, f"f{axis}_m_s2")
        _draw(figure, 4 + k, time, {"/felt": (said[:, k], VEHICLE), "plant": (really, FELT)})
    turned = np.linalg.norm(_vector(run, "w", "rad_s") - log.vector("/motion", "w"), axis=1)
    _draw(figure, 7, time, {"turning rate": (DEGREES * turned, FELT)})
    speeds = _by_wheel(run.correction, CORRECTION.fields, "w", "rad_s")
    _draw(figure, 8, time, speeds)
    power = _power(run)
    _draw(figure, 9, time, {"power": (power, FELT)})
    _draw(figure, 10, time, {"energy": (_integral(time, power), FELT)})
    return styled(figure, height=ROW * len(titles), rows=True)


def _titles(run: PlantRun, opened: PlantRun | None) -> list[str]:
    """Titles of the rows, with the colours of lines in them."""
    lines = [coloured("sphere and schedule" if opened else "sphere and schedule, open", FELT)]
    if opened:
        lines += [coloured("the same with the loop open", _OPEN)]
        lines += [coloured("sphere and estimate", _ESTIMATE)]
    wheels = ", ".join(coloured(name, AXES[k]) for k, name in enumerate(_WHEELS))
    both = f"{coloured('/felt', VEHICLE)}, {coloured('the plant', FELT)}"
    return [
        f"angle between orientations, °: {', '.join(lines)}",
        f"slip, creep included, m/s: {wheels}",
        f"normal force, N: {wheels}",
        *(f"specific force {axis}, m/s²: {both}" for axis in _FORCES),
        "turning rate of the cabin less that of the schedule, °/s",
        f"correction of the speed by feedback {run.feedback}, rad/s: {wheels}",
        "power of all drives, W",
        "energy of all drives, in less out, J",
    ]


def _errors(run: PlantRun, opened: PlantRun | None) -> dict[str, tuple[Array, str]]:
    lines = {} if opened is None else {"open": (DEGREES * _column(opened, "error_rad"), _OPEN)}
    lines["sphere and schedule"] = (DEGREES * _column(run, "error_rad"), FELT)
    if opened is not None:
        lines["estimate"] = (DEGREES * _column(run, "estimate_error_rad"), _ESTIMATE)
    return lines


def _draw(figure: Any, row: int, time: Array, lines: Mapping[str, tuple[Array, str]]) -> None:
    """Add lines, each values (n,) and a colour by its name, to a row."""
    for name, (values, colour) in lines.items():
        kept = thinned(values[:, None])
        trace = line(time[kept], values[kept], name, colour, legend=False)
        figure.add_trace(trace.update(hovertemplate=f"{name} %{{y}}<extra></extra>"), row, 1)


def _by_wheel(
    rows: Array, fields: tuple[str, ...], name: str, unit: str
) -> dict[str, tuple[Array, str]]:
    columns = [rows[:, fields.index(f"{name}{k}_{unit}")] for k in (1, 2, 3)]
    return {w: (c, colour) for w, c, colour in zip(_WHEELS, columns, AXES, strict=True)}


def _power(run: PlantRun) -> Array:
    """Power of all drives, W: torque times speed of each wheel, summed."""
    wheels = [_column(run, f"t{k}_n_m") * _column(run, f"u{k}_rad_s") for k in (1, 2, 3)]
    return wheels[0] + wheels[1] + wheels[2]


def _integral(time: Array, values: Array) -> Array:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(time)
    return np.concatenate([np.zeros(1), np.cumsum(steps)])


def _column(run: PlantRun, field: str) -> Array:
    column: Array = run.plant[:, PLANT.fields.index(field)]
    return column


def _vector(run: PlantRun, name: str, unit: str) -> Array:
    return np.stack([_column(run, f"{name}{axis}_{unit}") for axis in "xyz"], axis=1)
