"""Names of files that are not UTF-8, as on an old disk or from a zip, in every command."""

import json
import os
from pathlib import Path

import pytest

from atlas_cueing.recording import read_log
from atlas_cueing.scenario.platform_file import presets
from atlas_cueing.vehicles import own_scripts

from .conftest import SCRIPT, Command

NAME = os.fsdecode(b"caf\xe9")
SHOWN = "caf\\xe9"


@pytest.fixture
def here(command: Command, tmp_path: Path) -> Path:
    """A folder with a scenario, a platform, a script and a log of that name."""
    (tmp_path / f"{NAME}.toml").write_text(SCRIPT)
    (tmp_path / f"{NAME}.xml").write_bytes(own_scripts()["c1722"].read_bytes())
    (tmp_path / f"{NAME}-platform.toml").write_bytes(presets()["atlas-2.9m"].read_bytes())
    assert command("run", f"{NAME}.toml", "-o", f"{NAME}.mcap").status == 0
    (tmp_path / f"{NAME}-twin.mcap").write_bytes((tmp_path / f"{NAME}.mcap").read_bytes())
    return tmp_path


@pytest.mark.usefixtures("here")
@pytest.mark.parametrize(
    "words",
    [
        ["run", f"{NAME}.toml", "-o", f"{NAME}-new.mcap"],
        ["run", "s.toml", "-o", "new.mcap", "--set", f"platform.file={NAME}-platform.toml"],
        ["run", "s.toml", "-o", "new.mcap", "--set", f'platform.file="{NAME}-platform.toml"'],
        [
            "run",
            "s.toml",
            "-o",
            "new.mcap",
            "--set",
            f"vehicle.script={NAME}.xml",
            "--trust-models",
        ],
        ["run", "s.toml", "-o", "new.mcap", "--set", f"description={NAME}"],
        ["review", f"{NAME}.mcap"],
        ["review", f"{NAME}.mcap", "--html", f"{NAME}.html", "--replay", f"{NAME}-3d.html"],
        ["compare", f"{NAME}.mcap", f"{NAME}-twin.mcap", "--html", f"{NAME}.html"],
        ["recue", f"{NAME}.mcap", "-o", f"{NAME}-new.mcap", "--set", "cueing.method=force"],
        ["recue", f"{NAME}.mcap", "-o", "new.mcap", "--set", f"platform.file={NAME}-platform.toml"],
        ["recover", f"{NAME}.mcap", "-o", f"{NAME}-new.mcap"],
        ["platform", f"{NAME}-platform.toml"],
        ["live", f"{NAME}.toml", "-o", f"{NAME}-new.mcap", "--duration", "0.1"],
    ],
    ids=lambda words: " ".join(words).replace(NAME, "N"),
)
def test_they_work(command: Command, words: list[str]) -> None:
    ended = command(*words)
    assert ended.status == (0 if words[0] != "live" else ended.status), ended.err
    assert "This is a bug" not in ended.err
    assert f"{ended.out}{ended.err}".isascii()


def test_in_the_log_they_have_a_question_mark(command: Command, here: Path) -> None:
    command("recue", f"{NAME}.mcap", "-o", "new.mcap")
    assert read_log(here / "new.mcap").metadata["recued_from"] == "caf?.mcap"
    command("run", "s.toml", "--set", f"vehicle.script={NAME}.xml", "--trust-models")
    assert "caf?.xml" in read_log(here / "short.mcap").attachments
    assert command("recue", "short.mcap", "-o", "again.mcap").status == 0


def test_they_are_shown_and_json_keeps_them(command: Command, here: Path) -> None:
    assert f"log                       {SHOWN}.mcap\n" in command("review", f"{NAME}.mcap").out
    assert json.loads(command("review", f"{NAME}.mcap", "--json").out)["log"] == f"{NAME}.mcap"
    command("review", f"{NAME}.mcap", "--html", "page.html")
    assert f"{SHOWN}.mcap" in (here / "page.html").read_text()
    assert command("run", f"no{NAME}.toml").err.startswith(
        f"error: no{SHOWN}.toml: file: cannot be read"
    )


def test_a_batch(command: Command, here: Path) -> None:
    ended = command("batch", f"{NAME}.toml", "-o", f"{NAME}-runs", "--jobs", "1")
    assert ended.status == 0, ended.err
    assert "caf?.toml" in (here / f"{NAME}-runs" / "summary.csv").read_text()
    assert f"<h1>{SHOWN}-runs</h1>" in (here / f"{NAME}-runs" / "index.html").read_text()


def test_a_line_break_in_a_name_forges_no_message(command: Command) -> None:
    for words in (
        ["run", "a\nerror: b.toml"],
        ["platform", "a\nerror: b"],
        ["review", "a\nerror: b"],
        ["batch", "a\nb", "-o", "x"],
    ):
        ended = command(*words)
        assert ended.status == 2
        assert ended.err.count("\n") == 1
        assert "a\\n" in ended.err


def test_a_folder_that_jsbsim_cannot_be_told_of(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / NAME).mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / NAME))
    ended = command("run", "s.toml")
    assert ended.status == 2
    assert "its name is not UTF-8, which JSBSim needs; set TMPDIR" in ended.err
