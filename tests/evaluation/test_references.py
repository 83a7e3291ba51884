"""Every metric in blocks against the same metric of the whole run, by numpy and scipy."""

import numpy as np
import pytest

from atlas_cueing.evaluation import (
    BLOCK_TICKS,
    DECLARED,
    Consistency,
    ContactLoads,
    LimitUse,
    Metrics,
    gathered,
)
from atlas_cueing.scenario import load_platform

from . import references
from .flights import any_flight
from .test_blocks import STAGE, TO_WHEELS, WHEELS

MODEL = load_platform("atlas-2.9m").load_model()
TO_SPHERE = np.linalg.inv(TO_WHEELS)
counts = pytest.mark.parametrize("count", [50, 2000, BLOCK_TICKS + 700])


def agree(found: dict[str, float], expected: dict[str, float]) -> None:
    """Quantiles are in single precision; the integrator has its own tolerance."""
    assert list(found) == list(expected)
    for name, value in expected.items():
        rel = 1.2e-7 if "_p9" in name else 1e-9
        assert found[name] == pytest.approx(value, rel=rel, abs=1e-9), name


@counts
def test_metrics(count: int) -> None:
    flight = any_flight(count, 11)
    found = gathered(Metrics(), flight)
    agree(found, references.metrics(flight))


@counts
def test_limit_use(count: int) -> None:
    flight = any_flight(count, 12)
    expected = references.limit_use(flight, WHEELS, STAGE)
    agree(gathered(LimitUse(WHEELS, STAGE), flight), expected)


def test_consistency() -> None:
    """The scheme is of fourth order: its error is far below what any of its terms gives here."""
    flight = any_flight(400, 13)
    found = gathered(Consistency(TO_WHEELS, TO_SPHERE), flight)
    expected = references.consistency(flight, TO_SPHERE)
    assert list(found) == list(expected)
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=1e-9, abs=1e-7), name


def test_every_metric_is_declared_and_every_declared_one_is_computed() -> None:
    """In one order: that of `--json`, of `compare` and of the columns of a batch."""
    flight = any_flight(10, 14)
    computed = gathered(Metrics(), flight) | gathered(Consistency(TO_WHEELS, TO_SPHERE), flight)
    computed |= gathered(ContactLoads(MODEL), flight)
    assert list(computed) == list(DECLARED)
