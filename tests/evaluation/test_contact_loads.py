"""Figures of loads in blocks against the same of the whole run, and the lines made of them."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.evaluation import BLOCK_TICKS, ContactLoads, RunColumns, gathered
from atlas_cueing.evaluation.contact_loads import load_violations, traction_lines
from atlas_cueing.loads import Drive, Preload, WheelContact, balance
from atlas_cueing.scenario import load_platform

from .flights import any_flight, still

MODEL = load_platform("atlas-2.9m").load_model()
WEIGHT = 490.0 * 9.80665


def wild(count: int) -> RunColumns:
    """A flight on which wheels slip and lift."""
    flight = any_flight(count, 4)
    alpha = np.random.default_rng(4).normal(size=(count, 3)) * 6.0
    return replace(flight, motion_alpha_W=alpha, motion_a_W=0.5 * alpha[:, ::-1])


@pytest.mark.parametrize("count", [50, BLOCK_TICKS + 700])
def test_in_blocks(count: int) -> None:
    flight = any_flight(count, 15)
    loads = balance(
        MODEL, flight.motion_q_WS, flight.motion_w_W, flight.motion_alpha_W, flight.motion_a_W
    )
    touching = np.all(loads.normal > 0.0, axis=1)
    slipping = ~touching | np.any(np.abs(loads.drive) > 0.5 * loads.normal, axis=1)
    total, power = loads.power.sum(axis=1), loads.power
    supplied = np.where(power > 0.0, power / 0.9, 0.9 * power).sum(axis=1)

    def integral(x: np.ndarray) -> float:
        return float(np.trapezoid(x, flight.time))

    expected = {
        "traction_use_max": min(100.0, float(loads.traction_use.max())),
        "traction_slip_share": slipping.mean(),
        "normal_min_n": loads.normal.min(),
        "normal_max_n": loads.normal.max(),
        "lift_off_share": 1.0 - touching.mean(),
        "preload_needed_n": loads.preload_needed.max(),
        "wheel_torque_max_n_m": np.abs(loads.torque).max(),
        "wheel_torque_rms_n_m": np.sqrt(np.mean(loads.torque**2, axis=0)).max(),
        "motor_speed_max_rad_s": 10.0 * np.abs(loads.speed).max(),
        "power_peak_w": total.max(),
        "power_regenerated_peak_w": -total.min(),
        "energy_j": integral(np.maximum(power, 0.0).sum(axis=1)),
        "energy_regenerated_j": integral(np.maximum(-power, 0.0).sum(axis=1)),
        "energy_supplied_j": integral(supplied),
    }
    found = gathered(ContactLoads(MODEL), flight)
    assert list(found) == list(expected)
    for name, value in expected.items():
        assert found[name] == pytest.approx(float(value), rel=1e-9), name


def test_at_rest() -> None:
    found = gathered(ContactLoads(MODEL), still(20))
    assert found["normal_min_n"] == pytest.approx(WEIGHT / (3.0 * np.sin(np.radians(40.0))))
    assert found["preload_needed_n"] == pytest.approx(-WEIGHT)
    assert found["traction_use_max"] == pytest.approx(0.0, abs=1e-12)
    assert found["energy_j"] == pytest.approx(0.0, abs=1e-12)
    assert traction_lines(found, MODEL) == []
    assert load_violations(found, MODEL) == []


def test_no_ticks() -> None:
    found = ContactLoads(MODEL).figures()
    assert set(found.values()) == {0.0}
    assert load_violations(found, MODEL) == traction_lines(found, MODEL) == []


def test_without_regeneration_the_supply_gives_all_and_takes_nothing() -> None:
    flight = any_flight(200, 3)
    drive = Drive(efficiency=1.0, regeneration=False)
    found = gathered(ContactLoads(replace(MODEL, drive=drive)), flight)
    assert found["energy_supplied_j"] == pytest.approx(found["energy_j"])


def test_the_preload_needed_holds_the_wheels() -> None:
    flight = wild(100)
    needed = gathered(ContactLoads(MODEL), flight)["preload_needed_n"]
    held = replace(MODEL, preloads=(Preload((0.0, 0.0, 1.0), needed + 1e-6),))
    found = gathered(ContactLoads(held), flight)
    assert found["traction_use_max"] == pytest.approx(1.0, abs=1e-6)
    assert found["traction_slip_share"] == found["lift_off_share"] == 0.0
    (line,) = traction_lines(found, MODEL)
    assert line == "traction: 1.000 of the friction in use at most, 0.800 with the margin of 1.25"


def test_lines() -> None:
    found = gathered(ContactLoads(MODEL), wild(100))
    slip, lift = traction_lines(found, MODEL)
    assert f"a wheel slips on {found['traction_slip_share']:.2%} of the ticks" in slip
    assert f"{found['preload_needed_n']:.6g} N more straight down" in slip
    assert f"lifts off on {found['lift_off_share']:.2%}" in lift


def test_violations() -> None:
    found = gathered(ContactLoads(MODEL), wild(100))
    wheels = tuple(
        WheelContact(w.contact, w.drive, w.radius, w.friction, load_limit=10.0)
        for w in MODEL.wheels
    )
    weak = replace(MODEL, wheels=wheels, drive=Drive(1.0, 0.5, 2.0))
    names = [line.split(" = ")[0] for line in load_violations(found, weak)]
    assert names == [
        "wheel_torque_max_n_m",
        "wheel_torque_rms_n_m",
        "motor_speed_max_rad_s",
        "normal_max_n",
    ]


def test_no_force_straight_down_loads_a_wheel_on_top() -> None:
    model = load_platform("atlas-orthogonal").load_model()
    figures = gathered(ContactLoads(replace(model, supports=())), still(5))
    assert figures["traction_slip_share"] == 1.0
    assert "no force straight down would hold it" in traction_lines(figures, model)[0]
