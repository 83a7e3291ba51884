"""The paper's J, and the matrices of double rows, emerge from rollers that know neither."""

import numpy as np
import pytest

from atlas_cueing.scenario import load_platform
from atlas_cueing.wheels import RollerRows, row_corrections

pytest.importorskip("mujoco", reason="mujoco is not installed (extra physics)")
from roller_plant import comparison, roll

GEOMETRY = load_platform("atlas-tabletop").geometry()


def test_the_jacobian_emerges() -> None:
    """Eq. 16: the mean rate of a sphere on wheels of one row is J times their speeds."""
    rolled = roll(GEOMETRY, [RollerRows(0.0, 0.005, 16)] * 3, (6.0, -4.0, 5.0), 0.5)
    found = comparison(GEOMETRY, rolled, {})
    assert found.mean_error < 5e-3
    turned = np.linalg.norm(rolled.w_W.mean(axis=0))
    assert turned > 1.0
    swapped = type(rolled)(rolled.omega[:, [1, 0, 2]], rolled.w_W, rolled.rows)
    assert comparison(GEOMETRY, swapped, {}).mean_error > 0.5  # it can tell


def test_the_matrices_of_double_rows_emerge() -> None:
    """Omega = C_s J omega with the rows that touch; a single-row model is far off."""
    rows = [RollerRows(0.006, 0.005, 12)] * 3
    rolled = roll(GEOMETRY, rows, (3.0, -2.0, 2.5), 0.6)
    found = comparison(GEOMETRY, rolled, row_corrections(GEOMETRY, rows))
    assert found.rows_seen >= 6  # of eight combinations
    assert found.with_rows < 0.006
    assert found.single_row > 0.03
    assert found.rows_swapped > 0.06
