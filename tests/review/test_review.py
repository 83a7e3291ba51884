"""Every fault put into a clean log is found: at its place, at its time, for its reason."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import tomli_w

from atlas_cueing.errors import InputError, LogError
from atlas_cueing.recording import read_log
from atlas_cueing.review import open_run, review
from atlas_cueing.review.actuators import limit_shares
from atlas_cueing.scenario.reading import parse_toml

from .corrupting import Columns, columns_of, corrupted

AT = 300  # tick of a fault
Change = Callable[[Columns], None]


def add(name: str, amount: float, at: int | slice = AT) -> Change:
    def change(columns: Columns) -> None:
        columns[name][at] += amount

    return change


def put(name: str, value: float) -> Change:
    def change(columns: Columns) -> None:
        columns[name][AT] = value

    return change


def drop(*topics: str, ticks: slice = slice(AT, AT + 3)) -> Change:
    """Messages lost: of the given topics, or of all."""

    def change(columns: Columns) -> None:
        for name in columns:
            if not topics or name.split()[0] in topics:
                columns[name] = np.delete(columns[name], ticks)

    return change


def turn(topic: str, quaternion: str, angle: float, at: slice) -> Change:
    """A turn of the orientation about x, from some tick on."""

    def change(columns: Columns) -> None:
        w, x, y, z = (columns[f"{topic} {quaternion}_{c}"] for c in "wxyz")
        c, s = np.cos(0.5 * angle), np.sin(0.5 * angle)
        w[at], x[at], y[at], z[at] = c * w[at] - s * x[at], c * x[at] + s * w[at], c * y[at] - s * z[at], c * z[at] + s * y[at]

    return change


def flip(topic: str, quaternion: str) -> Change:
    def change(columns: Columns) -> None:
        for c in "wxyz":
            columns[f"{topic} {quaternion}_{c}"][AT:] *= -1.0

    return change


def scale(topic: str, quaternion: str, factor: float) -> Change:
    def change(columns: Columns) -> None:
        for c in "wxyz":
            columns[f"{topic} {quaternion}_{c}"][AT] *= factor

    return change


def later(topic: str, seconds: float, at: slice = slice(AT, None)) -> Change:
    """Time moved, of one topic or (empty) of all."""

    def change(columns: Columns) -> None:
        for name in columns:
            if name.endswith(" time_s") and name.startswith(topic):
                columns[name][at] += seconds

    return change


def swap(columns: Columns) -> None:
    """Two ticks in the wrong order."""
    for values in columns.values():
        values[[AT, AT + 1]] = values[[AT + 1, AT]]


STEP = 1.0 / 120.0
DEGREE = np.pi / 180.0

# What was put in, the check that has to say so, where, and at which tick (None: of the whole log).
FAULTS: dict[str, tuple[Change, str, str, int | None]] = {
    "NaN in the motion": (put("/motion wy_rad_s", np.nan), "not a number", "/motion wy_rad_s", AT),
    "infinite force": (put("/vehicle fz_m_s2", np.inf), "not a number", "/vehicle fz_m_s2", AT),
    "NaN as a flag": (put("/motion stage_limited", np.nan), "not a number", "/motion stage_limited", AT),
    "flag of a half": (put("/motion wheels_limited", 0.5), "no flag", "/motion wheels_limited", AT),
    "wheel speed off by 1e-6": (add("/wheels w2_rad_s", 1e-6), "not J^-1 of the motion", "/wheels w2_rad_s", AT),
    "wheel acceleration off by 1e-6": (add("/wheels a3_rad_s2", 1e-6), "not J^-1 of the motion", "/wheels a3_rad_s2", AT),
    "two wheels exchanged": (
        lambda c: c.update({"/wheels w1_rad_s": c["/wheels w2_rad_s"], "/wheels w2_rad_s": c["/wheels w1_rad_s"]}),
        "not J^-1 of the motion",
        "/wheels w1_rad_s",
        None,
    ),
    "orientation stepped by 0.01 deg": (
        turn("/motion", "q_ws", 0.01 * DEGREE, slice(AT, None)),
        "orientation is not the integral of Omega",
        "/motion q_ws",
        AT,
    ),
    "orientation creeps by 0.01 deg a second": (
        lambda c: turn("/motion", "q_ws", 0.01 * DEGREE * c["/motion time_s"], slice(None))(c),
        "orientation is not the integral of the wheels",
        "/motion q_ws",
        None,
    ),
    "body rates for base rates": (
        lambda c: c.update(
            {f"/motion w{a}_rad_s": s * c[f"/felt w{a}_rad_s"] for a, s in zip("xyz", (1, -1, -1), strict=True)}
        ),
        "orientation is not the integral of Omega",
        "/motion q_ws",
        None,
    ),
    "norm off by 1e-6": (scale("/motion", "q_ws", 1.0 + 1e-6), "norm", "/motion q_ws", AT),
    "norm of the vehicle off by 1e-6": (scale("/vehicle", "q_nb", 1.0 - 1e-6), "norm", "/vehicle q_nb", AT),
    "sign flips": (flip("/motion", "q_ws"), "sign flips", "/motion q_ws", AT),
    "sign of the vehicle flips": (flip("/vehicle", "q_nb"), "sign flips", "/vehicle q_nb", AT),
    "vehicle's attitude jumps unsaid": (
        turn("/vehicle", "q_nb", 1.0 * DEGREE, slice(AT, None)),
        "attitude jumps and no state tells of it",
        "/vehicle q_nb",
        AT,
    ),
    "felt force off by 1e-6": (add("/felt fy_m_s2", 1e-6), "not what the motion makes the rider feel", "/felt fy_m_s2", AT),
    "felt rate off by 1e-6": (add("/felt wz_rad_s", 1e-6), "not what the motion makes the rider feel", "/felt wz_rad_s", AT),
    "direction off by 1e-5": (
        add("/felt direction_error_rad", 1e-5),
        "not what the motion makes the rider feel",
        "/felt direction_error_rad",
        AT,
    ),
    "stage stepped by 0.1 mm": (
        add("/motion px_m", 1e-4, slice(AT, None)),
        "not the integral of its speed",
        "/motion px_m",
        AT,
    ),
    "stage speed stepped by 1 cm/s": (
        add("/motion vz_m_s", 1e-2, slice(AT, None)),
        "not the integral of its acceleration",
        "/motion vz_m_s",
        AT,
    ),
    "three ticks lost": (drop(), "gap", "/motion time_s", AT + 3),
    "three ticks lost on one topic": (drop("/wheels"), "ticks lost", "/wheels", AT),
    "time stretched by a twentieth of a tick": (
        later("", 0.05 * STEP, slice(AT, AT + 1)),
        "uneven time",
        "/motion time_s",
        None,
    ),
    "time runs back": (swap, "time runs back", "/motion time_s", None),
    "one topic late": (later("/cue", 1e-4), "time differs from /motion", "/cue time_s", None),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_found(flight: Path, tmp_path: Path, name: str) -> None:
    change, check, place, tick = FAULTS[name]
    times = read_log(flight).column("/motion", "time_s")
    found = review(corrupted(flight, tmp_path / "bad.mcap", change))
    assert not found.clean
    matching = [finding for finding in found.findings if (finding.check, finding.place) == (check, place)]
    assert matching, [str(finding) for finding in found.findings]
    assert tick is None or matching[0].time == pytest.approx(times[tick], abs=1e-9)
    json.dumps(found.to_json()["findings"], allow_nan=False)


def test_a_clean_flight(flight: Path) -> None:
    found = review(flight)
    assert found.findings == ()
    assert (found.clean, found.verdict, found.duration) == (True, "clean", pytest.approx(6.0))
    table = found.to_json()
    assert (table["result"], table["ticks"], table["violations"]) == ("ok", 721, [])
    assert table["metrics"] == found.metrics


@pytest.mark.parametrize("name", ["wheel_speed", "wheel_acceleration", "stage_travel", "stage_speed", "stage_acceleration"])
def test_a_logged_limit_broken_by_a_thousandth(flight: Path, tmp_path: Path, name: str) -> None:
    """The flight stays as it is and the limit is set a thousandth below what was used, so that nothing else is amiss."""
    used = np.abs(limit_shares(open_run(flight))[name])
    found = review(with_limit(flight, tmp_path / "bad.mcap", name, used.max() / 1.001))
    logged = [finding for finding in found.findings if finding.check == "limit" and " by " not in finding.place]
    assert len(logged) == 1
    worst = np.argwhere(used == used.max())[0][0]
    assert logged[0].time == read_log(flight).column("/motion", "time_s")[worst]
    assert str(logged[0]) in found.to_json()["violations"]
    assert review(with_limit(flight, tmp_path / "fair.mcap", name, used.max() * 1.001)).clean


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
def test_a_limit_broken_by_a_thousandth_between_ticks(flight: Path, tmp_path: Path, name: str, place: str) -> None:
    """Slopes of what is logged, reckoned here once more with numpy's gradient of a single column."""
    log = read_log(flight)
    axes = "123" if place.startswith("/wheels") else "xyz"
    topic, field = place.split()[0], place.split()[1]
    time, most, limit = log.column(topic, "time_s"), 0.0, limits(log.attachments["platform.toml"], name)
    for k, axis in enumerate(axes):
        slope = np.diff(log.column(topic, field.format(k=axis))) / np.diff(time)
        if "second" in place:
            slope = np.diff(slope) / np.diff(time)[1:]
        most = max(most, float(np.abs(slope).max() / limit[k]))
    found = review(with_limit(flight, tmp_path / "bad.mcap", name, most / 1.001))
    assert any(place.format(k=axis) in str(finding) for axis in axes for finding in found.findings if finding.check == "limit")


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
        ({"result": "vehicle_failed", "reason": "at 3 s"}, None, ["result: result = 'vehicle_failed', allowed: 'ok'; at 3 s"]),
        ({}, [(0.0, "running", ""), (2.0, "FAULT_STOPPING", "late")], ["2.000000 s /status: fault: FAULT_STOPPING: late"]),
        ({"result": ""}, [], ["result = ''"]),
    ],
)
def test_what_the_run_says_itself(
    flight: Path, tmp_path: Path, metadata: dict[str, str], states: list[tuple[float, str, str]] | None, texts: list[str]
) -> None:
    found = review(corrupted(flight, tmp_path / "bad.mcap", metadata=metadata, states=states))
    assert len(found.findings) == len(texts)
    assert all(text in str(finding) for text, finding in zip(texts, found.findings, strict=True))


