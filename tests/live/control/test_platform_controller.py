"""The platform in each state: how it begins, where it leads, and that no stream has a gap."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.cueing import CAUSAL_METHODS
from atlas_cueing.errors import PlanningError
from atlas_cueing.live.control.command import command_of, standstill
from atlas_cueing.live.control.state_machine import Event, State
from atlas_cueing.live.input.source import no_vehicle
from atlas_cueing.rotation import IDENTITY, ZERO, exp, geodesic
from atlas_cueing.signals import Cue, Motion, VehicleState

from ..rig import ROUNDING, Rig

QUICK = ("cueing.stage.planner=onset",)


def columns(rig: Rig, part: str, name: str) -> np.ndarray:
    return np.array([getattr(getattr(tick, part), name) for tick in rig.tape.ticks])


def signs(q: np.ndarray) -> float:
    return float(np.min(np.sum(q[1:] * q[:-1], axis=1)))


def test_it_starts_parked_at_rest_upright_in_the_centre() -> None:
    rig = Rig()
    assert rig.state is State.PARKED
    assert not rig.platform.tracking
    assert not rig.platform.moving
    assert rig.platform.needs_cueing
    assert rig.motion == Motion(0.0, IDENTITY, ZERO, ZERO, ZERO, ZERO, ZERO, (0.0, 0.0))
    assert command_of(rig.platform.step(no_vehicle(rig.dt)), ZERO) == standstill(rig.motion, ZERO)


def test_an_event_without_a_way_changes_nothing() -> None:
    rig = Rig()
    assert not rig.platform.handle(Event.RESET)
    assert rig.platform.handle(Event.ENGAGE)
    assert not rig.platform.handle(Event.ENGAGE)
    assert rig.state is State.ENGAGING
    assert not rig.platform.moving  # it has not set out yet


@pytest.mark.parametrize("method", CAUSAL_METHODS)
@pytest.mark.parametrize("platform", ["atlas-2.9m", "atlas-tabletop", "atlas-1.5m"])
def test_there_and_back_with_every_method(method: str, platform: str) -> None:
    """Engaged to a spinning vehicle, held, resumed, parked, engaged again: in all limits."""
    rig = Rig(
        0.02,
        platform,
        (f"cueing.method={method}", *(QUICK if method != "classical" else ())),
        rate=0.3,
    )
    rig.bring_to(State.HOLDING)
    rig.until(lambda: not rig.platform.moving, 3.0)
    rig.press("engage")
    rig.until(State.RUNNING, 8.0)
    rig.press("park")
    rig.tick()
    rig.until(State.PARKED, 60.0)
    assert geodesic(rig.motion.q_WS, IDENTITY) < 2e-3
    assert np.hypot.reduce(rig.motion.p_WS_W) < 2e-3
    assert rig.platform.needs_cueing
    rig.press("engage")
    rig.until(State.RUNNING, 8.0)
    assert rig.excess() <= ROUNDING
    for part, name in (("cue", "q_WS"), ("motion", "q_WS"), ("vehicle", "q_NB")):
        assert signs(columns(rig, part, name)) > 0.0, f"the sign of {part} {name} jumps"


def test_a_turn_over_does_not_tear_the_cue_at_the_next_start() -> None:
    """Home by the shorter way may be home at -q, which the next cueing knows nothing of.

    Then the same through a fault.
    """
    rig = Rig(0.02, settings=("cueing.method=attitude", *QUICK), rate=1.2)
    rig.bring_to(State.RUNNING)
    rig.until(lambda: rig.motion.q_WS[0] < -0.5, 20.0)
    rig.press("park")
    rig.tick()
    rig.until(State.PARKED, 60.0)
    assert rig.motion.q_WS[0] < 0.0
    rig.bring_to(State.STOPPED)
    rig.press("reset")
    rig.tick()
    rig.until(State.PARKED, 60.0)
    rig.bring_to(State.RUNNING)
    assert signs(columns(rig, "cue", "q_WS")) > 0.0
    assert signs(columns(rig, "motion", "q_WS")) > 0.0


def test_the_stop_of_a_fault_turns_the_sphere_as_its_wheels_do() -> None:
    """Orientation against scipy's integral of J times the wheels' speeds, over the stop."""
    rig = Rig(0.002, settings=QUICK)
    rig.bring_to(State.RUNNING)
    begin = len(rig.tape.ticks) - 1
    rig.tick(lateness=0.025)
    rig.until(State.STOPPED, 5.0)
    J = np.array(rig.scenario.platform.geometry().sphere_from_wheels)
    w = columns(rig, "wheels", "speed")[begin:] @ J.T
    turns = Rotation.from_rotvec(0.5 * rig.dt * (w[1:] + w[:-1]))
    q = Rotation.from_quat(rig.tape.ticks[begin].motion.q_WS, scalar_first=True)
    for turn in turns:
        q = turn * q
    end = Rotation.from_quat(rig.motion.q_WS, scalar_first=True)
    assert (q * end.inv()).magnitude() < 1e-4
    assert all(tick.motion.limited == (1.0, 1.0) for tick in rig.tape.ticks[begin + 1 : -1])
    assert rig.tape.ticks[-1].motion.w_WS_W == ZERO


def test_time_is_even_through_a_reset() -> None:
    rig = Rig(0.003, settings=QUICK)
    rig.bring_to(State.STOPPED)
    rig.press("reset")
    rig.fly(2.0)
    times = columns(rig, "motion", "time")
    np.testing.assert_array_equal(times, [(k + 1) * rig.dt for k in range(len(times))])
    for part in ("vehicle", "cue", "wheels"):
        np.testing.assert_array_equal(columns(rig, part, "time"), times)


def test_the_first_cueing_is_not_built_in_the_tick_that_sets_out() -> None:
    """A pipeline takes tens of milliseconds to build.

    There is one already, at the start and after a reset.
    """
    rig = Rig(0.02)
    rig.platform._new_pipeline = lambda: pytest.fail("built in a tick")  # type: ignore[assignment]
    rig.bring_to(State.RUNNING)


@pytest.mark.parametrize("bad", [float("nan"), float("inf")])
def test_a_cue_that_is_not_finite_is_refused(bad: float) -> None:
    rig = Rig(settings=QUICK)
    rig.bring_to(State.RUNNING)
    assert rig.platform._cueing is not None
    rig.platform._cueing = SimpleNamespace(
        step=lambda vehicle: Cue(vehicle.time, IDENTITY, (bad, 0.0, 0.0), ZERO, ZERO, ZERO)
    )
    with pytest.raises(PlanningError, match="not finite"):
        rig.platform.step(
            VehicleState(rig.tape.ticks[-1].motion.time + rig.dt, IDENTITY, ZERO, (0.0, 0.0, -9.8))
        )


def test_the_commands_say_what_the_tick_says() -> None:
    rig = Rig(settings=QUICK)
    rig.bring_to(State.RUNNING)
    tick, command = rig.tape.ticks[-1], rig.tape.commands[-1]
    assert (command.time, command.p_WS_W, command.v_WS_W) == (
        tick.motion.time,
        tick.motion.p_WS_W,
        tick.motion.v_WS_W,
    )
    assert (command.wheel_speed, command.wheel_acceleration) == (
        tick.wheels.speed,
        tick.wheels.acceleration,
    )


def test_no_vehicle_is_level_and_at_rest() -> None:
    assert no_vehicle(3.0) == VehicleState(3.0, IDENTITY, ZERO, (0.0, 0.0, -9.80665))
    assert exp(no_vehicle(3.0).w_NB_B) == IDENTITY
