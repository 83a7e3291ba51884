"""Files that others write, each by a writer or a format of theirs, against the vehicle in them."""

from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.flight_data import ImportedFlights, import_flight, load_map

from .recorders import dataflash, dataflash_text, ros_bag, ulog
from .test_import_flight import worst
from .truth import truth

FLOWN = truth(np.arange(500) / 100.0)


def errors(found: ImportedFlights) -> float:
    (flight,) = found.flights
    assert flight.step == 0.01
    assert flight.attitude == "measured"
    return max(worst(flight).values())


@pytest.mark.parametrize("storage", ["MCAP", "SQLITE3"])
def test_ros_imu(tmp_path: Path, storage: str) -> None:
    """As a folder, and as the one file in it."""
    bag = ros_bag(tmp_path / "bag", FLOWN, storage)
    found = import_flight(bag, load_map("ros-imu"))
    assert found.flights[0].exact
    assert errors(found) < 1e-6
    (file,) = [path for path in bag.iterdir() if path.suffix in (".mcap", ".db3")]
    assert errors(import_flight(file, load_map("ros-imu"))) < 1e-6


@pytest.mark.parametrize("storage", ["MCAP", "SQLITE3"])
def test_ros_odometry_gives_the_attitude(tmp_path: Path, storage: str) -> None:
    bag = ros_bag(tmp_path / "bag", FLOWN, storage, odometry=True, oriented=False)
    found = import_flight(bag, load_map("ros-imu-odometry", ["force.table=/imu/data"]))
    (flight,) = found.flights
    assert flight.attitude == "measured"
    assert worst(flight)["force"] < 1e-6
    assert worst(flight)["attitude"] < 1e-4, "at 50 Hz, content of 1 Hz"


def test_ros_imu_without_orientation_is_filtered_and_marked(tmp_path: Path) -> None:
    bag = ros_bag(tmp_path / "bag", FLOWN, "MCAP", oriented=False)
    found = import_flight(bag, load_map("ros-imu"))
    assert found.flights[0].attitude.startswith("complementary filter")
    assert found.notes == ("attitude: not in the file",)
    assert worst(found.flights[0])["force"] < 1e-6


def test_the_recorders_time(tmp_path: Path) -> None:
    bag = ros_bag(tmp_path / "bag", FLOWN, "MCAP")
    found = import_flight(bag, load_map("ros-imu", ["time.column=received"]))
    assert errors(found) < 1e-6


def test_ulog(tmp_path: Path) -> None:
    found = import_flight(ulog(tmp_path / "a.ulg", FLOWN), load_map("px4"))
    assert found.flights[0].exact
    assert errors(found) < 1e-6


def test_a_ulog_that_its_own_library_has_written_again(tmp_path: Path) -> None:
    from pyulog import ULog

    ULog(str(ulog(tmp_path / "a.ulg", FLOWN))).write_ulog(str(tmp_path / "b.ulg"))
    assert errors(import_flight(tmp_path / "b.ulg", load_map("px4"))) < 1e-6


def test_dataflash(tmp_path: Path) -> None:
    found = import_flight(dataflash(tmp_path / "a.bin", FLOWN), load_map("ardupilot"))
    assert found.flights[0].exact
    assert errors(found) < 1e-6
    found = import_flight(dataflash_text(tmp_path / "a.log", FLOWN), load_map("ardupilot"))
    assert errors(found) < 1e-6


def test_one_of_several_sensors(tmp_path: Path) -> None:
    log = dataflash(tmp_path / "a.bin", FLOWN, sensors=(0, 1))
    assert errors(import_flight(log, load_map("ardupilot"))) < 1e-6
    second = import_flight(log, load_map("ardupilot", ["force.instance=1"]))
    assert np.abs(second.flights[0].f_B - FLOWN.f_B - 1.0).max() < 1e-6
    with pytest.raises(InputError, match="no message 'IMU' of instance 2"):
        import_flight(log, load_map("ardupilot", ["force.instance=2"]))


