"""The felt force of a coning cabin, written out by hand, and of a head off the centre."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.review.checks.felt_force import check_felt_force, felt_again
from atlas_cueing.signals import felt

from ..runs import G, coning, with_flight


def test_a_coning_cabin() -> None:
    run = coning()
    force, rate = felt_again(run)
    assert force == pytest.approx(run.flight.felt_f, abs=1e-12)
    assert rate == pytest.approx(run.flight.felt_w, abs=1e-12)
    assert force[0] == pytest.approx([0.0, 0.0, -G])
    assert check_felt_force(run) == []


def test_a_head_off_the_centre_agrees_with_what_the_recorder_writes() -> None:
    run = coning()
    rider = run.platform.rider.model_copy(update={"head_m": (0.1, -0.2, 0.4)})
    off = replace(run, platform=run.platform.model_copy(update={"rider": rider}))
    f = run.flight
    force, rate = felt(
        f.motion_q_WS, f.motion_w_W, f.motion_alpha_W, f.motion_a_W, (0.1, -0.2, 0.4)
    )
    assert felt_again(off)[0] == pytest.approx(force, abs=1e-12)
    assert felt_again(off)[1] == pytest.approx(rate, abs=1e-12)
    assert {finding.place for finding in check_felt_force(off)} >= {
        "/felt fx_m_s2",
        "/felt fy_m_s2",
        "/felt fz_m_s2",
    }


@pytest.mark.parametrize("angle", [1e-9, 1e-4, 1.0, 3.0, np.pi])
def test_the_angle_is_judged_near_zero_and_near_half_a_turn(angle: float) -> None:
    run = coning()
    c, s = np.cos(angle), np.sin(angle)
    f = run.flight.felt_f
    axis = np.array([1.0, 0.0, 0.0])
    side = np.cross(axis, f)
    tilted = f * c + side * s + axis * (f @ axis)[:, None] * (1 - c)
    run = with_flight(run, replace(run.flight, vehicle_f_B=tilted))
    across = np.linalg.norm(side, axis=1) / np.linalg.norm(f, axis=1)
    expected = 2.0 * np.arcsin(np.clip(across * np.sin(0.5 * angle), 0.0, 1.0))
    table = run.log.tables["/felt"]
    values = table.values.copy()
    values[:, -1] = expected
    run = replace(
        run, log=replace(run.log, tables={**run.log.tables, "/felt": replace(table, values=values)})
    )
    assert check_felt_force(run) == []
    values[100, -1] += 1e-6
    (found,) = check_felt_force(run)
    assert (found.place, found.time) == ("/felt direction_error_rad", pytest.approx(1.0))
