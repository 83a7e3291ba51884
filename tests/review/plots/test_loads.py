"""What the plots of the loads show."""

import numpy as np
import pytest

from atlas_cueing.review.plots.loads import loads_over_time, torque_and_speed
from atlas_cueing.review.plots.style import FAULT

from ..checks.test_logged_loads import AT, changed, with_loads
from ..runs import coning


def test_rows() -> None:
    run = with_loads(coning())
    plot = loads_over_time(run)
    titles = [annotation.text for annotation in plot.layout.annotations]
    assert [title.split(",")[0] for title in titles] == [
        "traction use",
        "normal force",
        "torque at the axle",
        "power of all wheels",
        "energy of each wheel for itself",
    ]
    assert len(plot.data) == 3 * 3 + 2 * 2
    normal = run.log.vector("/loads", "n")
    assert max(plot.data[3].y) == pytest.approx(normal[:, 0].max(), rel=1e-6)
    torques = sorted(shape.y0 for shape in plot.layout.shapes if shape.yref == "y3")
    assert torques == [-600.0, 600.0]


def test_energy_is_the_integral_of_the_power() -> None:
    run = with_loads(coning())
    power, time = run.log.vector("/loads", "p"), run.flight.time
    plot = loads_over_time(run)
    ends = [trace.y[-1] for trace in plot.data if trace.yaxis == "y5"]
    expected = [np.trapezoid(np.maximum(s * power, 0.0).sum(axis=1), time) for s in (1.0, -1.0)]
    assert ends == pytest.approx(expected, rel=1e-5)


def test_slip_is_shaded() -> None:
    run = with_loads(coning())
    assert not [shape for shape in loads_over_time(run).layout.shapes if shape.type == "rect"]
    slips = changed(run, "use2", 1.5)
    (shaded,) = [s for s in loads_over_time(slips).layout.shapes if s.type == "rect"]
    assert shaded.x0 == pytest.approx(run.flight.time[AT])
    assert shaded.x1 == pytest.approx(run.flight.time[AT + 1])


def test_torque_in_the_envelope_of_the_motor() -> None:
    run = with_loads(coning())
    plot = torque_and_speed(run)
    assert len(plot.data) == 3
    (envelope,) = plot.layout.shapes
    assert (envelope.x1, envelope.y1) == (32.0, 600.0)
    assert envelope.line.color == FAULT
    bare = run.platform.model_copy(update={"drive": None})
    assert not torque_and_speed(type(run)(run.log, bare, run.flight)).layout.shapes
