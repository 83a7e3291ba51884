from dataclasses import replace
from math import cos, inf, nan, radians, sin

import numpy as np
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.rotation import norm, rotate, to_euler
from atlas_cueing.vehicles import AircraftFlight, InitialConditions, JsbsimVehicle, TimedInput
from atlas_cueing.vehicles.jsbsim.loading import load
from atlas_cueing.vehicles.jsbsim.start import start_aircraft

from ..flying import CRUISE, cessna, fly

PARKED = InitialConditions(altitude=0.0, airspeed=0.0, trim=True)


def test_initial_conditions_are_taken_in_si_units() -> None:
    initial = InitialConditions(
        altitude=2000.0, airspeed=60.0, heading=radians(200.0), pitch=radians(5.0),
        roll=radians(-20.0),
        latitude=radians(47.0), longitude=radians(-8.0),
    )  # fmt: skip
    fdm = load(cessna())
    start_aircraft(fdm, AircraftFlight("c172x", initial))
    assert fdm["position/h-sl-ft"] * 0.3048 == pytest.approx(2000.0, abs=1e-3)
    assert fdm["velocities/vt-fps"] * 0.3048 == pytest.approx(60.0, abs=1e-6)
    assert fdm["position/lat-geod-deg"] == pytest.approx(47.0, abs=1e-6)
    assert fdm["position/long-gc-deg"] == pytest.approx(-8.0, abs=1e-9)
    angles = [fdm[f"attitude/{name}-deg"] for name in ("psi", "theta", "phi")]
    assert angles == pytest.approx([200.0, 5.0, -20.0], abs=1e-9)


def test_velocity_points_along_the_nose() -> None:
    fdm = load(cessna())
    start_aircraft(
        fdm, AircraftFlight("f16", InitialConditions(2000.0, 150.0, pitch=0.3, roll=1.0))
    )
    assert fdm["aero/alpha-rad"] == pytest.approx(0.0, abs=1e-9)
    assert fdm["aero/beta-rad"] == pytest.approx(0.0, abs=1e-9)
    assert fdm["flight-path/gamma-rad"] == pytest.approx(0.3, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        (name, bad)
        for name in ("altitude", "airspeed", "heading", "pitch", "roll", "latitude", "longitude")
        for bad in (nan, inf)
    ]
    + [
        ("altitude", -501.0),
        ("altitude", 1e9),
        ("airspeed", -1.0),
        ("airspeed", 3e4),
        ("pitch", 1.6),
        ("latitude", -1.6),
    ],
)
def test_initial_conditions_out_of_bounds_are_refused_with_bounds(name: str, value: float) -> None:
    with pytest.raises(InputError, match=f"initial {name} = {value}, allowed: .* <= {name} <= "):
        JsbsimVehicle(cessna(initial=replace(CRUISE, **{name: value})))


def test_trim_in_flight_finds_equilibrium() -> None:
    states = fly(JsbsimVehicle(cessna()))
    force_N = rotate(states[0].q_NB, states[0].f_B)
    assert force_N == pytest.approx((0.0, 0.0, -9.80665), abs=2e-3)
    assert max(norm(state.w_NB_B) for state in states) < 2e-3
    untrimmed = JsbsimVehicle(cessna(initial=replace(CRUISE, trim=False)))
    assert abs(untrimmed.state.f_B[2] + 9.80665) > 0.5


def test_trim_on_the_ground_settles_on_the_gear() -> None:
    states = fly(JsbsimVehicle(cessna(initial=replace(PARKED, engines_running=False))))
    for state in (states[0], states[-1]):
        assert rotate(state.q_NB, state.f_B) == pytest.approx((0.0, 0.0, -9.80665), abs=0.05)
    assert abs(to_euler(states[0].q_NB)[1]) > radians(0.1), (
        "gear of unequal length: it does not stand level"
    )
    assert max(norm(state.w_NB_B) for state in states) < 0.01


def test_a_trim_that_fails_is_refused_with_where_it_was_tried_and_what_acted_on_it() -> None:
    flaps, rudder = (
        TimedInput(0.0, "fcs/flap-cmd-norm", 1.0),
        TimedInput(0.5, "fcs/rudder-cmd-norm", 1.0),
    )
    with pytest.raises(InputError) as caught:
        JsbsimVehicle(cessna(flaps, rudder, initial=replace(CRUISE, airspeed=10.0)))
    told = str(caught.value)
    assert told.startswith(
        "initial.trim = true: no full trim of 'c172x' at altitude_m = 1500, airspeed_m_s = 10,"
        " pitch_deg = 0"
    )
    assert "at time 0 these act on the trim: fcs/flap-cmd-norm)" in told
    assert told.endswith("or trim = false")


