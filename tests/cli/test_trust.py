"""`--trust-models` from the command to the last process that flies."""

import json
from pathlib import Path

import pytest

from atlas_cueing.recording import read_log

from .conftest import SCRIPT, Command

USERS = """<runscript name="glide">
  <use aircraft="c172x" initialize="reset00"/>
  <run start="0.0" end="0.4" dt="0.01"/>
</runscript>
"""


@pytest.fixture
def users(command: Command, tmp_path: Path) -> Command:
    """The command beside a scenario `s.toml` with a user's script."""
    (tmp_path / "s.toml").write_text(SCRIPT.replace("c1722", "mine.xml"))
    (tmp_path / "mine.xml").write_text(USERS)
    return command


@pytest.mark.parametrize("arguments", [["run", "s.toml"], ["batch", "s.toml", "-o", "out"]], ids=["run", "batch"])
def test_without_it_nothing_flies_and_nothing_is_written(users: Command, tmp_path: Path, arguments: list[str]) -> None:
    ended = users(*arguments)
    assert (ended.status, ended.out) == (2, "")
    (line,) = ended.err.splitlines()
    assert "mine.xml: this script is not one of JSBSim's own" in line
    assert "--trust-models" in line
    assert {path.name for path in tmp_path.iterdir()} == {"s.toml", "mine.xml"}


def test_with_it_run_and_batch_fly_the_same(users: Command, tmp_path: Path) -> None:
    assert users("run", "s.toml", "--trust-models", "-o", "one.mcap").status == 0
    ended = users("batch", "s.toml", "-o", "out", "--jobs", "1", "--trust-models", "--json")
    assert ended.status == 0, ended.err
    (row,) = json.loads(ended.out)["table"]
    assert (tmp_path / "out" / f"{row['run']}.mcap").read_bytes() == (tmp_path / "one.mcap").read_bytes()


def test_a_log_is_cued_anew_without_it_and_flown_again_with_it(users: Command, tmp_path: Path) -> None:
    assert users("run", "s.toml", "--trust-models", "-o", "one.mcap").status == 0
    assert users("recue", "one.mcap", "-o", "again.mcap", "--set", "cueing.method=force").status == 0
    again = tmp_path / "again"
    again.mkdir()
    for name, content in read_log(tmp_path / "one.mcap").attachments.items():
        (again / name).write_bytes(content)
    refused = users("run", "again/scenario.toml", "-o", "two.mcap")
    assert (refused.status, refused.err.count("\n")) == (2, 1)
    assert "--trust-models" in refused.err
    assert users("run", "again/scenario.toml", "-o", "two.mcap", "--trust-models").status == 0
    assert (tmp_path / "two.mcap").read_bytes() == (tmp_path / "one.mcap").read_bytes()


def test_cueing_anew_never_reads_the_script(users: Command, tmp_path: Path) -> None:
    """The log's script may be anything: it is carried along and not flown."""
    assert users("run", "s.toml", "--trust-models", "-o", "one.mcap").status == 0
    assert USERS.encode() in (tmp_path / "one.mcap").read_bytes()
    (tmp_path / "mine.xml").unlink()
    assert users("recue", "one.mcap", "-o", "again.mcap").status == 0
    assert read_log(tmp_path / "again.mcap").attachments["mine.xml"] == USERS.encode()
