"""The pages as files; `test_browser` opens them."""

import os
import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from live.logs import largest_file

from atlas_cueing.errors import InputError, OutputError
from atlas_cueing.evaluation import DECLARED
from atlas_cueing.printable import html_text
from atlas_cueing.review import Finding, compare_logs, cue_again, judge, review_log
from atlas_cueing.review.plots.downsample import POINTS
from atlas_cueing.review.plots.time_series import MOST_MARKS, over_time
from atlas_cueing.review.report import write_comparison, write_page

from .corrupting import corrupted
from .runs import coning


@pytest.fixture(scope="module")
def page(flight: Path, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The page of a clean flight."""
    file = tmp_path_factory.mktemp("page") / "page.html"
    write_page(review_log(flight), file)
    return file.read_text()


def own_part(page: str) -> str:
    """What is not plotly's own script."""
    return re.sub(r"<script>/\*\*.*?</script>", "", page, count=1, flags=re.DOTALL)


def test_verdict_first(page: str) -> None:
    body = own_part(page)
    assert len(body) < len(page) - 1_000_000
    assert (
        body.index("<span class='verdict clean'>clean</span>")
        < body.index("atlas-2.9m")
        < body.index("Over time")
    )
    for version in ("jsbsim version", "ruckig version", "atlas cueing version"):
        assert version in body


def test_what_the_figures_say_is_beside_the_verdict(page: str) -> None:
    """All that this log has; the mismatch ratio is for logs beside others."""
    body = own_part(page)
    for name, metric in DECLARED.items():
        told = f"<dt>{metric.title}</dt><dd>{html_text(metric.meaning)}</dd>"
        assert (told in body) == bool(metric.meaning and name != "mismatch_ratio"), name
    assert body.index("verdict clean") < body.index("class='meanings'") < body.index("Over time")


def test_nothing_is_fetched(page: str) -> None:
    body = own_part(page)
    assert not re.search(r"(src|href)\s*=", body)
    assert not re.search(r"@import|url\(", body)


def test_findings_are_listed_and_marked(flight: Path, tmp_path: Path) -> None:
    bad = corrupted(
        flight, tmp_path / "bad.mcap", lambda c: c["/wheels w2_rad_s"].__setitem__(300, 5.0)
    )
    found = review_log(bad)
    write_page(found, tmp_path / "page.html")
    body = own_part((tmp_path / "page.html").read_text())
    assert f"<span class='verdict'>{found.verdict}</span>" in body
    assert body.count("<li class='finding'>") == len(found.findings)
    plot = over_time(found)
    assert {shape.x0 for shape in plot.layout.shapes if shape.yref == "paper"} == {
        finding.time for finding in found.findings
    }
    (marks,) = [trace for trace in plot.data if trace.name == "finding"]
    assert len(marks.x) == len(found.findings) <= MOST_MARKS


def test_what_a_log_says_is_text_not_html(flight: Path, tmp_path: Path) -> None:
    evil = "<script>alert(1)</script>"
    metadata = {"scenario": evil, "result": evil, "reason": evil, evil: evil}
    bad = corrupted(flight, tmp_path / "bad.mcap", metadata=metadata, states=[(1.0, evil, evil)])
    write_page(review_log(bad), tmp_path / "page.html")
    assert evil not in (tmp_path / "page.html").read_text()


def test_a_field_with_an_evil_name(tmp_path: Path) -> None:
    """The names of fields come from the log, and end in the plots' own script."""
    evil = "</script><script>alert(1)</script>"
    found = replace(judge(coning()), findings=(Finding(evil, evil, 1.0, evil),))
    write_page(found, tmp_path / "page.html")
    assert "<script>alert" not in (tmp_path / "page.html").read_text()


def test_the_rows_share_their_zoom_and_show_the_columns(flight: Path) -> None:
    found = review_log(flight)
    plot = over_time(found)
    axes = [
        axis for name, axis in plot.to_plotly_json()["layout"].items() if name.startswith("xaxis")
    ]
    assert len(axes) == 11
    assert sum("matches" in axis for axis in axes) == 10
    vehicle, rider = plot.data[:2]
    assert (vehicle.name, rider.name, rider.fill) == ("vehicle", "rider", "tonexty")
    assert np.array_equal(vehicle.y, found.run.flight.vehicle_f_B[:, 0].astype(np.float32))
    assert all(len(trace.x) <= POINTS for trace in plot.data)


def test_an_odd_log_has_a_page(flight: Path, tmp_path: Path) -> None:
    """No ticks, one tick, numbers that are none."""
    for name, ticks in (("none", slice(0)), ("one", slice(1)), ("five", slice(5))):
        log = corrupted(
            flight,
            tmp_path / f"{name}.mcap",
            lambda c, t=ticks: c.update({n: v[t] for n, v in c.items()}),
        )
        write_page(review_log(log), tmp_path / f"{name}.html")
    log = corrupted(
        flight,
        tmp_path / "nan.mcap",
        lambda c: [c[n].__setitem__(9, np.nan) for n in c if "time" not in n],
    )  # type: ignore[func-returns-value, arg-type]
    write_page(review_log(log), tmp_path / "nan.html")
    assert all(
        (tmp_path / f"{name}.html").stat().st_size > 4e6 for name in ("none", "one", "five", "nan")
    )


def test_a_comparison(flight: Path, tmp_path: Path) -> None:
    cue_again(flight, ["cueing.method=attitude"], tmp_path / "other.mcap")
    write_comparison(compare_logs([flight, tmp_path / "other.mcap"]), tmp_path / "both.html")
    body = own_part((tmp_path / "both.html").read_text())
    assert "<h1>blend against attitude</h1>" in body
    cell = r"<td class='number'>[\d.]+</td>"
    row = rf"<tr><td title='[^']+'>force rms m/s²</td>{cell}{cell}"
    assert len(re.findall(row, body)) == 2
    assert re.search(row, body).start() < body.index("Over time")  # type: ignore[union-attr]


def test_without_plotly_it_says_what_to_install(
    flight: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [
        name
        for name in sys.modules
        if name.startswith(("plotly", "atlas_cueing.review.plots.time_series"))
    ]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr("atlas_cueing.review.plots.time_series", raising=False)
    monkeypatch.setitem(sys.modules, "plotly", None)
    with pytest.raises(InputError, match=r"pip install 'atlas_cueing\[report\]'"):
        write_page(review_log(flight), tmp_path / "page.html")


def test_a_full_disk_leaves_the_old_page(flight: Path, tmp_path: Path) -> None:
    found = review_log(flight)
    (tmp_path / "page.html").write_text("old")
    for file in ("page.html", "new.html"):
        with (
            largest_file(100_000),
            pytest.raises(OutputError, match=rf"page .*{file}: File too large"),
        ):
            write_page(found, tmp_path / file)
        with (
            largest_file(100_000),
            pytest.raises(OutputError, match=rf"page .*{file}: File too large"),
        ):
            write_comparison(compare_logs([flight, flight]), tmp_path / file)
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
    assert (tmp_path / "page.html").read_text() == "old"
    write_page(found, tmp_path / "page.html")
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
    assert len((tmp_path / "page.html").read_text()) > 1_000_000


def test_a_log_whose_name_is_no_text(flight: Path, tmp_path: Path) -> None:
    log = tmp_path / os.fsdecode(b"caf\xe9.mcap")
    log.write_bytes(flight.read_bytes())
    write_page(review_log(log), tmp_path / "page.html")
    assert "caf\\xe9.mcap" in own_part((tmp_path / "page.html").read_text())


def test_nowhere_to_write(flight: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="No such file or directory"):
        write_page(review_log(flight), tmp_path / "no" / "page.html")
