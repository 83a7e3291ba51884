"""Meshes against areas, volumes and lengths in closed form.

A wrong order of corners would turn a volume's sign.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.viewer.shapes import Mesh, circle, merged, patch, rod, spindle

part = st.floats(-1.0, 1.0)
point = st.tuples(part, part, part).map(np.array)


def corners(mesh: Mesh) -> np.ndarray:
    vertices, faces = mesh
    assert faces.max() < len(vertices)
    return vertices[faces]


def area(mesh: Mesh) -> float:
    a, b, c = np.moveaxis(corners(mesh), 1, 0)
    return float(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def volume(mesh: Mesh) -> float:
    """Of a closed mesh, positive if all faces look outwards (divergence theorem)."""
    a, b, c = np.moveaxis(corners(mesh), 1, 0)
    return float(np.sum(a * np.cross(b, c)) / 6.0)


def test_a_whole_sphere() -> None:
    mesh = patch(2.0, (0.0, 2.0 * np.pi), (-0.5 * np.pi, 0.5 * np.pi))
    assert np.linalg.norm(mesh[0], axis=1) == pytest.approx(2.0)
    assert area(mesh) == pytest.approx(4.0 * np.pi * 4.0, rel=0.01)
    assert volume(mesh) == pytest.approx(4.0 / 3.0 * np.pi * 8.0, rel=0.01)


@given(st.floats(-3.0, 3.0), st.floats(0.05, 3.0), st.floats(-1.5, 1.4), st.floats(0.05, 1.0))
def test_a_patch_has_the_area_of_its_zone(
    azimuth: float, width: float, elevation: float, height: float
) -> None:
    """Archimedes: R^2 times the width times the difference of the sines."""
    top = min(elevation + height, 0.5 * np.pi)
    exact = 9.0 * width * (np.sin(top) - np.sin(elevation))
    assert area(patch(3.0, (azimuth, azimuth + width), (elevation, top))) == pytest.approx(
        exact, rel=0.01
    )


@given(point, point, st.floats(0.01, 1.0), st.sampled_from([0.0, 0.5, 1.0]))
def test_a_rod_has_the_volume_of_a_frustum(
    start: np.ndarray, end: np.ndarray, radius: float, tip: float
) -> None:
    length = float(np.linalg.norm(end - start))
    if length < 1e-3:
        return
    sides = 64
    section = 0.5 * sides * np.sin(2.0 * np.pi / sides)  # of a polygon, for pi
    exact = section * radius**2 * length * (1.0 + tip + tip * tip) / 3.0
    assert volume(rod(start, end, radius, tip, sides)) == pytest.approx(exact, rel=1e-6, abs=1e-9)


def test_a_rod_reaches_from_start_to_end() -> None:
    vertices, _ = rod((1.0, 2.0, 3.0), (1.0, 2.0, 7.0), 0.5)
    assert vertices.min(axis=0) == pytest.approx([0.5, 1.5, 3.0], abs=0.02)
    assert vertices.max(axis=0) == pytest.approx([1.5, 2.5, 7.0], abs=0.02)


def test_a_spindle_is_thickest_in_the_middle() -> None:
    vertices, _ = spindle(np.zeros(3), np.array((1.0, 0.0, 0.0)), 2.0, 0.5)
    away = np.hypot(vertices[:, 1], vertices[:, 2])
    assert away[np.abs(vertices[:, 0]) < 1e-9].max() == pytest.approx(0.5)
    assert away[np.abs(vertices[:, 0]) > 0.99].max() < 0.3


def test_merged_meshes_keep_their_volumes() -> None:
    one, other = rod((0, 0, 0), (0, 0, 1), 0.3), rod((5, 0, 0), (5, 2, 0), 0.2)
    assert volume(merged([one, other, one])) == pytest.approx(2.0 * volume(one) + volume(other))


def test_a_circle_closes() -> None:
    segments = circle(2.0, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), 90)
    assert segments.shape == (90, 2, 3)
    assert np.linalg.norm(segments, axis=2) == pytest.approx(2.0)
    assert segments[1:, 0] == pytest.approx(segments[:-1, 1])
    assert segments[0, 0] == pytest.approx(segments[-1, 1])
    assert np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum() == pytest.approx(
        4.0 * np.pi, rel=1e-3
    )
