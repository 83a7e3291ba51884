"""The solver against problems whose answer is known."""

import sys

import numpy as np
import pytest
from scipy.sparse import csc_array, eye_array

from atlas_cueing.cueing.preview import solver
from atlas_cueing.cueing.preview.solver import Bounds, minimise
from atlas_cueing.errors import InputError

ONE = csc_array(eye_array(3))


def nearest(point: list[float], bounds: Bounds) -> np.ndarray:
    return minimise(ONE, -np.array(point), bounds)


def test_within_a_box() -> None:
    bounds = Bounds()
    bounds.within(ONE, 0.5)
    assert nearest([2.0, -0.2, -7.0], bounds) == pytest.approx([0.5, -0.2, -0.5], abs=1e-6)


def test_within_a_ball() -> None:
    bounds = Bounds()
    bounds.length(csc_array(np.ones((1, 1))), 2.0)
    assert nearest([3.0, 0.0, 4.0], bounds) == pytest.approx([1.2, 0.0, 1.6], abs=1e-6)


def test_on_a_plane() -> None:
    bounds = Bounds()
    bounds.equal(csc_array([[0.0, 0.0, 1.0]]), np.array([3.0]))
    bounds.zero(csc_array([[1.0, -1.0, 0.0]]))
    assert nearest([1.0, 3.0, 0.0], bounds) == pytest.approx([2.0, 2.0, 3.0], abs=1e-6)


def test_bounds_on_a_part_of_the_unknowns_and_two_at_once() -> None:
    inner, outer = Bounds(), Bounds()
    inner.within(csc_array(np.ones((1, 1))), 1.0)
    outer.within(ONE, 2.0)
    assert nearest([5.0, 5.0, 5.0], outer + inner.among(1, 3)) == pytest.approx(
        [2.0, 1.0, 2.0], abs=1e-6
    )


def test_the_size_of_the_cost_does_not_matter() -> None:
    bounds = Bounds()
    bounds.within(ONE, 0.5)
    for size in (1e-9, 1e9):
        x = minimise(csc_array(size * ONE), size * np.array([-2.0, 0.2, 7.0]), bounds)
        assert x == pytest.approx([0.5, -0.2, -0.5], abs=1e-6)


def test_bounds_that_contradict_each_other_are_no_plan() -> None:
    bounds = Bounds()
    bounds.within(ONE, 0.5)
    bounds.equal(csc_array([[1.0, 0.0, 0.0]]), np.array([3.0]))
    with pytest.raises(InputError, match=r"found no plan .* PrimalInfeasible"):
        nearest([1.0, 0.0, 0.0], bounds)


def bounded(side: float) -> Bounds:
    bounds = Bounds()
    bounds.equal(csc_array([[1.0, 0.0, 0.0]]), np.array([side]))
    return bounds


@pytest.mark.parametrize("bad", [np.nan, 1e300])
def test_numbers_that_are_none_are_no_plan(bad: float) -> None:
    bounds = Bounds()
    bounds.within(ONE, 0.5)
    with pytest.raises(InputError, match="found no plan"):
        minimise(ONE, np.array([0.0, 1.0, 2.0]), bounds + bounded(bad))


def test_without_clarabel_the_message_tells_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "clarabel", None)
    with pytest.raises(InputError, match=r"pip install 'atlas_cueing\[preview\]'"):
        solver.clarabel()
