"""Contacts that open, against a general solver of the same minimum."""

import numpy as np
import pytest
from scipy.optimize import nnls

from atlas_cueing.loads import LoadModel, Support
from atlas_cueing.loads.exact_push import pushing_forces
from atlas_cueing.loads.normal_forces import bilateral_forces, normal_forces

from .models import point_mass, ring, unit

RNG = np.random.default_rng(7)


def supported(preload: float = 300.0) -> LoadModel:
    below = [unit([np.cos(a), np.sin(a), -0.7]) for a in np.arange(6) * 1.0472]
    above = [unit([np.cos(a), np.sin(a), 0.8]) for a in np.arange(6) * 1.0472 + 0.3]
    supports = [Support(u, 0.5, preload) for u in below] + [Support(u, 0.3, preload) for u in above]
    return LoadModel("x", 1.0, point_mass(), ring(3, 0.7), supports=tuple(supports))


def by_least_squares(model: LoadModel, need: np.ndarray) -> np.ndarray:
    """Least complementary energy sum (n - n0)^2 / 2k over n >= 0, with the balance weighted."""
    root = 1.0 / np.sqrt(model.stiffness)
    heavy = 1e7
    A = np.vstack([np.diag(root), heavy * model.all_contacts.T])
    return nnls(A, np.concatenate([root * model.unloaded, -heavy * need]), maxiter=1000)[0]


def test_open_contacts() -> None:
    model = supported()
    need = RNG.normal(size=(60, 3)) * 1500.0
    forces, pushing = normal_forces(model, need)
    assert 0 < pushing.sum() < 60  # both kinds are there
    assert np.all(forces >= 0.0)
    np.testing.assert_allclose(forces @ model.all_contacts, -need, atol=1e-5)
    for k in range(60):
        np.testing.assert_allclose(forces[k], by_least_squares(model, need[k]), atol=0.05)


def test_all_contacts_closed_is_the_bilateral_solution() -> None:
    model, need = supported(3000.0), RNG.normal(size=(20, 3)) * 100.0 + [0.0, 0.0, 2e3]
    forces, pushing = normal_forces(model, need)
    assert np.all(pushing)
    np.testing.assert_array_equal(forces, bilateral_forces(model, need))


def test_what_nothing_can_hold_is_bilateral() -> None:
    """Three wheels below cannot pull the sphere down."""
    model = LoadModel("x", 1.0, point_mass(), (*ring(3, 0.7), *ring(2, 0.5)))
    need = np.array([[0.0, 0.0, -900.0]])
    forces, pushing = normal_forces(model, need)
    assert not pushing[0]
    np.testing.assert_array_equal(forces, bilateral_forces(model, need))
    assert forces.min() < 0.0


def test_stiffness_of_three_wheels_does_not_matter() -> None:
    wheels = ring(3, 0.7)
    other = tuple(
        type(w)(w.contact, w.drive, w.radius, 0.5, stiffness=k)
        for w, k in zip(wheels, (1, 9, 30), strict=True)
    )
    need = RNG.normal(size=(5, 3)) * 100.0
    one, two = (LoadModel("x", 1.0, point_mass(), each) for each in (wheels, other))
    np.testing.assert_allclose(bilateral_forces(one, need), bilateral_forces(two, need), rtol=1e-9)
    np.testing.assert_allclose(
        bilateral_forces(one, need), -np.linalg.solve(one.U.T, need.T).T, rtol=1e-9
    )


def test_published_share_of_passive_wheels() -> None:
    """Twelve passive wheels 25 deg below the equator take most of 490 kg (three at 40 deg)."""
    ring_below = [
        unit(
            [
                np.cos(np.radians(25)) * np.cos(a),
                np.cos(np.radians(25)) * np.sin(a),
                -np.sin(np.radians(25)),
            ]
        )
        for a in np.arange(12) * np.pi / 6 + np.pi / 12
    ]
    wheels = ring(3, np.radians(40))
    for ratio, expected in ((1.0, 913.0), (0.5, 1336.0), (0.2, 1852.0)):
        model = LoadModel(
            "x",
            1.45,
            point_mass(490.0),
            wheels,
            supports=tuple(Support(u, ratio) for u in ring_below),
        )
        forces, _ = normal_forces(model, np.array([[0.0, 0.0, 490.0 * 9.80665]]))
        assert forces[0, 0] == pytest.approx(expected, abs=0.6)


def random_contacts(rng: np.random.Generator) -> LoadModel:
    """Three wheels below, and up to twelve supports anywhere, soft and hard, loaded or not."""
    supports = tuple(
        Support(
            unit(rng.normal(size=3)), 10.0 ** rng.uniform(-2, 1), rng.choice([0.0, 100.0, 400.0])
        )
        for _ in range(rng.integers(1, 13))
    )
    return LoadModel("x", 1.0, point_mass(), ring(3, 0.7), supports=supports)


def test_a_push_that_balances_is_found_whenever_there_is_one() -> None:
    """3000 random states; nnls says of each whether the contacts can push so at all."""
    rng = np.random.default_rng(11)
    held, missed, invented = 0, 0, 0
    for _ in range(100):
        model = random_contacts(rng)
        need = rng.normal(size=(30, 3)) * 1500.0
        forces, _ = normal_forces(model, need)
        left = np.array([nnls(model.all_contacts.T, -each)[1] for each in need])
        balances = left < 1e-6 * np.abs(need).max(axis=1)
        pushes = np.all(forces >= 0.0, axis=1)
        held += int(balances.sum())
        missed += int(np.sum(balances & ~pushes))
        invented += int(np.sum(~balances & pushes))
        np.testing.assert_allclose(forces @ model.all_contacts, -need, atol=1e-4)
    assert 1000 < held < 3000  # both kinds are there
    assert (missed, invented) == (0, 0)


def test_pushes_of_few_contacts_have_the_least_energy() -> None:
    """At the least energy of n >= 0 with U^T n = -need: (n - n0) / k = u . d, or less where 0."""
    rng = np.random.default_rng(12)
    found = 0
    for _ in range(150):
        model, need = random_contacts(rng), rng.normal(size=3) * 1500.0
        n = pushing_forces(model, need)
        if n is None:
            continue
        strain = (n - model.unloaded) / model.stiffness
        pushing = n > 0.0
        d = np.linalg.lstsq(model.all_contacts[pushing], strain[pushing], rcond=None)[0]
        np.testing.assert_allclose(model.all_contacts[pushing] @ d, strain[pushing], atol=1e-3)
        if pushing.sum() >= 3:
            assert np.all(strain[~pushing] >= model.all_contacts[~pushing] @ d - 1e-3)
            found += 1
    assert found > 60
