"""The layouts of a design on the terminal, and what is to be said of the chosen one."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..design import Front
    from ..scenario import Platform


def exceeded(platform: "Platform", figures: dict[str, float]) -> list[str]:
    """What the rides ask of the chosen layout beyond what its file names."""
    drive, wheels = platform.drive, platform.wheel
    limits = [
        ("torque_max_n_m", drive.torque_n_m if drive else None, "drive.torque_n_m"),
        ("torque_rms_n_m", drive.torque_rms_n_m if drive else None, "drive.torque_rms_n_m"),
        (
            "motor_speed_max_rad_s",
            drive.motor_speed_rad_s if drive else None,
            "drive.motor_speed_rad_s",
        ),
        (
            "wheel_speed_max_rad_s",
            min(platform.limits_of_each_wheel().speed),
            "wheel_limits.speed_rad_s",
        ),
        (
            "wheel_load_max_n",
            min((each.load_limit_n for each in wheels if each.load_limit_n), default=None),
            "wheel.load_limit_n",
        ),
    ]
    return [
        f"these rides ask more of the chosen layout than {key} = {limit:.6g}: {figures[name]:.6g}"
        for name, limit, key in limits
        if limit is not None and figures[name] > limit
    ]


def searched_on(front: "Front") -> list[str]:
    """How many ticks were searched, and by how much it is worse at all of them."""
    return [
        f"searched at the {front.worst_ticks} worst of {front.ticks} ticks, measured at all: at"
        f" most {100.0 * front.gap:.2g} % worse there"
    ]


def table_text(front: "Front", notes: Sequence[str], folder: Path) -> str:
    """The layouts as a table, remarks, and where everything was written."""
    from ..design.design_page import cell, name_of, shown_columns

    columns = shown_columns(front)
    rows = [["layout", *(f"{head} {unit}".strip() for _, head, unit, _, _ in columns)]]
    for k, row in enumerate(front.rated):
        cells = [cell(row, key, factor, decimals) for key, _, _, factor, decimals in columns]
        rows.append([name_of(front, k), *cells])
    words = [head.split() for head in rows[0]]
    tall = max(map(len, words))
    heads = [[*[""] * (tall - len(each)), *each] for each in words]
    lines = [[head[k] for head in heads] for k in range(tall)] + rows[1:]
    widths = [max(len(line[k]) for line in lines) for k in range(len(rows[0]))]
    shown = [
        "  ".join(
            [
                f"{line[0]:<{widths[0]}}",
                *(f"{c:>{w}}" for c, w in zip(line[1:], widths[1:], strict=True)),
            ]
        )
        for line in lines
    ]
    return "\n".join([*shown, *(f"remark: {note}" for note in notes), f"written: {folder}"])
