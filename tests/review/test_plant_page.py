"""The page of a flight on the simulated platform."""

import re
from dataclasses import replace
from math import degrees
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing import load_scenario, run_scenario
from atlas_cueing.plant import DEFINITIONS, PlantRun, fly_plant, plant_figures
from atlas_cueing.recording import Log
from atlas_cueing.review import open_run
from atlas_cueing.review.plant_page import write_plant_page
from atlas_cueing.review.plots.plant import plant_over_time
from atlas_cueing.signals import PLANT

from .test_report import own_part

SCENARIOS = Path(__file__).parents[2] / "scenarios"
Flown = tuple[Log, PlantRun, PlantRun]


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> Flown:
    """A log, and its schedule with the loop open and closed."""
    settings = ("cueing.method=force", "duration_s=2", "platform.preset=atlas-2.9m-halo")
    scenario = load_scenario(SCENARIOS / "f16_rolls.toml", settings)
    run = open_run(run_scenario(scenario, tmp_path_factory.mktemp("page") / "ride.mcap").log)
    opened, closed = (fly_plant(run.log, run.platform, kind) for kind in ("none", "fix"))
    return run.log, opened, closed


def test_figures_of_both_loops(flown: Flown, tmp_path: Path) -> None:
    log, opened, closed = flown
    write_plant_page(log, closed, tmp_path / "page.html", opened)
    body = own_part((tmp_path / "page.html").read_text())
    assert "<th>none</th><th>fix</th>" in body
    rows = {
        name: re.findall(r"<td class='number'>(.*?)</td>", row)
        for name, row in re.findall(r"'>(\w+)</td>((?:<td class='number'>.*?</td>)+)", body)
    }
    assert len(rows) == len(DEFINITIONS)
    columns = [plant_figures(run, log) for run in (opened, closed)]
    assert rows["slip_max_m_s"] == [f"{c['slip_max_m_s']:.4g}" for c in columns]
    ends = [f"{degrees(c['orientation_error_end_rad']):.4g}" for c in columns]
    assert rows["orientation_error_end_deg"] == ends
    assert not re.findall(r"(?:src|href)=", body)


def test_an_open_loop_stands_alone(flown: Flown, tmp_path: Path) -> None:
    log, opened, _ = flown
    write_plant_page(log, opened, tmp_path / "page.html")
    body = own_part((tmp_path / "page.html").read_text())
    assert "<th></th><th>none</th></tr>" in body
    titles = [a.text for a in plant_over_time(log, opened, None).layout.annotations]
    assert "estimate" not in titles[0]


def test_the_lines_are_those_of_the_plant(flown: Flown) -> None:
    log, opened, closed = flown
    plot = plant_over_time(log, closed, opened)
    rows = [len([t for t in plot.data if t.yaxis == f"y{k or ''}"]) for k in ("", *range(2, 11))]
    assert rows == [3, 3, 3, 2, 2, 2, 1, 3, 1, 1]
    error = closed.plant[:, PLANT.fields.index("error_rad")]
    assert max(plot.data[1].y) == pytest.approx(np.degrees(error).max(), rel=1e-6)
    energy = next(t for t in plot.data if t.yaxis == "y10").y[-1]
    assert energy == pytest.approx(closed.work[0], rel=0.02)  # by ticks, against all steps


def test_names_from_a_log_are_text(flown: Flown, tmp_path: Path) -> None:
    log, opened, _ = flown
    evil = replace(log, metadata={**log.metadata, "scenario": "<b>x", "method": "<script>"})
    write_plant_page(evil, opened, tmp_path / "page.html")
    body = own_part((tmp_path / "page.html").read_text())
    assert "<b>x" not in body
    assert "<td><script>" not in body
