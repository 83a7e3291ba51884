import re
from pathlib import Path

from atlas_cueing.batch.overview import write_overview

METRIC = "force_rms_m_s2"
ROW = {"run": "a-1", "vehicle": "c1722", "method": "blend", "platform": "p", "result": "ok", "log": "a-1.mcap", METRIC: 1.25}


def page(folder: Path, *rows: dict[str, object], settings: tuple[str, ...] = ()) -> str:
    write_overview(rows, settings, [METRIC], folder)
    return (folder / "index.html").read_text()


def test_every_run_has_a_row_with_links_to_what_there_is(tmp_path: Path) -> None:
    (tmp_path / "a-1.json").touch()
    (tmp_path / "a-1.html").touch()
    text = page(tmp_path, ROW, {**ROW, "run": "b-2", "log": "", "result": "vehicle_failed", "reason": "it <fell>"})
    good, bad = re.findall(r"<tr.*?</tr>", text.split("<tbody>")[1])
    assert re.findall(r'href="([^"]*)"', good) == ["a-1.html", "a-1.mcap", "a-1.json"]
    assert re.findall(r'href="([^"]*)"', bad) == []
    assert ">1.25<" in good
    assert good.startswith("<tr>")
    assert bad.startswith('<tr class="bad">')
    assert bad.count("it &lt;fell&gt;") == 2  # as its text, and for sorting
    assert "<fell>" not in text
    assert "2 runs: 1 ok, 1 vehicle_failed" in text


def test_a_violation_is_marked(tmp_path: Path) -> None:
    assert '<tr class="bad">' in page(tmp_path, {**ROW, "violations": 1})


def test_a_picture_for_two_parameters_only(tmp_path: Path) -> None:
    rows = [{**ROW, "g": g, "h": h} for g in (1, 2) for h in (3, 4)]
    assert page(tmp_path, *rows, settings=("g", "h")).count("<rect") == 4
    assert "<svg" not in page(tmp_path, *rows[:2], settings=("g", "h"))
    assert "<svg" not in page(tmp_path, *[{**row, "i": i} for i, row in enumerate(rows)], settings=("g", "h", "i"))


def test_names_stand_beside_the_picture(tmp_path: Path) -> None:
    rows = [{**ROW, "method": a, "script": b} for a in ("m1", "m2") for b in ("s1", "s2", "s3")]
    text = page(tmp_path, *rows, settings=("script", "method"))
    assert re.search(r'text-anchor="end"[^>]*>s1<', text)
    assert re.search(r'text-anchor="middle"[^>]*>m1<', text)
    assert 'text-anchor="start" font-size="13" fill="currentColor">script<' in text


def test_nothing_comes_from_elsewhere(tmp_path: Path) -> None:
    text = page(tmp_path, ROW).replace("http://www.w3.org/2000/svg", "")
    assert "http" not in text
    assert "src=" not in text


def test_heads_and_cells_stand_over_each_other(tmp_path: Path) -> None:
    text = page(tmp_path, {**ROW, "cueing.method": "blend", "g": 3}, settings=("cueing.method", "g"))
    heads = re.findall(r"<th[^>]*>(.*?)</th>", text)
    cells = re.findall(r"<td[^>]*>(.*?)</td>", text)
    assert len(heads) == len(cells)
    assert cells[heads.index("g")] == "3"
    assert cells[heads.index(METRIC)] == "1.25"
    assert "cueing.method" not in heads  # has its own column already
