"""Loads in a log against those of its motion, and against what contacts and drives can give."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.loads import balance, load_columns
from atlas_cueing.loads.normal_forces import bilateral_forces
from atlas_cueing.recording import TopicColumns
from atlas_cueing.review import RecordedRun
from atlas_cueing.review import loads_again as loads_module
from atlas_cueing.review.checks.logged_loads import check_contact_loads, traction_notes
from atlas_cueing.review.loads_again import loads_again
from atlas_cueing.scenario import Platform, load_platform, presets
from atlas_cueing.signals import LOADS

from ..runs import coning

AT = 300


def with_loads(run: RecordedRun) -> RecordedRun:
    """The run with the loads that a recorder gives it."""
    f = run.flight
    columns = load_columns(run.platform.load_model())
    values = columns(f.motion_q_WS, f.motion_w_W, f.motion_alpha_W, f.motion_a_W)
    table = TopicColumns(LOADS.fields, np.column_stack([f.time, values]))
    return replace(run, log=replace(run.log, tables={**run.log.tables, "/loads": table}))


def changed(run: RecordedRun, field: str, value: float) -> RecordedRun:
    table = run.log.tables["/loads"]
    values = table.values.copy()
    values[AT, table.fields.index(field)] = value
    tables = {**run.log.tables, "/loads": replace(table, values=values)}
    return replace(run, log=replace(run.log, tables=tables))


def strict(run: RecordedRun, **drive: float) -> RecordedRun:
    """The run on a platform that wants slip and lift-off as findings."""
    traction = run.platform.traction.model_copy(update={"report": "finding"})
    drives = run.platform.drive.model_copy(update=drive)
    platform = run.platform.model_copy(update={"traction": traction, "drive": drives})
    return replace(run, platform=platform)


@pytest.mark.parametrize("name", list(presets()))
def test_what_the_recorder_writes_is_found_again(name: str) -> None:
    run = with_loads(coning(platform=name))
    assert check_contact_loads(strict(run)) == []
    assert traction_notes(run) == ()


@pytest.mark.parametrize("name", list(presets()))
def test_two_derivations_of_a_wild_motion(name: str) -> None:
    """With contacts that open on the way, and wheels that lift."""
    run, random = coning(platform=name), np.random.default_rng(5)
    f = run.flight
    wild = replace(
        f,
        motion_w_W=f.motion_w_W + random.normal(size=f.motion_w_W.shape),
        motion_alpha_W=random.normal(size=f.motion_w_W.shape) * 5.0,
        motion_a_W=random.normal(size=f.motion_w_W.shape) * 8.0,
    )
    again = loads_again(replace(run, flight=wild))
    model = run.platform.load_model()
    loads = balance(model, wild.motion_q_WS, wild.motion_w_W, wild.motion_alpha_W, wild.motion_a_W)
    for name in ("drive", "torque", "power"):
        found, expected = getattr(again, name), getattr(loads, name)
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-8)
    np.testing.assert_allclose(again.normal, loads.normal, rtol=1e-8, atol=1e-5)
    assert np.any(~loads.all_in_contact)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5])
def test_forces_where_few_contacts_push(count: int) -> None:
    """A displaced sphere on springs: its forces are known, and so what they hold."""
    platform = load_platform("atlas-2.9m-halo")
    wheels = np.array([wheel.wheel().contact for wheel in platform.wheel])
    supports = [each.support() for each in platform.support or ()]
    contacts = np.array([*wheels, *(each.contact for each in supports)])
    stiffness = np.array([2e6] * 3 + [each.stiffness for each in supports])
    held = np.array([0.0] * 3 + [each.preload for each in supports])
    moved = np.random.default_rng(8).normal(size=(4000, 3)) * 2e-3
    forces = np.maximum(held + stiffness * (moved @ contacts.T), 0.0)
    forces = forces[(forces > 0.0).sum(axis=1) == count][:40]
    assert len(forces) >= 5
    found = loads_module._normal_forces(platform, wheels, -forces @ contacts)
    np.testing.assert_allclose(found, forces, rtol=1e-9, atol=1e-7)


def test_forces_where_no_push_holds_are_those_of_contacts_that_pull() -> None:
    platform = load_platform("atlas-2.9m-halo")
    wheels = np.array([wheel.wheel().contact for wheel in platform.wheel])
    down = np.array([[0.0, 0.0, -1e5], [300.0, 0.0, -1e5]])
    found = loads_module._normal_forces(platform, wheels, down)
    assert np.all(found.min(axis=1) < 0.0)
    expected = bilateral_forces(platform.load_model(), down)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize(
    ("field", "value", "check"),
    [
        ("f2_n", 1.0, "not what the motion needs"),
        ("n1_n", 2000.0, "not what the motion needs"),
        ("t3_n_m", 7.0, "not what the motion needs"),
        ("p1_w", 7.0, "not what the motion needs"),
        ("use2", 1.2, "slip"),
        ("n3_n", -5.0, "lift-off"),
        ("t1_n_m", 601.0, "limit"),
        ("t1_n_m", -601.0, "limit"),
    ],
)
def test_a_number_put_in_on_purpose(field: str, value: float, check: str) -> None:
    run = strict(with_loads(coning()))
    found = [
        each for each in check_contact_loads(changed(run, field, value)) if each.check == check
    ]
    assert [(each.place, each.time) for each in found] == [
        (f"/loads {field}", pytest.approx(run.flight.time[AT]))
    ]


def test_slip_is_a_note_unless_the_platform_wants_a_finding() -> None:
    run = changed(with_loads(coning()), "use2", 1.2)
    (note,) = traction_notes(run)
    assert "/loads use2: slip: traction use = 1.2, allowed: traction use <= 1" in note
    assert not any(each.check == "slip" for each in check_contact_loads(run))


def test_motor_speed_and_thermal_torque() -> None:
    run = with_loads(coning())
    found = check_contact_loads(strict(run, motor_speed_rad_s=50.0, torque_rms_n_m=0.5))
    assert {each.check for each in found} == {"limit"}
    assert {each.place for each in found} == {
        *(f"/wheels w{k}_rad_s at the motor" for k in (1, 2, 3)),
        *(f"/loads t{k}_n_m" for k in (1, 2, 3)),
    }


def test_a_wheel_that_carries_too_much() -> None:
    run = with_loads(coning())
    wheels = tuple(w.model_copy(update={"load_limit_n": 2000.0}) for w in run.platform.wheel)
    run = replace(run, platform=run.platform.model_copy(update={"wheel": wheels}))
    assert {each.place for each in check_contact_loads(run)} == {
        f"/loads n{k}_n" for k in (1, 2, 3)
    }


def test_without_the_topic_the_loads_are_derived() -> None:
    run = coning()
    heavy = tuple(part.model_copy(update={"com_m": (0.0, 0.0, -1.2)}) for part in run.platform.part)
    run = strict(replace(run, platform=run.platform.model_copy(update={"part": heavy})))
    assert {each.check for each in check_contact_loads(run)} >= {"slip"}


def test_a_platform_without_masses_has_nothing_to_check() -> None:
    platform = load_platform("atlas-2.9m")
    bare = Platform.model_validate(platform.model_dump(exclude={"part"}, exclude_none=True))
    run = replace(coning(), platform=bare)
    assert check_contact_loads(run) == []
    assert traction_notes(run) == ()
