"""A cueing method of a user's own, from a file and from an installed package, by every command."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.recording import read_log
from atlas_cueing.review import cue_again, review_log

from .conftest import Command

HALF = (Path(__file__).parents[2] / "scenarios/half_turn.py").read_text()
OWN = ("--set", "cueing.method=half_turn.py:HalfTurn")
TRUST = "--trust-models"
TOPICS = ("/vehicle", "/cue", "/motion", "/wheels", "/felt")
FAILING = """
class Failing:
    "Turns for a while, and then does what it is told."

    class Parameters(__import__("pydantic").BaseModel):
        after_s: float = 0.2
        how: __import__("typing").Literal["raise", "nothing", "exit"] = "raise"

    def __init__(self, dt, parameters):
        self.parameters, self.angle, self.dt = parameters, 0.0, dt

    def step(self, vehicle):
        self.angle += 0.5 * self.dt
        if vehicle.time >= self.parameters.after_s:
            if self.parameters.how == "raise":
                return 1 / 0
            if self.parameters.how == "exit":
                raise SystemExit
            self.angle = float("nan")
        c, s = __import__("math").cos(self.angle / 2), __import__("math").sin(self.angle / 2)
        return (c, 0.0, 0.0, s), (0.0, 0.0, 0.5)
"""


@pytest.fixture
def own(command: Command, tmp_path: Path) -> Command:
    """The command, with methods beside its scenario."""
    (tmp_path / "half_turn.py").write_text(HALF)
    (tmp_path / "failing.py").write_text(FAILING)
    return command


def same_cueing(one: str, other: str) -> bool:
    logs = read_log(one), read_log(other)
    return all(
        np.array_equal(*(log.tables[topic].values for log in logs), equal_nan=True)
        for topic in TOPICS
    )


def test_a_method_in_a_file_flies_and_is_in_the_log(own: Command, tmp_path: Path) -> None:
    refused = own("run", "s.toml", *OWN)
    assert refused.status == 2
    assert "half_turn.py is a program; if you trust whoever wrote it" in refused.err
    assert not [*tmp_path.glob("*.mcap*")]
    ended = own("run", "s.toml", *OWN, "--set", "cueing.gain=0.25", TRUST)
    assert ended.status == 0, ended.err
    log = read_log("short.mcap")
    assert log.metadata["method"] == "half_turn.py:HalfTurn"
    assert log.metadata["method_version"] == "1.0"
    assert log.attachments["half_turn.py"] == HALF.encode()
    assert b"gain = 0.25" in log.attachments["scenario.toml"]
    rates = log.vector("/vehicle", "w") * (0.25, -0.25, -0.25)
    cued = np.linalg.norm(log.vector("/cue", "w"), axis=1)
    assert cued == pytest.approx(np.linalg.norm(rates, axis=1), abs=1e-12)
    assert cued.max() > 0.0


def test_its_log_is_cued_again_by_the_same_method_or_by_none(own: Command) -> None:
    own("run", "s.toml", *OWN, TRUST)
    own("run", "s.toml", "-o", "other.mcap")
    Path("half_turn.py").unlink()
    refused = own("recue", "short.mcap", "-o", "again.mcap")
    assert refused.status == 2
    assert "the log's half_turn.py is a program" in refused.err
    assert not Path("again.mcap").exists()
    assert own("recue", "short.mcap", "-o", "again.mcap", TRUST).status == 0
    assert same_cueing("short.mcap", "again.mcap")
    hedge = own("recue", "short.mcap", "-o", "hedge.mcap", "--set", "cueing.method=hedge")
    assert hedge.status == 0, hedge.err
    assert same_cueing("hedge.mcap", "other.mcap")
    assert not [key for key in read_log("hedge.mcap").metadata if key.startswith("method_")]
    Path("half_turn.py").write_text(HALF)
    mine = own("recue", "other.mcap", "-o", "mine.mcap", *OWN, TRUST)
    assert mine.status == 0, mine.err
    assert same_cueing("mine.mcap", "short.mcap")
    assert own("compare", "short.mcap", "other.mcap").out.split()[:2] == [
        "half_turn.py:H..",
        "hedge",
    ]


def test_another_method_under_the_same_name_does_not_stand_in(
    own: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where the log's file was exchanged, or a package is there in another version."""
    own("run", "s.toml", *OWN, TRUST)
    monkeypatch.setattr(
        "atlas_cueing.cueing.own.own_method.OwnMethod.metadata", lambda _: {"method_version": "2.0"}
    )
    with pytest.raises(InputError, match=r"method_version = '1\.0'.*here: .*'2\.0'"):
        cue_again("short.mcap", [], "new.mcap", trust_models=True)
    assert not Path("new.mcap").exists()


@pytest.mark.parametrize(
    ("how", "reason"),
    [
        ("raise", "ZeroDivisionError: division by zero (failing.py, line 16)"),
        ("nothing", "step gave ((nan, 0.0, 0.0, nan), (0.0, 0.0, 0.5)), which is not finite"),
        ("exit", "SystemExit:"),
    ],
)
def test_what_it_does_wrong_is_a_finding_with_its_name(own: Command, how: str, reason: str) -> None:
    setting = ("--set", "cueing.method=failing.py:Failing", "--set", f"cueing.how={how}")
    ended = own("run", "s.toml", *setting, TRUST, "--json")
    result = json.loads(ended.out)
    assert (ended.status, result["result"], result["violations"]) == (1, "method_failed", [])
    assert result["reason"].startswith("method 'failing.py:Failing' at 0.2")
    assert reason in result["reason"]
    found = review_log("short.mcap")
    assert [finding.check for finding in found.findings] == ["result"]
    assert "failing.py:Failing" in str(found.findings[0])
    times = read_log("short.mcap").column("/motion", "time_s")
    assert 0.2 - 2.0 / 120.0 < times[-1] < 0.2
    own("run", "s.toml", "-o", "whole.mcap")
    assert own("recue", "whole.mcap", *setting, "-o", "again.mcap", TRUST).status == 1
    assert same_cueing("short.mcap", "again.mcap")
    assert [finding.check for finding in review_log("again.mcap").findings] == ["result"]


