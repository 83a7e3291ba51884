"""Arrows at the contacts: where they point, how long they are, and what they say of slip."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.review import RecordedRun
from atlas_cueing.scenario import Platform
from atlas_cueing.viewer.contact_arrows import contact_forces
from atlas_cueing.viewer.recorded_motion import RecordedMotion
from atlas_cueing.viewer.scene import Scene

from .test_scene import BESIDE, node, place


def test_at_rest_the_wheels_carry_the_weight(
    server: Any, platform: Platform, run: RecordedRun
) -> None:
    still = np.zeros_like(run.flight.motion_w_W)
    up = np.tile([1.0, 0.0, 0.0, 0.0], (len(still), 1))
    flight = replace(
        run.flight, motion_q_WS=up, motion_w_W=still, motion_alpha_W=still, motion_a_W=still
    )
    Scene(server, platform).show(RecordedMotion(flight, platform).pose(3))
    for k, wheel in enumerate(platform.wheel):
        path = f"{BESIDE}/contact_force_{k + 1}"
        at, turned = place(server, path)
        contact = np.array(wheel.wheel().contact)
        np.testing.assert_allclose(at, platform.sphere.radius_m * contact, atol=1e-9)
        np.testing.assert_allclose(turned.apply([0.0, 0.0, 1.0]), -contact, atol=1e-6)
        assert node(server, path).scale == pytest.approx(0.33 * platform.sphere.radius_m)
        assert (node(server, f"{path}/grip").visible, node(server, f"{path}/slip").visible) == (
            True,
            False,
        )


def test_a_wheel_that_slips_is_red(server: Any, platform: Platform, run: RecordedRun) -> None:
    pose = RecordedMotion(run.flight, platform).pose(3)
    assert pose.slipping is not None
    Scene(server, platform).show(replace(pose, slipping=np.array([False, True, False])))
    shown = [node(server, f"{BESIDE}/contact_force_{k}/slip").visible for k in (1, 2, 3)]
    assert shown == [False, True, False]


def test_forces_are_those_that_make_the_motion(platform: Platform, run: RecordedRun) -> None:
    found = contact_forces(platform, run.flight)
    assert found is not None
    forces, _ = found
    masses = sum(part.mass_kg for part in platform.part or ())
    com = sum(part.mass_kg * np.array(part.com_m) for part in platform.part or ()) / masses
    c = Rotation.from_quat(run.flight.motion_q_WS, scalar_first=True).apply(com)
    w, alpha = run.flight.motion_w_W, run.flight.motion_alpha_W
    a = run.flight.motion_a_W + np.cross(alpha, c) + np.cross(w, np.cross(w, c))
    expected = masses * (a + np.array([0.0, 0.0, 9.80665]))
    np.testing.assert_allclose(forces.sum(axis=1), expected, rtol=1e-9, atol=1e-6)


def test_without_masses_there_are_none(platform: Platform, run: RecordedRun) -> None:
    bare = platform.model_copy(update={"part": None})
    assert contact_forces(bare, run.flight) is None
    assert RecordedMotion(run.flight, bare).pose(0).contact_force is None
