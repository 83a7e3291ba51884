"""Rides whose forces are known: circles, loops, turns, hills, straight lines."""

import numpy as np
import pytest

from atlas_cueing.errors import InputError, VehicleError
from atlas_cueing.rotations import geodesic, length, rotate
from atlas_cueing.vehicles import Car, TrackFlight, TrackVehicle
from atlas_cueing.vehicles.track import whole_ride
from atlas_cueing.vehicles.track_ride import Ride

G = 9.80665
FLU = np.array([1.0, -1.0, -1.0])


def points(*columns: np.ndarray) -> tuple[tuple[float, float, float], ...]:
    return tuple((float(x), float(y), float(z)) for x, y, z in zip(*columns, strict=True))


def circle(radius: float, count: int, vertical: bool) -> tuple[tuple[float, float, float], ...]:
    """A circle from its bottom, or level to the left, through so many points."""
    angle = 2 * np.pi * np.arange(count) / count
    across, along = radius * (1.0 - np.cos(angle)), radius * np.sin(angle)
    zero = np.zeros(count)
    return points(along, zero, across) if vertical else points(along, across, zero)


def to_the_end(vehicle: TrackVehicle) -> None:
    while vehicle.advance():
        pass


def loop(flight: TrackFlight) -> Ride:
    return whole_ride(flight)


def test_the_bottom_and_the_top_of_a_circle() -> None:
    """v^2 / r + g below, v^2 / r - g above, and the rider's head inwards all around."""
    r, v = 10.0, 25.0
    for bank in (None, (0.0,) * 72):
        ride = loop(TrackFlight(circle(r, 72, True), Car(v), bank, True, 2, 500.0))
        height = r * (1.0 - np.cos(angle_of(ride, r)))
        square = v * v - 2.0 * G * height
        assert ride.f_B[0] == pytest.approx([0.0, 0.0, -(v * v / r + G)], abs=1e-5)
        expected = -(square / r + G * np.cos(angle_of(ride, r)))
        assert np.abs(ride.f_B[:, 2] - expected).max() < 1e-4
        assert np.abs(ride.f_B[:, :2]).max() < 1e-4, "without friction nothing pushes along"
        assert ride.f_B[:, 2].max() < 0.0, "never out of the seat"
        top = int(np.argmax(height))
        down = rotate(ride.q_NB[top : top + 1], np.array([[0.0, 0.0, 1.0]]))[0]
        assert down[2] < -0.999, "head down at the top"
        assert np.abs(ride.w_B[:, 1] - np.sqrt(square) / r).max() < 1e-4


def angle_of(ride: Ride, r: float) -> np.ndarray:
    """The angle around a circle, by the distance, the points' chords being shorter than the arc."""
    chord = 2.0 * r * np.sin(np.pi / 72)
    return ride.distance / chord * (2.0 * np.pi / 72)


def test_energy_is_kept_to_the_last_digits() -> None:
    """v^2 / 2 + g h of a car without friction, heights by the forces alone."""
    ride = loop(TrackFlight(circle(10.0, 72, True), Car(25.0), None, True, 20, 500.0))
    bottoms = [int(np.argmin(np.abs(angle_of(ride, 10.0) - 2 * np.pi * k))) for k in range(20)]
    energy = 0.5 * ride.speed**2 + G * 10.0 * (1.0 - np.cos(angle_of(ride, 10.0)))
    assert np.abs(energy / energy[0] - 1.0).max() < 1e-6
    assert np.abs(energy[bottoms] / energy[0] - 1.0).max() < 1e-9


@pytest.mark.parametrize("vertical", [True, False])
def test_it_goes_where_its_forces_lead(vertical: bool) -> None:
    """The specific force, turned into space and integrated twice, leads back to the start."""
    track = circle(10.0, 72, True) if vertical else closed_hills()
    ride = loop(TrackFlight(track, Car(25.0), None, True, 1, 1000.0))
    a_N = rotate(ride.q_NB, ride.f_B) + np.array([0.0, 0.0, G])
    dt = 1e-3
    v0 = rotate(ride.q_NB[:1], np.array([[25.0, 0.0, 0.0]]))[0]
    v_N = v0 + dt * np.cumsum(np.vstack([np.zeros(3), 0.5 * (a_N[1:] + a_N[:-1])]), axis=0)
    assert np.abs(length(v_N) - ride.speed).max() < 1e-3
    p_N = dt * np.cumsum(0.5 * (v_N[1:] + v_N[:-1]), axis=0)
    assert np.linalg.norm(p_N[-1]) < 0.05  # less than the last step
    forward = rotate(ride.q_NB, np.tile([1.0, 0.0, 0.0], (len(v_N), 1)))
    assert np.abs(forward - v_N / length(v_N)[:, None]).max() < 1e-3


def closed_hills() -> tuple[tuple[float, float, float], ...]:
    angle = 2 * np.pi * np.arange(60) / 60
    height = 3.0 * (1.0 - np.cos(3 * angle))
    return points(60.0 * np.sin(angle), 40.0 * (1.0 - np.cos(angle)), height)


def test_rates_are_those_of_the_attitude() -> None:
    ride = loop(TrackFlight(closed_hills(), Car(20.0), None, True, 1, 1000.0))
    turned = geodesic(ride.q_NB[:-1], ride.q_NB[1:]) * 1000.0
    told = length(0.5 * (ride.w_B[1:] + ride.w_B[:-1]))
    assert np.abs(turned - told).max() < 1e-4


