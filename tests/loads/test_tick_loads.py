"""The loop's arithmetic against that of whole runs."""

import numpy as np
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.loads import LoadModel, Preload, Support, WheelContact, balance
from atlas_cueing.signals import Motion, WheelSpeeds

from .models import random_body, random_states, ring, unit

RNG = np.random.default_rng(3)


def test_a_tick_is_a_row_of_the_run() -> None:
    wheels = tuple(
        WheelContact(w.contact, w.drive, w.radius, mu, J, 0.05, 1.5)
        for w, mu, J in zip(ring(3, 0.7, 0.3), (0.4, 0.5, 0.6), (0.3, 0.4, 0.5), strict=True)
    )
    model = LoadModel(
        "x", 1.4, random_body(RNG), wheels,
        (Preload((0.0, 0.0, 1.0), 1e4),),
        (Support(unit([0.3, 0.2, -1.0]), 0.4, 900.0), Support(unit([0.1, -0.2, 1.0]), 0.01, 900.0)),
    )  # fmt: skip
    states = random_states(RNG, 200)
    rows, per_tick = balance(model, **states), model.per_tick()
    assert rows.all_in_contact.mean() > 0.5
    for k in np.flatnonzero(rows.all_in_contact).tolist():
        q, w, alpha, a = (tuple(value[k].tolist()) for value in states.values())
        motion = Motion(1.5, q, w, alpha, (0.0,) * 3, (0.0,) * 3, a, (0.0, 0.0))
        turning = WheelSpeeds(
            1.5, tuple(rows.speed[k].tolist()), tuple(rows.acceleration[k].tolist())
        )
        tick = per_tick.loads(motion, turning)
        assert tick.time == 1.5
        for name, found in (
            ("drive", tick.drive),
            ("normal", tick.normal),
            ("torque", tick.torque),
            ("power", tick.power),
            ("traction_use", tick.use),
        ):
            np.testing.assert_allclose(found, getattr(rows, name)[k], rtol=1e-9, atol=1e-8)


def test_a_lifted_wheel_has_no_grip() -> None:
    model = LoadModel("x", 1.4, random_body(RNG), ring(3, 0.7))
    motion = Motion(
        0.0,
        (1.0, 0.0, 0.0, 0.0),
        (0.0,) * 3,
        (0.0,) * 3,
        (0.0,) * 3,
        (0.0,) * 3,
        (20.0, 0.0, 0.0),
        (0.0, 0.0),
    )
    tick = model.per_tick().loads(motion, WheelSpeeds(0.0, (0.0,) * 3, (0.0,) * 3))
    assert min(tick.normal) < 0.0
    assert tick.use[int(np.argmin(tick.normal))] == float("inf")


def test_only_three_wheels() -> None:
    with pytest.raises(InputError, match="allowed in a loop: 3"):
        LoadModel("x", 1.4, random_body(RNG), ring(4, 0.7)).per_tick()
