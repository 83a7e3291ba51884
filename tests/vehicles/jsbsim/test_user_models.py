"""Aircraft of a user's own: their files, and that nothing outside of the folder is read."""

import shutil
import socket
from dataclasses import replace
from pathlib import Path

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.vehicles import (
    AircraftFlight,
    InitialConditions,
    JsbsimVehicle,
    ScriptFlight,
    own_aircraft,
)
from atlas_cueing.vehicles.jsbsim.library import root
from atlas_cueing.vehicles.jsbsim.loading import load
from atlas_cueing.vehicles.jsbsim.user_models import (
    MAX_USERS_BYTES,
    aircraft_objection,
    user_files,
    user_model,
)

from ..flying import cessna, fly, write_script


def mine(folder: Path, of: str = "c172x", name: str = "mymodel", *, engines: bool = False) -> Path:
    """A copy of one of JSBSim's aircraft under another name; gives the model.

    Perhaps with copies of all its engines.
    """
    home = folder / "aircraft" / name
    shutil.copytree(own_aircraft()[of].parent, home)
    (home / f"{of}.xml").rename(home / f"{name}.xml")
    if engines:
        shutil.copytree(root() / "engine", folder / "engine")
    return home / f"{name}.xml"


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def flight(folder: Path, name: str = "mymodel") -> AircraftFlight:
    return replace(cessna(), aircraft=name, models=folder)


@pytest.mark.parametrize("engines", [False, True])
@pytest.mark.parametrize(
    "of", ["c172x", "f16", "737", "F450", "J3Cub", "ah1s", "Short_S23", "A320"]
)
def test_a_copy_flies_as_the_aircraft_that_it_is_a_copy_of(
    of: str, engines: bool, tmp_path: Path
) -> None:
    mine(tmp_path, of, engines=engines)
    initial = InitialConditions(altitude=1500.0, airspeed=60.0)
    own = AircraftFlight(of, initial)
    copy = replace(own, aircraft="mymodel", models=tmp_path)
    assert fly(JsbsimVehicle(copy)) == fly(JsbsimVehicle(own))


def test_engines_beside_it_go_before_jsbsims_own(tmp_path: Path) -> None:
    mine(tmp_path, engines=True)
    edit(
        tmp_path / "engine" / "eng_io320.xml",
        '<displacement unit="IN3"> 320.0',
        '<displacement unit="IN3"> 330.0',
    )
    strong, own = (fly(JsbsimVehicle(one), 0.5)[-1] for one in (flight(tmp_path), cessna()))
    assert strong != own


def test_systems_beside_it_and_with_it_are_found(tmp_path: Path) -> None:
    model = mine(tmp_path)
    system = '<system name="x"><property value="{}">my/{}</property></system>'
    places = {"systems": "shared", "aircraft/mymodel": "home", "aircraft/mymodel/Systems": "kept"}
    for value, (place, name) in enumerate(places.items()):
        (tmp_path / place).mkdir(exist_ok=True)
        (tmp_path / place / f"{name}.xml").write_text(system.format(value + 1, name))
    edit(
        model,
        "</fdm_config>",
        "".join(f'<system file="{name}"/>' for name in places.values()) + "</fdm_config>",
    )
    assert set(user_files("mymodel", tmp_path)) >= {
        f"{place}/{name}.xml" for place, name in places.items()
    }
    fdm = load(flight(tmp_path))
    assert [fdm[f"my/{name}"] for name in places.values()] == [1.0, 2.0, 3.0]


def test_a_script_beside_it_flies_it_with_its_own_initial_conditions(tmp_path: Path) -> None:
    mine(tmp_path)
    (tmp_path / "scripts").mkdir()
    script = write_script(tmp_path / "scripts" / "s.xml", aircraft="mymodel", initialize="reset01")
    own = write_script(tmp_path / "scripts" / "own.xml", initialize="reset01")
    assert fly(JsbsimVehicle(ScriptFlight(script, models=tmp_path))) == fly(
        JsbsimVehicle(ScriptFlight(own))
    )
    assert "aircraft/mymodel/reset01.xml" in user_files("mymodel", tmp_path, "reset01")
    with pytest.raises(InputError, match=r"s\.xml: no aircraft 'mymodel' in JSBSim"):
        JsbsimVehicle(ScriptFlight(script))


