import csv
import json
import os
import random
import re
import signal
import subprocess
import sys
import time
from hashlib import sha256
from pathlib import Path

import pytest

from atlas_cueing.errors import MissingExtraError
from atlas_cueing.recording import read_log

from .conftest import SCRIPT, Command

SWEEP = (
    f'{SCRIPT}\n[sweep]\ncueing.method = ["blend", "attitude"]\ncueing.force_gain = [1.0, 0.5]\n'
)
START = [sys.executable, "-c", "import sys; from atlas_cueing.cli import main; sys.exit(main())"]


@pytest.fixture
def sweep(command: Command, tmp_path: Path) -> Command:
    """The command beside a sweep of four runs instead of a scenario."""
    (tmp_path / "s.toml").write_text(SWEEP)
    return command


def test_a_batch_for_people(sweep: Command, tmp_path: Path) -> None:
    ended = sweep(
        "batch", "s.toml", "-o", "out", "--jobs", "1", "--top", "2", "--sort", "force_rms_m_s2"
    )
    assert ended.status == 0
    assert ended.err.startswith("4 runs, 0 of them done already; to fly: 2 s of flight at most\n")
    assert re.search(
        r"^4 of 4 runs done, 0 failed, \d+ flight s a second$", ended.err, re.MULTILINE
    )
    lines = ended.out.splitlines()
    assert re.match(
        r"run +result +cueing.method +cueing.force_gain +force rms m/s2 +mismatch JND",
        lines[0],
    )
    assert [
        bool(
            re.match(
                r"short-c1722-\w+-[0-9a-f]{12} +ok +(blend|attitude) +(1|0\.5) +\d+\.\d+", line
            )
        )
        for line in lines[1:4]
    ] == [True, True, False]
    assert "runs        4 ok" in lines
    assert "violations  0" in lines
    with (tmp_path / "out" / "summary.csv").open(newline="") as file:
        table = list(csv.DictReader(file))
    forces = [float(row["force_rms_m_s2"]) for row in table]
    assert forces == sorted(forces)
    assert {(row["cueing.method"], row["cueing.force_gain"]) for row in table} == {
        *(("blend", "1.0"), ("blend", "0.5"), ("attitude", "1.0"), ("attitude", "0.5")),
    }
    assert (tmp_path / "out" / "index.html").read_text().count("<rect") == 4
    for row in table:
        assert read_log(tmp_path / "out" / row["log"]).metadata["method"] == row["method"]


def test_a_batch_for_programs_and_a_second_time(sweep: Command, tmp_path: Path) -> None:
    first = sweep("batch", "s.toml", "-o", "out", "--json")
    table = json.loads(first.out)
    assert (first.status, table["folder"], table["runs"], table["results"]) == (
        0,
        "out",
        4,
        {"ok": 4},
    )
    assert {row["result"] for row in table["table"]} == {"ok"}
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "out").glob("short*")}
    again = sweep("batch", "s.toml", "-o", "out", "--json")
    assert (again.status, json.loads(again.out)) == (0, table)
    assert again.err == "4 runs, 4 of them done already; to fly: 0 s of flight at most\n"
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "out").glob("short*")} == before


