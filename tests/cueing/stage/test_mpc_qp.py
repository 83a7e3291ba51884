"""The quadratic program against a second derivation of it, by simulating plans."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import simpson
from scipy.optimize import minimize

from atlas_cueing.cueing.stage.mpc_qp import LIMIT_SHARE, MpcProblem
from atlas_cueing.signals import StageLimits

LIMITS = (1.0, 1.5, 6.0, 60.0)
DURATIONS = (0.02, 0.02, 0.04, 0.08, 0.14, 0.2, 0.4, 0.6, 1.0, 1.5)
OMEGA, FADE = 0.7, 5.0
STATES = [
    (0.0, 0.0, 0.0, 1.0),  # far from all limits
    (0.3, -0.2, 0.1, -0.5),
    (0.0, 0.0, 0.0, 50.0),  # all limits at work
    (0.7, 0.6, -0.5, 8.0),  # near the end of the travel
    (-0.5, -1.0, 1.5, -20.0),
    (0.0, 1.45, 0.0, 30.0),  # near the largest speed
]
FINE = 40  # samples a block
Path = tuple[np.ndarray, np.ndarray, np.ndarray]


def simulate(state: tuple[float, ...], jerks: np.ndarray) -> list[tuple[np.ndarray, Path]]:
    """Times from now and p, v, a of each block, by Taylor's series from its start."""
    p, v, a = state[:3]
    blocks, begin = [], 0.0
    for h, j in zip(DURATIONS, jerks, strict=True):
        t = np.linspace(0.0, h, FINE + 1)
        path = p + v * t + a * t**2 / 2 + j * t**3 / 6, v + a * t + j * t**2 / 2, a + j * t
        blocks.append((begin + t, path))
        p, v, a = (float(x[-1]) for x in path)
        begin += h
    return blocks


def cost(state: tuple[float, ...], jerks: np.ndarray) -> float:
    """Integral of the squared departure from the fading demand's onset filter."""
    total = 0.0
    for t, (p, v, a) in simulate(state, jerks):
        departure = a + 2.0 * OMEGA * v + OMEGA**2 * p - state[3] * np.exp(-t / FADE)
        total += float(simpson(departure**2, x=t))
    return total


def controls(state: tuple[float, ...], jerks: np.ndarray) -> np.ndarray:
    """Use of each limit by accelerations, jerks, and control points of v and p.

    The begin is left out.
    """
    used = list(jerks / LIMITS[3])
    for k, (_, (p, v, a)) in enumerate(simulate(state, jerks)):
        speeds, places = bernstein(v, 2), bernstein(p, 3)
        used += [
            a[-1] / LIMITS[2],
            *(speeds[1 if k else 2 :] / LIMITS[1]),
            *(places[1 if k else 3 :] / LIMITS[0]),
        ]
    return np.array(used) / LIMIT_SHARE


def bernstein(values: np.ndarray, degree: int) -> np.ndarray:
    """Control points of the polynomial through values, evenly spaced over a block."""
    s = np.linspace(0.0, 1.0, len(values))
    binomial = {2: (1, 2, 1), 3: (1, 3, 3, 1)}[degree]
    basis = np.stack([c * s**i * (1 - s) ** (degree - i) for i, c in enumerate(binomial)], axis=1)
    return np.linalg.lstsq(basis, values)[0]


def affine(of: Callable[[np.ndarray], np.ndarray], size: int) -> tuple[np.ndarray, np.ndarray]:
    """Matrix and offset of a function that is affine."""
    offset = of(np.zeros(size))
    return np.stack([of(unit) - offset for unit in np.eye(size)], axis=1), offset


def best(state: tuple[float, ...]) -> np.ndarray:
    """Jerks of the best plan by scipy's SLSQP, with the problem built from the simulation alone."""
    n = len(DURATIONS)
    grid = lambda x: np.concatenate([  # noqa: E731
        (a + 2.0 * OMEGA * v + OMEGA**2 * p - state[3] * np.exp(-t / FADE)) * np.sqrt(weights(t))
        for t, (p, v, a) in simulate(state, x)
    ])  # fmt: skip
    scale = 1.0 / np.array(DURATIONS)  # steps of acceleration as unknowns: well conditioned
    residual, constant = affine(lambda x: grid(scale * x), n)
    limits, used = affine(lambda x: controls(state, scale * x), n)
    final, left = affine(
        lambda x: np.array([float(q[-1]) for q in simulate(state, scale * x)[-1][1][1:]]), n
    )
    hessian, linear = residual.T @ residual, residual.T @ constant
    within: Any = [
        {"type": "ineq", "fun": lambda x: 1.0 - limits @ x - used, "jac": lambda _: -limits},
        {"type": "ineq", "fun": lambda x: 1.0 + limits @ x + used, "jac": lambda _: limits},
        {"type": "eq", "fun": lambda x: final @ x + left, "jac": lambda _: final},
    ]
    found = minimize(
        lambda x: x @ hessian @ x / 2.0 + linear @ x,
        np.zeros(n),
        jac=lambda x: hessian @ x + linear,
        constraints=within,
        method="SLSQP",
        options={"maxiter": 500, "ftol": 1e-15},
    )
    assert np.max(np.abs(final @ found.x + left)) < 1e-8, found.message
    jerks: np.ndarray = scale * found.x
    return jerks


def weights(t: np.ndarray) -> np.ndarray:
    """Simpson's."""
    w = np.full(len(t), 2.0)
    w[1::2] = 4.0
    w[[0, -1]] = 1.0
    return w * (t[1] - t[0]) / 3.0


