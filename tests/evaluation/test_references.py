"""Every metric in blocks against the same metric of the whole run, by numpy and scipy."""

from dataclasses import replace

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
from atlas_cueing.evaluation.perceived import Perceived
from atlas_cueing.scenario import load_platform

from . import reference_limits, references
from .flights import G, any_flight
from .test_blocks import STAGE, TO_WHEELS, WHEELS

MODEL = load_platform("atlas-2.9m").load_model()
TO_SPHERE = np.linalg.inv(TO_WHEELS)
BESIDE_ANOTHER = {"mismatch_ratio"}  # comparisons and batches have it
PERCEIVED = ("perceived_tilt_rms_rad", "perceived_turn_rms_rad_s")
counts = pytest.mark.parametrize("count", [50, 2000, BLOCK_TICKS + 700])


def agree(found: dict[str, float], expected: dict[str, float]) -> None:
    """Quantiles are in single precision; the integrator has its own tolerance."""
    assert list(found) == list(expected)
    for name, value in expected.items():
        rel = 1.2e-7 if "_p9" in name else 1e-9
        assert found[name] == pytest.approx(value, rel=rel, abs=1e-9), name


@counts
def test_metrics(count: int) -> None:
    """The observers have a flight with weight, for one that tumbles about none tears them apart.

    Where the force sensed is opposite to the expected, rounding decides about which axis they turn.
    """
    flight = any_flight(count, 11)
    agree(
        {k: v for k, v in gathered(Metrics(), flight).items() if k not in PERCEIVED},
        references.metrics(flight),
    )
    heavy = replace(flight, vehicle_f_B=flight.vehicle_f_B - np.array([0.0, 0.0, G]))
    perceived = gathered(Perceived(), heavy)
    agree(perceived, references.perceived(heavy))
    assert tuple(perceived) == PERCEIVED


@counts
def test_limit_use(count: int) -> None:
    flight = any_flight(count, 12)
    expected = reference_limits.limit_use(flight, WHEELS, STAGE)
    agree(gathered(LimitUse(WHEELS, STAGE), flight), expected)


def test_consistency() -> None:
    """The scheme is of fourth order: its error is far below what any of its terms gives here."""
    flight = any_flight(400, 13)
    found = gathered(Consistency(TO_WHEELS, TO_SPHERE), flight)
    expected = reference_limits.consistency(flight, TO_SPHERE)
    assert list(found) == list(expected)
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=1e-9, abs=1e-7), name


def test_every_metric_is_declared_and_every_declared_one_is_computed() -> None:
    """In one order: that of `--json`, of `compare` and of the columns of a batch."""
    flight = any_flight(10, 14)
    computed = gathered(Metrics(), flight) | gathered(Consistency(TO_WHEELS, TO_SPHERE), flight)
    computed |= gathered(ContactLoads(MODEL), flight)
    assert list(computed) == [name for name in DECLARED if name not in BESIDE_ANOTHER]
    assert set(DECLARED) - set(computed) == BESIDE_ANOTHER