def test_a_run_that_fails_is_a_finding(sweep: Command) -> None:
    ended = sweep(
        "batch", "s.toml", "-o", "out", "--set", 'sweep.vehicle.script=["c1722", "plotfile"]'
    )
    assert ended.status == 1
    assert (
        len(
            re.findall(
                r"^short-plotfile-\w+-[0-9a-f]{12}: vehicle_failed: .*<plotset>",
                ended.err,
                re.MULTILINE,
            )
        )
        == 4
    )
    assert "4 ok, 4 vehicle_failed" in ended.out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["missing.toml", "-o", "out"], "missing.toml: file: cannot be read"),
        (["s.toml", "-o", "no/such"], "folder no/such: no is missing"),
        (["s.toml", "-o", "s.toml"], "folder s.toml: s.toml is no folder"),
        (["s.toml", "-o", "out", "--set", "duration_s=0"], "--set: duration_s = 0: "),
        (["s.toml", "-o", "out", "--jobs", "0"], "--jobs"),
        (
            ["s.toml", "-o", "out", "--cluster", "nonsense"],
            "--cluster nonsense: no scheduler reached",
        ),
        (["s.toml", "-o", "out", "--sort", "beauty"], "--sort beauty: no such metric"),
        (["s.toml"], "--output"),
        (["s.toml", "-o", "nonsense://out"], "-o nonsense://out: Protocol not known: nonsense"),
        (["s.toml", "-o", "file://out"], "-o file://out: a local URL has three slashes"),
        (["s.toml", "-o", "file:///no/such/place"], "file:///no/such/place: FileNotFoundError"),
    ],
    ids=lambda part: str(part)[:30],
)
def test_bad_input_writes_nothing(
    sweep: Command, tmp_path: Path, arguments: list[str], message: str
) -> None:
    ended = sweep("batch", *arguments)
    assert (ended.status, ended.out) == (2, "")
    assert message in ended.err
    assert "Traceback" not in ended.err
    assert [path.name for path in tmp_path.iterdir()] == ["s.toml"]


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        (
            "force",
            r"force_rms_m_s2, force_p95_m_s2, force_max_m_s2, force_\w+, force_\w+ and \d+ more\?",
        ),
        ("Stage travel", r"stage_travel_max_m\?"),  # as the review writes it
        ("banana", "allowed: .*|did you mean '.*"),  # in no name
        ("dirction_rms_rad", r"'direction_rms_rad'\?"),
        ("p99", r"extra_rate_p99_rad_s\?"),  # in the middle of a name
    ],
)
def test_a_wrong_metric_is_answered_with_those_that_were_meant(
    sweep: Command, word: str, meant: str
) -> None:
    ended = sweep("batch", "s.toml", "-o", "out", "--sort", word)
    assert ended.status == 2
    assert re.search(
        rf"--sort {word}: no such metric; (did you mean )?({meant})", ended.err.replace("\n", " ")
    )


def test_one_run_is_one_run(sweep: Command) -> None:
    one = sweep(
        "batch", "s.toml", "-o", "out", "--dry-run", "--set", 'sweep={cueing.method=["blend"]}'
    )
    assert one.err.startswith("1 run, 0 of them done already")


