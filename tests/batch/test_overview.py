"""Flights of scenarios, by the vehicle table."""

import re
from html import unescape
from math import nan

import pytest

from atlas_cueing.batch.overview import overview

from .overviews import ANGLE, FAILED, METRIC, ROW, SAME, page


def tables(text: str) -> list[tuple[list[str], list[list[str]]]]:
    """Heads and rows of each table, as read by eye."""
    found = []
    for table in re.findall(r"<table.*?</table>", text, re.DOTALL):
        heads, *rows = [
            re.findall(r"<t[hd].*?</t[hd]>", row) for row in re.findall(r"<tr.*?</tr>", table)
        ]
        found.append(
            (
                ["".join(read(cell)) for cell in heads],
                [["".join(read(cell)) for cell in row] for row in rows],
            )
        )
    return found


def read(cell: str) -> str:
    return unescape(re.sub(r"<[^>]*>", "", cell.replace("<small>", " ")))


def totals(text: str) -> dict[str, str]:
    return {
        name: value
        for value, name in re.findall(r"<div[^>]*><b>(.*?)</b><span>(.*?)</span></div>", text)
    }


def test_every_run_has_a_row_with_links_to_what_there_is() -> None:
    name = ROW["run"]
    text = page(
        {**ROW, "log": f"{name}.mcap"},
        FAILED,
        files=(f"{name}.json", f"{name}.html", f"{name}.mcap", "index.html"),
    )
    good, bad = re.findall(r"<tr.*?</tr>", text)[1::2]
    assert re.findall(r'href="([^"]*)"', good) == [f"{name}.html", f"{name}.mcap", f"{name}.json"]
    assert re.findall(r'href="([^"]*)"', bad) == []
    assert good.startswith("<tr>")
    assert bad.startswith('<tr class="bad">')
    assert "<h1>mine &amp; yours</h1>" in text


def test_a_run_is_called_by_scenario_and_method() -> None:
    text = page(ROW)
    _, ((name, *_),) = tables(text)[0]
    assert name == "short · blend 0123456789ab"
    assert f'title="{ROW["run"]}"' in text


def test_figures_are_in_units_for_people_and_heads_tell_their_names() -> None:
    text = page(
        {**ROW, "wheels_limited_share": 0.123, "rate_rms_rad_s": 0.1},
        metrics=(METRIC, ANGLE, "wheels_limited_share"),
    )
    ((heads, rows),) = tables(text)
    assert heads == ["run", "force rms m/s²", "direction rms deg", "wheels limited %", "links"]
    assert rows[0][1:4] == ["1.250", "28.648", "12.30"]
    assert re.findall(r'<th class="\w*" title="(\w+)', text) == [
        "run",
        METRIC,
        ANGLE,
        "wheels_limited_share",
    ]
    assert 'data-v="0.5"' in text  # sorted by the number itself
    assert re.search(rf'title="{METRIC}: [^"]+\." aria-sort=ascending', text)


def test_what_failed_stands_apart_with_its_reasons() -> None:
    rows = [
        ROW,
        FAILED,
        {**FAILED, "run": "d", "result": "crashed", "reason": "no"},
        {**SAME, "run": "c", "result": "not_flown"},
    ]
    text = page(*rows, {**FAILED, "run": "e"})
    (_, good), (heads, bad) = tables(text)
    assert len(good) == 1
    assert heads == ["run", "result", "reason", "links"]
    assert [row[1:3] for row in bad] == [
        ["crashed", "no"],
        ["vehicle_failed", "it <fell>"],
        ["vehicle_failed", "it <fell>"],
        ["not_flown", ""],
    ]
    assert "Not flown to the end: 1 crashed, 2 vehicle failed, 1 not flown" in text
    assert "<table>" not in page(FAILED).split("<h2>Not")[0]  # none flew: no empty table


def test_totals_stand_on_top() -> None:
    flown = [
        {**ROW, "duration_s": 4000.0, "violations": 2},
        {**ROW, "duration_s": 500.0, "violations": 0},
    ]
    text = page(*flown, FAILED)
    assert totals(text) == {
        "runs": "3",
        "ok": "2",
        "failed": "1",
        "violations": "2",
        "of flight": "1.2 h",
    }
    assert totals(page({**FAILED, "result": "not_flown"}))["not flown"] == "1"
    assert text.index("totals") < text.index("<table>")


def test_a_violation_is_marked() -> None:
    text = page({**ROW, "violations": 1}, {**ROW, "violations": 0})
    assert text.count('<tr class="bad">') == 1
    assert "violations" in tables(text)[0][0]
    assert "violations" not in tables(page({**ROW, "violations": 0}))[0][0]


