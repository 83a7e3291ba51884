"""A metric against the two parameters of a sweep, as SVG.

Drawn here and not by plotly: plotly would put 5 MB of script into the page of every batch, and
nothing where the extra `report` is missing. This is a few kilobytes, needs no extra, and follows
the reader's light or dark colours.
"""

from collections.abc import Sequence
from math import ceil, inf, isnan
from statistics import fmean
from typing import Any

from ..printable import html_text
from .column import Column
from .table import Row

# px; of the plot at most, and the room for its axes
_WIDTH, _HEIGHT, _LEFT, _TOP = 640.0, 400.0, 190.0, 34.0
_ROW = 48.0  # px; height of a row of cells at most
_CHARACTER, _LINE = 7.0, 16.0  # px; width of one in a label, height of a label
_DARK = 0.55  # share of the colours up to which white can be read on them
_GRID = 100  # values of a parameter up to which every value gets a row or column of its own
# The ends and middle of matplotlib's viridis: readable in grey and without red and green.
_COLOURS = ((68, 1, 84), (33, 145, 140), (253, 231, 37))


def parameters(table: Sequence[Row], settings: Sequence[str]) -> list[str]:
    """The swept keys that have more than one value in the table."""
    return [key for key in settings if len({repr(row.get(key)) for row in table}) > 1]


def picture(table: Sequence[Row], x: str, y: str, metric: str) -> str:
    """SVG of the metric against columns `x` and `y`, "" if no run has all three.

    A grid is drawn as cells, each with the mean of its runs, anything else as dots.
    """
    points = [(row[x], row[y], row[metric]) for row in table if _known(row, x, y, metric)]
    if not points:
        return ""
    column = Column.of_metric(metric)
    across, up = (
        _Axis([a for a, _, _ in points], _WIDTH),
        _Axis([b for _, b, _ in points], _HEIGHT, _ROW),
    )
    cells: dict[tuple[float, float], list[float]] = {}
    for a, b, value in points:
        cells.setdefault((across.place(a), up.place(b)), []).append(float(value))
    means = {at: fmean(found) for at, found in cells.items()}
    least, most = min(means.values()), max(means.values())
    share = {
        at: (mean - least) / (most - least) if most > least else 0.5 for at, mean in means.items()
    }
    marks = [_mark(across, up, at, column.cell(mean), share[at]) for at, mean in means.items()]
    title = f"{column.line}: {column.cell(least)} (dark) to {column.cell(most)} (light)"
    bottom = _TOP + up.length
    heads = [Column.of_key(key).line for key in (x, y)]
    texts = [
        _text(_LEFT, 18, title, "start", metric),
        _text(_LEFT + _WIDTH / 2, bottom + 40, heads[0], tip=x),
    ]
    texts += [_text(_LEFT - 6, 30, heads[1], "end", y)]
    texts += [_text(_LEFT + at, bottom + 18, label) for at, label in across.labels()]
    texts += [_text(_LEFT - 6, bottom - at + 4, label, "end") for at, label in up.labels(_LINE)]
    size = f'viewBox="0 0 {_LEFT + _WIDTH + 20:g} {bottom + 50:g}" width="{_LEFT + _WIDTH + 20:g}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>{"".join(marks + texts)}</svg>'


class _Axis:
    """Places of values on an axis, px from its origin."""

    def __init__(self, found: Sequence[Any], most: float, cell: float = inf) -> None:
        """Lay out the values found.

        most: length of the axis at most, px; cell: length for each of a few values at most, px.
        """
        numbers = all(
            isinstance(value, int | float) and not isinstance(value, bool) for value in found
        )
        distinct = {repr(value): value for value in found}
        self._values = (
            sorted(distinct.values()) if numbers else [distinct[text] for text in sorted(distinct)]
        )
        self._order = {repr(value): i for i, value in enumerate(self._values)}
        self.discrete = not numbers or len(self._values) <= _GRID
        self.length = min(most, cell * len(self._values)) if self.discrete else most
        self.cell = self.length / len(self._values) if self.discrete else 10.0

    def place(self, value: Any) -> float:
        """Middle of the value's cell, or its place between the least and the largest."""
        if self.discrete:
            return (self._order[repr(value)] + 0.5) * self.cell
        return (
            self.length * float(value - self._values[0]) / float(self._values[-1] - self._values[0])
        )

    def labels(self, room: float | None = None) -> list[tuple[float, str]]:
        """Places and texts of the values that are written at the axis.

        room: px that each needs along the axis; by default the width of the longest.
        """
        texts = [
            f"{value:.4g}" if isinstance(value, float) else str(value) for value in self._values
        ]
        pairs = list(zip(self._values, texts, strict=True))
        shown = pairs if self.discrete else [pairs[0], pairs[-1]]
        needed = len(shown) * (room or _CHARACTER * (2 + max(map(len, texts))))
        return [
            (self.place(value), text)
            for value, text in shown[:: max(ceil(needed / self.length), 1)]
        ]


def _known(row: Row, x: str, y: str, metric: str) -> bool:
    value = row.get(metric)
    return x in row and y in row and isinstance(value, int | float) and not isnan(value)


def _mark(across: _Axis, up: _Axis, at: tuple[float, float], value: str, share: float) -> str:
    """A dot, or a cell with its value in it where that has room."""
    colour, tip = _colour(share), f"<title>{html_text(value)}</title>"
    x, y = _LEFT + at[0], _TOP + up.length - at[1]
    if not (across.discrete and up.discrete):
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{colour}">{tip}</circle>'
    place = (
        f'x="{x - across.cell / 2:.1f}" y="{y - up.cell / 2:.1f}" width="{across.cell:.1f}"'
        f' height="{up.cell:.1f}"'
    )
    room = up.cell >= _LINE and across.cell >= _CHARACTER * (2 + len(value))
    ink = "white" if share < _DARK else "black"
    return (
        f"<rect {place}"
        f' fill="{colour}">{tip}</rect>{_text(x, y + 5, value, fill=ink) if room else ""}'
    )


def _colour(share: float) -> str:
    low, high = (_COLOURS[0], _COLOURS[1]) if share < 0.5 else (_COLOURS[1], _COLOURS[2])
    part = 2.0 * share if share < 0.5 else 2.0 * share - 1.0
    return "#" + "".join(f"{round(a + part * (b - a)):02x}" for a, b in zip(low, high, strict=True))


def _text(
    x: float, y: float, text: str, anchor: str = "middle", tip: str = "", fill: str = "currentColor"
) -> str:
    title = f"<title>{html_text(tip)}</title>" if tip else ""
    place = f'x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="13" fill="{fill}"'
    return f"<text {place}>{title}{html_text(text)}</text>"
