from itertools import pairwise
from math import cos, degrees, inf, nan, radians
from pathlib import Path

import jsbsim
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.errors import InputError, VehicleError
from atlas_cueing.rotation import geodesic, norm, rotate
from atlas_cueing.signals import Vehicle
from atlas_cueing.vehicles import (
    AircraftFlight,
    Bounds,
    InitialConditions,
    JsbsimVehicle,
    ScriptFlight,
    TimedInput,
    own_scripts,
)
from atlas_cueing.vehicles.jsbsim.jsbsim_log import capture
from atlas_cueing.vehicles.jsbsim.jsbsim_vehicle import MOST_RESETS

from ..flying import CRUISE, body_from_north, cessna, event, fly, write_script


def script(name: str, **changes: float) -> ScriptFlight:
    return ScriptFlight(own_scripts()[name], **changes)


def flown_to_failure(vehicle: JsbsimVehicle) -> VehicleError:
    with pytest.raises(VehicleError) as caught:
        fly(vehicle, 200.0)
    return caught.value


def test_it_is_a_vehicle() -> None:
    vehicle: Vehicle = JsbsimVehicle(cessna())
    assert vehicle.state.time == 0.0
    assert vehicle.dt == 1.0 / 120.0


@pytest.mark.parametrize(
    "flight",
    [cessna(TimedInput(0.5, "fcs/aileron-cmd-norm", 1.0, 0.3)), script("c1722")],
)
def test_the_same_flight_twice_is_bitwise_the_same(flight: ScriptFlight | AircraftFlight) -> None:
    one, two = JsbsimVehicle(flight), JsbsimVehicle(flight)  # side by side, in one process
    for _ in range(600):
        assert one.advance()
        assert two.advance()
        assert one.state == two.state
    assert norm(one.state.w_NB_B) > 1e-3, "nothing happened"