def test_a_jump_that_a_state_tells_of_is_a_note(flight: Path, tmp_path: Path) -> None:
    when = float(read_log(flight).column("/motion", "time_s")[AT])
    states = [(0.0, "running", ""), (when, "attitude_jump", "by 1 deg"), (when + STEP, "running", "")]
    change = turn("/vehicle", "q_nb", 1.0 * DEGREE, slice(AT, None))
    found = review(corrupted(flight, tmp_path / "told.mcap", change, states=states))
    assert found.clean
    assert found.notes == (f"{when:.6f} to {when + STEP:.6f} s attitude_jump: by 1 deg",)


def test_a_log_without_ticks(flight: Path, tmp_path: Path) -> None:
    found = review(corrupted(flight, tmp_path / "empty.mcap", drop(ticks=slice(None)), metadata={"result": "vehicle_failed"}))
    assert [finding.check for finding in found.findings] == ["result", "empty"]
    assert (found.duration, found.run.step) == (0.0, 0.0)


def test_a_log_of_one_tick(flight: Path, tmp_path: Path) -> None:
    assert review(corrupted(flight, tmp_path / "one.mcap", drop(ticks=slice(1, None)))).clean


def test_a_rewritten_log_is_the_same(flight: Path, tmp_path: Path) -> None:
    """The corrupter adds nothing of its own, or the faults above would prove little."""
    again = corrupted(flight, tmp_path / "same.mcap", metadata={"scenario": "roll"})
    one, other = columns_of(read_log(flight)), columns_of(read_log(again))
    assert one.keys() == other.keys()
    assert all(np.array_equal(one[name], other[name]) for name in one)
    assert review(again).clean


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ({"platform.toml": b"name = 3"}, "the log's platform.toml"),
        ({"platform.toml": b"\xff"}, "UTF-8"),
        ({"../evil.toml": b""}, "allowed: a plain file name"),
        ({"big": bytes(2 << 20)}, "allowed: at most"),
    ],
)
def test_bad_files_inside(flight: Path, tmp_path: Path, files: dict[str, bytes], message: str) -> None:
    bad = corrupted(flight, tmp_path / "bad.mcap", attachments=files)
    with pytest.raises(LogError, match=message) as caught:
        review(bad)
    assert "\n" not in str(caught.value)
    assert not (tmp_path.parent / "evil.toml").exists()


@pytest.mark.parametrize("name", ["nothing.mcap", ".", "x" * 300])
def test_no_such_file(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError):
        review(tmp_path / name)
