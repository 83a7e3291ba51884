"""The cues of a plan, tick by tick."""

import numpy as np
import pytest

from atlas_cueing.cueing import CueSource
from atlas_cueing.cueing.preview.planned_cues import PlannedCues
from atlas_cueing.errors import InputError
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.signals import Cue, VehicleState


def made() -> PlannedCues:
    rows = np.arange(24.0).reshape(2, 12)
    return PlannedCues(
        np.array([0.0, 0.1]), np.eye(4)[:2], *(rows[:, i : i + 3] for i in (0, 3, 6, 9))
    )


def state(time: float) -> VehicleState:
    return VehicleState(time, IDENTITY, ZERO, (0.0, 0.0, -9.80665))


def test_every_row_is_a_cue() -> None:
    plan: CueSource = made()
    assert plan.step(state(0.0)) == Cue(0.0, IDENTITY, (0, 1, 2), (3, 4, 5), (6, 7, 8), (9, 10, 11))
    second = plan.step(state(0.1))
    assert second == Cue(0.1, (0, 1, 0, 0), (12, 13, 14), (15, 16, 17), (18, 19, 20), (21, 22, 23))
    assert all(type(x) is float for x in (*second.q_WS, *second.a_WS_W))


def test_states_that_it_was_not_made_for_are_refused() -> None:
    plan = made()
    with pytest.raises(InputError, match=r"other states: there is none at 0\.05 s"):
        plan.step(state(0.05))
    plan.step(state(0.0))
    with pytest.raises(InputError, match="other states"):
        plan.step(state(0.0))
    plan.step(state(0.1))
    with pytest.raises(InputError, match=r"other states: there is none at 0\.2 s"):
        plan.step(state(0.2))
