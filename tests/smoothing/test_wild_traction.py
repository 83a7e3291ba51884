"""A few of the hostile rides of `tools/wild_traction`, and what they find without a defence."""

import numpy as np
import pytest

from .cues import UPRIGHT
from .traction_flights import Kept, demand
from .wild_traction import PLATFORMS, lines, ride

HALO = "atlas-2.9m-halo, 0 kN"


@pytest.mark.parametrize("name", PLATFORMS)
def test_hostile_rides_break_nothing(name: str) -> None:
    found = ride(name, 2, 1000)
    assert found.ticks == 1000
    assert found.kinematic_broken == found.traction_broken == 0
    assert 0.8 < found.friction <= 1.0  # it is also reached, so that the test could fail
    assert max(found.kinematic.values()) > 0.99


def test_a_seed_is_repeatable() -> None:
    assert ride(HALO, 3, 300) == ride(HALO, 3, 300) != ride(HALO, 4, 300)


def test_without_traction_kept_they_find_slip_and_no_other_limit() -> None:
    found = ride(HALO, 11, 1000, kept=False)
    assert found.traction_broken > 0
    assert found.kinematic_broken == 0
    assert f"traction broken on {found.traction_broken} ticks" in " ".join(lines(HALO, found))


def test_without_a_look_at_the_stop_they_find_slip() -> None:
    assert ride(HALO, 11, 1000, blind=True).traction_broken > 0


def test_at_rest_springs_share_weight_and_halo_by_stiffness() -> None:
    """All is even around z, so each contact gives k u_z times the depth, along its direction."""
    kept = Kept("atlas-2.9m-halo", 0.0, 0.5)
    use, normal, _ = demand(kept.model, kept.fly(0.01, [UPRIGHT]))
    up, k = np.array([0.6427876] * 3 + [0.4226183] * 12), np.array([2e6] * 3 + [4e5] * 12)
    load = 490.0 * 9.80665 + 12 * 0.5 * 750.0 * np.sin(np.radians(60.0))
    assert normal[0] == pytest.approx(load * k * up / (k @ up**2), rel=1e-6)
    assert use.max() < 1e-9
