"""What is wrong with a CSV file or a map, told with line, column and value."""

import os
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError, ScenarioError
from atlas_cueing.flight_data import import_flight, known_maps, load_map

from .truth import plain_csv, truth

FLOWN = truth(np.arange(300) / 100.0)


def lines_of(folder: Path) -> list[str]:
    return plain_csv(folder / "a.csv", FLOWN).read_text().splitlines()


def cell(line: str, column: int, text: str) -> str:
    cells = line.split(",")
    cells[column] = text
    return ",".join(cells)


@pytest.mark.parametrize(
    ("column", "text", "told"),
    [
        (1, "abc", r"a\.csv: line 51, column 'fx' = 'abc', allowed: a finite number"),
        (4, "inf", r"line 51, column 'wx' = 'inf', allowed: a finite number"),
        (4, "nan", r"line 51, column 'wx' = 'nan', allowed: a finite number"),
        (0, "1e999", r"line 51, column 'time_s' = '1e999'"),
        (2, "", r"line 51: fy = nan, allowed: a finite number, or none in all of fx, fy, fz"),
        (3, "1e5", r"0\.490000 s, near line 51: specific force 1e\+05 m/s\^2, .*force\.unit"),
        (5, "500", r"near line 51: angular rate 500 rad/s, allowed: 0 <= value <= 50; is rate"),
        (0, "-3", r"line 51: time_s goes back by 3\.48 s"),
        (1, "x" * 300, r"line 51, column 'fx' = 'x{40}\.\.\.'"),
    ],
)
def test_a_bad_cell(tmp_path: Path, column: int, text: str, told: str) -> None:
    lines = lines_of(tmp_path)
    lines[50] = cell(lines[50], column, text)
    (tmp_path / "a.csv").write_text("\n".join(lines))
    with pytest.raises(InputError, match=told):
        import_flight(tmp_path / "a.csv", load_map("csv"))


def test_a_short_line_and_a_bad_header(tmp_path: Path) -> None:
    lines = lines_of(tmp_path)
    for text, told in (
        (
            "\n".join([*lines[:20], "0.19,1,2", *lines[20:]]),
            r"line 21: 3 columns, so none called 'fz'",
        ),
        ("\n".join(lines[1:]), r"no column 'time_s' or 'time' or 't' \(time\.column of the map\)"),
        (lines[0].replace("fx", "fy") + "\n1", "no column 'fx'"),
        (lines[0].replace("qw", "fy") + "\n1", "2 columns are called 'fy'"),
        (lines[0] + "\n", "no numbers below the header"),
        (
            "\n".join(lines[:5]),
            r"samples of fx, fy, fz with times of their own, allowed: at least 8",
        ),
        ("\n".join(lines[:40]), r"have 0\.380 s in common without a gap, allowed: 1 s or more"),
        ("a\0b\n", "line 1: a zero byte"),
    ):
        (tmp_path / "a.csv").write_text(text)
        with pytest.raises(InputError, match=told):
            import_flight(tmp_path / "a.csv", load_map("csv"))
    (tmp_path / "a.csv").write_bytes(b"time_s,\xff\xfe\n")
    with pytest.raises(InputError, match="line 1: not UTF-8 text: byte 8"):
        import_flight(tmp_path / "a.csv", load_map("csv"))
    os.mkfifo(tmp_path / "pipe")
    for path, told in (
        (tmp_path, "is a folder"),
        (tmp_path / "none", "no such file"),
        (tmp_path / "pipe", "not a regular file"),
    ):
        with pytest.raises(InputError, match=told):
            import_flight(path, load_map("csv"))


def test_a_line_longer_than_the_header(tmp_path: Path) -> None:
    lines = lines_of(tmp_path)
    count = len(lines[0].split(","))
    (tmp_path / "a.csv").write_text("\n".join([*lines[:30], f"{lines[30]},7", *lines[31:]]))
    told = rf"a\.csv: line 31: {count + 1} columns, allowed: the {count} of the header; are its"
    with pytest.raises(InputError, match=told):
        import_flight(tmp_path / "a.csv", load_map("csv"))
    (tmp_path / "a.csv").write_text("\n".join([lines[0], *(f"{line}, ," for line in lines[1:])]))
    found = import_flight(tmp_path / "a.csv", load_map("csv"))
    assert np.array_equal(found.flights[0].f_B, FLOWN.f_B), "delimiters at the end are no columns"


