"""`--trust-models` from the command to the last process that flies."""

import json
import shutil
from pathlib import Path

import pytest

from atlas_cueing.recording import read_log
from atlas_cueing.vehicles import own_aircraft
from atlas_cueing.vehicles.jsbsim.library import root

from .conftest import SCRIPT, Command

USERS = """<runscript name="glide">
  <use aircraft="c172x" initialize="reset00"/>
  <run start="0.0" end="0.4" dt="0.01"/>
</runscript>
"""


@pytest.fixture
def users(command: Command, tmp_path: Path) -> Command:
    """The command beside a scenario `s.toml` whose aircraft lies there.

    It is flown by inputs or by a script.
    """
    (tmp_path / "s.toml").write_text(SCRIPT.replace("c1722", "mine.xml"))
    (tmp_path / "mine.xml").write_text(USERS)
    return command


@pytest.mark.parametrize(
    "arguments", [["run", "s.toml"], ["batch", "s.toml", "-o", "out"]], ids=["run", "batch"]
)
def test_without_it_nothing_flies_and_nothing_is_written(
    users: Command, tmp_path: Path, arguments: list[str]
) -> None:
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
    assert (tmp_path / "out" / f"{row['run']}.mcap").read_bytes() == (
        tmp_path / "one.mcap"
    ).read_bytes()


def test_a_log_is_cued_anew_without_it_and_flown_again_with_it(
    users: Command, tmp_path: Path
) -> None:
    assert users("run", "s.toml", "--trust-models", "-o", "one.mcap").status == 0
    assert (
        users("recue", "one.mcap", "-o", "again.mcap", "--set", "cueing.method=force").status == 0
    )
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


OWN = """
name = "own"
duration_s = 0.3
[vehicle]
aircraft = "mymodel"
input = [ { time_s = 0.1, property = "fcs/elevator-cmd-norm", value = -0.2 } ]
[vehicle.initial]
altitude_m = 1500
airspeed_m_s = 55.0
trim = true
[platform]
preset = "atlas-2.9m"
"""
SCRIPTED = """<runscript name="own">
  <use aircraft="mymodel" initialize="reset01"/>
  <run start="0.0" end="0.3" dt="0.01"/>
</runscript>
"""


@pytest.fixture(params=["aircraft", "script"])
def own(request: pytest.FixtureRequest, command: Command, tmp_path: Path) -> Command:
    """The command beside a scenario `s.toml` whose aircraft lies there.

    It is flown by inputs or by a script.
    """
    shutil.copytree(own_aircraft()["c172x"].parent, tmp_path / "aircraft" / "mymodel")
    (tmp_path / "aircraft" / "mymodel" / "c172x.xml").rename(
        tmp_path / "aircraft" / "mymodel" / "mymodel.xml"
    )
    (tmp_path / "engine").mkdir()
    shutil.copy(root() / "engine" / "eng_io320.xml", tmp_path / "engine")
    (tmp_path / "mine.xml").write_text(SCRIPTED)
    (tmp_path / "s.toml").write_text(
        OWN if request.param == "aircraft" else SCRIPT.replace("c1722", "mine.xml")
    )
    return command


def test_an_aircraft_of_ones_own_needs_trust_too(own: Command, tmp_path: Path) -> None:
    before = set(tmp_path.rglob("*"))
    for command in (["run", "s.toml"], ["batch", "s.toml", "-o", "out"], ["live", "s.toml"]):
        ended = own(*command)
        assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
        assert (
            "is not one of JSBSim's own, and it is a program; if you trust whoever wrote it"
            in ended.err
        )
    assert set(tmp_path.rglob("*")) == before


def test_an_aircraft_of_ones_own_flies_in_run_and_batch_and_from_its_log(
    own: Command, tmp_path: Path
) -> None:
    assert own("run", "s.toml", "--trust-models", "-o", "one.mcap").status == 0
    ended = own("batch", "s.toml", "-o", "out", "--jobs", "1", "--trust-models", "--json")
    assert ended.status == 0, ended.err
    (row,) = json.loads(ended.out)["table"]
    assert (tmp_path / "out" / f"{row['run']}.mcap").read_bytes() == (
        tmp_path / "one.mcap"
    ).read_bytes()
    for name, content in read_log(tmp_path / "one.mcap").attachments.items():
        (tmp_path / "again" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "again" / name).write_bytes(content)
    assert (tmp_path / "again" / "engine" / "eng_io320.xml").is_file()
    assert own("run", "again/scenario.toml", "--trust-models", "-o", "two.mcap").status == 0
    assert (tmp_path / "two.mcap").read_bytes() == (tmp_path / "one.mcap").read_bytes()


def test_cueing_anew_needs_no_model(own: Command, tmp_path: Path) -> None:
    assert own("run", "s.toml", "--trust-models", "-o", "one.mcap").status == 0
    for gone in ("aircraft", "engine"):
        shutil.rmtree(tmp_path / gone)
    assert own("recue", "one.mcap", "-o", "again.mcap", "--set", "cueing.method=force").status == 0
    again, one = (read_log(tmp_path / f"{name}.mcap").attachments for name in ("again", "one"))
    assert (
        {name: again[name] for name in one if "/" in name}
        == {name: one[name] for name in one if "/" in name}
        != {}
    )
    assert own("review", "again.mcap").status == 0


def test_a_changed_model_is_another_run(own: Command, tmp_path: Path) -> None:
    ids = set()
    for horsepower in ("160.0", "170.0"):
        engine = tmp_path / "engine" / "eng_io320.xml"
        engine.write_text(engine.read_text().replace("160.0  </maxhp>", f"{horsepower}  </maxhp>"))
        ended = own(
            "batch", "s.toml", "-o", f"out{horsepower}", "--jobs", "1", "--trust-models", "--json"
        )
        ids.add(json.loads(ended.out)["table"][0]["run"])
    assert len(ids) == 2
