from math import pi, radians

import jsbsim
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.rotation import norm, rotate
from atlas_cueing.vehicles import AircraftFlight, InitialConditions, JsbsimVehicle, TimedInput
from atlas_cueing.vehicles.jsbsim.loading import load
from atlas_cueing.vehicles.jsbsim.readings import Readings
from atlas_cueing.vehicles.jsbsim.start import start_aircraft

from ..flying import body_from_north, cessna, fly


@pytest.fixture(scope="module")
def fdm() -> jsbsim.FGFDMExec:
    return load(cessna())


def placed(fdm: jsbsim.FGFDMExec, psi: float, theta: float, phi: float) -> None:
    fdm["ic/h-sl-ft"] = 5000.0
    fdm["ic/psi-true-rad"], fdm["ic/theta-rad"], fdm["ic/phi-rad"] = psi, theta, phi
    fdm.run_ic()


@pytest.mark.parametrize("distance", [1.0, 1e-2, 1e-4, 2e-6, 9e-7, 1e-7, 1e-8, 1e-9, 0.0])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_attitude_is_jsbsims_matrix_at_any_distance_from_vertical(
    distance: float, side: float, fdm: jsbsim.FGFDMExec
) -> None:
    rng = np.random.default_rng(7)
    for psi, phi in zip(rng.uniform(0.0, 2.0 * pi, 20), rng.uniform(-pi, pi, 20), strict=True):
        placed(fdm, psi, side * (0.5 * pi - distance), phi)
        q = Readings(fdm).state(0.0).q_NB
        attitude = Rotation.from_quat(q, scalar_first=True).as_matrix().T
        assert np.abs(attitude - body_from_north(fdm)).max() < 5e-8


def test_the_signs_of_attitude(fdm: jsbsim.FGFDMExec) -> None:
    placed(fdm, radians(90.0), 0.0, 0.0)  # heading east
    assert rotate(Readings(fdm).state(0.0).q_NB, (1.0, 0.0, 0.0)) == pytest.approx(
        (0.0, 1.0, 0.0), abs=1e-7
    )
    placed(fdm, 0.0, radians(30.0), 0.0)  # nose up: the nose points up, which is -z
    assert rotate(Readings(fdm).state(0.0).q_NB, (1.0, 0.0, 0.0)) == pytest.approx(
        (0.75**0.5, 0.0, -0.5), abs=1e-7
    )
    placed(fdm, 0.0, 0.0, radians(90.0))  # right wing down
    assert rotate(Readings(fdm).state(0.0).q_NB, (0.0, 1.0, 0.0)) == pytest.approx(
        (0.0, 0.0, 1.0), abs=1e-7
    )  # JSBSim's own rounding


def test_the_sign_of_the_quaternion_never_flips_through_rolls_and_headings() -> None:
    rolls = AircraftFlight(
        "f16",
        InitialConditions(4000.0, 220.0, heading=radians(359.5), trim=True),
        (TimedInput(0.0, "fcs/aileron-cmd-norm", 0.6, 0.5),),
    )
    states = fly(JsbsimVehicle(rolls), 10.0)
    q = np.array([state.q_NB for state in states])
    assert (np.sum(q[1:] * q[:-1], axis=1) > 0.999).all()
    assert np.sum([state.w_NB_B[0] for state in states]) / 120.0 > 4.0 * pi, "it did not roll twice"
    assert q[:, 0].min() < -0.9, "the quaternion did not go round: nothing was at stake"
    assert np.abs(np.linalg.norm(q, axis=1) - 1.0).max() < 1e-14


def test_rates_are_the_derivative_of_attitude_in_body_axes() -> None:
    states = fly(JsbsimVehicle(cessna(TimedInput(0.0, "fcs/aileron-cmd-norm", 0.5, 0.2))), 3.0)
    turned = Rotation.from_quat([state.q_NB for state in states], scalar_first=True)
    by_attitude = (turned[:-1].inv() * turned[1:]).as_rotvec() * 120.0
    rates = np.array([state.w_NB_B for state in states])
    assert np.abs(rates).max() > 0.3
    assert np.abs(by_attitude - rates[:-1]).max() < 5e-4


def test_height_is_in_metres_above_ground(fdm: jsbsim.FGFDMExec) -> None:
    placed(fdm, 0.0, 0.0, 0.0)
    assert Readings(fdm).height() == pytest.approx(1524.0, abs=0.01)


@pytest.mark.parametrize("latitude", [0.0, 30.0, -80.0])
def test_a_vehicle_at_rest_shows_standard_gravity_anywhere(latitude: float) -> None:
    parked = InitialConditions(
        0.0, 0.0, latitude=radians(latitude), engines_running=False, trim=True
    )
    fdm = load(cessna())
    start_aircraft(fdm, AircraftFlight("c172x", parked))
    for _ in range(600):
        fdm.run()
    local = norm(tuple(fdm[f"accelerations/a-pilot-{axis}-ft_sec2"] for axis in "xyz")) * 0.3048
    assert abs(local - 9.80665) > 1e-3, "local gravity is standard here: nothing is tested"
    assert norm(Readings(fdm).state(0.0).f_B) == pytest.approx(9.80665, abs=1e-3)