def test_pages_for_the_browser(
    sweep: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command = ("batch", "s.toml", "-o", "out", "--pages", "--set", "sweep.cueing.force_gain=[1.0]")
    assert sweep(*command).status == 0
    pages = list((tmp_path / "out").glob("short*.html"))
    assert len(pages) == 2
    assert all(
        f'href="{page.name}"' in (tmp_path / "out" / "index.html").read_text() for page in pages
    )
    pages[0].write_text("mine")
    assert sweep(*command).status == 0
    assert pages[0].read_text() == "mine"
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    ended = sweep(*command)
    assert (ended.status, ended.err) == (
        2,
        f"error: {MissingExtraError('--pages', 'plotly', 'report')}\n",
    )


def test_a_dry_run_writes_nothing(sweep: Command, tmp_path: Path) -> None:
    ended = sweep("batch", "s.toml", "-o", "out", "--dry-run")
    assert (ended.status, ended.out) == (0, "")
    assert ended.err == "4 runs, 0 of them done already; to fly: 2 s of flight at most\n"
    assert [path.name for path in tmp_path.iterdir()] == ["s.toml"]


def test_run_points_to_batch(sweep: Command) -> None:
    ended = sweep("run", "s.toml")
    assert ended.status == 2
    assert "sweep: a sweep stands for many runs" in ended.err


def test_a_local_cluster(sweep: Command, tmp_path: Path) -> None:
    assert sweep("batch", "s.toml", "-o", "here", "--top", "0").status == 0
    assert sweep("batch", "s.toml", "-o", "there", "--cluster", "local", "--jobs", "1").status == 0
    here, there = (
        {path.name: path.read_bytes() for path in (tmp_path / name).glob("*.mcap")}
        for name in ("here", "there")
    )
    assert len(here) == 4
    assert here == there


def test_to_a_url_and_again(sweep: Command, tmp_path: Path) -> None:
    """The same files as in a folder; the second time only what is missing, and pages."""
    url = f"file://{tmp_path}/there"
    assert sweep("batch", "s.toml", "-o", "here").status == 0
    first = sweep("batch", "s.toml", "-o", url, "--jobs", "1", "--top", "0")
    assert first.status == 0
    assert f"overview    {url}/index.html" in first.out.splitlines()
    here, there = (
        {path.name for path in (tmp_path / name).iterdir()} for name in ("here", "there")
    )
    assert there == {name for name in here if not name.endswith(".lock")}
    logs = {path: path.stat() for path in (tmp_path / "there").glob("*.mcap")}
    assert all(path.read_bytes() == (tmp_path / "here" / path.name).read_bytes() for path in logs)
    gone, *_ = logs
    gone.unlink()
    again = sweep("batch", "s.toml", "-o", url, "--json", "--pages")
    assert (again.status, json.loads(again.out)["folder"]) == (0, url)
    assert again.err.startswith("4 runs, 3 of them done already")
    assert all(
        (path.stat().st_ino, path.stat().st_mtime_ns) == (was.st_ino, was.st_mtime_ns)
        for path, was in logs.items()
        if path != gone
    )
    assert gone.read_bytes() == (tmp_path / "here" / gone.name).read_bytes()
    overview = (tmp_path / "there" / "index.html").read_text()
    assert all(
        f'href="{path.stem}.html"' in overview and path.with_suffix(".html").is_file()
        for path in logs
    )
    assert not list((tmp_path / "there").glob("*.upload"))


def started(folder: Path) -> "subprocess.Popen[str]":
    command = [*START, "batch", "s.toml", "-o", "out", "--jobs", "1"]
    return subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def logs(folder: Path) -> dict[str, tuple[int, str]]:
    """Logs whose runs are complete: when they were written, and what is in them."""
    records = (folder / "out").glob("*.json")
    done = [path.with_suffix(".mcap") for path in records]
    return {
        path.name: (path.stat().st_mtime_ns, sha256(path.read_bytes()).hexdigest()) for path in done
    }


def test_a_driver_killed_again_and_again(sweep: Command, tmp_path: Path) -> None:
    """What was complete is neither flown again nor changed; in the end everything is there."""
    (tmp_path / "s.toml").write_text(SWEEP.replace("0.45", "2.0"))
    moments = random.Random(7)
    for count in range(3):
        before = logs(tmp_path) if count else {}
        driver = started(tmp_path)
        while driver.poll() is None and len(list(tmp_path.glob("out/*.mcap*"))) <= len(before):
            time.sleep(0.01)
        time.sleep(moments.random() * 0.2)
        driver.kill()
        driver.communicate(timeout=60)
        assert before.items() <= logs(tmp_path).items()
    before = logs(tmp_path)
    assert sweep("batch", "s.toml", "-o", "out").status == 0
    assert before.items() <= logs(tmp_path).items()
    assert len(logs(tmp_path)) == 4
    assert sweep("batch", "s.toml", "-o", "anew").status == 0
    assert {path.read_bytes() for path in tmp_path.glob("anew/*.mcap")} == {
        path.read_bytes() for path in tmp_path.glob("out/*.mcap")
    }


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_the_batch_and_says_how_to_go_on(
    tmp_path: Path, number: signal.Signals
) -> None:
    (tmp_path / "s.toml").write_text(SWEEP.replace("0.45", "3600.0").replace("c1722", "ball"))
    driver = started(tmp_path)
    while driver.poll() is None and not list(tmp_path.glob("out/*.part")):
        time.sleep(0.01)
    os.kill(driver.pid, number)
    out, err = driver.communicate(timeout=60)
    assert driver.returncode == 1
    assert err.endswith("stopped: 4 runs not done; the same command flies them\n")
    assert "4 not_flown" in out
    assert (tmp_path / "out" / "summary.csv").exists()
