"""Which layouts are worth having."""

import numpy as np
import pytest

from atlas_cueing.design import check_objectives
from atlas_cueing.design.objective import costs, nearest_to_ideal, not_dominated
from atlas_cueing.errors import InputError


def test_what_another_beats_everywhere_is_not_worth_having() -> None:
    table = np.array([[1.0, 9.0], [2.0, 5.0], [3.0, 5.0], [5.0, 1.0], [6.0, 6.0], [2.0, 5.0]])
    assert not_dominated(table) == [0, 1, 3]


def test_against_all_pairs_by_hand() -> None:
    table = np.random.default_rng(3).integers(0, 9, (60, 3)).astype(float)
    worth = {
        tuple(a)
        for a in table.tolist()
        if not any(
            b != a and all(x <= y for x, y in zip(b, a, strict=True)) for b in table.tolist()
        )
    }
    assert {tuple(table[k].tolist()) for k in not_dominated(table)} == worth


def test_the_choice_is_the_one_whose_worst_objective_is_least() -> None:
    assert nearest_to_ideal(np.array([[0.0, 10.0], [4.0, 3.0], [10.0, 0.0]])) == 1


def test_a_reserve_of_preload_costs_nothing() -> None:
    figures = {"preload_needed_n": -500.0, "clearance_m": 0.3}
    assert costs(figures, ("preload_needed_n", "clearance_m")).tolist() == [0.0, -0.3]


def test_names_that_are_none_are_refused() -> None:
    with pytest.raises(InputError, match="--objective beauty: allowed: preload_needed_n"):
        check_objectives(["beauty"], rows=False)
    with pytest.raises(InputError, match="row_offset_m"):
        check_objectives(["row_largest_correction"], rows=False)
