"""What the table of a design shows, and how finely."""

import numpy as np

from atlas_cueing.design import Front, Layout, Rated
from atlas_cueing.design.design_page import cell, shown_columns
from atlas_cueing.design.measure import measure_fully
from atlas_cueing.design.ridden import Ridden
from atlas_cueing.scenario import load_platform

ATLAS = load_platform("atlas-2.9m")
STANDING = Ridden(
    np.zeros((1, 3)), np.array([[0.0, 0.0, 4800.0]]), np.ones((1, 3)), np.ones((1, 3))
)


def front_of(scale: float, gear: float, *objectives: str) -> Front:
    """A table of two layouts whose forces, torques and powers are `scale` times those of Atlas."""
    rows = []
    for layout in (Layout(40.0, 0.0, 0.0, 0.15, 10.0), Layout(30.0, 9.0, 0.0, 0.15, gear)):
        found = measure_fully(ATLAS, layout, STANDING)
        assert found
        forces = {k: v * scale for k, v in found.figures.items() if k.endswith(("_n", "_m", "_w"))}
        rows.append(Rated(layout, found.figures | forces, "found", on_front=True))
    return Front(tuple(rows), 0, objectives, 1, 1, 0.0, 1)


def shown(front: Front) -> dict[str, tuple[str, str]]:
    """Unit and first cell of each column."""
    columns = shown_columns(front)
    return {c[0]: (c[2], cell(front.rated[0], c[0], c[3], c[4])) for c in columns}


def test_a_small_platform_has_newtons_and_decimals() -> None:
    large, small = shown(front_of(1.0, 10.0)), shown(front_of(1e-3, 10.0))
    assert large["wheel_load_max_n"] == ("kN", "2.49")
    assert small["wheel_load_max_n"] == ("N", "2.5")
    assert large["torque_max_n_m"][0] == small["torque_max_n_m"][0] == "N m"
    assert float(small["torque_max_n_m"][1]) > 0.0


def test_what_was_searched_and_asked_for_is_shown() -> None:
    plain = shown(front_of(1.0, 10.0, "torque_max_n_m"))
    assert not {"gear", "motor_speed_max_rad_s", "row_largest_correction"} & set(plain)
    geared = shown(front_of(1.0, 5.0, "motor_speed_max_rad_s", "row_largest_correction"))
    assert {"gear", "motor_speed_max_rad_s", "row_largest_correction"} <= set(geared)
