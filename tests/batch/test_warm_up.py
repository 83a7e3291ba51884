"""What a worker makes before its first run."""

from atlas_cueing.batch.warm_up import warm_up


def test_it_flies() -> None:
    assert warm_up() == "ok"
