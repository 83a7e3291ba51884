from math import inf, nan

import pytest

from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles import Bounds

CALM = VehicleState(0.0, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.80665))


def with_(q: float = 1.0, w: float = 0.0, f: float = -9.8) -> VehicleState:
    return VehicleState(0.0, (q, 0.0, 0.0, 0.0), (0.0, w, 0.0), (0.0, 0.0, f))


def test_a_calm_state_is_believed() -> None:
    assert Bounds().objection(CALM, 1000.0) == ""


@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_what_is_not_finite_is_never_believed(bad: float) -> None:
    assert "specific force" in Bounds().objection(with_(f=bad), 0.0)
    assert "body rate" in Bounds().objection(with_(w=bad), 0.0)
    assert "height" in Bounds().objection(CALM, bad)
    assert "attitude" in Bounds().objection(with_(q=nan), 0.0)


def test_each_bound_is_inclusive_and_named_with_its_value() -> None:
    bounds = Bounds(force=100.0, rate=3.0, depth=2.0, height=500.0)
    assert bounds.objection(with_(f=100.0), 500.0) == ""
    assert bounds.objection(with_(w=3.0), -2.0) == ""
    assert (
        bounds.objection(with_(f=100.1), 0.0)
        == "specific force 100.1 m/s^2, allowed: 0 <= force <= 100"
    )
    assert bounds.objection(with_(w=3.1), 0.0) == "body rate 3.1 rad/s, allowed: 0 <= rate <= 3"
    assert (
        bounds.objection(CALM, -2.1) == "height above ground -2.1 m, allowed: -2 <= height <= 500"
    )
    assert (
        bounds.objection(CALM, 500.1) == "height above ground 500.1 m, allowed: -2 <= height <= 500"
    )


def test_the_magnitude_counts_not_the_components() -> None:
    state = VehicleState(0.0, CALM.q_NB, (0.0, 0.0, 0.0), (60.0, 60.0, 60.0))  # |f| = 104
    assert "103.9" in Bounds(force=100.0).objection(state, 0.0)


def test_the_defaults_let_a_hard_landing_pass_but_no_crash() -> None:
    assert Bounds().objection(with_(f=303.0), 0.0) == ""  # JSBSim's c3105
    assert Bounds().objection(with_(f=690.0 * 9.8), 0.0) != ""  # JSBSim's f16_test
