"""Wheels with two rows of rollers, against a search for where they touch and first order."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from atlas_cueing.errors import SlipConditionError
from atlas_cueing.scenario import load_platform
from atlas_cueing.wheels import (
    OmniWheel,
    RollerRows,
    row_contact,
    row_correction,
    row_corrections,
    row_effect,
    tilt,
)

ROWS = RollerRows(0.025, 0.03, 8)
GEOMETRY = load_platform("atlas-2.9m").geometry()


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("wheel", GEOMETRY.wheels)
def test_the_contact_is_where_torus_and_sphere_are_nearest(wheel: OmniWheel, side: int) -> None:
    """A circle of a roller's profile, in the plane of contact and axle, pressed onto the sphere."""
    u, b = np.array(wheel.contact), np.array(wheel.induced)
    beta = tilt(1.45, ROWS)
    # the wheel's axle is where the row's profile just touches: distance of the profile's centre
    height = (1.45 + ROWS.profile_radius) * np.cos(beta)
    centre = height * u + side * ROWS.offset * b

    def gap(angle: float) -> float:
        point = centre - ROWS.profile_radius * (np.cos(angle) * u + np.sin(angle) * b)
        return float(np.linalg.norm(point))

    found = minimize_scalar(gap, bounds=(-0.3, 0.3), options={"xatol": 1e-12})
    assert found.fun == pytest.approx(1.45, abs=1e-12)
    point = centre - ROWS.profile_radius * (np.cos(found.x) * u + np.sin(found.x) * b)
    touching = row_contact(1.45, wheel, ROWS, side)
    np.testing.assert_allclose(touching.contact, point / 1.45, atol=1e-7)
    # the axle is one wheel radius beyond the lowest point of the row
    axle = height - ROWS.profile_radius + wheel.radius
    assert touching.radius == pytest.approx(axle - point @ u, abs=1e-9)


def test_first_order() -> None:
    """C_s - 1 = beta B^-1 diag(s) U, and the mean of all is 1 up to beta^2."""
    B, U = np.array(GEOMETRY.induced_rows), np.array([w.contact for w in GEOMETRY.wheels])
    errors = []
    for offset in (0.02, 0.002):
        rows = [replace(ROWS, offset=offset)] * 3
        beta = tilt(1.45, rows[0])
        corrections = row_corrections(GEOMETRY, rows)
        linear = {s: beta * np.linalg.solve(B, np.diag(s) @ U) for s in corrections}
        worst = max(np.abs(C - np.eye(3) - linear[s]).max() for s, C in corrections.items())
        mean = np.abs(np.mean(list(corrections.values()), axis=0) - np.eye(3)).max()
        errors.append((worst, mean))
    np.testing.assert_allclose(np.array(errors[0]) / errors[1], 100.0, rtol=0.02)


def test_no_offset_is_no_correction() -> None:
    for correction in row_corrections(GEOMETRY, [replace(ROWS, offset=0.0)] * 3).values():
        np.testing.assert_allclose(correction, np.eye(3), atol=1e-14)


def test_ripple_and_drift() -> None:
    """By size of the platform: the smaller the sphere, the more the rows matter."""
    effect = row_effect(GEOMETRY, [ROWS] * 3)
    assert np.degrees(effect.tilt) == pytest.approx([0.968] * 3, abs=1e-3)
    assert effect.largest_correction == pytest.approx(0.024, abs=5e-4)
    assert effect.mean_correction == pytest.approx(2.9e-4, abs=5e-6)
    assert 0.017 <= effect.ripple <= 0.021
    assert radians(0.04) < effect.drift_mean < radians(0.25) < effect.drift_max < radians(2.0)


def test_rows_that_make_it_singular() -> None:
    """An offset of the sphere's own radius turns a contact onto the axle."""
    wide = RollerRows(1.4499, 0.0, 8)
    wheel = OmniWheel.along((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), 0.15)
    twice = replace(GEOMETRY, wheels=(wheel, wheel, GEOMETRY.wheels[2]))
    with pytest.raises(SlipConditionError):
        row_correction(twice, [wide] * 3, (1, 1, 1))