@pytest.mark.parametrize("delimiter", [";", "\t"])
def test_decimal_commas(tmp_path: Path, delimiter: str) -> None:
    lines = lines_of(tmp_path)
    german = [line.replace(",", delimiter).replace(".", ",") for line in lines]
    (tmp_path / "a.csv").write_text("\n".join(german))
    found = import_flight(tmp_path / "a.csv", load_map("csv", ["csv.decimal=','"]))
    assert np.array_equal(found.flights[0].f_B, FLOWN.f_B)
    assert np.array_equal(found.flights[0].q_NB, imported_as_it_is(tmp_path))
    with pytest.raises(InputError, match=r"line 2, column 'time_s' = '0,0', .*csv\.decimal"):
        import_flight(tmp_path / "g.csv", load_map("csv"))
    thousands = german[10].split(delimiter)
    thousands[1] = "1.234,5"
    (tmp_path / "a.csv").write_text("\n".join([*german[:10], delimiter.join(thousands)]))
    with pytest.raises(InputError, match=r"line 11, column 'fx' = '1\.234,5'"):
        import_flight(tmp_path / "a.csv", load_map("csv", ["csv.decimal=,"]))


@pytest.mark.parametrize("delimiter", [",", ", ", ";", "\t"])
@pytest.mark.parametrize("settings", [[], ["csv.delimiter=','"]])
def test_decimal_commas_within_quotes(tmp_path: Path, delimiter: str, settings: list[str]) -> None:
    """Also where commas part the columns, as spreadsheets write them."""
    head, *lines = lines_of(tmp_path)
    rows = [[f'"{cell}"' for cell in line.replace(".", "!").split(",")] for line in lines]
    german = [delimiter.join(row).replace("!", ",") for row in rows if len(row) > 1]
    header = delimiter.join(head.split(","))
    (tmp_path / "a.csv").write_text("\n".join([header, *german]))
    own = [setting.replace("','", f"'{delimiter.strip(' ')}'") for setting in settings]
    found = import_flight(tmp_path / "a.csv", load_map("csv", ["csv.decimal=','", *own]))
    assert np.array_equal(found.flights[0].f_B, FLOWN.f_B)
    with pytest.raises(InputError, match=r"line 2, column 'time_s' = '0,0', .*csv\.decimal"):
        import_flight(tmp_path / "a.csv", load_map("csv", own))


def test_decimal_commas_among_commas_without_quotes_are_refused(tmp_path: Path) -> None:
    head, *lines = lines_of(tmp_path)
    (tmp_path / "a.csv").write_text("\n".join([head, *(each.replace(".", ",") for each in lines)]))
    for settings in ([], ["csv.decimal=','"]):
        with pytest.raises(InputError, match=r"line 2: \d+ columns.*or quotes around each number"):
            import_flight(tmp_path / "a.csv", load_map("csv", settings))


def imported_as_it_is(folder: Path) -> np.ndarray:
    """Attitude of the same file with points; the one with commas is kept as g.csv."""
    (folder / "a.csv").rename(folder / "g.csv")
    plain_csv(folder / "a.csv", FLOWN)
    return import_flight(folder / "a.csv", load_map("csv")).flights[0].q_NB


def test_lines_that_end_with_cr_alone(tmp_path: Path) -> None:
    lines = lines_of(tmp_path)
    for end in ("\r", ""):
        (tmp_path / "a.csv").write_bytes(("\r".join(lines) + end).encode())
        found = import_flight(tmp_path / "a.csv", load_map("csv"))
        assert np.array_equal(found.flights[0].f_B, FLOWN.f_B)
    lines[20] = cell(lines[20], 2, "abc")
    (tmp_path / "a.csv").write_bytes("\r".join(lines).encode())
    with pytest.raises(InputError, match="line 21, column 'fy' = 'abc'"):
        import_flight(tmp_path / "a.csv", load_map("csv"))


@pytest.mark.parametrize(
    ("line", "text"), [(0, 'time_s\rx,"fx"'), (20, '"0.19\r",1,2'), (20, f'"{"7" * 200_000}"')]
)
def test_what_csv_itself_refuses(tmp_path: Path, line: int, text: str) -> None:
    lines = lines_of(tmp_path)
    lines[line] = text
    (tmp_path / "a.csv").write_bytes("\n".join(lines).encode())
    with pytest.raises(InputError, match=rf"a\.csv: line {line + 1}: "):
        import_flight(tmp_path / "a.csv", load_map("csv"))


