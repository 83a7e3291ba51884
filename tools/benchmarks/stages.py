"""What each stage costs a tick.

The mean is processor time over blocks of ticks without a clock between them, as a run has it.
Median and p99.9 are over the ticks of passes with a clock around every call, whose own cost is in
them and told apart. A tick counts with the least of its passes: it does the same work in each, and
what comes on top is the machine's (a slice of 4 ms for someone else).
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import chain
from statistics import median
from time import process_time
from typing import Any

import numpy as np

from atlas_cueing.cueing import CAUSAL_METHODS
from atlas_cueing.live.control.command import command_of
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.run import build_pipeline, open_vehicle, ticks
from atlas_cueing.scenario import Scenario
from atlas_cueing.signals import Tick, VehicleState

from .effort import Bench
from .flights import STAGED, script_scenario
from .peers import ruckig_call
from .rows import Asked, Row
from .timing import clock_cost, each, without_garbage
from .whole_run import Bare

BLOCK = 32  # ticks, as a run takes them through the pipeline
ASKED = Asked(40.0)  # us a tick: blend, without vehicle and recording
_CALLS = 2000  # of a peer, to time it

# a stage at its start, and what it is to be given
Ready = Callable[[], tuple[Callable[[Any], object], Sequence[Any]]]


@dataclass(slots=True)
class Stage:
    """A stage as it is measured: means of each round (us a tick), each pass's ticks (ns)."""

    ready: Ready
    means: list[float] = field(default_factory=list)
    passes: list[list[int]] = field(default_factory=list)

    def round(self) -> None:
        """One round of both kinds."""
        step, items = self.ready()
        begun = process_time()
        for item in items:
            step(item)
        self.means.append((process_time() - begun) / _ticks(items) * 1e6)
        step, items = self.ready()
        self.passes.append(each(step, items))

    def row(self, what: str, **more: Any) -> Row:
        """The mean, with median and p99.9 beside it."""
        if len(self.passes[0]) < _ticks(self.ready()[1]):
            return Row("stages", what, median(self.means), "us", self.means, **more)
        ticks = np.min(self.passes, axis=0) / 1e3
        note = f"median {np.median(ticks):.1f}, p99.9 {np.quantile(ticks, 0.999):.0f}"
        return Row("stages", what, median(self.means), "us", self.means, note=note, **more)


def measure(bench: Bench) -> Iterator[Row]:
    """Vehicle, cueing by each method, smoothing, guard, wheels, the whole pipeline.

    Calls of ruckig beside them.
    """
    scenarios = {
        name: script_scenario(bench.folder, STAGED, bench.effort.flight, name)
        for name in CAUSAL_METHODS
    }
    blend = scenarios["blend"]
    flight = flown(blend)
    states, dt = [tick.vehicle for tick in flight], flight[1].vehicle.time
    stages = {
        f"cueing {name}": Stage(partial(_cueing, scenario, dt, states))
        for name, scenario in scenarios.items()
    }
    stages["smoothing"] = Stage(
        lambda: (build_pipeline(blend, dt).smoothing.step, [tick.cue for tick in flight])
    )
    stages["wheels"] = Stage(
        lambda: (build_pipeline(blend, dt).wheels.speeds, [tick.motion for tick in flight])
    )
    stages["guard"] = Stage(partial(_guard, blend, dt, flight))
    stages["pipeline"] = Stage(lambda: (build_pipeline(blend, dt).block, list(_blocks(states))))
    stages["advance"] = Stage(lambda: _vehicle(blend, len(flight)))
    stages["bare"] = Stage(lambda: _bare(len(flight)))
    calls = {axes: ruckig_call(axes) for axes in (1, 3)}
    planning: dict[int, list[float]] = {axes: [] for axes in calls}
    with without_garbage():
        for number in range(bench.effort.rounds):
            bench.say(f"stages: round {number + 1} of {bench.effort.rounds}")
            for stage in stages.values():
                stage.round()
            for axes, call in calls.items():
                planning[axes].append(call_cost(call))
    yield from _rows(stages, planning)


def flown(scenario: Scenario) -> list[Tick]:
    """All ticks of a flight."""
    vehicle = open_vehicle(scenario)
    return [*chain.from_iterable(ticks(vehicle, build_pipeline(scenario, vehicle.dt)))]


def _rows(stages: dict[str, Stage], planning: dict[int, list[float]]) -> Iterator[Row]:
    bare, advance = stages.pop("bare"), stages.pop("advance")
    one, three = median(planning[1]), median(planning[3])
    reading = Stage(
        advance.ready,
        [a - b for a, b in zip(advance.means, bare.means, strict=True)],
        advance.passes,
    )
    yield bare.row("bare JSBSim step")
    row = reading.row(
        "vehicle: advance less bare run()",
        reference="bare step",
        reference_value=median(bare.means),
    )
    yield row.noted("these with run() in it")
    asked = {"pipeline": ASKED}
    references = {
        "smoothing": ("six ruckig calls, 1 DOF", 6.0 * one),
        "pipeline": ("bare step", median(bare.means)),
    }
    titles = {"pipeline": "blend pipeline: cueing, smoothing, wheels"}
    for name, stage in stages.items():
        reference, value = references.get(name, ("ruckig call, 3 DOF", three))
        yield stage.row(
            titles.get(name, name),
            reference=reference,
            reference_value=value,
            asked=asked.get(name),
        )
    for axes, samples in planning.items():
        yield Row("stages", f"ruckig calculate, {axes} DOF", median(samples), "us", samples)
    yield Row(
        "stages",
        "the clock around each tick",
        clock_cost(),
        "us",
        note="is in the medians above, not in the means",
    )


def call_cost(call: Callable[[], object]) -> float:
    """Processor time of a call, us: the mean over a block of them."""
    begun = process_time()
    for _ in range(_CALLS):
        call()
    return (process_time() - begun) / _CALLS * 1e6


def _ticks(items: Sequence[Any]) -> int:
    return sum(len(item) if isinstance(item, list) else 1 for item in items)


def _blocks(states: list[VehicleState]) -> Iterator[list[VehicleState]]:
    for start in range(0, len(states), BLOCK):
        yield states[start : start + BLOCK]


def _cueing(
    scenario: Scenario, dt: float, states: list[VehicleState]
) -> tuple[Callable[[Any], object], Sequence[Any]]:
    return build_pipeline(scenario, dt).cueing.step, states


def _guard(
    scenario: Scenario, dt: float, ticks: list[Tick]
) -> tuple[Callable[[Any], object], Sequence[Any]]:
    """A guard that lets all of them through, or the time is that of something else."""
    platform = scenario.platform
    guard = Guard(dt, platform.wheel_limit_values(), platform.stage_limit_values())
    smoothing = build_pipeline(scenario, dt).smoothing
    commands = []
    for tick in ticks:
        smoothing.step(tick.cue)
        commands.append(command_of(tick, smoothing.wheel_motion()[0]))
    guard.start(commands[0])
    for command in commands[1:]:
        guard.check(command)
    if guard.stopping:
        raise SystemExit(f"the guard refuses a command: {guard.reason}")
    guard.start(commands[0])
    return guard.check, commands[1:]


def _vehicle(scenario: Scenario, ticks: int) -> tuple[Callable[[Any], object], Sequence[Any]]:
    vehicle = open_vehicle(scenario)
    return lambda _: vehicle.advance(), range(ticks - 1)


def _bare(ticks: int) -> tuple[Callable[[Any], object], Sequence[Any]]:
    bare = Bare(STAGED, ticks)
    bare.load()
    return lambda _: bare.step(), range(ticks - 1)