def test_its_outputs_and_inputs_are_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = mine(tmp_path)
    (model.parent / "out.xml").write_text(f'<output name="{tmp_path}/c.csv" type="CSV" rate="10"/>')
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    ports = (
        f'<output name="{tmp_path}/b.csv" type="CSV" rate="10"/><output file="out"/><input'
        f' port="{port}"/>'
    )
    edit(model, "</fdm_config>", f"{ports}</fdm_config>")
    monkeypatch.chdir(tmp_path)
    before = set(tmp_path.rglob("*"))
    fly(JsbsimVehicle(flight(tmp_path)))
    assert set(tmp_path.rglob("*")) == before
    with socket.socket() as other:
        other.bind(("127.0.0.1", port))


@pytest.mark.parametrize(
    "bad", ["/etc/passwd", "../../secret", "a/../b", ".hidden", "a//b", "~/x", "a\\b"]
)
def test_a_file_that_leads_elsewhere_is_refused(bad: str, tmp_path: Path) -> None:
    model = mine(tmp_path / "in")
    (tmp_path / "secret.xml").write_text("<system/>")
    edit(model, "</fdm_config>", f'<system file="{bad}"/></fdm_config>')
    assert all(
        path.is_relative_to(tmp_path / "in")
        for path in user_files("mymodel", tmp_path / "in").values()
    )
    with pytest.raises(
        InputError, match=r"mymodel\.xml: <system file=.*>, allowed: a path of plain names"
    ):
        load(flight(tmp_path / "in"))


def test_links_that_lead_elsewhere_are_not_followed(tmp_path: Path) -> None:
    model = mine(tmp_path / "out")
    (tmp_path / "in" / "aircraft").mkdir(parents=True)
    (tmp_path / "in" / "aircraft" / "mymodel").symlink_to(model.parent)
    assert user_model("mymodel", tmp_path / "in") is None
    model = mine(tmp_path / "in", name="linked")
    (model.parent / "x.xml").symlink_to(tmp_path / "out" / "aircraft" / "mymodel" / "reset01.xml")
    edit(model, "</fdm_config>", '<system file="x"/></fdm_config>')
    assert "aircraft/linked/x.xml" not in user_files("linked", tmp_path / "in")


def test_a_name_that_jsbsim_has_too_is_refused_unless_it_says_which(tmp_path: Path) -> None:
    mine(tmp_path, name="c172x")
    assert "for the latter" in aircraft_objection("c172x", tmp_path)
    assert aircraft_objection("./c172x", tmp_path) == aircraft_objection("f16", tmp_path) == ""
    assert load(flight(tmp_path, "./c172x")).get_model_name() == "c172x"
    with pytest.raises(
        InputError,
        match=r"JSBSim ships an aircraft 'c172x', and there is one in .*allowed: './c172x'",
    ):
        load(flight(tmp_path, "c172x"))


@pytest.mark.parametrize(
    "name",
    ["", ".", "..", "../mymodel", "aircraft/mymodel", "/", "my\0model", "x" * 5000, "mymodel/"],
)
def test_what_is_no_name_finds_nothing(name: str, tmp_path: Path) -> None:
    mine(tmp_path)
    assert user_model(name, tmp_path) is None
    assert "no aircraft" in aircraft_objection(name, tmp_path)


def test_what_is_wrong_with_it_is_told_of_the_users_file(tmp_path: Path) -> None:
    model = mine(tmp_path)
    whole = model.read_text()
    for text, told in (
        ("hello", "not a readable XML file"),
        ("<runscript/>", "root element is <runscript>, must be <fdm_config>"),
        ("<a>" * 300, "nested deeper"),
        (whole + " " * MAX_USERS_BYTES, "too large"),
        (
            whole.replace("<mass_balance", "<nothing").replace("</mass_balance", "</nothing"),
            "JSBSim cannot load it",
        ),
        (whole.replace('file="eng_io320"', 'file="none"'), "JSBSim cannot load it"),
    ):
        model.write_text(text)
        with pytest.raises(InputError, match=told) as caught:
            load(flight(tmp_path))
        assert "atlas_cueing_" not in str(caught.value), "the private copy is nobody's business"


def test_too_many_files_are_refused(tmp_path: Path) -> None:
    model = mine(tmp_path)
    for i in range(110):
        (model.parent / f"s{i}.xml").write_text("<system/>")
    edit(
        model,
        "</fdm_config>",
        "".join(f'<system file="s{i}"/>' for i in range(110)) + "</fdm_config>",
    )
    with pytest.raises(InputError, match="names too many files, allowed: at most 100"):
        user_files("mymodel", tmp_path)