def test_some_columns_of_an_attitude_are_not_none(tmp_path: Path) -> None:
    lines = lines_of(tmp_path)
    lines[0] = lines[0].replace("qy", "other")
    (tmp_path / "a.csv").write_text("\n".join(lines))
    told = (
        r"has 'qw', 'qx', 'qz' of attitude\.columns of the map, but not 'qy' or 'q_nb_y', allowed:"
        " all 4 of them, or none"
    )
    with pytest.raises(InputError, match=told):
        import_flight(tmp_path / "a.csv", load_map("csv"))


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_how_it_may_be_written(tmp_path: Path, delimiter: str) -> None:
    """A mark before the text, comments, blank lines, quotes, lines above the header, CR LF."""
    lines = lines_of(tmp_path)
    lines[0] = ",".join(f'"{name}"' for name in lines[0].split(","))
    lines[1:1] = ["# a comment", ""]
    text = "\r\n".join(["recorded by x", *(line.replace(",", delimiter) for line in lines)])
    (tmp_path / "a.csv").write_text(text, encoding="utf-8-sig", newline="")
    found = import_flight(tmp_path / "a.csv", load_map("csv", ["csv.header_line=2"]))
    assert np.array_equal(found.flights[0].f_B, FLOWN.f_B)


def test_units_in_the_header(tmp_path: Path) -> None:
    lines = lines_of(tmp_path)
    lines[0] = "t [s],ax (g),ay (g),az (g),P (deg/s),Q (deg/s),R (deg/s),qw,qx,qy,qz"
    for k in range(1, len(lines)):
        numbers = [float(x) for x in lines[k].split(",")]
        numbers[1:4] = [x / 9.80665 for x in numbers[1:4]]
        numbers[4:7] = np.degrees(numbers[4:7]).tolist()
        lines[k] = ",".join(map(repr, numbers))
    (tmp_path / "a.csv").write_text("\n".join(lines))
    text = known_maps()["csv"].read_text()
    for unit in ('unit = "s"\n', 'unit = "m/s2"\n', 'unit = "rad/s"\n'):
        text = text.replace(unit, "")
    columns = (
        *("time.column='t [s]'", "force.columns=['ax (g)', 'ay (g)', 'az (g)']"),
        "rate.columns=['P (deg/s)', 'Q (deg/s)', 'R (deg/s)']",
    )
    (tmp_path / "m.toml").write_text(text)
    (flight,) = import_flight(
        tmp_path / "a.csv", load_map(str(tmp_path / "m.toml"), columns)
    ).flights
    assert np.abs(flight.f_B - FLOWN.f_B).max() < 1e-12
    assert np.abs(flight.w_NB_B - FLOWN.w_B).max() < 1e-12
    with pytest.raises(InputError, match=r"column 'qw' names no unit; set force\.unit of the map"):
        import_flight(
            tmp_path / "a.csv",
            load_map(str(tmp_path / "m.toml"), [*columns, "force.columns=['qw', 'qx', 'qy']"]),
        )


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        (["force.frame=XYZ"], "--set: force.frame = 'XYZ': allowed: 'FRD', 'FLU', 'NED', 'ENU'"),
        (["force.unit=kg"], "--set: force.unit = 'kg': allowed: m/s2, g, mg, ft/s2, cm/s2"),
        (["force.columns=['a']"], "force.columns = ['a']: allowed: a list of 3 columns"),
        (["grid.rate_hz=5"], "grid.rate_hz = 5: allowed: a number, 10 <= value <= 1000"),
        (["sensor.position_m=[1]"], "sensor.position_m = [1]: allowed: a list of three"),
        (["force.unti=g"], "force.unti = 'g': unknown key; did you mean 'unit'?"),
        (["attitude.kind=euler"], "4 columns, allowed with euler: 3: roll, pitch, yaw"),
        (["format=ulog"], "force, rate and attitude of a ulog file need a table"),
        (["attitude.columns=['a', 'b']"], "allowed: a list of 3 or 4 columns"),
    ],
)
def test_a_map_is_checked(settings: list[str], told: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        load_map("csv", settings)
    assert told in str(caught.value)


def test_an_unknown_map(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match=r"--map: px5: .*did you mean 'px4'"):
        load_map("px5")
    with pytest.raises(ScenarioError, match=r"none\.toml: file: cannot be read"):
        load_map(str(tmp_path / "none.toml"))
    (tmp_path / "m.toml").write_text('format = "csv"\n')
    with pytest.raises(ScenarioError) as caught:
        load_map(str(tmp_path / "m.toml"))
    assert [mistake.key for mistake in caught.value.mistakes] == ["time", "force"]


def test_every_map_of_the_package_is_one() -> None:
    for name in known_maps():
        found = load_map(name)
        assert found.name == name
        assert found.description


def test_a_tab_as_it_is_typed() -> None:
    assert load_map("csv", [r"csv.delimiter=\t"]).csv.delimiter == "\t"
