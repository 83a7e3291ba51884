"""Helpers that die: each is told once, whichever it is."""

from atlas_cueing.telemetry import HelperWatch, Loss


def test_each_death_is_told_once() -> None:
    watch, alive = HelperWatch(), {"a": True, "b": True, "c": True}
    assert watch.losses() == ()
    for name in alive:
        watch.add(lambda name=name: alive[name], name, parks=name == "b")
    assert [watch.losses() for _ in range(9)] == [()] * 9
    alive["b"] = alive["c"] = False
    found = [loss for _ in range(9) for loss in watch.losses()]
    assert sorted(found) == [Loss("b", True), Loss("c", False)]
    assert [watch.losses() for _ in range(9)] == [()] * 9
