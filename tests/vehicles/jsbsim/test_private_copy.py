from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.vehicles import own_aircraft, own_scripts
from atlas_cueing.vehicles.jsbsim.private_copy import (
    MAX_DEPTH,
    MAX_FILE_BYTES,
    copy_aircraft,
    copy_script,
)
from atlas_cueing.vehicles.jsbsim.user_models import MAX_USERS_BYTES, read_users

from ..flying import event, write_script

OUTPUT = '<output name="127.0.0.1" type="SOCKET" protocol="TCP" port="45999" rate="10"/>'


def parsed(path: Path) -> ET.Element:
    return ET.parse(path).getroot()  # noqa: S314  JSBSim's own files and ours


def test_outputs_and_ports_of_a_script_are_left_out_and_the_rest_is_kept(tmp_path: Path) -> None:
    script = write_script(
        tmp_path / "s.xml",
        event("fcs/elevator-cmd-norm", "1"),
        OUTPUT + '<input port="45998"/>' + OUTPUT,
    )
    _, copy = copy_script(script, tmp_path / "a")
    tags = [element.tag for element in parsed(copy)]
    assert tags == ["use", "run"]
    assert "45999" not in copy.read_text()
    assert "elevator-cmd-norm" in copy.read_text()


# all that have some
@pytest.mark.parametrize("name", ["c172x", "737", "B17", "ball", "global5000", "pogo-jsbsim"])
def test_outputs_and_ports_of_a_model_are_left_out_but_signals_are_kept(
    name: str, tmp_path: Path
) -> None:
    original = parsed(own_aircraft()[name])
    copy = parsed(copy_aircraft(name, tmp_path) / name / f"{name}.xml")
    ports = [element for element in original if element.tag in ("input", "output")]
    assert ports, "the original has nothing to leave out: test another aircraft"
    assert [e.tag for e in copy if isinstance(e.tag, str)] == [
        e.tag for e in original if e not in ports
    ]
    signals = [
        (e.tag, e.text)
        for e in original.findall(".//flight_control//*") + original.findall(".//autopilot//*")
    ]
    assert signals == [
        (e.tag, e.text)
        for e in copy.findall(".//flight_control//*") + copy.findall(".//autopilot//*")
    ]


def test_files_beside_the_model_are_within_reach_and_the_original_is_not_touched(
    tmp_path: Path,
) -> None:
    before = own_aircraft()["c172x"].read_bytes()
    copies = copy_aircraft("c172x", tmp_path) / "c172x"
    assert {path.name for path in copies.iterdir()} == {
        path.name for path in own_aircraft()["c172x"].parent.iterdir()
    }
    assert not (copies / "c172x.xml").is_symlink()
    assert own_aircraft()["c172x"].read_bytes() == before


def test_initial_conditions_beside_the_script_win_over_those_of_the_aircraft(
    tmp_path: Path,
) -> None:
    script = write_script(tmp_path / "s.xml", initialize="mine")
    (tmp_path / "mine.xml").write_text("<initialize><altitude>7</altitude></initialize>")
    for name in ("mine", "mine.xml"):
        script = write_script(tmp_path / "s.xml", initialize=name)
        tree, _ = copy_script(script, tmp_path / f"for {name}")
        copy = Path(tree.find("use").get("initialize", ""))  # type: ignore[union-attr]
        assert copy == tmp_path / f"for {name}" / "mine.xml", (
            "a copy, which nobody changes between our look and JSBSim's"
        )
        assert parsed(copy).findtext("altitude") == "7"


def test_initial_conditions_of_the_aircraft_keep_their_name(tmp_path: Path) -> None:
    tree, _ = copy_script(write_script(tmp_path / "s.xml"), tmp_path / "a")
    assert tree.find("use").get("initialize") == "reset01"  # type: ignore[union-attr]


@pytest.mark.parametrize(
    "name", ["../secret", "/etc/fstab", "a/../../secret", "..\\secret", "a b", "x\ty", "\u0130"]
)
def test_initial_conditions_elsewhere_are_refused(name: str, tmp_path: Path) -> None:
    """JSBSim would open them, and say what is in them when they are not what it wants."""
    folder = tmp_path / "in"
    folder.mkdir()
    (tmp_path / "secret.xml").write_text("<initialize/>")
    with pytest.raises(InputError, match=r"s\.xml: initialize = .*allowed: a file's name"):
        copy_script(write_script(folder / "s.xml", initialize=name), tmp_path / "a")


def test_a_link_that_leads_elsewhere_is_not_followed(tmp_path: Path) -> None:
    folder = tmp_path / "in"
    folder.mkdir()
    (tmp_path / "secret.xml").write_text("<initialize/>")
    (folder / "link.xml").symlink_to(tmp_path / "secret.xml")
    tree, _ = copy_script(write_script(folder / "s.xml", initialize="link"), tmp_path / "a")
    assert tree.find("use").get("initialize") == "link", (
        "left to the aircraft's own folder, where there is none"
    )


