"""Axes that do not turn, against scipy's rotations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.cueing.preview.inertial import inertial
from atlas_cueing.rotation import exp, flip

from ..vehicles import LEVEL, manoeuvring, spinning


def test_a_constant_rate_turns_about_its_axis() -> None:
    w = (0.4, -0.3, 0.9)
    seen = inertial(list(spinning(exp((0.3, 0.2, 0.1)), w, 0.01, 500)), 0.01)
    turned = Rotation.from_quat(np.roll(seen.q_AS, -1, axis=1))
    expected = Rotation.from_rotvec(np.outer(seen.time, flip(w)))
    assert np.max((turned.inv() * expected).magnitude()) < 1e-9
    assert np.allclose(seen.w_A, flip(w))
    # gravity does not turn with the body
    assert np.ptp(seen.f_A, axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


def test_turning_drops_out_of_the_vehicle_s_own_attitude() -> None:
    """A differs from N by a constant turn: angles between orientations are the same."""
    states = list(manoeuvring(0.005, 8.0))
    seen = inertial(states, 0.005)
    turned = Rotation.from_quat(np.roll(seen.q_AS, -1, axis=1))
    flown = Rotation.from_quat(np.roll([state.q_NB for state in states], -1, axis=1))
    angles = [(r[0].inv() * r).magnitude() for r in (turned, flown)]
    assert np.max(np.abs(angles[0] - angles[1])) < 1e-4


def test_one_state_is_a_flight() -> None:
    seen = inertial(list(spinning((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.01, 1)), 0.01)
    assert seen.q_AS.tolist() == [[1.0, 0.0, 0.0, 0.0]]
    assert seen.f_A.tolist() == [list(flip(LEVEL))]
