import re

from atlas_cueing.batch.overview import overview

METRIC = "force_rms_m_s2"
ROW = {"run": "a-1", "vehicle": "c1722", "method": "blend", "platform": "p", "result": "ok", "log": "a-1.mcap", METRIC: 1.25}


def page(*rows: dict[str, object], settings: tuple[str, ...] = (), files: tuple[str, ...] = ()) -> str:
    return overview(rows, settings, [METRIC], "mine & yours", files)


def test_every_run_has_a_row_with_links_to_what_there_is() -> None:
    failed = {**ROW, "run": "b-2", "log": "", "result": "vehicle_failed", "reason": "it <fell>"}
    text = page(ROW, failed, files=("a-1.json", "a-1.html", "a-1.mcap", "index.html"))
    good, bad = re.findall(r"<tr.*?</tr>", text.split("<tbody>")[1])
    assert re.findall(r'href="([^"]*)"', good) == ["a-1.html", "a-1.mcap", "a-1.json"]
    assert re.findall(r'href="([^"]*)"', bad) == []
    assert ">1.25<" in good
    assert good.startswith("<tr>")
    assert bad.startswith('<tr class="bad">')
    assert bad.count("it &lt;fell&gt;") == 2  # as its text, and for sorting
    assert "<fell>" not in text
    assert "2 runs: 1 ok, 1 vehicle_failed" in text
    assert "<h1>mine &amp; yours</h1>" in text


def test_a_violation_is_marked() -> None:
    assert '<tr class="bad">' in page({**ROW, "violations": 1})


def test_a_picture_for_two_parameters_only() -> None:
    rows = [{**ROW, "g": g, "h": h} for g in (1, 2) for h in (3, 4)]
    assert page(*rows, settings=("g", "h")).count("<rect") == 4
    assert "<svg" not in page(*rows[:2], settings=("g", "h"))
    assert "<svg" not in page(*[{**row, "i": i} for i, row in enumerate(rows)], settings=("g", "h", "i"))


def test_names_stand_beside_the_picture() -> None:
    rows = [{**ROW, "method": a, "script": b} for a in ("m1", "m2") for b in ("s1", "s2", "s3")]
    text = page(*rows, settings=("script", "method"))
    assert re.search(r'text-anchor="end"[^>]*>s1<', text)
    assert re.search(r'text-anchor="middle"[^>]*>m1<', text)
    assert 'text-anchor="start" font-size="13" fill="currentColor">script<' in text


def test_nothing_comes_from_elsewhere() -> None:
    text = page(ROW).replace("http://www.w3.org/2000/svg", "")
    assert "http" not in text
    assert "src=" not in text


def test_heads_and_cells_stand_over_each_other() -> None:
    text = page({**ROW, "cueing.method": "blend", "g": 3}, settings=("cueing.method", "g"))
    heads = re.findall(r"<th[^>]*>(.*?)</th>", text)
    cells = re.findall(r"<td[^>]*>(.*?)</td>", text)
    assert len(heads) == len(cells)
    assert cells[heads.index("g")] == "3"
    assert cells[heads.index(METRIC)] == "1.25"
    assert "cueing.method" not in heads  # has its own column already
