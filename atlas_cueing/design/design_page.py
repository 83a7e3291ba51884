"""One page for a browser: the layouts worth having, as pictures and a table, in one file."""

from collections.abc import Sequence
from math import floor, log10

from ..atomic_file import PAGE_BEGINS
from ..batch.page_assets import STYLE
from ..printable import html_text
from .front import Front, Rated
from .ridden import FlightName

_WIDTH, _HEIGHT, _LEFT, _TOP, _BOTTOM = 470.0, 300.0, 74.0, 16.0, 46.0
_ELEVATIONS = (15.0, 60.0)  # deg, from dark to light
# The ends and middle of matplotlib's viridis: readable in grey and without red and green.
_COLOURS = ((68, 1, 84), (33, 145, 140), (253, 231, 37))

Column = tuple[str, str, str, float, int]  # figure, head, unit, factor, decimals
COLUMNS: tuple[Column, ...] = (
    ("elevation_deg", "elevation", "°", 1.0, 1),
    ("skew_deg", "skew", "°", 1.0, 1),
    ("azimuth_deg", "azimuth", "°", 1.0, 1),
    ("wheel_radius_m", "wheel radius", "m", 1.0, 3),
    ("gear", "gear", "", 1.0, 2),
    ("condition_number", "condition", "", 1.0, 3),
    ("preload_needed_n", "preload needed", "kN", 1e-3, 2),
    ("wheel_load_max_n", "wheel load at it", "kN", 1e-3, 2),
    ("torque_max_n_m", "torque max", "N m", 1.0, 0),
    ("torque_rms_n_m", "torque rms", "N m", 1.0, 0),
    ("wheel_speed_max_rad_s", "wheel speed", "rad/s", 1.0, 1),
    ("motor_torque_max_n_m", "motor torque", "N m", 1.0, 1),
    ("motor_speed_max_rad_s", "motor speed", "rad/s", 1.0, 0),
    ("power_peak_w", "power peak", "kW", 1e-3, 1),
    ("regenerated_peak_w", "regen. peak", "kW", 1e-3, 1),
    ("lift_off_m_s2", "lift-off", "m/s²", 1.0, 2),
    ("sphere_rate_worst_rad_s", "rate, worst axis", "rad/s", 1.0, 2),
    ("sphere_acceleration_worst_rad_s2", "accel., worst axis", "rad/s²", 1.0, 2),
    ("clearance_m", "clearance", "m", 1.0, 2),
    ("ripple_rms", "ripple", "%", 100.0, 2),
    ("row_largest_correction", "largest |C-1|", "%", 100.0, 2),
)
"""Columns of the table, here and on the terminal."""

_IF_VARIED = ("wheel_radius_m", "gear", "ripple_rms")
_IF_ASKED = (  # as an objective
    "motor_torque_max_n_m",
    "motor_speed_max_rad_s",
    "regenerated_peak_w",
    "sphere_acceleration_worst_rad_s2",
    "row_largest_correction",
)
_FIGURES = 2  # digits that the largest of a column has at least
_NOTHING = 1e-6  # in the unit of a column: less is shown as 0


def shown_columns(front: Front) -> list[Column]:
    """The columns of a table, each fine enough for its numbers.

    Some are there only where the layouts differ in them, some only where they are objectives.
    """
    table = [row.to_json() for row in front.rated]
    return [
        _fine(column, max(abs(float(row[column[0]])) for row in table))
        for column in COLUMNS
        if not (column[0] in _IF_ASKED and column[0] not in front.objectives)
        and not (column[0] in _IF_VARIED and len({float(row[column[0]]) for row in table}) == 1)
    ]


def _fine(column: Column, largest: float) -> Column:
    """The column with decimals for numbers up to `largest`; kN of a small platform become N."""
    key, head, unit, factor, decimals = column
    if unit.startswith("k") and factor * largest < 0.1:
        unit, factor, decimals = unit[1:], 1.0, 0
    if factor * largest > _NOTHING:
        decimals = max(decimals, _FIGURES - 1 - floor(log10(factor * largest)))
    return key, head, unit, factor, decimals


def design_page(
    front: Front, title: str, flights: Sequence[FlightName], notes: Sequence[str]
) -> str:
    """The page: a picture for each objective against the first one, table, flights and notes."""
    x = front.objectives[0]
    others = front.objectives[1:] or ("elevation_deg",)
    pictures = "".join(_picture(front, x, y) for y in others)
    remarks = "".join(f"<p>{html_text(note)}</p>" for note in notes)
    heads = "".join(
        f"<th><span>{html_text(head)}</span><small>{html_text(unit)}</small></th>"
        for _, head, unit, _, _ in shown_columns(front)
    )
    body = "\n".join(_row(front, k) for k in range(len(front.rated)))
    flown = "".join(
        f"<tr><td>{html_text(each.scenario)}</td><td>{html_text(each.method)}</td>"
        f"<td>{html_text(each.platform)}</td><td>{each.ticks}</td></tr>"
        for each in flights
    )
    return (
        f'{PAGE_BEGINS}<html lang="en"><head><meta charset="utf-8">'
        f"<title>{html_text(title)}</title><style>{STYLE}.pictures{{display:flex;flex-wrap:wrap}}"
        ".dense td,.dense th{overflow-wrap:normal}"
        f".chosen td{{font-weight:700}}</style></head><body><h1>{html_text(title)}</h1>{remarks}"
        f'<div class="pictures">{pictures}</div>'
        f'<table class="dense"><thead><tr><th>layout</th>{heads}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table><h2>Flights</h2>"
        "<table><thead><tr><th>scenario</th><th>method</th><th>flown on</th><th>ticks</th></tr>"
        f"</thead><tbody>{flown}</tbody></table></body></html>\n"
    )


