"""What a layout can be asked to be good at."""

from collections.abc import Sequence

import numpy as np

from ..errors import InputError
from ..rotations import Array
from .measure import Figures

OBJECTIVES = {  # name to sign: +1 is better small, -1 better large
    "preload_needed_n": 1.0,  # beyond none: a reserve is not worth a torque
    "wheel_load_max_n": 1.0,
    "torque_max_n_m": 1.0,
    "wheel_speed_max_rad_s": 1.0,
    "motor_torque_max_n_m": 1.0,
    "motor_speed_max_rad_s": 1.0,
    "power_peak_w": 1.0,
    "regenerated_peak_w": 1.0,
    "condition_number": 1.0,
    "row_largest_correction": 1.0,
    "clearance_m": -1.0,
    "sphere_rate_worst_rad_s": -1.0,
    "sphere_acceleration_worst_rad_s2": -1.0,
}
USUAL = ("preload_needed_n", "wheel_load_max_n", "torque_max_n_m", "wheel_speed_max_rad_s")
ALIKE = 2e-3  # of what an objective spans in the table: no difference to a designer


def check_objectives(names: Sequence[str], *, rows: bool) -> tuple[str, ...]:
    """Return the objectives, each once; the usual ones for none.

    rows: whether the platform describes wheels with two rows. Raises InputError for a name that is
    none, and for the ripple of wheels without rows.
    """
    for name in names:
        if name not in OBJECTIVES:
            raise InputError(f"--objective {name}: allowed: {', '.join(OBJECTIVES)}")
        if name == "row_largest_correction" and not rows:
            raise InputError(
                f"--objective {name}: needs row_offset_m, roller_profile_radius_m and"
                " rollers_per_row on every [[wheel]] of the platform"
            )
    return tuple(dict.fromkeys(names)) or USUAL


def costs(figures: Figures, objectives: Sequence[str]) -> Array:
    """The figures as costs, (objectives,): smaller is better; no preload needed costs 0."""
    values = (OBJECTIVES[name] * figures[name] for name in objectives)
    return np.array(
        [
            max(value, 0.0) if name == "preload_needed_n" else value
            for name, value in zip(objectives, values, strict=True)
        ]
    )


def not_dominated(table: Array) -> list[int]:
    """Rows of costs (n, objectives) than which no other is better in one and as good in all.

    Of rows that are as good as equal (ALIKE of the range of each objective) the first is kept.
    """
    near = ALIKE * (table.max(axis=0) - table.min(axis=0))
    kept: list[int] = []
    for k, row in enumerate(table):
        as_good = np.all(table <= row, axis=1)
        better = np.any(table < row, axis=1)
        twin = any(bool(np.all(np.abs(table[other] - row) <= near)) for other in kept)
        if not np.any(as_good & better) and not twin:
            kept.append(k)
    return kept


def nearest_to_ideal(table: Array) -> int:
    """The row of costs (n, objectives) whose worst objective is least, each from 0 to 1.

    0 is the best and 1 the worst of that objective in the table (Chebyshev distance).
    """
    low, high = table.min(axis=0), table.max(axis=0)
    share = (table - low) / np.where(high > low, high - low, 1.0)
    # an objective that all rows reach equally does not count; the mean decides between equals
    return int(np.argmin(share.max(axis=1) + 1e-6 * share.mean(axis=1)))
