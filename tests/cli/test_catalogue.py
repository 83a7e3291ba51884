"""`keys`, `new` and `list`: what there is to set, and a scenario to begin with."""

import json
from pathlib import Path

import pytest

from atlas_cueing.cueing import METHODS
from atlas_cueing.scenario import load_platform, load_scenario
from atlas_cueing.scenario.cueing_table import TABLES
from atlas_cueing.scenario.keys import KeyEntry, keys
from atlas_cueing.scenario.platform_file import Platform
from atlas_cueing.scenario.scenario import ScenarioFile
from atlas_cueing.scenario.tables import ScenarioTable, tables_in
from atlas_cueing.scenario.vehicle_table import SOURCES

from .conftest import Command


def names(table: dict[str, object], before: str) -> set[str]:
    """Dotted keys of a dumped table; of lists of tables with N."""
    found: set[str] = set()
    for key, value in table.items():
        tables = isinstance(value, list | tuple) and value and isinstance(value[0], dict)
        if isinstance(value, dict):
            found |= names(value, f"{before}{key}.")
        elif value is None or value == ():
            continue
        elif tables:
            found |= names(value[0], f"{before}{key}.N.")  # type: ignore[index]
        else:
            found.add(f"{before}{key}")
    return found


def test_every_key_of_files_is_listed() -> None:
    listed = {entry.key for entry in keys()}
    assert names(load_platform("atlas-2.9m").model_dump(), "platform.") <= listed
    for table in TABLES.values():
        assert names(table().model_dump(), "cueing.") <= listed
    inner = ("initial", "input", "signal")  # tables of tables
    for source in SOURCES.values():
        own = {f"vehicle.{key}" for key in source.model_fields if key not in inner}
        assert own <= listed
    assert {"name", "duration_s", "recording.skip", "sweep.KEY"} <= listed


def test_what_is_listed_is_what_is_declared() -> None:
    (rate,) = (entry for entry in keys("cueing.align_rate_deg_s") if "blend" in entry.of)
    parameter = next(p for p in METHODS["blend"].parameters if p.key == "align_rate_deg_s")
    assert (rate.default, rate.unit) == (parameter.default(METHODS["blend"].defaults), "deg/s")
    assert rate.allowed == f"a number, {parameter.allowed}"
    assert rate.meaning.startswith(parameter.description)
    (stiffness,) = keys("platform.wheel.N.stiffness_n_m")
    assert stiffness.unit == "N/m"


def test_every_key_has_a_meaning_of_its_own() -> None:
    """And not the first line of its table, which says nothing of the key."""
    about = {str(table.__doc__).partition("\n")[0].rstrip(".") for table in inner_tables()} - {""}
    assert "`[sphere]`" in about
    for entry in keys():
        assert entry.meaning, entry.key
        assert entry.meaning not in about, entry.key


def inner_tables() -> list[type[ScenarioTable]]:
    """Every table of the files."""
    tables: list[type[ScenarioTable]] = [*SOURCES.values(), Platform, ScenarioFile]
    for table in tables:
        tables += [t for f in table.model_fields.values() for t in tables_in(f.annotation)]
    return tables


def test_keys_of_one_method(command: Command) -> None:
    for method, table in TABLES.items():
        listed = keys(method=method)
        assert {entry.of for entry in listed} == {f"method {method}"}
        assert names(table().model_dump(), "cueing.") <= {entry.key for entry in listed}
        assert len({entry.key for entry in listed}) == len(listed)
    shown = command("keys", "cueing.stage", "--method", "hedge").out
    assert "cueing.stage.horizon_s = 5.0 [s] (method hedge)" in shown
    assert "atlas-cueing keys --method hedge" in command("keys", "cueing.hedge").err
    wrong = command("keys", "--method", "hedges")
    assert (wrong.status, "--method hedges: allowed: " in wrong.err) == (2, True)
    assert "no key of method hedge begins with 'x'" in command("keys", "x", "--method", "hedge").err


def test_a_key_of_another_unit_and_a_word() -> None:
    (drag,) = keys("vehicle.drag_per_m")
    assert drag.unit == "1/m"
    (report,) = keys("platform.traction.report")
    assert report.allowed == "'remark' or 'finding'"


@pytest.mark.parametrize("entry", keys("cueing."), ids=lambda entry: f"{entry.key} {entry.of}")
@pytest.mark.usefixtures("command")
def test_a_default_is_accepted(entry: KeyEntry) -> None:
    method = entry.of.split()[1].strip(",")
    if entry.default is not None:
        settings = [f"cueing.method={method}", f"{entry.key}={entry.written}"]
        load_scenario("s.toml", settings)


def test_keys_by_their_beginning(command: Command) -> None:
    assert all(line.startswith("recording.") for line in command("keys", "rec").out.splitlines())
    table = json.loads(command("keys", "duration_s", "--json").out)
    assert table["keys"][0]["allowed"] == "a number, 0 < value <= 86400"
    refused = command("keys", "nothing")
    assert (refused.status, refused.out) == (2, "")
    assert "no key begins with 'nothing'" in refused.err


def test_a_new_scenario_flies_with_every_comment_taken_out(command: Command) -> None:
    assert command("new", "mine").status == 0
    text = Path("mine.toml").read_text()
    assert command("run", "mine.toml", "--set", "duration_s=0.5").status == 0
    bare = [line.removeprefix("# ") for line in text.splitlines()[1:]]
    Path("bare.toml").write_text("\n".join(bare))
    assert load_scenario("bare.toml").file == load_scenario("mine.toml").file
    again = command("new", "mine")
    assert (again.status, Path("mine.toml").read_text()) == (2, text)
    assert command("new", "../mine").status == 2
    assert command("new", "yours.toml").status == 0
    assert {path.name for path in Path().glob("yours*")} == {"yours.toml"}
    assert 'name = "yours"' in Path("yours.toml").read_text()


def test_lists(command: Command) -> None:
    assert "f16" in command("list", "aircraft").out.splitlines()
    assert "c1722" in command("list", "scripts").out.splitlines()
    assert "fcs/aileron-cmd-norm (RW)" in command("list", "properties", "f16").out.splitlines()
    assert command("list", "properties", "nothing").status == 2
    assert command("list", "engines").status == 2
    assert "of which aircraft? as: atlas-cueing list properties f16" in (
        command("list", "properties").err
    )
    assert "allowed: list aircraft, without 'f16'" in command("list", "aircraft", "f16").err
