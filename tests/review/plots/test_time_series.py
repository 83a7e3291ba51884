"""What the plots of a page show; `test_page` has the page around them."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.review import judge, review_log
from atlas_cueing.review.plots.downsample import POINTS
from atlas_cueing.review.plots.limit_bars import limit_bars
from atlas_cueing.review.plots.overlays import overlays
from atlas_cueing.review.plots.space import in_space
from atlas_cueing.review.plots.spectra import SEGMENT, spectra
from atlas_cueing.review.plots.style import AXES, FAULT
from atlas_cueing.review.plots.time_series import over_time

from ..runs import coning, with_flight, with_states


def test_every_row_tells_its_unit_and_its_time() -> None:
    plot = over_time(judge(coning()))
    titles = [annotation.text for annotation in plot.layout.annotations]
    assert len(titles) == 11
    assert all(
        re.search(r", (m/s²|°/s|°|rad/s|rad/s²|m)\b|, °$|limited", title) for title in titles
    ), titles
    axes = [
        axis for name, axis in plot.to_plotly_json()["layout"].items() if name.startswith("xaxis")
    ]
    assert all(axis["showticklabels"] for axis in axes)


def test_a_title_has_the_colours_of_its_lines() -> None:
    plot = over_time(judge(coning()))
    (stage,) = [
        annotation.text
        for annotation in plot.layout.annotations
        if annotation.text.startswith("stage position")
    ]
    told = re.findall(r"color:(#\w+)'><b>(\w)</b>", stage)
    drawn = [(trace.line.color, trace.name) for trace in plot.data if trace.name in ("x", "y", "z")]
    assert told == drawn == list(zip(AXES, "xyz", strict=True))


def test_limits_are_told_apart() -> None:
    """Three wheels share a limit, drawn once; the stage's z has one of its own, in its colour."""
    shapes = over_time(judge(coning())).layout.shapes
    drawn = {
        (shape.yref.removesuffix(" domain"), abs(shape.y0), shape.line.color)
        for shape in shapes
        if shape.y0 == shape.y1
    }
    assert drawn == {
        ("y8", 31.0, FAULT),
        ("y9", 60.0, FAULT),
        ("y10", 1.0, FAULT),
        ("y10", 0.75, AXES[2]),
    }


def test_flags_have_a_lane_each() -> None:
    run = coning()
    limited = np.zeros((len(run.flight.time), 2))
    limited[100:200, 1] = 1.0
    plot = over_time(judge(with_flight(run, replace(run.flight, limited=limited))))
    wheels, stage = (
        trace
        for trace in plot.data
        if trace.fill == "tonexty" and trace.name in ("wheels", "stage")
    )
    assert set(np.asarray(wheels.y)) == {1.0}
    assert sorted(set(np.asarray(stage.y).round(3))) == [0.0, 0.8]


def test_rounding_is_not_drawn_as_a_signal() -> None:
    run = coning()
    noise = 1e-15 * np.random.default_rng(1).normal(size=run.flight.felt_f.shape)
    still = replace(
        run.flight, felt_f=noise, wheel_speed=noise, motion_p_W=noise + np.array([0.0, 0.0, 2e-9])
    )
    drawn = over_time(judge(with_flight(run, still))).data
    flat = [trace.name for trace in drawn if not np.any(np.asarray(trace.y))]
    assert [flat.count(name) for name in ("rider", "wheel 1", "wheel 2", "x", "y", "z")] == [
        3,
        1,
        1,
        1,
        1,
        0,
    ]


def test_spells_of_other_states_are_shaded() -> None:
    run = with_states(
        coning(),
        (0.0, "running", ""),
        (1.0, "holding", "late"),
        (2.5, "running", ""),
        (5.0, "parking", ""),
    )
    plot = over_time(judge(run))
    shaded = [(shape.x0, shape.x1) for shape in plot.layout.shapes if shape.type == "rect"]
    assert shaded == [(1.0, 2.5), (5.0, 6.0)]
    assert any(trace.name == "state other than running" for trace in plot.data)


def test_paths_in_space() -> None:
    run = coning()
    paths = {(trace.name, trace.mode): trace for trace in in_space(run).data if trace.name}
    nose, begin = paths["nose", "lines"], paths["nose", "markers"]
    t = run.flight.time
    assert np.asarray(nose.x) == pytest.approx(np.cos(0.8 * t), abs=1e-6)
    assert np.asarray(nose.y) == pytest.approx(np.sin(0.8 * t), abs=1e-6)
    assert [*begin.x, *begin.y, *begin.z] == [1.0, 0.0, 0.0]
    assert np.max(np.abs(paths["travel", "lines"].z)) == 0.75


def test_bars_show_the_largest_use() -> None:
    run = coning()
    first, *_ = limit_bars(run).data
    used = dict(zip(first.x, first.y, strict=True))
    assert used["stage travel"] == pytest.approx(100.0 * np.abs(run.flight.motion_p_W[:, 0]).max())
    assert used["wheel speed"] == pytest.approx(
        100.0 * np.abs(run.flight.wheel_speed[:, 0]).max() / 31.0
    )
    assert list(used) == [f"wheel {q}" for q in ("speed", "acceleration", "jerk")] + [
        f"stage {q}" for q in ("travel", "speed", "acceleration", "jerk")
    ]


@pytest.mark.parametrize("dt", [0.01, 0.001])
def test_spectra_resolve_the_same_at_any_rate(dt: float) -> None:
    """A sine of amplitude 2 m/s² at 0.5 Hz has a power of 2 (m/s²)² there.

    A Hann window spreads it over 1.5 bins.
    """
    run = coning(round(60.0 / dt) + 1, dt)
    force = np.zeros((len(run.flight.time), 3))
    force[:, 1] = 2.0 * np.sin(np.pi * run.flight.time)
    vehicle = spectra(with_flight(run, replace(run.flight, vehicle_f_B=force))).data[0]
    hertz, power = np.asarray(vehicle.x, dtype=np.float64), np.asarray(vehicle.y, dtype=np.float64)
    assert hertz[0] == pytest.approx(1.0 / SEGMENT)
    assert hertz[np.argmax(power)] == pytest.approx(0.5)
    assert power.max() == pytest.approx(2.0 / (1.5 / SEGMENT), rel=0.01)
    assert len(hertz) <= POINTS


def test_overlays_have_a_line_a_run_and_row(flight: Path) -> None:
    found = review_log(flight)
    plot = overlays(["one", "two"], [found.run, found.run])
    assert [trace.name for trace in plot.data] == ["one"] * 4 + ["two"] * 4
    assert len({trace.line.color for trace in plot.data}) == 2
    assert [trace.showlegend for trace in plot.data] == [True, False, False, False] * 2
