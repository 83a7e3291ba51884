"""Every fault put into a clean log is found: at its place, at its time, for its reason."""

import json
from pathlib import Path

import numpy as np
import pytest
import tomli_w

from atlas_cueing.errors import InputError, LogError
from atlas_cueing.recording import read_log
from atlas_cueing.review import open_run, review_log
from atlas_cueing.review.checks.actuators import limit_shares
from atlas_cueing.scenario.reading import parse_toml

from .corrupting import columns_of, corrupted
from .faults import AT, DEGREE, FAULTS, STEP, drop, turn


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_found(flight: Path, tmp_path: Path, name: str) -> None:
    change, check, place, tick = FAULTS[name]
    times = read_log(flight).column("/motion", "time_s")
    found = review_log(corrupted(flight, tmp_path / "bad.mcap", change))
    assert not found.clean
    matching = [
        finding for finding in found.findings if (finding.check, finding.place) == (check, place)
    ]
    assert matching, [str(finding) for finding in found.findings]
    assert tick is None or matching[0].time == pytest.approx(times[tick], abs=1e-9)
    json.dumps(found.to_json()["findings"], allow_nan=False)


def test_a_clean_flight(flight: Path) -> None:
    found = review_log(flight)
    assert found.findings == ()
    assert (found.clean, found.verdict, found.duration) == (True, "clean", pytest.approx(6.0))
    table = found.to_json()
    assert (table["result"], table["ticks"], table["violations"]) == ("ok", 721, [])
    assert table["metrics"] == found.metrics


@pytest.mark.parametrize(
    "name",
    ["wheel_speed", "wheel_acceleration", "stage_travel", "stage_speed", "stage_acceleration"],
)
def test_a_logged_limit_broken_by_a_thousandth(flight: Path, tmp_path: Path, name: str) -> None:
    """The limit is set a thousandth below what the same flight used, so nothing else is wrong."""
    used = np.abs(limit_shares(open_run(flight))[name])
    found = review_log(with_limit(flight, tmp_path / "bad.mcap", name, used.max() / 1.001))
    logged = [
        finding
        for finding in found.findings
        if finding.check == "limit" and " by " not in finding.place
    ]
    assert len(logged) == 1
    worst = np.argwhere(used == used.max())[0][0]
    assert logged[0].time == read_log(flight).column("/motion", "time_s")[worst]
    assert str(logged[0]) in found.to_json()["violations"]
    assert review_log(with_limit(flight, tmp_path / "fair.mcap", name, used.max() * 1.001)).clean


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("wheel_acceleration", "/wheels w{k}_rad_s by differences"),
        ("wheel_jerk", "/wheels a{k}_rad_s2 by differences"),
        ("wheel_jerk", "/wheels w{k}_rad_s by second differences"),
        ("stage_speed", "/motion p{k}_m by differences"),
        ("stage_acceleration", "/motion v{k}_m_s by differences"),
        ("stage_jerk", "/motion a{k}_m_s2 by differences"),
        ("stage_jerk", "/motion v{k}_m_s by second differences"),
    ],
)
def test_a_limit_broken_by_a_thousandth_between_ticks(
    flight: Path, tmp_path: Path, name: str, place: str
) -> None:
    """Slopes of logged columns again, by numpy's gradient of a single column."""
    log = read_log(flight)
    axes = "123" if place.startswith("/wheels") else "xyz"
    topic, field = place.split()[0], place.split()[1]
    time, most, limit = (
        log.column(topic, "time_s"),
        0.0,
        limits(log.attachments["platform.toml"], name),
    )
    for k, axis in enumerate(axes):
        slope = np.diff(log.column(topic, field.format(k=axis))) / np.diff(time)
        if "second" in place:
            slope = np.diff(slope) / np.diff(time)[1:]
        most = max(most, float(np.abs(slope).max() / limit[k]))
    found = review_log(with_limit(flight, tmp_path / "bad.mcap", name, most / 1.001))
    assert any(
        place.format(k=axis) in str(finding)
        for axis in axes
        for finding in found.findings
        if finding.check == "limit"
    )


def limits(platform: bytes, name: str) -> tuple[float, float, float]:
    kind, _, quantity = name.partition("_")
    table = parse_toml(platform.decode(), "platform.toml")[f"{kind}_limits"]
    (key,) = [key for key in table if key.startswith(quantity)]
    one, two, three = table[key]
    return one, two, three