@pytest.mark.parametrize("name", ["round", "x" * 300])
def test_a_link_that_leads_nowhere_is_none(tmp_path: Path, name: str) -> None:
    (tmp_path / "round.xml").symlink_to(tmp_path / "round.xml")
    tree, _ = copy_script(write_script(tmp_path / "s.xml", initialize=name), tmp_path / "a")
    assert tree.find("use").get("initialize") == name, "left to the aircraft's own folder"


@pytest.mark.parametrize("where", ["script", "initial"])
def test_references_to_files_are_refused(where: str, tmp_path: Path) -> None:
    inside = '<event><set name="x" file="/etc/passwd"/></event>'
    (tmp_path / "mine.xml").write_text(
        f"<initialize>{inside if where == 'initial' else ''}</initialize>"
    )
    script = write_script(
        tmp_path / "s.xml", inside if where == "script" else "", initialize="mine"
    )
    with pytest.raises(
        InputError, match=r"<set file='/etc/passwd'>, allowed: no references to files"
    ):
        copy_script(script, tmp_path / "a")


def test_initial_conditions_are_scanned_as_the_script_is(tmp_path: Path) -> None:
    (tmp_path / "mine.xml").write_text("<initialize>" + "<a>" * 200_000)
    with pytest.raises(InputError, match=rf"mine\.xml: elements nested deeper than {MAX_DEPTH}"):
        copy_script(write_script(tmp_path / "s.xml", initialize="mine"), tmp_path / "a")


def test_a_users_file_is_small(tmp_path: Path) -> None:
    script = write_script(tmp_path / "s.xml", f"<!--{'x' * MAX_USERS_BYTES}-->")
    with pytest.raises(InputError, match=f"at most {MAX_USERS_BYTES}"):
        copy_script(script, tmp_path / "a")
    with pytest.raises(InputError, match=f"allowed: size <= {MAX_USERS_BYTES}"):
        read_users(script)
    with pytest.raises(InputError, match="cannot be read: No such file"):
        read_users(tmp_path / "gone.xml")
    assert read_users(write_script(script)) == script.read_bytes()


def test_lines_keep_their_numbers_through_comments(tmp_path: Path) -> None:
    script = own_scripts()["c172_elevator_doublet"]
    _, copy = copy_script(script, tmp_path)
    lines = [
        next(n for n, line in enumerate(p.read_text().splitlines()) if "Re-Trim" in line)
        for p in (script, copy)
    ]
    assert abs(lines[0] - lines[1]) <= 3  # the head of the file is joined


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "not a readable XML file: no element found"),
        ("hello", "not a readable XML file: syntax error"),
        ("<runscript>", "not a readable XML file"),
        ('<?xml version="1.0" encoding="foo"?><runscript/>', "not a readable XML file"),
        ("<output/>", "root element is <output>, must be <runscript>"),
        ("<runscript/>", "0 elements <use>, allowed: one"),
        (
            '<runscript><use aircraft="c172x"/><use aircraft="f16"/></runscript>',
            "2 elements <use>, allowed: one",
        ),
        ("<runscript><use/></runscript>", "no aircraft '' in JSBSim"),
        (
            '<runscript><use aircraft="c127x"/></runscript>',
            "no aircraft 'c127x' in JSBSim; did you mean 'c172x'",
        ),
        ('<runscript><use aircraft="../../x"/></runscript>', "no aircraft '../../x' in JSBSim"),
        ("<runscript>" + "<a>" * 200_000, f"nested deeper than {MAX_DEPTH}"),
        (
            '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa">'
            + "".join(
                f'<!ENTITY {b} "{f"&{a};" * 30}">' for a, b in zip("abcdef", "bcdefg", strict=True)
            )
            + "]><runscript>&g;</runscript>",
            "not a readable XML file",
        ),
    ],
)
def test_what_is_not_a_script_is_refused(text: str, complaint: str, tmp_path: Path) -> None:
    script = tmp_path / "s.xml"
    script.write_text(text)
    with pytest.raises(InputError, match=f"s.xml: .*{complaint}"):
        copy_script(script, tmp_path)


def test_missing_folders_and_huge_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="not a readable XML file"):
        copy_script(tmp_path / "missing.xml", tmp_path)
    with pytest.raises(InputError, match="not a readable XML file"):
        copy_script(tmp_path, tmp_path)


def test_a_huge_model_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("atlas_cueing.vehicles.jsbsim.private_copy.root", lambda: tmp_path)
    huge = tmp_path / "huge.xml"
    with huge.open("wb") as file:
        file.truncate(MAX_FILE_BYTES + 1)
    with pytest.raises(InputError, match="at most 20000000"):
        copy_script(huge, tmp_path)
