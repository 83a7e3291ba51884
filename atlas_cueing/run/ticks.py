"""The loop from the vehicle through the pipeline."""

# mypyc: runs every tick

from collections.abc import Callable, Iterator
from typing import Final

from ..pipeline import Pipeline
from ..signals import Tick, Vehicle, VehicleState

BLOCK: Final = 256  # ticks taken through the pipeline stage by stage


def ticks(
    vehicle: Vehicle, pipeline: Pipeline, stop: Callable[[], bool] = lambda: False
) -> Iterator[list[Tick]]:
    """Fly `vehicle` to its end and yield its ticks in blocks of at most BLOCK.

    The first tick is that of the vehicle's present state. A block costs less than as many single
    ticks (see `Pipeline.block`), so blocks are what is handed on.

    Args:
        vehicle: at its first state.
        pipeline: a new one, made for the vehicle's step.
        stop: asked before each step; when true, the flight ends there.

    Raises:
        MethodError: an own cueing method failed.
        VehicleError: the vehicle failed. What it flew before has been yielded, as after any other
            error of the vehicle.
    """
    states, more = [vehicle.state], True
    while more:
        try:
            more = _fill(states, vehicle, stop)
        finally:  # an error waits until the ticks before it are taken
            while states:
                done = pipeline.block(states)
                yield done
                states = states[len(done) :]


def _fill(states: list[VehicleState], vehicle: Vehicle, stop: Callable[[], bool]) -> bool:
    """Step the vehicle until there is a block of states; False at the end of the flight."""
    while len(states) < BLOCK:
        if stop() or not vehicle.advance():
            return False
        states.append(vehicle.state)
    return True
