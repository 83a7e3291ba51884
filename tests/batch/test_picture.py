from itertools import pairwise, product
from xml.etree import ElementTree as ET

from atlas_cueing.batch.picture import parameters, picture

SVG = "{http://www.w3.org/2000/svg}"


def drawn(rows: list[dict[str, object]]) -> ET.Element:
    return ET.fromstring(picture(rows, "x", "y", "turns_roll"))  # noqa: S314 - our own


def marks(svg: ET.Element, tag: str) -> list[tuple[dict[str, str], str]]:
    return [(mark.attrib, mark.findtext(f"{SVG}title", "")) for mark in svg.iter(f"{SVG}{tag}")]


def test_a_grid_has_a_cell_for_each_pair() -> None:
    rows: list[dict[str, object]] = [
        {"x": x, "y": y, "turns_roll": float(x)} for x, y in product((3, 1, 2), ("b", "a"))
    ]
    cells = marks(drawn(rows), "rect")
    assert len(cells) == 6
    places = {title: float(cell["x"]) for cell, title in cells}
    assert places["1.0000"] < places["2.0000"] < places["3.0000"]
    assert {cell["fill"] for cell, _ in cells} == {"#440154", "#21918c", "#fde725"}
    assert {cell["width"] for cell, _ in cells} == {"213.3"}


def test_a_cell_tells_its_figure_in_the_unit_shown_where_there_is_room() -> None:
    rows: list[dict[str, object]] = [
        {"x": x, "a.y_deg_s": y, "direction_rms_rad": 0.1 * x * y}
        for x, y in product((1, 2), (3, 5))
    ]
    svg = ET.fromstring(picture(rows, "x", "a.y_deg_s", "direction_rms_rad"))  # noqa: S314 - our own
    texts = ["".join(text.itertext()) for text in svg.iter(f"{SVG}text")]
    assert {"17.189", "28.648", "34.377", "57.296"} < set(texts)  # degrees
    assert "direction rms, deg: 17.189 (dark) to 57.296 (light)" in [
        text.removeprefix("direction_rms_rad") for text in texts
    ]
    assert "a.y_deg_sy, deg/s" in texts  # the key as the tooltip
    inks = {"".join(text.itertext()): text.attrib["fill"] for text in svg.iter(f"{SVG}text")}
    assert (inks["17.189"], inks["57.296"]) == ("white", "black")
    many: list[dict[str, object]] = [
        {"x": x, "y": y, "turns_roll": 1.2345678} for x, y in product(range(40), range(40))
    ]
    assert [text for text in drawn(many).iter(f"{SVG}text") if text.text == "1.2346"] == []


def test_a_few_rows_are_no_higher_than_they_need_be() -> None:
    few, many = ([{"x": 1, "y": y, "turns_roll": 1.0} for y in range(count)] for count in (3, 60))
    assert float(drawn(list(few)).attrib["viewBox"].split()[3]) == 34.0 + 3 * 48.0 + 50.0
    assert float(drawn(list(many)).attrib["viewBox"].split()[3]) == 34.0 + 400.0 + 50.0


def test_several_runs_of_a_cell_are_averaged() -> None:
    rows: list[dict[str, object]] = [
        {"x": 1, "y": y, "turns_roll": m} for y, m in ((1, 2.0), (1, 4.0), (2, 5.0))
    ]
    assert {title for _, title in marks(drawn(rows), "rect")} == {"3.0000", "5.0000"}


def test_draws_are_dots_where_their_values_are() -> None:
    rows: list[dict[str, object]] = [
        {"x": i / 100, "y": 1.0 - i / 100, "turns_roll": float(i)} for i in range(101)
    ]
    dots = marks(drawn(rows), "circle")
    assert len(dots) == 101
    assert [(dot["cx"], dot["cy"]) for dot, title in dots if title == "25.0000"] == [
        ("350.0", "134.0")
    ]


def test_labels_do_not_run_into_each_other() -> None:
    rows: list[dict[str, object]] = [
        {"x": f"a_long_name_{i}", "y": i, "turns_roll": 1.0} for i in range(90)
    ]
    texts = [
        (float(t.attrib["x"]), float(t.attrib["y"]), t.text or "")
        for t in drawn(rows).iter(f"{SVG}text")
    ]
    below = sorted(x for x, _, text in texts if text.startswith("a_long"))
    beside = sorted(y for _, y, text in texts if text.isdigit())
    assert min(b - a for a, b in pairwise(below)) > 7.0 * len("a_long_name_10")
    assert min(b - a for a, b in pairwise(beside)) >= 16.0
    assert len(below) >= 4
    assert len(beside) >= 20


def test_runs_without_the_figure_are_left_out_and_none_at_all_is_no_picture() -> None:
    rows: list[dict[str, object]] = [
        {"x": 1, "y": 1, "turns_roll": float("nan")},
        {"x": 1, "y": 2},
        {"y": 1, "turns_roll": 1.0},
    ]
    assert picture(rows, "x", "y", "turns_roll") == ""
    assert len(marks(drawn([*rows, {"x": 1, "y": 1, "turns_roll": 1.0}]), "rect")) == 1


def test_names_are_escaped() -> None:
    assert "<b>" not in picture([{"x": "<b>", "y": 1, "turns_roll": 1.0}], "x", "y", "turns_roll")


def test_parameters_are_the_keys_that_vary() -> None:
    rows: list[dict[str, object]] = [
        {"a": 1, "b": [1, 2], "c": 0},
        {"a": 1, "b": [1, 3], "c": 0},
        {"a": 1, "b": [1, 2]},
    ]
    assert parameters(rows, ["a", "b", "c", "d"]) == ["b", "c"]