def test_from_the_first_state_on(own: Command) -> None:
    setting = ("--set", "cueing.method=failing.py:Failing", "--set", "cueing.after_s=0")
    ended = own("run", "s.toml", *setting, TRUST, "--json")
    assert (ended.status, json.loads(ended.out)["ticks"]) == (1, 0)


@pytest.mark.parametrize(
    ("settings", "reason"),
    [
        (
            ["half_turn.py:HalfTurn", "cueing.gain=2"],
            "gain = 2: allowed: a number, 0 <= value <= 1",
        ),
        (["half_turn.py:HalfTurn", "cueing.gian=1"], "gian = 1: unknown key; did you mean 'gain'"),
        (["half_turn.py:HalfTrun"], "has no class 'HalfTrun'; allowed: HalfTurn"),
        (["half.py:HalfTurn"], "no such file; allowed: one in the scenario's folder"),
        (["../half.py:HalfTurn"], "no such file"),
        (["broken.py:Mine"], "does not load: SyntaxError: "),
        (["raising.py:Mine"], "does not load: ModuleNotFoundError: No module named 'nothing_here'"),
        (["binary.py:Mine"], "does not load: "),
        (["half_turn"], "allowed: FILE.py:CLASS, attitude, blend"),
    ],
)
def test_mistakes_are_told_and_nothing_is_written(
    own: Command, settings: list[str], reason: str
) -> None:
    Path("broken.py").write_text("class Mine(:\n")
    Path("raising.py").write_text("import nothing_here\n")
    Path("binary.py").write_bytes(b"\0\1\2")
    setting = [part for text in settings for part in ("--set", text)]
    setting[1] = f"cueing.method={settings[0]}"
    ended = own("run", "s.toml", *setting, TRUST)
    assert ended.status == 2
    assert reason in ended.err
    assert not Path("short.mcap").exists()


PROJECT = """
[build-system]
requires = ["setuptools>=77"]
build-backend = "setuptools.build_meta"
[project]
name = "half-turn"
version = "2.5"
[project.entry-points."atlas_cueing.methods"]
half_turn = "half_turn:HalfTurn"
[tool.setuptools]
py-modules = ["half_turn"]
"""
SWEEP = """
name = "swept"
duration_s = 0.45
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
[sweep]
cueing.method = ["half_turn", "blend", "half_turn.py:HalfTurn"]
"""
COMMANDS = """
import sys
from atlas_cueing.cli import main
def run(*arguments):
    print(main(arguments), flush=True)
run("run", "s.toml", "--set", "cueing.method=half_turn", "--set", "cueing.gain=0.25")
run("recue", "short.mcap", "-o", "again.mcap")
run("recue", "short.mcap", "-o", "blend.mcap", "--set", "cueing.method=blend")
run("compare", "short.mcap", "blend.mcap")
run("batch", "sweep.toml", "-o", "swept", "--trust-models")
run("live", "s.toml", "-o", "live.mcap", "--rate", "100", "--set", "cueing.method=half_turn",
    "--duration", "1.5")
"""


def test_a_method_of_an_installed_package(own: Command, tmp_path: Path) -> None:
    """Installed from a folder by pip, it flies by its name, in workers as well, and untrusted."""
    project, site = tmp_path / "project", tmp_path / "site"
    project.mkdir()
    (project / "pyproject.toml").write_text(PROJECT)
    (project / "half_turn.py").write_text(HALF)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation"]
    offline = ["--no-index", "--disable-pip-version-check", "--target", str(site), str(project)]
    subprocess.run([*pip, *offline], check=True, capture_output=True)
    (tmp_path / "sweep.toml").write_text(SWEEP)
    done = subprocess.run(
        [sys.executable, "-c", COMMANDS],
        env={**os.environ, "PYTHONPATH": str(site)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
    )
    statuses = [line for line in done.stdout.splitlines() if line.isdecimal() and len(line) == 1]
    assert statuses[:5] == ["0"] * 5, done.stdout + done.stderr
    told = read_log("short.mcap").metadata
    assert [told[f"method{key}"] for key in ("", "_version", "_package")] == [
        "half_turn",
        "2.5",
        "half-turn",
    ]
    assert same_cueing("short.mcap", "again.mcap")
    assert not same_cueing("short.mcap", "blend.mcap")
    logs = {read_log(path).metadata["method"]: path for path in (tmp_path / "swept").glob("*.mcap")}
    assert set(logs) == {"half_turn", "blend", "half_turn.py:HalfTurn"}
    assert same_cueing(str(logs["half_turn"]), str(logs["half_turn.py:HalfTurn"]))
    live = read_log("live.mcap")
    assert live.metadata["method_package"] == "half-turn"
    refused = own("recue", "short.mcap", "-o", "new.mcap")
    assert refused.status == 2
    assert "cueing.method = 'half_turn': allowed: " in refused.err
    assert not Path("new.mcap").exists()
