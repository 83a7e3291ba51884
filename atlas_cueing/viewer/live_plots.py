"""Plots beside the scene: vehicle and rider, wheels and stage with limits, timing of the loop."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..rotations import Array
from ..scenario import Platform

if TYPE_CHECKING:
    from viser import GuiApi

# x, y, z and wheels 1, 2, 3; colour-blind safe (Okabe & Ito 2008)
_AXES = ("#d55e00", "#009e73", "#0072b2")
_LIMIT = "#888888"
_HEIGHT = 132  # pixels
_GREY = {
    "stroke": "#5b6470",
    "grid": {"stroke": "#e3e7ec", "width": 1},
    "ticks": {"show": False},
    "font": "11px sans-serif",
}


@dataclass(frozen=True, slots=True)
class Traces:
    """Columns (n,) and (n, k) to plot: s, m/s^2, rad/s, m.

    timing: lateness and cost, s; None for a log.
    """

    time: Array
    pilot_f: Array
    felt_f: Array
    pilot_w: Array
    felt_w: Array
    wheel_speed: Array
    p_W: Array
    timing: Array | None


class Plots:
    """All plots of a page, one below the other."""

    def __init__(self, gui: "GuiApi", platform: Platform, *, timing: bool) -> None:
        """Add the plots to a page; `timing` is whether there is a loop to be timed."""
        self._speed = np.array(platform.wheel_limit_values().speed)
        self._travel = np.array(platform.stage_limit_values().travel)
        compared = [*_lines("xyz", ""), *_lines("xyz", " pilot", dash=(4, 3), width=1.0)]
        bounds = [_line("+ limit", _LIMIT, (2, 3)), _line("− limit", _LIMIT, (2, 3))]
        self._force = _plot(
            gui, "Specific force, m/s²  (rider solid, pilot dashed; cabin x y z)", compared
        )
        self._rate = _plot(gui, "Angular rate, deg/s", compared)
        self._wheels = _plot(
            gui, "Wheel speed, % of its limit", [*_lines("123", "", before="wheel "), *bounds]
        )
        self._stage = _plot(gui, "Stage position, % of its travel", [*_lines("xyz", ""), *bounds])
        self._timing = (
            _plot(gui, "Loop, ms", [_line("late", _AXES[0]), _line("cost", _AXES[2])])
            if timing
            else None
        )

    def show(self, traces: Traces) -> None:
        """Draw `traces` in the place of those before."""
        limits = np.full((len(traces.time), 2), 100.0) * (1.0, -1.0)
        _show(self._force, traces.time, traces.felt_f, traces.pilot_f)
        _show(self._rate, traces.time, np.degrees(traces.felt_w), np.degrees(traces.pilot_w))
        _show(self._wheels, traces.time, 100.0 * traces.wheel_speed / self._speed, limits)
        _show(self._stage, traces.time, 100.0 * traces.p_W / self._travel, limits)
        if self._timing is not None and traces.timing is not None:
            _show(self._timing, traces.time, 1e3 * traces.timing)


def _plot(gui: "GuiApi", title: str, lines: list[dict[str, Any]]) -> Any:
    gui.add_html(
        f'<div style="font:600 12px sans-serif;color:#2c3440;padding:6px 12px 0">{title}</div>'
    )
    series: Any = ({"label": "s"}, *lines)
    axes: Any = ({**_GREY, "size": 26}, {**_GREY, "size": 46})
    return gui.add_uplot(
        tuple(np.zeros(1) for _ in series),
        series,
        scales={"x": {"time": False}},
        axes=axes,
        legend={"show": True, "live": False},
        height=_HEIGHT,
    )


def _show(plot: Any, time: Array, *blocks: Array) -> None:
    plot.data = (time, *np.hstack(blocks).T)


def _lines(
    names: str, after: str, *, before: str = "", dash: tuple[int, ...] = (), width: float = 1.6
) -> list[dict[str, Any]]:
    return [
        _line(f"{before}{name}{after}", colour, dash, width)
        for name, colour in zip(names, _AXES, strict=True)
    ]


def _line(
    label: str, colour: str, dash: tuple[int, ...] = (), width: float = 1.6
) -> dict[str, Any]:
    line: dict[str, Any] = {
        "label": label,
        "stroke": colour,
        "width": width,
        "points": {"show": False},
    }
    return {**line, "dash": dash} if dash else line