def with_limit(flight: Path, output: Path, name: str, share: float) -> Path:
    """The same log on a platform with one limit times `share`."""
    table = parse_toml(read_log(flight).attachments["platform.toml"].decode(), "platform.toml")
    kind, _, quantity = name.partition("_")
    (key,) = [key for key in table[f"{kind}_limits"] if key.startswith(quantity)]
    table[f"{kind}_limits"][key] = [share * limit for limit in table[f"{kind}_limits"][key]]
    return corrupted(flight, output, attachments={"platform.toml": tomli_w.dumps(table).encode()})


@pytest.mark.parametrize(
    ("metadata", "states", "texts"),
    [
        (
            {"result": "vehicle_failed", "reason": "at 3 s"},
            None,
            ["result: result = 'vehicle_failed', allowed: 'ok'; at 3 s"],
        ),
        (
            {},
            [(0.0, "running", ""), (2.0, "FAULT_STOPPING", "late")],
            ["2.000000 s /status: fault: FAULT_STOPPING: late"],
        ),
        ({"result": ""}, [], ["result = ''"]),
    ],
)
def test_what_the_run_says_itself(
    flight: Path,
    tmp_path: Path,
    metadata: dict[str, str],
    states: list[tuple[float, str, str]] | None,
    texts: list[str],
) -> None:
    found = review_log(corrupted(flight, tmp_path / "bad.mcap", metadata=metadata, states=states))
    assert len(found.findings) == len(texts)
    assert all(text in str(finding) for text, finding in zip(texts, found.findings, strict=True))


def test_a_jump_that_a_state_tells_of_is_a_note(flight: Path, tmp_path: Path) -> None:
    when = float(read_log(flight).column("/motion", "time_s")[AT])
    states = [
        (0.0, "running", ""),
        (when, "attitude_jump", "by 1 deg"),
        (when + STEP, "running", ""),
    ]
    change = turn("/vehicle", "q_nb", 1.0 * DEGREE, slice(AT, None))
    found = review_log(corrupted(flight, tmp_path / "told.mcap", change, states=states))
    assert found.clean
    assert found.notes == (f"{when:.6f} to {when + STEP:.6f} s attitude_jump: by 1 deg",)


def test_a_log_without_ticks(flight: Path, tmp_path: Path) -> None:
    found = review_log(
        corrupted(
            flight,
            tmp_path / "empty.mcap",
            drop(ticks=slice(None)),
            metadata={"result": "vehicle_failed"},
        )
    )
    assert [finding.check for finding in found.findings] == ["result", "empty"]
    assert (found.duration, found.run.step) == (0.0, 0.0)


def test_a_log_of_one_tick(flight: Path, tmp_path: Path) -> None:
    assert review_log(corrupted(flight, tmp_path / "one.mcap", drop(ticks=slice(1, None)))).clean


def test_a_rewritten_log_is_the_same(flight: Path, tmp_path: Path) -> None:
    """The corrupter adds nothing of its own, or the faults above would prove little."""
    again = corrupted(flight, tmp_path / "same.mcap", metadata={"scenario": "roll"})
    one, other = columns_of(read_log(flight)), columns_of(read_log(again))
    assert one.keys() == other.keys()
    assert all(np.array_equal(one[name], other[name]) for name in one)
    assert review_log(again).clean


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ({"platform.toml": b"name = 3"}, "the log's platform.toml"),
        ({"platform.toml": b"\xff"}, "UTF-8"),
        ({"../evil.toml": b""}, "lead nowhere else"),
        ({"/evil.toml": b""}, "lead nowhere else"),
        ({"a/../../evil.toml": b""}, "lead nowhere else"),
        ({"a//b": b""}, "lead nowhere else"),
        ({"a/" * 8 + "b": b""}, "lead nowhere else"),
        ({"platform.toml/b": b""}, "is a file and a folder"),
        ({"a": b"", "a/b/c": b""}, "is a file and a folder"),
        ({"big": bytes(2 << 20)}, "allowed: at most"),
    ],
)
def test_bad_files_inside(
    flight: Path, tmp_path: Path, files: dict[str, bytes], message: str
) -> None:
    bad = corrupted(flight, tmp_path / "bad.mcap", attachments=files)
    with pytest.raises(LogError, match=message) as caught:
        review_log(bad)
    assert "\n" not in str(caught.value)
    assert not (tmp_path.parent / "evil.toml").exists()


@pytest.mark.parametrize("name", ["nothing.mcap", ".", "x" * 300])
def test_no_such_file(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError):
        review_log(tmp_path / name)


def test_a_scenario_is_no_log(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text('name = "s"')
    with pytest.raises(InputError, match="to fly a scenario: atlas-cueing run"):
        review_log(tmp_path / "s.toml")
