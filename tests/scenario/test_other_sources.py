"""Vehicles that no JSBSim flies: FlightGear, packets, recordings, bodies and tracks."""

from pathlib import Path

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import RecordedFlight, load_scenario
from atlas_cueing.vehicles import (
    Car,
    FlightgearFlight,
    RigidBodyFlight,
    TrackFlight,
)

from .conftest import Refused
from .flights import FLIGHTGEAR, RECORDING, RIGID_BODY, TRACK
from .texts import AIRCRAFT, SCRIPT, SIGNALS


def test_flightgear_and_its_defaults(tmp_path: Path) -> None:
    path = tmp_path / "s.toml"
    path.write_text(FLIGHTGEAR)
    assert load_scenario(path).live_flight == FlightgearFlight("127.0.0.1", 5501, 120.0)
    settings = ("vehicle.host=127.0.0.2", "vehicle.port=6000", "vehicle.rate_hz=60")
    assert load_scenario(path, settings).live_flight == FlightgearFlight("127.0.0.2", 6000, 60.0)


def test_a_recording_lies_beside_the_scenario(tmp_path: Path) -> None:
    """Whether it is there is seen when it is played.

    The scenario inside a log must load without it.
    """
    path = tmp_path / "s.toml"
    path.write_text(RECORDING)
    assert load_scenario(path).live_flight == RecordedFlight(tmp_path / "logs/flown.mcap")


def test_what_flies_in_batch_runs_flies_live_too(tmp_path: Path) -> None:
    for text in (SCRIPT, AIRCRAFT, SIGNALS):
        (tmp_path / "s.toml").write_text(text)
        scenario = load_scenario(tmp_path / "s.toml")
        assert scenario.live_flight == scenario.flight


