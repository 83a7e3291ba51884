"""The longest stretch of a run in state `running`."""

from dataclasses import dataclass

from atlas_cueing.evaluation import Metrics, engaged_segment, gathered

from .flights import still


@dataclass(frozen=True)
class Change:
    time: float
    state: str


def rows(*changes: tuple[float, str]) -> list[float]:
    """Times of what is left of a flight of 1 s at 8 Hz."""
    return engaged_segment(still(8, 0.125), [Change(*change) for change in changes]).time.tolist()


def test_without_a_running_state_nothing_is_left_and_it_has_figures() -> None:
    assert rows() == []
    assert rows((0.0, "parked"), (0.3, "engaging")) == []
    assert gathered(Metrics(), engaged_segment(still(8, 0.125), []))["ticks"] == 0.0


def test_a_state_begins_with_the_tick_at_which_it_is_told() -> None:
    assert rows((0.0, "parked"), (0.25, "running"), (0.625, "parking")) == [0.25, 0.375, 0.5]


def test_the_last_state_goes_on_to_the_end() -> None:
    assert rows((0.0, "parked"), (0.7, "running")) == [0.75, 0.875]


def test_the_longest_stretch_is_taken() -> None:
    changes = (
        (0.0, "running"),
        (0.2, "holding"),
        (0.35, "running"),
        (0.7, "parking"),
        (0.85, "running"),
    )
    assert rows(*changes) == [0.375, 0.5, 0.625]