@pytest.mark.parametrize(
    ("name", "map_name"),
    [
        ("a.ulg", "px4"),
        ("a.bin", "ardupilot"),
        ("a.log", "ardupilot"),
        ("a.mcap", "ros-imu"),
        ("a.db3", "ros-imu"),
        ("a.csv", "csv"),
    ],
)
@pytest.mark.parametrize("content", ["empty", "noise", "text", "cut"])
def test_damaged_files_are_refused_by_name(
    tmp_path: Path, name: str, map_name: str, content: str
) -> None:
    whole = {
        "a.ulg": lambda: ulog(tmp_path / "w", FLOWN),
        "a.bin": lambda: dataflash(tmp_path / "w", FLOWN),
        "a.log": lambda: dataflash_text(tmp_path / "w", FLOWN),
        "a.mcap": lambda: next((ros_bag(tmp_path / "b", FLOWN, "MCAP")).glob("*.mcap")),
        "a.db3": lambda: next((ros_bag(tmp_path / "b", FLOWN, "SQLITE3")).glob("*.db3")),
        "a.csv": lambda: tmp_path / "none",
    }
    data = {
        "empty": b"",
        "noise": np.random.default_rng(4).bytes(5000),
        "text": b"hello, world\n1, 2\n",
    }.get(content)
    if data is None:
        if name == "a.csv":
            return
        data = whole[name]().read_bytes()[:300]
    (tmp_path / name).write_bytes(data)
    with pytest.raises(InputError, match=rf"{name}: ") as caught:
        import_flight(tmp_path / name, load_map(map_name))
    assert "\n" not in str(caught.value)


def test_a_damaged_dataflash_log_is_read_as_far_as_it_goes_and_says_so(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    whole = dataflash(tmp_path / "a.bin", FLOWN).read_bytes()
    begin = whole.index(b"\xa3\x95", len(whole) // 2)
    (tmp_path / "a.bin").write_bytes(whole[: begin + 2] + b"\xc2" + whole[begin + 3 :])
    found = import_flight(tmp_path / "a.bin", load_map("ardupilot"))
    told = f"the file is damaged, unknown msg type 0xc2 (194) at {begin}; what comes after it"
    assert found.notes[0].startswith(told)
    assert 0.4 < found.flights[0].time[-1] / FLOWN.time[-1] < 0.6
    (tmp_path / "a.bin").write_bytes(whole[: begin + 1] + b"?" + whole[begin + 2 :])
    found = import_flight(tmp_path / "a.bin", load_map("ardupilot"))
    assert "the file is damaged, bad header 0xa33f" in found.notes[0]
    assert "left out" not in found.notes[0]
    assert found.flights[0].time[-1] > 0.98 * FLOWN.time[-1]
    assert capfd.readouterr() == ("", "")


def test_what_is_not_in_the_file_is_named_with_what_is(tmp_path: Path) -> None:
    bag = ros_bag(tmp_path / "bag", FLOWN, "MCAP")
    for settings, told in (
        (
            ["force.table=/imu"],
            r"no topic or type '/imu' .*topics: /imu/data \(sensor_msgs/msg/Imu",
        ),
        (["force.columns=['a.x', 'a.y', 'a.z']"], r"has no 'a\.x' \(force\.columns of the map\)"),
    ):
        with pytest.raises(InputError, match=told):
            import_flight(bag, load_map("ros-imu", settings))
    log = ulog(tmp_path / "a.ulg", FLOWN)
    with pytest.raises(
        InputError, match=r"no message 'gyro' of instance 0 .*sensor_combined \(0\)"
    ):
        import_flight(log, load_map("px4", ["rate.table=gyro"]))
    with pytest.raises(InputError, match=r"no column 'x' or 'y' \(force\.columns"):
        import_flight(log, load_map("px4", ["force.columns=[['x', 'y'], 'a', 'b']"]))