def test_a_level_turn_banks_until_no_side_force_is_left() -> None:
    r, v = 50.0, 20.0
    ride = loop(TrackFlight(circle(r, 72, False), Car(v), None, True, 1, 100.0))
    whole = float(np.hypot(v * v / r, G))
    assert np.abs(ride.f_B - np.array([0.0, 0.0, -whole])).max() < 1e-4
    right = rotate(ride.q_NB, np.tile([0.0, 1.0, 0.0], (len(ride.time), 1)))
    bank = np.degrees(np.arcsin(-right[:, 2]))  # to the left: the right side is up
    assert np.abs(bank - np.degrees(np.arctan2(v * v / r, G))).max() < 1e-4
    flat = loop(TrackFlight(circle(r, 72, False), Car(v), (0.0,) * 72, True, 1, 100.0))
    assert np.abs(flat.f_B - np.array([0.0, -v * v / r, -G])).max() < 1e-4
    given = (-0.2,) * 72
    banked = loop(TrackFlight(circle(r, 72, False), Car(v), given, True, 1, 100.0))
    assert banked.f_B[5][1] == pytest.approx(-np.cos(0.2) * v * v / r + np.sin(0.2) * G, abs=1e-4)


def test_over_a_hill_the_rider_stays_upright() -> None:
    """Weightless and beyond: the bank is bridged, nobody turns over."""
    x = np.linspace(0.0, 120.0, 61)
    ride = loop(TrackFlight(points(x, 0 * x, 12.0 * np.exp(-(((x - 60) / 12) ** 2))), Car(24.0)))
    assert ride.f_B[:, 2].max() > 3.0, "out of the seat"
    down = rotate(ride.q_NB, np.tile([0.0, 0.0, 1.0], (len(ride.time), 1)))
    assert down[:, 2].min() > 0.5
    assert np.abs(ride.f_B[:, 1]).max() < 1e-6


def test_friction_drag_and_the_end() -> None:
    x = np.linspace(0.0, 200.0, 41)
    straight = points(x, 0 * x, 0 * x)
    ride = loop(TrackFlight(straight, Car(30.0, friction=0.1)))
    assert np.abs(ride.speed - (30.0 - 0.1 * G * ride.time)).max() < 1e-6
    assert np.abs(ride.f_B - np.array([-0.1 * G, 0.0, -G])).max() < 1e-6
    ride = loop(TrackFlight(straight, Car(30.0, drag=0.01)))
    assert np.abs(ride.speed - 30.0 / (1.0 + 0.3 * ride.time)).max() < 1e-5
    vehicle = TrackFlight(straight, Car(10.0, friction=0.1)).vehicle()
    with pytest.raises(VehicleError, match=r"comes to a stop 5\d\.\d m along the track; give it"):
        to_the_end(vehicle)
    assert vehicle.state.time == pytest.approx(10.0 / (0.1 * G), abs=0.5)
    vehicle = TrackFlight(straight, Car(30.0)).vehicle()
    to_the_end(vehicle)
    assert vehicle.state.time == pytest.approx(200.0 / 30.0, abs=0.01)


def test_a_lift_pulls_the_car_up() -> None:
    x = np.linspace(0.0, 100.0, 51)
    ride = loop(TrackFlight(points(x, 0 * x, 0.5 * x), Car(10.0, lift_speed=3.0)))
    slope = np.arctan(0.5)
    late = ride.time > 0.5 * ride.time[-1]
    assert np.abs(ride.speed[late] - 3.0).max() < 1e-9
    expected = np.array([G * np.sin(slope), 0.0, -G * np.cos(slope)])
    assert np.abs(ride.f_B[late] - expected).max() < 1e-6


def test_a_head_off_the_track() -> None:
    """Inside a circle it goes round on a smaller one."""
    r, v, h = 20.0, 22.0, 1.2
    ride = loop(TrackFlight(circle(r, 72, True), Car(v, head=(0.0, 0.0, -h)), None, True))
    assert ride.f_B[0][2] == pytest.approx(-(v * v / r**2 * (r - h) + G), abs=1e-3)


@pytest.mark.parametrize(
    ("flight", "message"),
    [
        (TrackFlight(circle(9.0, 5, True), Car(9.0)), "5 points, allowed: at least 6"),
        (TrackFlight(circle(9.0, 9, True), Car(9.0), (0.0,)), "1 banks for 9 points"),
        (TrackFlight(circle(9.0, 9, True) + circle(9.0, 9, True), Car(9.0)), ""),
        (TrackFlight(circle(9.0, 9, True)[:1] * 9, Car(9.0)), "points 0 and 1 are the same"),
        (TrackFlight(circle(9.0, 900, True), Car(9.0), None, True, 1000), "points in all laps"),
    ],
)
def test_what_is_no_track(flight: TrackFlight, message: str) -> None:
    if not message:
        assert flight.vehicle() is not None
        return
    with pytest.raises(InputError, match=f"track: .*{message}"):
        flight.vehicle()


def test_too_much_for_a_rider() -> None:
    with pytest.raises(VehicleError, match="specific force"):
        TrackFlight(circle(1.0, 72, False), Car(50.0), None, True).vehicle()
