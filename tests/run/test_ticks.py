"""The loop from the vehicle through the pipeline."""

from itertools import chain
from pathlib import Path

import pytest
from scenario.texts import SIGNALS

from atlas_cueing.errors import VehicleError
from atlas_cueing.run import build_pipeline, open_vehicle, ticks
from atlas_cueing.run.ticks import BLOCK
from atlas_cueing.scenario import Scenario, load_scenario
from atlas_cueing.signals import Tick, VehicleState
from atlas_cueing.vehicles import RecordedVehicle


def loaded(folder: Path, *settings: str) -> Scenario:
    (folder / "s.toml").write_text(SIGNALS)
    return load_scenario(folder / "s.toml", settings)


class Failing(RecordedVehicle):
    """A recorded vehicle that fails where it would end."""

    error: BaseException = VehicleError(1.0, "no more")

    def advance(self) -> bool:
        if super().advance():
            return True
        raise self.error


def states(count: int) -> list[VehicleState]:
    return [
        VehicleState(0.02 * k, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.80665))
        for k in range(count)
    ]


def test_blocks_are_the_single_steps(tmp_path: Path) -> None:
    scenario = loaded(tmp_path, "duration_s=12")
    vehicle, pipeline = open_vehicle(scenario), build_pipeline(scenario, 0.02)
    single = [pipeline.step(vehicle.state)]
    while vehicle.advance():
        single.append(pipeline.step(vehicle.state))
    blocks = list(ticks(open_vehicle(scenario), build_pipeline(scenario, 0.02)))
    assert [len(block) for block in blocks] == [256, 256, 89]
    assert [*chain.from_iterable(blocks)] == single


@pytest.mark.parametrize("count", [1, 2, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK])
@pytest.mark.parametrize("error", [VehicleError(1.0, "no more"), KeyboardInterrupt()])
def test_what_was_flown_comes_before_the_failure(
    tmp_path: Path, count: int, error: BaseException
) -> None:
    vehicle = Failing(states(max(count, 2)))
    vehicle.error = error
    if count == 1:
        vehicle.advance()
    found: list[Tick] = []
    blocks = ticks(vehicle, build_pipeline(loaded(tmp_path), 0.02))
    with pytest.raises(type(error)):
        found.extend(chain.from_iterable(blocks))
    assert len(found) == count


def test_a_request_to_stop_is_looked_at_before_each_step(tmp_path: Path) -> None:
    looks = iter([False] * 300 + [True] * 5)
    pipeline = build_pipeline(loaded(tmp_path), 0.02)
    found = ticks(RecordedVehicle(states(1000)), pipeline, lambda: next(looks))
    assert [len(block) for block in found] == [256, 45]