def solved(problem: MpcProblem, state: tuple[float, float, float, float]) -> list[float]:
    """Jerks of the plan, which there is."""
    plan = problem.solve(*state)
    assert plan is not None
    return plan.jerks


def accelerations(state: tuple[float, ...], jerks: np.ndarray) -> np.ndarray:
    return np.cumsum(np.array(jerks) * DURATIONS) + state[2]


@pytest.mark.parametrize("state", STATES, ids=str)
def test_the_plan_is_the_one_that_scipy_finds(state: tuple[float, float, float, float]) -> None:
    jerks = solved(MpcProblem(DURATIONS, OMEGA, FADE, LIMITS), state)
    other = best(state)
    assert cost(state, np.array(jerks)) == pytest.approx(cost(state, other), rel=1e-6, abs=1e-9)
    assert accelerations(state, np.array(jerks)) == pytest.approx(
        accelerations(state, other), abs=1e-4
    )


@pytest.mark.parametrize("state", STATES, ids=str)
def test_every_plan_ends_at_a_standstill_inside_all_limits(
    state: tuple[float, float, float, float],
) -> None:
    """Also between the nodes, and with the limits used where the demand is large."""
    jerks = solved(MpcProblem(DURATIONS, OMEGA, FADE, LIMITS), state)
    blocks = simulate(state, np.array(jerks))
    assert [float(x[-1]) for x in blocks[-1][1][1:]] == pytest.approx([0.0, 0.0], abs=1e-6)
    most = (
        np.max(np.abs([np.concatenate([path[i] for _, path in blocks]) for i in range(3)]), axis=1)
        / LIMITS[:3]
    )
    assert np.all(most <= 1.0)
    assert np.max(np.abs(jerks)) <= LIMITS[3]
    if state[3] == 50.0:
        assert np.max(np.abs(jerks)) > 0.99 * LIMITS[3]
        assert np.max(np.abs(controls(state, np.array(jerks)))) > 0.999


def test_costs_and_limits_are_those_of_the_simulation() -> None:
    """For plans at random, good or bad: the matrices give what simulating gives."""
    random = np.random.default_rng(5)
    problem = MpcProblem(DURATIONS, OMEGA, FADE, LIMITS)
    difference = []
    state = (0.2, -0.3, 0.4, 1.5)
    now = np.array(state)
    for _ in range(5):
        x = random.standard_normal(len(DURATIONS) - 1)
        jerks = np.diff(np.concatenate([[state[2]], x, [0.0]])) / DURATIONS
        quadratic = float(x @ problem.hessian @ x / 2.0 + x @ problem.gradient @ now)
        difference.append(cost(state, jerks) - quadratic)
        bounded = np.concatenate([x, problem.rows @ x]) + problem.offset @ now[:3]
        last = [float(q[-1]) for q in simulate(state, jerks)[-1][1]]
        assert bounded[-1] == pytest.approx(last[1], abs=1e-12)  # the equation
        assert bounded[-2] == pytest.approx(last[0], abs=1e-12)  # where it ends
    assert difference == pytest.approx([difference[0]] * 5, rel=1e-7)  # what the state alone costs


class BrokenSolver:
    """daqp that answers with these flags."""

    def __init__(self, updated: int, flag: int) -> None:
        self._updated, self._flag = updated, flag

    def update(self, **_: Any) -> int:
        return self._updated

    def solve(self) -> tuple[np.ndarray, float, int, dict[str, Any]]:
        return np.full(len(DURATIONS) - 1, np.nan), 0.0, self._flag, {}


@pytest.mark.parametrize(("updated", "flag"), [(-1, 1), (0, -1), (0, -4), (0, 2), (0, 0)])
def test_any_odd_status_is_no_plan(updated: int, flag: int) -> None:
    problem = MpcProblem(DURATIONS, OMEGA, FADE, LIMITS)
    assert problem.solve(0.0, 0.0, 0.0, 1.0) is not None
    problem._solver = BrokenSolver(updated, flag)
    assert problem.solve(0.0, 0.0, 0.0, 1.0) is None


def test_a_state_without_a_way_out_is_no_plan_and_is_forgotten() -> None:
    """Too fast to stop before the end; then from a harmless state as if nothing had been."""
    problem = MpcProblem(DURATIONS, OMEGA, FADE, LIMITS)
    assert problem.solve(0.95, 1.4, 0.0, 0.0) is None
    again, fresh = (
        solved(problem, STATES[1]),
        solved(MpcProblem(DURATIONS, OMEGA, FADE, LIMITS), STATES[1]),
    )
    assert again == pytest.approx(fresh, abs=1e-6)


@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_small_and_large_stages_are_solved_alike(scale: float) -> None:
    """All lengths times a factor: all jerks times that."""
    one = solved(MpcProblem(DURATIONS, OMEGA, FADE, LIMITS), (0.3, -0.2, 0.1, 5.0))
    travel, speed, acceleration, jerk = (scale * x for x in LIMITS)
    p, v, a, demand = (scale * x for x in (0.3, -0.2, 0.1, 5.0))
    other = solved(
        MpcProblem(DURATIONS, OMEGA, FADE, (travel, speed, acceleration, jerk)),
        (p, v, a, demand),
    )
    assert [x / scale for x in other] == pytest.approx(one, abs=1e-2)


def test_axis_limits_come_in_the_order_of_stage_limits() -> None:
    names = list(StageLimits.__dataclass_fields__)
    assert names[:4] == ["travel", "speed", "acceleration", "jerk"]