def test_a_length_has_a_column_where_one_can_see_that_it_differs() -> None:
    heads = [
        tables(page(*({**ROW, "duration_s": d} for d in pair)))[0][0]
        for pair in ((5.0, 5.001), (5.0, 5.01))
    ]
    assert ["duration s" in head for head in heads] == [False, True]
    assert (
        tables(page({**ROW, "violations": 2}, metrics=("violations",)))[0][0].count("violations")
        == 1
    )


def test_only_what_differs_has_a_column() -> None:
    rows = [
        {**ROW, "vehicle": v, "vehicle.script": v, "cueing.force_gain": g, "cueing.x_m": 3}
        for v, g in (("a", 1), ("b", 2))
    ]
    text = page(*rows, settings=("vehicle.script", "cueing.force_gain", "cueing.x_m"))
    ((heads, found),) = tables(text)
    assert heads[:3] == ["run", "vehicle", "force gain"]
    assert [row[1:3] for row in found] == [["a", "1"], ["b", "2"]]
    assert 'title="cueing.force_gain"' in text
    assert "Same in all: x 3, method blend, platform atlas-2.9m." in text


def test_a_swept_method_has_a_column_and_keys_of_one_name_are_told_in_full() -> None:
    rows = [
        {**ROW, "method": m, "cueing.method": m, "a.gain_s": i, "b.gain_s": -i}
        for i, m in enumerate(("blend", "force"))
    ]
    heads = tables(page(*rows, settings=("cueing.method", "a.gain_s", "b.gain_s")))[0][0]
    assert heads[1:4] == ["method", "a.gain_s s", "b.gain_s s"]


def test_the_least_is_told_from_the_rest_and_no_number_is_a_dash() -> None:
    text = page(
        {**ROW, METRIC: 2.0},
        {**ROW, METRIC: 1.0},
        {**ROW, METRIC: nan},
        {**SAME, "run": "n", "result": "ok"},
    )
    cells = re.findall(r'<td class="(figure[^"]*)" data-v="([^"]*)"(.*?)>(.*?)</td>', text)
    assert [(kind, value, shown) for kind, value, _, shown in cells] == [
        ("figure", "2.0", "2.000"),
        ("figure least", "1.0", "1.000"),
        ("figure", "", "–"),
        ("figure", "", ""),
    ]
    assert [style for _, _, style, _ in cells[:2]] == [
        ' style="--part:100%"',
        ' style="--part:50%"',
    ]


def test_a_picture_for_two_parameters_only() -> None:
    rows = [{**ROW, "g": g, "h": h} for g in (1, 2) for h in (3, 4)]
    assert page(*rows, settings=("g", "h")).count("<rect") == 4
    assert "<svg" not in page(*rows[:2], settings=("g", "h"))
    assert "<svg" not in page(
        *[{**row, "i": i} for i, row in enumerate(rows)], settings=("g", "h", "i")
    )


def test_names_stand_beside_the_picture() -> None:
    rows = [{**ROW, "method": a, "script": b} for a in ("m1", "m2") for b in ("s1", "s2", "s3")]
    text = page(*rows, settings=("script", "method"))
    assert re.search(r'text-anchor="end"[^>]*>s1<', text)
    assert re.search(r'text-anchor="middle"[^>]*>m1<', text)
    assert re.search(r'text-anchor="end"[^>]*><title>script</title>script<', text)


def test_nothing_comes_from_elsewhere() -> None:
    text = page(ROW).replace("http://www.w3.org/2000/svg", "")
    assert "http" not in text
    assert "src=" not in text


def test_everything_is_escaped() -> None:
    bad = '<b>"&'
    names = (
        "run",
        "scenario",
        "vehicle",
        "method",
        "platform",
        "reason",
        "result",
        "log",
        f"k.{bad}",
    )
    rows = [{**dict.fromkeys(names, bad + str(i)), METRIC: 1.0} for i in (1, 2)]
    text = page(
        *rows,
        *[{**row, "result": "ok"} for row in rows],
        settings=(f"k.{bad}", "platform"),
        files=(f"{bad}1.html",),
    )
    assert "<b>" not in re.sub(r"<div[^>]*><b>", "", text)
    assert bad not in text
    assert "&lt;b&gt;&quot;&amp;1" in text


@pytest.mark.parametrize(
    ("time", "text"),
    [(0.0, "0.0 s"), (59.0, "59.0 s"), (90.0, "1.5 min"), (3599.0, "60.0 min"), (9000.0, "2.5 h")],
)
def test_the_length_of_all_flights_reads_well(time: float, text: str) -> None:
    run = {"run": "a", "scenario": "a", "method": "blend", "result": "ok", "duration_s": time}
    page = overview([run], [], ["force_rms_m_s2"], "title", [])
    assert f"<b>{text}</b><span>of flight</span>" in page
