"""The whole loop with a plant in place of hardware: held, bounded, and stopped when it must be."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.live.control.drive_status import CabinSensors
from atlas_cueing.live.control.state_machine import State

from .plant_rides import PLATFORM, PlantRide, turned_away
from .rig import Rig


def moving(ride: PlantRide) -> np.ndarray:
    """Whether the schedule moves, by tick."""
    return np.array(
        [any(t.wheels.speed) or any(t.wheels.acceleration) for t in ride.rig.tape.ticks]
    )


@pytest.mark.parametrize(("rate", "lead"), [(100.0, 0.06), (250.0, 0.02)])
def test_a_fix_holds_what_creep_turns_away(rate: float, lead: float) -> None:
    quiet = {"fix_noise_rad": 0.0, "gyro_noise_rad_sqrt_s": 0.0}
    quiet |= {"first_fix_gain": 0.0, "fix_gain": 0.08, "fix_bias_gain": 0.0032}  # settles in 8 s
    open_loop = PlantRide("none", rate, lead=lead, **quiet)
    closed = PlantRide("fix", rate, lead=lead, **quiet)
    for ride in (open_loop, closed):
        assert ride.rig.controller.outcome.result == "ok"
        assert ride.refused == ""
    assert open_loop.error[-1] > 0.1, "or there is nothing to hold"
    assert closed.error[-1] < 0.1 * open_loop.error[-1]
    assert closed.error.max() < 0.7 * open_loop.error.max()
    assert closed.rig.attitude is not None
    assert closed.rig.attitude.figures()["fixes"] >= 70
    # the schedule is not touched
    flown, alone = closed.rig.tape.ticks, open_loop.rig.tape.ticks
    count = min(len(flown), len(alone))
    assert [t.motion for t in flown[:count]] == [t.motion for t in alone[:count]]


def test_the_gyro_alone_drifts_by_its_bias() -> None:
    quiet = {"gyro_noise_rad_sqrt_s": 0.0, "turning": 0.01}
    ride = PlantRide("gyro", gyro_bias_rad_s=0.01, **quiet)  # type: ignore[arg-type]
    seconds = len(ride.error) * ride.rig.dt
    assert ride.error[-1] == pytest.approx(np.degrees(0.01 * seconds), rel=0.15)
    true = PlantRide("gyro", gyro_bias_rad_s=0.0, **quiet)  # type: ignore[arg-type]
    assert true.error[-1] < 0.02


def test_schedule_and_correction_keep_the_limits_together() -> None:
    hard = {"attitude_gain_1_s": 50.0, "correction_rate_rad_s": 5.0, "correction_share": 1.0}
    ride = PlantRide("fix", fix_noise_rad=0.03, fix_gain=0.5, **hard)
    limits, h = ride.rig.wheel_limits, ride.rig.dt
    speed, acceleration = ride.sums[:, 0], ride.sums[:, 1]
    added = speed - np.array([t.wheels.speed for t in ride.rig.tape.ticks])
    assert np.abs(added).max() > 1.0, "or nothing was tried"
    assert (np.abs(speed) <= np.array(limits.speed) * (1.0 + 1e-6)).all()
    assert (np.abs(acceleration) <= np.array(limits.acceleration) * (1.0 + 1e-6)).all()
    most = np.array(limits.jerk) * h * (1.0 + 1e-6)
    assert (np.abs(np.diff(acceleration, axis=0)) <= most).all()
    assert ride.refused == "", "and the drives take every set point"


def test_nothing_moves_at_rest() -> None:
    ride = PlantRide("fix", fix_noise_rad=0.02)
    rest = ~moving(ride)
    assert not ride.sums[0].any()
    assert not ride.sums[-1].any(), "parked is at rest"
    early = np.flatnonzero(rest)[:100]
    assert not ride.sums[early].any(), "nor is it turned before it sets out"


def cut(number: int) -> object:
    def sensed(at: int, sensors: CabinSensors) -> CabinSensors | None:
        return None if at > number else sensors

    return sensed


def test_a_gyro_that_falls_silent_stops_the_platform() -> None:
    ride = PlantRide("fix", sensed=cut(250), fix_noise_rad=0.01)  # type: ignore[arg-type]
    outcome = ride.rig.controller.outcome
    assert outcome.result == "fault"
    assert "tell of no gyro" in outcome.reason
    assert ride.rig.state is State.STOPPED
    assert ride.refused == "", "the sum flies the stop that the drives fly"
    assert ride.drives.receiver.tripped == ""
    assert not ride.sums[-1].any()


def test_fixes_that_contradict_the_gyro_stop_the_platform() -> None:
    def sensed(at: int, sensors: CabinSensors) -> CabinSensors:
        if at < 250 or sensors.fix_WS is None:
            return sensors
        return replace(sensors, fix_WS=turned_away(sensors.fix_WS, (0.0, 0.3, 0.0)))

    ride = PlantRide("fix", sensed=sensed)
    assert "fixes are not where the gyro says, by 17" in ride.rig.controller.outcome.reason
    assert ride.refused == ""


def test_without_fixes_nothing_more_is_corrected() -> None:
    def sensed(at: int, sensors: CabinSensors) -> CabinSensors:
        return sensors if at < 150 else CabinSensors(sensors.turned)

    ride = PlantRide("fix", sensed=sensed, seconds=10.0, fix_noise_rad=0.02)
    assert ride.rig.controller.outcome.result == "ok"
    added = ride.sums[:, 0] - np.array([t.wheels.speed for t in ride.rig.tape.ticks])
    assert np.abs(added[100:350]).max() > 1e-3
    assert np.abs(added[650:-100]).max() < 1e-6


def test_a_platform_that_is_not_where_it_is_said_to_be_does_not_set_out() -> None:
    def sensed(_: int, sensors: CabinSensors) -> CabinSensors:
        fix = sensors.fix_WS and turned_away(sensors.fix_WS, (0.4, 0.0, 0.0))
        return replace(sensors, fix_WS=fix)

    ride = PlantRide("fix", sensed=sensed)
    assert not any(moving(ride))
    assert ride.rig.monitor is not None
    assert "fixes are not where the gyro says" in ride.rig.monitor.trouble


@pytest.mark.parametrize("state", [State.ENGAGING, State.RUNNING, State.HOLDING, State.PARKING])
def test_a_stop_in_any_state_is_the_drives_own(state: State) -> None:
    pressed: list[State] = []

    def before_slot(rig: Rig, _: int) -> None:
        if rig.state is State.RUNNING and state is State.HOLDING and not pressed:
            rig.press("hold")
            pressed.append(state)
        times = [time for time, name, _ in rig.tape.statuses if name == state.value]
        if times and rig.loop.time > times[0] + 0.3:
            rig.wanted.signals = 2

    ride = PlantRide("fix", before_slot=before_slot, fix_noise_rad=0.02)
    assert ride.rig.controller.outcome.result == "stopped"
    assert ride.refused == ""
    assert ride.drives.receiver.tripped == ""
    assert not ride.sums[-1].any()


def test_a_ride_is_not_over_before_the_sum_stands() -> None:
    """A correction may be longer on its way to rest than the schedule."""
    rig = Rig(0.01, PLATFORM, corrected="fix")
    assert rig.attitude is not None
    gate = rig.controller._gate
    assert gate.settled
    rig.attitude._wheels[1].state = (0.0, 0.3, 0.0)
    assert gate.standing
    assert not gate.settled


def test_it_does_not_set_out_before_it_has_a_fix() -> None:
    ride = PlantRide("fix", sensed=lambda _, sensors: CabinSensors(sensors.turned))
    assert not any(moving(ride))
    assert ride.rig.monitor is not None
    assert "no fix of the cabin" in ride.rig.monitor.trouble


def test_a_gyro_that_freezes_is_not_followed_for_long() -> None:
    kept: list[CabinSensors] = []

    def sensed(at: int, sensors: CabinSensors) -> CabinSensors:
        kept[:] = kept if at > 250 and kept else [sensors]
        return kept[0]

    ride = PlantRide("gyro", sensed=sensed, seconds=20.0)
    assert "deg from its schedule, allowed: 30 deg" in ride.rig.controller.outcome.reason
    assert ride.error.max() < 45.0
    assert not ride.sums[-1].any()
