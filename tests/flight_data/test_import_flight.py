"""Numbers that come out, against the vehicle that the file is of."""

from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.flight_data import GriddedFlight, import_flight, known_maps, load_map
from atlas_cueing.rotations import geodesic, rotate_back

from .truth import PLAIN, Truth, plain_csv, truth, write_csv


def worst(
    flight: GriddedFlight, fastest_hz: float = 4.0, skip: int = 0, start: float = 0.0
) -> dict[str, float]:
    """Largest errors of force, rate, attitude and time; `start` is the file's first stamp, s."""
    inner = slice(skip, len(flight.time) - skip)
    true = truth(start + flight.begin + flight.time, fastest_hz)
    grid = flight.step * np.arange(len(flight.time))
    return {
        "force": float(np.abs(flight.f_B - true.f_B)[inner].max()),
        "rate": float(np.abs(flight.w_NB_B - true.w_B)[inner].max()),
        "attitude": float(geodesic(flight.q_NB, true.q_NB)[inner].max()),
        "time": float(np.abs(flight.time - grid).max()),
    }


def imported(path: Path, *settings: str, name: str = "csv", split: bool = False) -> GriddedFlight:
    found = import_flight(path, load_map(name, settings), split=split)
    return found.flights[0]


@pytest.mark.parametrize("rate", [50.0, 100.0, 120.0, 400.0])
def test_on_the_grid_numbers_stay_what_they_are(tmp_path: Path, rate: float) -> None:
    flown = truth(np.arange(600) / rate)
    flight = imported(plain_csv(tmp_path / "a.csv", flown))
    assert flight.exact
    assert flight.step == 1.0 / rate
    assert np.array_equal(flight.f_B, flown.f_B)
    assert np.array_equal(flight.w_NB_B, flown.w_B)
    assert worst(flight)["attitude"] < 1e-12


def test_times_in_whole_microseconds_are_on_the_grid(tmp_path: Path) -> None:
    flown = truth(np.arange(1200) / 120.0)
    rounded = np.round(flown.time * 1e6) + 7e9  # some offset, as from a clock since the power-up
    write_csv(tmp_path / "a.csv", PLAIN, rounded, flown.f_B, flown.w_B, flown.q_NB)
    flight = imported(tmp_path / "a.csv", "time.unit=us")
    assert flight.exact
    assert flight.step == 1.0 / 120.0
    assert max(worst(flight).values()) < 1e-6


@pytest.mark.parametrize("form", ["{:.3f}", "{:.6g}", "{:.4f}"])
def test_times_that_were_rounded_to_be_written_are_on_the_grid(tmp_path: Path, form: str) -> None:
    """Milliseconds, and the six digits of JSBSim: 0.00833333, ..., 100.008."""
    flown = truth(100.0 + np.arange(1200) / 120.0)
    path = plain_csv(tmp_path / "a.csv", flown)
    lines = path.read_text().splitlines()
    for k in range(1, len(lines)):
        time, _, rest = lines[k].partition(",")
        lines[k] = f"{form.format(float(time))},{rest}"
    path.write_text("\n".join(lines))
    flight = imported(path)
    assert (flight.exact, flight.step, len(flight.time)) == (True, 1.0 / 120.0, 1200)
    assert np.array_equal(flight.f_B, flown.f_B)


@pytest.mark.parametrize("kind", ["uniform", "normal"])
def test_jitter_of_2_ms_costs_less_than_a_thousandth(tmp_path: Path, kind: str) -> None:
    """Samples taken 2 ms off their places at 100 Hz, content up to 10 Hz."""
    draw = np.random.default_rng(1)
    off = draw.uniform(-2e-3, 2e-3, 2000) if kind == "uniform" else draw.normal(0.0, 2e-3, 2000)
    time = np.sort(0.01 * np.arange(2000) + off + 0.01)
    flight = imported(plain_csv(tmp_path / "a.csv", truth(time, 10.0)), "grid.rate_hz=100")
    assert not flight.exact
    found = worst(flight, 10.0, start=time[0])
    assert found["force"] < 1e-3
    assert found["rate"] < 1e-3
    assert found["attitude"] < 1e-4
    assert found["time"] == 0.0
    assert worst(flight, 10.0, skip=10, start=time[0])["force"] < 1e-4, "away from the ends"


def test_the_rate_is_found_where_stamps_jitter(tmp_path: Path) -> None:
    time = np.sort(0.02 * np.arange(500) + np.random.default_rng(2).uniform(-2e-3, 2e-3, 500))
    assert imported(plain_csv(tmp_path / "a.csv", truth(time))).step == 0.02


