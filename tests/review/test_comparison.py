"""Logs side by side."""

import json
from pathlib import Path

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.review import compare_logs, cue_again, review_log

from .corrupting import corrupted


@pytest.fixture(scope="module")
def other(flight: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same flight by another method."""
    path = tmp_path_factory.mktemp("other") / "attitude.mcap"
    cue_again(flight, ["cueing.method=attitude"], path)
    return path


def test_two_methods(flight: Path, other: Path) -> None:
    both = compare_logs([flight, other])
    assert (both.names, both.clean) == (("blend", "attitude"), True)
    table = both.to_json()
    assert table["metrics"]["rate_rms_rad_s"] == [
        review_log(log).metrics["rate_rms_rad_s"] for log in (flight, other)
    ]  # type: ignore[index]
    assert [log["log"] for log in table["logs"]] == [str(flight), str(other)]  # type: ignore[attr-defined]
    json.dumps(table)


def test_names_tell_the_logs_apart(flight: Path, other: Path, tmp_path: Path) -> None:
    cue_again(flight, ["platform.preset=atlas-1.5m"], tmp_path / "small.mcap")
    assert compare_logs([flight, tmp_path / "small.mcap"]).names == ("atlas-2.9m", "atlas-1.5m")
    assert compare_logs([flight, other, tmp_path / "small.mcap"]).names == (
        "blend atlas-2.9m",
        "attitude atlas-2.9m",
        "blend atlas-1.5m",
    )
    (tmp_path / "twin.mcap").write_bytes(flight.read_bytes())
    assert compare_logs([flight, tmp_path / "twin.mcap"]).names == ("flight", "twin")
    assert compare_logs([flight, flight]).names == (str(flight), str(flight))


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("/vehicle fx_m_s2", "specific force differs from 2.500000 s on"),
        ("/vehicle wx_rad_s", "rates differs from 2.5"),
        ("/vehicle q_nb_x", "attitude differs from 2.5"),
    ],
)
def test_another_flight_is_refused(flight: Path, tmp_path: Path, name: str, message: str) -> None:
    changed = corrupted(
        flight, tmp_path / "other.mcap", lambda c: c[name].__setitem__(300, c[name][300] + 1e-12)
    )
    with pytest.raises(InputError, match=message):
        compare_logs([flight, changed])
    assert len(compare_logs([flight, changed], different_flights=True).reviews) == 2


def test_a_shorter_flight_is_refused(flight: Path, tmp_path: Path) -> None:
    short = corrupted(
        flight, tmp_path / "short.mcap", lambda c: c.update({n: v[:400] for n, v in c.items()})
    )
    with pytest.raises(InputError, match="400 ticks instead of 721"):
        compare_logs([flight, short])


def test_one_log_is_none_to_compare(flight: Path) -> None:
    with pytest.raises(InputError, match="at least two"):
        compare_logs([flight])


def test_a_fault_in_one_is_a_fault_of_all(flight: Path, tmp_path: Path) -> None:
    bad = corrupted(
        flight, tmp_path / "bad.mcap", lambda c: c["/wheels w1_rad_s"].__setitem__(300, 9.0)
    )
    assert not compare_logs([flight, bad]).clean


def test_a_ride_beside_one_that_stands_still(flight: Path, other: Path, tmp_path: Path) -> None:
    """The ratio is in reviews of the same flight on the same platform, and only there."""
    cue_again(flight, ["cueing.method=still"], tmp_path / "still.mcap")
    cue_again(flight, ["platform.preset=atlas-1.5m"], tmp_path / "small.mcap")
    shaken = corrupted(
        flight, tmp_path / "shaken.mcap", lambda c: c["/vehicle fx_m_s2"].__setitem__(300, 1.0)
    )
    logs = [flight, other, tmp_path / "still.mcap", tmp_path / "small.mcap", shaken]
    all_of_them = compare_logs(logs, different_flights=True).to_json()["metrics"]
    *rides, small, elsewhere = all_of_them["mismatch_ratio"]  # type: ignore[index]
    blend, attitude, still, *_ = all_of_them["mismatch"]  # type: ignore[index]
    assert still > 1.0
    assert rides == [max(blend, 1.0) / still, max(attitude, 1.0) / still, 1.0]
    assert (small, elsewhere) == (None, None)
    assert "mismatch_ratio" not in compare_logs([flight, other]).to_json()["metrics"]  # type: ignore[operator]
