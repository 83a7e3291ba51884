"""What a ride is worth beside one that stands still."""

import pytest

from atlas_cueing.evaluation import mismatch_ratio


@pytest.mark.parametrize(
    ("mismatch", "still", "ratio"),
    [(3.0, 6.0, 0.5), (6.0, 3.0, 2.0), (0.2, 4.0, 0.25), (0.2, 0.9, 1.0), (2.0, 0.1, 2.0)],
)
def test_what_cannot_be_felt_counts_as_just_noticed(
    mismatch: float, still: float, ratio: float
) -> None:
    assert mismatch_ratio(mismatch, still) == ratio