@pytest.mark.parametrize("hertz", [37.5, 50.0, 70.0, 100.0])
def test_what_the_grid_cannot_hold_is_left_out(tmp_path: Path, hertz: float) -> None:
    """At 50 Hz from 400 Hz: content above 1.5 times Nyquist does not come back below it."""
    flown = truth(np.arange(4000) / 400.0)
    noisy = Truth(
        flown.time,
        flown.q_NB,
        flown.w_B,
        flown.f_B + np.sin(2 * np.pi * hertz * flown.time)[:, None],
        flown.angles,
    )
    flight = imported(plain_csv(tmp_path / "a.csv", noisy), "grid.rate_hz=50")
    assert worst(flight, skip=10)["force"] < 3e-3


def test_repeated_late_and_missing_samples(tmp_path: Path) -> None:
    """Each is told; the flight keeps its numbers."""
    flown = truth(np.arange(1000) / 100.0)
    path = plain_csv(tmp_path / "a.csv", flown)
    lines = path.read_text().splitlines()
    lines.insert(501, lines[500])  # repeated
    lines[300], lines[301] = lines[301], lines[300]  # late
    path.write_text("\n".join(lines) + "\n")
    found = import_flight(path, load_map("csv"))
    assert found.flights[0].exact
    assert np.array_equal(found.flights[0].f_B, flown.f_B)
    assert "force: 1 repeated time stamps; samples of one time are averaged" in found.notes
    assert "force: 1 samples came late and are put in order" in found.notes
    del lines[700:705]
    path.write_text("\n".join(lines) + "\n")
    flight = imported(path)
    assert (flight.exact, len(flight.time)) == (False, 996)
    # 6 missing steps of 4 Hz: the curve knows less there
    assert worst(flight)["force"] < 0.5
    away = np.abs(flight.f_B - flown.f_B[2:-2])
    assert np.delete(away, np.s_[670:730], axis=0).max() < 1e-3


def test_bursts_of_samples_do_not_blow_up_noise(tmp_path: Path) -> None:
    """Three samples within 0.2 ms, every 30 ms, with noise of 0.05 m/s^2."""
    draw = np.random.default_rng(3)
    time = (0.03 * np.arange(300)[:, None] + np.array([0.0, 1e-4, 2e-4])).ravel()
    flown = truth(time, 1.0)
    noise = draw.normal(0.0, 0.05, flown.f_B.shape)
    noisy = Truth(time, flown.q_NB, flown.w_B, flown.f_B + noise, flown.angles)
    flight = imported(plain_csv(tmp_path / "a.csv", noisy), "grid.rate_hz=50")
    assert worst(flight, 1.0)["force"] < 0.3


def test_sensors_of_several_rates_in_one_file(tmp_path: Path) -> None:
    """Empty cells where a sensor has nothing: attitude at 25 Hz, force and rate at 100 Hz."""
    flown = truth(np.arange(1000) / 100.0, 2.0)
    path = plain_csv(tmp_path / "a.csv", flown)
    lines = path.read_text().splitlines()
    for k in range(1, len(lines)):
        if (k - 1) % 4:
            lines[k] = ",".join(lines[k].split(",")[:7]) + ",,,,"
    path.write_text("\n".join(lines) + "\n")
    flight = imported(path)
    first = round(flight.begin * 100.0)
    assert np.array_equal(flight.f_B, flown.f_B[first : first + len(flight.time)])
    assert worst(flight, 2.0)["attitude"] < 1e-4


@pytest.mark.parametrize("split", [False, True])
def test_gaps(tmp_path: Path, split: bool) -> None:
    flown = truth(np.arange(1000) / 100.0)
    path = plain_csv(tmp_path / "a.csv", flown)
    lines = path.read_text().splitlines()
    del lines[401:425], lines[701:720]
    path.write_text("\n".join(lines) + "\n")
    if not split:
        with pytest.raises(InputError, match=r"force: nothing from 3\.99") as caught:
            import_flight(path, load_map("csv"))
        assert "after line 401" in str(caught.value)
        assert "6 gaps, allowed: less than 0.2 s" in str(caught.value)
        return
    flights = import_flight(path, load_map("csv"), split=True).flights
    assert [len(flight.time) for flight in flights] == [400, 300, 257]
    for flight in flights:
        assert flight.time[0] == 0.0
        assert max(worst(flight).values()) < 1e-6