@pytest.mark.parametrize(
    "name", ["c172_elevator_doublet", "f16_runway_test", "Test_F450_Launch", "ah1s_flight_test"]
)
def test_states_are_those_of_plain_jsbsim(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # plain JSBSim leaves its files here
    vehicle = JsbsimVehicle(script(name))
    capture()
    plain = jsbsim.FGFDMExec(None)
    plain.load_script(str(own_scripts()[name]))
    plain.run_ic()
    axis_distance = plain["position/radius-to-vehicle-ft"] * cos(plain["position/lat-gc-rad"])
    centrifugal = 7.292115e-5**2 * axis_distance * cos(plain["position/lat-gc-rad"])
    for _ in range(round(12.0 / vehicle.dt)):
        state = vehicle.state
        attitude = Rotation.from_quat(state.q_NB, scalar_first=True).as_matrix().T
        # its quaternion is off unit length
        assert np.abs(attitude - body_from_north(plain)).max() < 1e-8
        assert state.w_NB_B == tuple(plain[f"velocities/{axis}-rad_sec"] for axis in "pqr")
        force = np.array([plain[f"accelerations/a-pilot-{axis}-ft_sec2"] for axis in "xyz"])
        apparent = plain["accelerations/gravity-ft_sec2"] - centrifugal
        assert state.f_B == pytest.approx(9.80665 * force / apparent, rel=1e-12, abs=1e-12)
        assert vehicle.advance()
        assert plain.run()


def test_at_rest_the_force_is_gravity_upwards() -> None:
    state = fly(JsbsimVehicle(script("f16_runway_test")), 3.0)[-1]
    # the nose gear holds it a little off level
    assert state.f_B == pytest.approx((0.0, 0.0, -9.80665), abs=0.25)
    assert rotate(state.q_NB, state.f_B) == pytest.approx((0.0, 0.0, -9.80665), abs=0.02)


@pytest.mark.parametrize("altitude", [1000.0, 12_000.0])
def test_level_flight_shows_standard_gravity_at_any_height(altitude: float) -> None:
    cruise = AircraftFlight(
        "737", InitialConditions(altitude, 200.0, latitude=radians(80.0), trim=True)
    )
    for state in fly(JsbsimVehicle(cruise), 1.0):
        assert norm(state.f_B) == pytest.approx(9.80665, abs=0.02)


@pytest.mark.parametrize("name", ["c172_elevator_doublet", "c3104", "J2460", "737_cruise"])
def test_time_is_the_number_of_steps_times_dt(name: str) -> None:
    vehicle = JsbsimVehicle(script(name))
    times = [state.time for state in fly(vehicle, 25.0)]
    assert times == [n * vehicle.dt for n in range(len(times))]
    assert len(times) > 1000


def test_time_goes_on_when_a_script_resets_the_flight(tmp_path: Path) -> None:
    flight = ScriptFlight(write_script(tmp_path / "s.xml", event("simulation/reset", "1")))
    vehicle = JsbsimVehicle(flight)
    clock = []
    while len(clock) < 180 and vehicle.advance():
        clock.append(vehicle._fdm.get_sim_time())
        assert vehicle.state.time == len(clock) * 0.01
    assert len(clock) == 180
    assert min(np.diff(clock)) < 0.0, "the script did not reset: nothing is tested"


def test_a_trim_in_mid_run_shows_as_a_jump_at_its_tick_and_nowhere_else() -> None:
    states = fly(JsbsimVehicle(script("c172_elevator_doublet")), 4.0)
    steps = [degrees(geodesic(a.q_NB, b.q_NB)) for a, b in pairwise(states)]
    assert [n for n, step in enumerate(steps) if step > 1.0] == [120]
    assert steps[120] > 5.0
    assert states[121].time - states[120].time == pytest.approx(0.0083333, abs=1e-9)


def test_a_script_ends_where_it_says_and_stays_ended() -> None:
    vehicle = JsbsimVehicle(script("737_test"))
    last = fly(vehicle)[-1]
    assert last.time == pytest.approx(1.0, abs=vehicle.dt)
    assert not vehicle.advance()
    assert vehicle.state is last


def test_twice_the_rate_is_twice_the_states_of_the_same_flight() -> None:
    slow, fast = (fly(JsbsimVehicle(script("c1721", rate_hz=rate)), 5.0) for rate in (120.0, 240.0))
    assert len(fast) == 2 * len(slow) - 1
    assert geodesic(slow[-1].q_NB, fast[-1].q_NB) < radians(0.5)


def test_inputs_reach_the_flight_at_their_time() -> None:
    pull = TimedInput(1.0, "fcs/elevator-cmd-norm", -0.5, 0.0)
    with_pull, without = (fly(JsbsimVehicle(cessna(*inputs))) for inputs in ((pull,), ()))
    same = [a == b for a, b in zip(with_pull, without, strict=True)]
    assert same.index(False) in (121, 122), "the first state after the input's step"
    assert not any(same[122:])
    assert with_pull[-1].w_NB_B[1] > 0.1, "stick back: nose up"


@pytest.mark.parametrize(
    ("aircraft", "airspeed", "altitude"), [("c172x", 60.0, 150.0), ("f16", 200.0, 400.0)]
)
def test_a_dive_into_the_ground_ends_the_flight_with_time_and_reason(
    aircraft: str, airspeed: float, altitude: float
) -> None:
    dive = InitialConditions(altitude, airspeed, pitch=radians(-60.0))
    vehicle = JsbsimVehicle(AircraftFlight(aircraft, dive))
    failure = flown_to_failure(vehicle)
    assert 1.0 < failure.time < 15.0
    assert failure.time == pytest.approx(vehicle.state.time + vehicle.dt)
    assert "allowed" in failure.reason
    assert Bounds().objection(vehicle.state, 0.0) == "", (
        "the state left behind is the last good one"
    )


@pytest.mark.parametrize(
    ("name", "at"),
    [("cannonball", 36.99), ("ball_chute", 30.42), ("f16_test", 127.9), ("p51_start_test", 0.0167)],
)
def test_own_scripts_that_end_badly_fail_at_their_time(name: str, at: float) -> None:
    failure = flown_to_failure(JsbsimVehicle(script(name)))
    assert failure.time == pytest.approx(at, abs=0.02)


def test_an_elevator_that_is_not_a_number_fails_one_step_later(tmp_path: Path) -> None:
    acos_of_2 = "<acos><value>2</value></acos>"
    flight = ScriptFlight(
        write_script(tmp_path / "s.xml", event("fcs/elevator-cmd-norm", acos_of_2))
    )
    vehicle = JsbsimVehicle(flight)
    failure = flown_to_failure(vehicle)
    assert failure.time == pytest.approx(0.5, abs=0.03)
    assert "nan" in failure.reason
    numbers = (vehicle.state.time, *vehicle.state.q_NB, *vehicle.state.w_NB_B, *vehicle.state.f_B)
    assert np.isfinite(numbers).all()


def test_an_infinite_angle_is_a_failed_vehicle(monkeypatch: pytest.MonkeyPatch) -> None:
    vehicle = JsbsimVehicle(cessna())
    monkeypatch.setattr(vehicle._readings, "_phi", lambda: inf)
    assert "not finite" in flown_to_failure(vehicle).reason


def test_a_first_state_out_of_bounds_fails_at_time_zero() -> None:
    with pytest.raises(VehicleError, match="specific force") as caught:
        JsbsimVehicle(cessna(), Bounds(force=9.0))
    assert caught.value.time == 0.0


def test_what_jsbsim_raises_in_mid_run_is_a_failed_vehicle(tmp_path: Path) -> None:
    text = event("fcs/elevator-cmd-norm", "0.1").replace("simulation/sim-time-sec", "nobody/knows")
    failure = flown_to_failure(JsbsimVehicle(ScriptFlight(write_script(tmp_path / "s.xml", text))))
    assert (
        failure.reason
        == "JSBSim: FGPropertyValue::GetValue() The property nobody/knows does not exist"
    )


def test_a_script_that_stops_the_clock_fails_instead_of_going_on_for_ever(tmp_path: Path) -> None:
    flight = ScriptFlight(write_script(tmp_path / "s.xml", event("simulation/pause", "1")))
    assert "clock stands still" in flown_to_failure(JsbsimVehicle(flight)).reason


def test_wrong_inputs_are_refused_when_built() -> None:
    with pytest.raises(InputError, match="did you mean 'fcs/elevator-cmd-norm'"):
        JsbsimVehicle(cessna(TimedInput(1.0, "fcs/elevatr-cmd-norm", 0.1)))
    with pytest.raises(InputError, match="did you mean 'c172x'"):
        JsbsimVehicle(AircraftFlight("c712x", CRUISE))
    with pytest.raises(InputError, match="value = nan"):
        JsbsimVehicle(cessna(TimedInput(1.0, "fcs/elevator-cmd-norm", nan)))


@pytest.mark.parametrize(
    ("name", "value"), [("simulation/do_simple_trim", -1.0), ("propulsion/set-running", 1e9)]
)
def test_an_input_that_jsbsim_throws_at_ends_the_flight_and_not_the_process(
    name: str, value: float
) -> None:
    vehicle = JsbsimVehicle(cessna(TimedInput(1.0, name, value)))
    failure = flown_to_failure(vehicle)
    assert failure.time == 1.0
    assert f"input on {name!r} = {value:g}: JSBSim: " in failure.reason
    assert vehicle.state.time == 1.0, "all before it is good"


RESET = (
    '<event name="r"{}><condition>simulation/sim-time-sec ge {}</condition><set'
    ' name="simulation/reset" value="1"/></event>'
)


@pytest.mark.parametrize(
    ("persistent", "time"), [("", 1.0), (' persistent="true"', 0.05), (' continuous="true"', 0.5)]
)
def test_a_script_that_resets_again_and_again_fails(
    persistent: str, time: float, tmp_path: Path
) -> None:
    script = write_script(tmp_path / "s.xml", RESET.format(persistent, time))
    failure = flown_to_failure(JsbsimVehicle(ScriptFlight(script)))
    assert (
        f"clock back more than {MOST_RESETS} times (simulation/reset), so its end never comes"
        in failure.reason
    )
    assert failure.time <= (MOST_RESETS + 1) * (time + 0.03)


def test_a_script_may_reset_and_come_to_its_end() -> None:
    """One of JSBSim's own does: 50 s, a reset, and the 40 s that it states."""
    vehicle = JsbsimVehicle(script("c172_cruise_8K"))
    while vehicle.advance():
        pass
    assert vehicle.state.time == pytest.approx(90.0, abs=0.1)


def test_an_aircraft_may_reset_as_often_as_it_likes_within_its_duration() -> None:
    resets = [TimedInput(0.1 * k, "simulation/reset", 1.0) for k in range(1, 15)]
    assert fly(JsbsimVehicle(cessna(*resets)))[-1].time == 2.0