def cell(row: Rated, key: str, factor: float, decimals: int) -> str:
    """A figure as it is shown."""
    return f"{factor * float(row.to_json()[key]) + 0.0:.{decimals}f}"


def name_of(front: Front, k: int) -> str:
    """How a row is called: its number, and what is special about it."""
    row = front.rated[k]
    words = [str(k), *([row.source] if row.source != "found" else [])]
    return " ".join([*words, *(["chosen"] if k == front.chosen else [])])


def _row(front: Front, k: int) -> str:
    row = front.rated[k]
    cells = "".join(
        f"<td>{cell(row, key, factor, decimals)}</td>"
        for key, _, _, factor, decimals in shown_columns(front)
    )
    chosen = ' class="chosen"' if k == front.chosen else ""
    return f"<tr{chosen}><td>{html_text(name_of(front, k))}</td>{cells}</tr>"


def _picture(front: Front, x: str, y: str) -> str:
    rows, scales = [row.to_json() for row in front.rated], [_scale(key) for key in (x, y)]
    points = [(scales[0] * float(row[x]), scales[1] * float(row[y])) for row in rows]
    places = [_places([point[axis] for point in points]) for axis in (0, 1)]
    marks = []
    for k, row in enumerate(front.rated):
        at = (_LEFT + _WIDTH * places[0][k], _TOP + _HEIGHT * (1.0 - places[1][k]))
        marks.append(_mark(front, k, row, at))
    labels = [
        _text(_LEFT + _WIDTH / 2.0, _TOP + _HEIGHT + 36.0, _line_of(x)),
        _text(4.0, 12.0, _line_of(y), "start"),
        *_ends([point[0] for point in points], [point[1] for point in points]),
    ]
    frame = (
        f'<rect x="{_LEFT}" y="{_TOP}" width="{_WIDTH}" height="{_HEIGHT}" fill="none"'
        ' stroke="currentColor" stroke-opacity=".3"/>'
    )
    size = f'viewBox="0 0 {_LEFT + _WIDTH + 16:g} {_TOP + _HEIGHT + _BOTTOM:g}" width="560"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>{frame}{"".join(marks + labels)}</svg>'


def _line_of(key: str) -> str:
    """The words of a figure with its unit; its name where the table does not have it."""
    heads = {name: f"{head}, {unit}" if unit else head for name, head, unit, _, _ in COLUMNS}
    return heads.get(key, key)


def _scale(key: str) -> float:
    return {name: factor for name, _, _, factor, _ in COLUMNS}.get(key, 1.0)


def _places(values: Sequence[float]) -> list[float]:
    """Share of the axis at which each value stands, with a margin."""
    low, high = min(values), max(values)
    return [0.04 + 0.92 * ((v - low) / (high - low) if high > low else 0.5) for v in values]


def _mark(front: Front, k: int, row: Rated, at: tuple[float, float]) -> str:
    """A dot of the elevation's colour; a square for the given, a ring for the chosen layout."""
    tip = html_text(
        f"{name_of(front, k)}: elevation {row.layout.elevation:.1f}°, skew {row.layout.skew:.1f}°,"
        f" azimuth {row.layout.azimuth:.1f}°, condition {row.figures['condition_number']:.3f}"
    )
    x, y = at
    fill = f'fill="{_colour(row.layout.elevation)}"'
    shape = (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" {fill}>'
        if row.source == "found"
        else f'<rect x="{x - 5:.1f}" y="{y - 5:.1f}" width="10" height="10" {fill}>'
    )
    closing = "</circle>" if row.source == "found" else "</rect>"
    ring = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="9" fill="none" stroke="currentColor"/>'
    return f"{shape}<title>{tip}</title>{closing}{ring if k == front.chosen else ''}"


def _ends(xs: Sequence[float], ys: Sequence[float]) -> list[str]:
    bottom = _TOP + _HEIGHT
    return [
        _text(_LEFT + 0.04 * _WIDTH, bottom + 18.0, f"{min(xs):.4g}"),
        _text(_LEFT + 0.96 * _WIDTH, bottom + 18.0, f"{max(xs):.4g}"),
        _text(_LEFT - 6.0, bottom - 0.04 * _HEIGHT, f"{min(ys):.4g}", "end"),
        _text(_LEFT - 6.0, _TOP + 0.04 * _HEIGHT + 10.0, f"{max(ys):.4g}", "end"),
    ]


def _colour(elevation: float) -> str:
    low, high = _ELEVATIONS
    share = min(max((elevation - low) / (high - low), 0.0), 1.0)
    a, b = (_COLOURS[0], _COLOURS[1]) if share < 0.5 else (_COLOURS[1], _COLOURS[2])
    part = 2.0 * share if share < 0.5 else 2.0 * share - 1.0
    return "#" + "".join(f"{round(p + part * (q - p)):02x}" for p, q in zip(a, b, strict=True))


def _text(x: float, y: float, text: str, anchor: str = "middle") -> str:
    place = f'x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="13" fill="currentColor"'
    return f"<text {place}>{html_text(text)}</text>"