@pytest.mark.parametrize("trim", [True, False])
def test_turbulence_from_time_zero_begins_with_the_second_state_and_flies(trim: bool) -> None:
    inputs = (
        TimedInput(0.0, "atmosphere/turb-type", 4.0),
        TimedInput(0.0, "atmosphere/turbulence/milspec/windspeed_at_20ft_AGL-fps", 75.0),
        TimedInput(0.0, "atmosphere/turbulence/milspec/severity", 7.0),
        TimedInput(0.0, "fcs/flap-cmd-norm", 0.5),
    )
    initial = replace(CRUISE, trim=trim)
    rough, calm = (
        fly(JsbsimVehicle(cessna(*some, initial=initial))) for some in (inputs, inputs[3:])
    )
    assert rough[0] == calm[0]
    assert (
        max(norm(state.w_NB_B) for state in rough)
        > max(norm(state.w_NB_B) for state in calm) + 0.01
    )


@pytest.mark.parametrize("value", [2.0, 1e9])
def test_an_input_at_time_zero_that_jsbsim_cannot_take_is_refused(value: float) -> None:
    with pytest.raises(
        InputError, match=r"input on 'simulation/do_simple_trim' = .*: JSBSim: .*allowed at time 0"
    ):
        JsbsimVehicle(
            cessna(
                TimedInput(0.0, "simulation/do_simple_trim", value),
                initial=replace(CRUISE, trim=False),
            )
        )


def test_an_aircraft_that_cannot_be_initialised_is_refused() -> None:
    # dr1, Camel and others read properties that only FlightGear has
    with pytest.raises(InputError, match=r"JSBSim cannot initialise it: .*does not exist"):
        JsbsimVehicle(AircraftFlight("dr1", replace(CRUISE, trim=False)))


def test_engines_run_at_time_zero_only_when_asked() -> None:
    thrust = {}
    for running in (True, False):
        fdm = load(cessna())
        start = replace(CRUISE, trim=False, engines_running=running)
        start_aircraft(fdm, cessna(TimedInput(0.0, "fcs/throttle-cmd-norm", 1.0), initial=start))
        for _ in range(10):
            fdm.run()
        thrust[running] = fdm["propulsion/engine/thrust-lbs"]
    assert thrust[True] > 100.0
    assert thrust[False] < 1.0


def test_a_wind_at_time_zero_is_felt_in_the_first_state() -> None:
    # from below, after the trim: more lift
    gust = TimedInput(0.0, "atmosphere/wind-down-fps", -15.0)
    rising = JsbsimVehicle(cessna(gust, initial=replace(CRUISE, trim=False)))
    still = JsbsimVehicle(cessna(initial=replace(CRUISE, trim=False)))
    assert rising.state.f_B[2] < still.state.f_B[2] - 3.0
    assert rising.state.time == 0.0
    before = rising.state.f_B
    rising.advance()
    assert np.abs(np.subtract(rising.state.f_B, before)).max() < 0.5, (
        "the first state shows what the second goes on with"
    )


def test_inputs_at_time_zero_act_on_the_trim() -> None:
    flaps = TimedInput(0.0, "fcs/flap-cmd-norm", 1.0)
    initial = replace(CRUISE, airspeed=45.0)
    clean, flapped = (
        to_euler(JsbsimVehicle(cessna(*inputs, initial=initial)).state.q_NB)[1]
        for inputs in ((), (flaps,))
    )
    assert flapped < clean - radians(1.0)


def test_inputs_at_time_zero_win_over_the_controls_of_the_trim() -> None:
    fdm = load(cessna())
    start_aircraft(fdm, cessna(TimedInput(0.0, "fcs/throttle-cmd-norm", 0.05)))
    assert fdm["fcs/throttle-cmd-norm"] == 0.05


def test_the_first_state_does_not_move_while_inputs_settle() -> None:
    fdm = load(cessna())
    start_aircraft(
        fdm,
        cessna(TimedInput(0.0, "fcs/elevator-cmd-norm", -1.0), initial=replace(CRUISE, trim=False)),
    )
    assert fdm.get_sim_time() == 0.0
    assert fdm["velocities/q-rad_sec"] == pytest.approx(0.0, abs=1e-4)


def test_level_turn_trimmed_by_hand_has_the_force_of_its_bank() -> None:
    # a banked, sideslip-free attitude shows the lift along the body z axis: no side force whatever
    # the roll
    state = JsbsimVehicle(cessna(initial=replace(CRUISE, trim=False, roll=radians(45.0)))).state
    upright = JsbsimVehicle(cessna(initial=replace(CRUISE, trim=False))).state
    assert state.f_B == pytest.approx(upright.f_B, abs=0.05)
    assert rotate(state.q_NB, state.f_B)[1] == pytest.approx(
        -sin(radians(45.0)) * state.f_B[2] + cos(radians(45.0)) * state.f_B[1], abs=1e-9
    )