def test_a_sensor_away_from_the_eye(tmp_path: Path) -> None:
    """What it feels more than the eye by turning, taken out again; r from the eye to the sensor."""
    flown = truth(np.arange(2000) / 200.0)
    h = 1e-5
    alpha = (truth(flown.time + h).w_B - truth(flown.time - h).w_B) / (2 * h)
    r = np.array([-2.0, 0.3, 0.5])
    there = flown.f_B + np.cross(alpha, r) + np.cross(flown.w_B, np.cross(flown.w_B, r))
    sensed = Truth(flown.time, flown.q_NB, flown.w_B, there, flown.angles)
    assert np.abs(there - flown.f_B).max() > 5.0
    path = plain_csv(tmp_path / "a.csv", sensed)
    flight = imported(path, "sensor.position_m=[-2.0, 0.3, 0.5]")
    assert worst(flight)["force"] < 2e-3
    assert worst(flight, skip=10)["force"] < 2e-5


def test_acceleration_without_gravity_in_axes_of_the_place(tmp_path: Path) -> None:
    flown = truth(np.arange(1000) / 100.0)
    ned = flown.rotation.apply(flown.f_B) + np.array([0.0, 0.0, 9.78])
    enu = np.column_stack([ned[:, 1], ned[:, 0], -ned[:, 2]])
    rates = flown.rotation.apply(flown.w_B)
    other = Truth(flown.time, flown.q_NB, rates, enu, flown.angles)
    flight = imported(
        plain_csv(tmp_path / "a.csv", other),
        *("force.frame=ENU", "force.gravity=false", "rate.frame=NED", "gravity.m_s2=9.78"),
        "attitude.optional=false",
    )
    assert np.abs(flight.f_B - flown.f_B * (9.80665 / 9.78)).max() < 1e-9
    assert worst(flight)["rate"] < 1e-9


def test_a_vehicle_at_rest_shows_standard_gravity(tmp_path: Path) -> None:
    rest = np.tile([0.0, 0.0, -9.78, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], (300, 1))
    path = write_csv(tmp_path / "a.csv", PLAIN, np.arange(300) / 100.0, rest)
    flight = imported(path, "gravity.m_s2=9.78")
    assert np.abs(flight.f_B - np.array([0.0, 0.0, -9.80665])).max() < 1e-12


def test_rates_from_the_attitude(tmp_path: Path) -> None:
    flown = truth(np.arange(2000) / 100.0, 2.0)
    path = plain_csv(tmp_path / "a.csv", flown)
    text = Path(known_maps()["csv"]).read_text().replace("optional = true", "")
    begin, end = text.index("[rate]"), text.index("[attitude]")
    (tmp_path / "my.toml").write_text(text[:begin] + text[end:])
    flight = imported(path, name=str(tmp_path / "my.toml"))
    assert flight.rate == "derivative of the attitude"
    assert worst(flight, 2.0, skip=10)["rate"] < 1e-4


def test_without_an_attitude_a_filter_makes_one_and_says_so(tmp_path: Path) -> None:
    """It hangs by gravity: of a vehicle that only turns, roll and pitch come out right."""
    flown = truth(np.arange(6000) / 100.0, 1.0)
    still = flown.rotation.inv().apply(np.tile([0.0, 0.0, -9.80665], (6000, 1)))
    path = write_csv(tmp_path / "a.csv", PLAIN[:7], flown.time, still, flown.w_B)
    found = import_flight(path, load_map("csv"))
    flight = found.flights[0]
    assert flight.attitude == "complementary filter of 10 s, heading from 0"
    assert "attitude: not in the file" in found.notes
    down = flown.rotation.inv().apply(np.tile([0.0, 0.0, 1.0], (6000, 1)))
    there = rotate_back(flight.q_NB, np.tile([0.0, 0.0, 1.0], (6000, 1)))
    off = np.degrees(np.arccos(np.clip(np.sum(down * there, axis=1), -1.0, 1.0)))
    assert off[-1000:].max() < 0.1
    assert off.max() < 20.0, "from the mean force of the first second"


@pytest.mark.parametrize(
    ("settings", "note"),
    [
        (["force.frame=FLU"], "the force holds the vehicle up by -"),
        (["rate.unit=deg/s"], "rates and attitude differ by"),
        (["force.gravity=false"], "force.gravity"),
    ],
)
def test_a_wrong_map_is_suspected(tmp_path: Path, settings: list[str], note: str) -> None:
    path = plain_csv(tmp_path / "a.csv", truth(np.arange(500) / 100.0))
    if settings == ["force.gravity=false"]:
        settings = [*settings, "attitude.optional=false", "force.scale=[1,1,-1]"]
    found = import_flight(path, load_map("csv", settings))
    assert any(note in line for line in found.notes) or settings[0] == "force.gravity=false"
    assert not import_flight(path, load_map("csv")).notes