def test_what_flies_only_live_is_refused_by_a_batch_run(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(FLIGHTGEAR)
    scenario = load_scenario(tmp_path / "s.toml")
    with pytest.raises(
        InputError, match=r"^source = '\w+' flies only live: atlas-cueing live FILE"
    ):
        run_scenario(scenario, tmp_path / "log.mcap")
    assert [path.name for path in tmp_path.iterdir()] == ["s.toml"]


@pytest.mark.parametrize("text", [FLIGHTGEAR, RECORDING], ids=["flightgear", "recording"])
def test_what_flies_live_goes_into_its_log(tmp_path: Path, text: str) -> None:
    (tmp_path / "s.toml").write_text(text)
    scenario = load_scenario(tmp_path / "s.toml")
    for name, content in scenario.attachments().items():
        (tmp_path / name).write_bytes(content)
    kept = load_scenario(tmp_path / "scenario.toml").live_flight
    if isinstance(kept, RecordedFlight):  # beside the scenario, by its name alone
        assert kept == RecordedFlight(tmp_path / "flown.mcap")
        assert kept.large_files().keys() == scenario.live_flight.large_files().keys()
    else:
        assert kept == scenario.live_flight


@pytest.mark.parametrize(
    "host", ['"0.0.0.0"', '"192.168.1.2"', '"::1"', '"localhost"', '""', "1", "nan", "[]"]
)
def test_packets_of_other_machines_are_no_matter_of_the_scenario(
    refused: Refused, host: str
) -> None:
    (told,) = refused(FLIGHTGEAR, f"vehicle.host={host}")
    assert told.endswith(
        "allowed: '127.0.0.1' or another loopback address; for packets of other machines: live"
        " --listen"
    )


@pytest.mark.parametrize(
    ("text", "mistakes"),
    [
        (
            FLIGHTGEAR.replace("[platform]", "port = 0\n[platform]"),
            ["port = 0: allowed: a whole number, 1 <= value <= 65535"],
        ),
        (
            FLIGHTGEAR.replace("[platform]", "port = 5.5\n[platform]"),
            ["port = 5.5: allowed: a whole number"],
        ),
        (
            FLIGHTGEAR.replace("[platform]", "rate_hz = 1\n[platform]"),
            ["rate_hz = 1: allowed: a number, 10 <= value <= 1000"],
        ),
        (
            FLIGHTGEAR.replace("[platform]", 'log = "x"\n[platform]'),
            ["log: not with source = 'flightgear'"],
        ),
        (
            FLIGHTGEAR.replace("[platform]", 'script = "c1722"\n[platform]'),
            ["script: not with source = 'flightgear'"],
        ),
        (
            RECORDING.replace('log = "logs/flown.mcap"', ""),
            ["log: missing, the log that is played"],
        ),
        (RECORDING.replace('"logs/flown.mcap"', '""'), ["log = '': allowed: path of a log"]),
        (
            RECORDING.replace("flown.mcap", "scenario.toml"),
            ["log = 'logs/scenario.toml': allowed: path of a log"],
        ),
        (RECORDING.replace('"logs/flown.mcap"', "1"), ["log = 1: allowed: path of a log"]),
        (
            RECORDING.replace("[platform]", "rate_hz = 50\nport = 5\n[platform]"),
            ["rate_hz: not with", "port: not with"],
        ),
        (SCRIPT.replace('"c1722"', '"c1722"\nport = 5'), ["port: not with source = 'jsbsim'"]),
        (SCRIPT.replace('"c1722"', '"c1722"\nlog = "x"'), ["log: only with source = 'recording'"]),
    ],
)
def test_keys_of_sources_that_fly_live(refused: Refused, text: str, mistakes: list[str]) -> None:
    told = refused(text)
    assert len(told) == len(mistakes)
    for line, mistake in zip(told, mistakes, strict=True):
        assert line.startswith(f"bad.toml: vehicle.{mistake}")


def test_a_body_and_a_track_in_si(tmp_path: Path) -> None:
    (tmp_path / "b.toml").write_text(
        RIGID_BODY.replace(
            "[platform]", "seat_m = [1, 0, 0]\nattitude_deg = [0, 0, 90]\n[platform]"
        )
    )
    body = load_scenario(tmp_path / "b.toml", ["vehicle.free_fall=false"]).flight
    assert isinstance(body, RigidBodyFlight)
    assert (body.seat, body.free_fall, body.rate_hz) == ((1.0, 0.0, 0.0), False, 120.0)
    assert body.w_B[1] == pytest.approx(0.6981317)
    assert body.q_NB == pytest.approx((0.5**0.5, 0.0, 0.0, 0.5**0.5))
    (tmp_path / "t.toml").write_text(
        TRACK.replace("speed_m_s", "bank_deg = [0, 0, 0, 0, 0, 0, 90]\nspeed_m_s")
    )
    track = load_scenario(tmp_path / "t.toml", ["vehicle.friction=0.01"]).flight
    assert isinstance(track, TrackFlight)
    assert track.car == Car(12.0, friction=0.01)
    assert track.bank is not None
    assert track.bank[-1] == pytest.approx(1.5707963)
    assert track.points[2] == (10.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ("text", "mistakes"),
    [
        (
            RIGID_BODY.replace("[3.0, 2.0, 1.2]", "[3.0, 1.0, 1.2]"),
            ["vehicle.inertia_kg_m2: the largest moment is 3 kg m^2, allowed: at most 2.2"],
        ),
        (
            RIGID_BODY.replace("[3.0, 2.0, 1.2]", "[3.0, 0, 1.2]"),
            ["vehicle.inertia_kg_m2.1 = 0: allowed: a number, 0 < value <= 1e+12"],
        ),
        (
            RIGID_BODY.replace("duration_s = 2.0", "").replace(
                "inertia_kg_m2 = [3.0, 2.0, 1.2]", ""
            ),
            ["vehicle.inertia_kg_m2: missing", "duration_s: missing, a free body tumbles for ever"],
        ),
        (TRACK.replace("speed_m_s = 12.0", ""), ["vehicle.speed_m_s: missing, or lift_speed_m_s"]),
        (TRACK.replace("speed_m_s", "laps = 2\nspeed_m_s"), ["vehicle.laps: only with closed"]),
        (TRACK.replace("[5, 0, 0]", "[5, 0]"), ["vehicle.points_m.1 = [5, 0]: allowed: a list of"]),
        (
            TRACK.replace("[5, 0, 0]", "[5, 0, nan]"),
            ["vehicle.points_m.1.2 = nan: allowed: a number"],
        ),
        (
            TRACK.replace("speed_m_s", "seat_m = [0, 0, 0]\nspeed_m_s"),
            ["vehicle.seat_m: not with source = 'track'"],
        ),
    ],
)
def test_keys_of_bodies_and_tracks(refused: Refused, text: str, mistakes: list[str]) -> None:
    told = refused(text)
    assert len(told) == len(mistakes)
    for line, mistake in zip(told, mistakes, strict=True):
        assert line.startswith(f"bad.toml: {mistake}")


def test_what_cannot_be_ridden_is_told_before_it_flies(tmp_path: Path) -> None:
    (tmp_path / "t.toml").write_text(TRACK.replace("[5, 0, 0]", "[0, 0, 0]"))
    with pytest.raises(InputError, match="points 0 and 1 are the same"):
        run_scenario(load_scenario(tmp_path / "t.toml"), tmp_path / "log.mcap")
    assert not (tmp_path / "log.mcap").exists()
