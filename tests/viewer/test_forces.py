"""How long a force is drawn."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.review import RecordedRun
from atlas_cueing.viewer import replay
from atlas_cueing.viewer.forces import ForceScale, largest_g
from atlas_cueing.viewer.play import PlayPage


@given(st.floats(0.0, 1e6), st.floats(0.0, 1e6))
def test_no_arrow_is_as_long_as_the_radius(largest: float, size: float) -> None:
    drawn = ForceScale(2.0, largest)
    assert drawn.length(size) <= 0.9 * 2.0 + 1e-9
    assert 0.9 * 2.0 / 8.0 <= drawn.unit <= 0.62 * 2.0 + 1e-9  # 1 g can always be seen
    if size <= min(largest, 8.0):
        assert drawn.length(size) == pytest.approx(size * drawn.unit)  # true to scale


def test_the_largest_of_a_flight_has_the_longest_arrow() -> None:
    assert ForceScale(1.45, 2.9).length(2.9) == pytest.approx(0.9 * 1.45)


def test_the_largest_counts_every_row_that_is_a_force() -> None:
    pilot = np.array([[0.0, 0.0, -9.80665], [np.nan, 500.0, 0.0], [np.inf, 0.0, 0.0]])
    felt = np.array([[3.0 * 9.80665, 0.0, -4.0 * 9.80665]])
    assert largest_g(pilot) == pytest.approx(1.0)
    assert largest_g(pilot, felt) == pytest.approx(5.0)
    assert largest_g(felt, pilot) == pytest.approx(5.0)
    assert largest_g(pilot[1:], felt[:0]) == 0.0


def test_a_known_flight_sets_the_scale(
    server: Any, run: RecordedRun, monkeypatch: pytest.MonkeyPatch, tmp_path: Any
) -> None:
    """Of the play page and of the replay file."""
    strong = run.flight.vehicle_f_B.copy()
    strong[40] = (0.0, 0.0, -5.0 * 9.80665)
    flight = replace(run.flight, vehicle_f_B=strong)
    PlayPage(server, run.platform, flight)
    scale = server.scene.get_handle_by_name("/scale")
    assert scale.text.endswith("(5.0 g)")
    asked: list[float] = []
    monkeypatch.setattr(replay, "Scene", lambda *given: asked.append(given[2]))
    monkeypatch.setattr(replay, "_replay", lambda *_: "")
    replay.write_replay(run.platform, flight, tmp_path / "replay.html")
    assert asked == [pytest.approx(5.0)]
