import os
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.vehicles import own_aircraft, own_scripts
from atlas_cueing.vehicles.private_copy import MAX_DEPTH, MAX_FILE_BYTES, copy_aircraft, copy_script

from .flying import event, write_script

OUTPUT = '<output name="127.0.0.1" type="SOCKET" protocol="TCP" port="45999" rate="10"/>'


def parsed(path: Path) -> ET.Element:
    return ET.parse(path).getroot()  # noqa: S314  JSBSim's own files and ours


def test_outputs_and_ports_of_a_script_are_left_out_and_the_rest_is_kept(tmp_path: Path) -> None:
    script = write_script(tmp_path / "s.xml", event("fcs/elevator-cmd-norm", "1"), OUTPUT + '<input port="45998"/>' + OUTPUT)
    _, copy = copy_script(script, tmp_path / "a")
    tags = [element.tag for element in parsed(copy)]
    assert tags == ["use", "run"]
    assert "45999" not in copy.read_text()
    assert "elevator-cmd-norm" in copy.read_text()


@pytest.mark.parametrize("name", ["c172x", "737", "B17", "ball", "global5000", "pogo-jsbsim"])  # all that have some
def test_outputs_and_ports_of_a_model_are_left_out_but_signals_are_kept(name: str, tmp_path: Path) -> None:
    original = parsed(own_aircraft()[name])
    copy = parsed(copy_aircraft(name, tmp_path) / name / f"{name}.xml")
    ports = [element for element in original if element.tag in ("input", "output")]
    assert ports, "the original has nothing to leave out: test another aircraft"
    assert [e.tag for e in copy if isinstance(e.tag, str)] == [e.tag for e in original if e not in ports]
    signals = [(e.tag, e.text) for e in original.findall(".//flight_control//*") + original.findall(".//autopilot//*")]
    assert signals == [(e.tag, e.text) for e in copy.findall(".//flight_control//*") + copy.findall(".//autopilot//*")]


def test_files_beside_the_model_are_within_reach_and_the_original_is_not_touched(tmp_path: Path) -> None:
    before = own_aircraft()["c172x"].read_bytes()
    copies = copy_aircraft("c172x", tmp_path) / "c172x"
    assert {path.name for path in copies.iterdir()} == {path.name for path in own_aircraft()["c172x"].parent.iterdir()}
    assert not (copies / "c172x.xml").is_symlink()
    assert own_aircraft()["c172x"].read_bytes() == before


def test_initial_conditions_beside_the_script_win_over_those_of_the_aircraft(tmp_path: Path) -> None:
    script = write_script(tmp_path / "s.xml", initialize="mine")
    (tmp_path / "mine.xml").write_text("<initialize/>")
    tree, _ = copy_script(script, tmp_path / "a")
    assert tree.find("use").get("initialize") == os.path.realpath(tmp_path / "mine.xml")  # type: ignore[union-attr]


def test_lines_keep_their_numbers_through_comments(tmp_path: Path) -> None:
    script = own_scripts()["c172_elevator_doublet"]
    _, copy = copy_script(script, tmp_path)
    lines = [next(n for n, line in enumerate(p.read_text().splitlines()) if "Re-Trim" in line) for p in (script, copy)]
    assert abs(lines[0] - lines[1]) <= 3  # the head of the file is joined


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "not a readable XML file: no element found"),
        ("hello", "not a readable XML file: syntax error"),
        ("<runscript>", "not a readable XML file"),
        ('<?xml version="1.0" encoding="foo"?><runscript/>', "not a readable XML file"),
        ("<output/>", "root element is <output>, must be <runscript>"),
        ("<runscript/>", "no aircraft '' in JSBSim"),
        ('<runscript><use aircraft="c127x"/></runscript>', "no aircraft 'c127x' in JSBSim; did you mean 'c172x'"),
        ('<runscript><use aircraft="../../x"/></runscript>', "no aircraft '../../x' in JSBSim"),
        ("<runscript>" + "<a>" * 200_000, f"nested deeper than {MAX_DEPTH}"),
        (
            '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa">'
            + "".join(f'<!ENTITY {b} "{f"&{a};" * 30}">' for a, b in zip("abcdef", "bcdefg", strict=True))
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
    huge = tmp_path / "huge.xml"
    with huge.open("wb") as file:
        file.truncate(MAX_FILE_BYTES + 1)
    with pytest.raises(InputError, match="at most 20000000"):
        copy_script(huge, tmp_path)
