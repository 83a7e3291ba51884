"""What a tick of the simulated platform costs, beside the bare JSBSim loop of as many steps."""

from collections.abc import Iterator
from functools import partial
from statistics import median

from atlas_cueing.plant import fly_plant
from atlas_cueing.recording import read_log
from atlas_cueing.run import run_scenario

from .effort import Bench
from .flights import STAGED, script_scenario
from .rows import Row
from .timing import cost, interleaved
from .whole_run import Bare

SHARE = 0.1  # of a flight: a tick of the plant is many steps
FEEDBACKS = ("none", "fix")  # the least that its loop does, and the most


def measure(bench: Bench) -> Iterator[Row]:
    """Processor time a tick, without a loop and with the one that does most."""
    bench.say(f"plant: {bench.effort.rounds} rounds")
    scenario = script_scenario(bench.folder, STAGED, SHARE * bench.effort.flight)
    ticks = run_scenario(scenario, bench.folder / "plant.mcap").ticks
    log, bare = read_log(bench.folder / "plant.mcap"), Bare(STAGED, ticks - 1)
    fly = partial(fly_plant, log, scenario.platform)
    works = {kind: partial(cost, partial(fly, kind)) for kind in FEEDBACKS}
    found = interleaved(bench.effort.rounds, {**works, "load": bare.load, "bare": bare.fly})
    steps = [1e6 * each.cpu / (ticks - 1) for each in found["bare"]]
    for kind in FEEDBACKS:
        samples = [1e6 * each.cpu / ticks for each in found[kind]]
        what = f"plant, feedback {kind}, CPU a tick"
        yield Row("plant", what, median(samples), "us", samples, "bare JSBSim step", median(steps))
