"""A whole run over the bare loop of JSBSim's own script.

Bare: load_script, run_ic, and run() as often as the run has steps; without the model's own output
files, which a run does not write either. Whole: `run_scenario`, from the loaded scenario to the
finished and evaluated log. The time of a tick is the difference of a long and a short flight over
their ticks, so that start-up is not in it; that is what is left of the short one.
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from statistics import median

import jsbsim

from atlas_cueing.cueing import DEFAULT_METHOD
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import Scenario
from atlas_cueing.vehicles import own_scripts
from atlas_cueing.vehicles.jsbsim.jsbsim_log import capture

from .effort import Bench
from .flights import SCRIPTS, STAGED, script_scenario
from .rows import Asked, Row
from .timing import Cost, cost, interleaved

SHORT = 1.0  # s of flight
# beside `blend` with loads: method, and whether the platform has loads
OTHERS = (("blend", False), (DEFAULT_METHOD, True), (DEFAULT_METHOD, False))
ASKED = Asked(2.0, of_ratio=True, goal=1.5)


class Bare:
    """JSBSim and nothing else."""

    def __init__(self, script: str, steps: int) -> None:
        capture()  # its console output
        self._script, self._steps = str(own_scripts()[script]), steps
        self._fdm: jsbsim.FGFDMExec | None = None

    def load(self) -> Cost:
        """To the first state."""
        return cost(self._load)

    def fly(self) -> Cost:
        """All steps."""
        return cost(self._fly)

    def _load(self) -> None:
        self._fdm = jsbsim.FGFDMExec(jsbsim.get_default_root_dir())
        self._fdm.set_debug_level(0)
        self._fdm.load_script(self._script)
        self._fdm.disable_output()
        self._fdm.run_ic()

    def step(self) -> bool:
        """One of them."""
        return self._fdm.run()

    def _fly(self) -> None:
        run = self._fdm.run
        left = self._steps
        while left and run():
            left -= 1


def measure(bench: Bench) -> Iterator[Row]:
    """Ratio, wall times and start-up of each script; the ratio of the other kinds of run."""
    for script, share in SCRIPTS.items():
        bench.say(f"run: {script}, {bench.effort.rounds} rounds")
        length = max(share * bench.effort.flight, 2.0 * SHORT)
        long, short = (
            script_scenario(bench.folder, script, duration) for duration in (length, SHORT)
        )
        yield from _rows(bench, script, script, long, short)
    for method, loads in OTHERS:
        name = f"{STAGED}, {method}{'' if loads else ', no loads'}"
        bench.say(f"run: {name}, {bench.effort.rounds} rounds")
        long, short = (
            script_scenario(bench.folder, STAGED, duration, method, loads=loads)
            for duration in (bench.effort.flight, SHORT)
        )
        yield next(_rows(bench, name, STAGED, long, short))


def _rows(bench: Bench, name: str, script: str, long: Scenario, short: Scenario) -> Iterator[Row]:
    log = bench.folder / "run.mcap"
    many, few = _ticks(long, log), _ticks(short, log)  # warms up, too
    bare = Bare(script, many - 1)
    works = {
        "short": _run(short, log),
        "long": _run(long, log),
        "load": bare.load,
        "bare": bare.fly,
    }
    found = interleaved(bench.effort.rounds, works)
    ticks = [
        (more - less) / (many - few)
        for more, less in zip(found["long"], found["short"], strict=True)
    ]
    steps = [each / (many - 1) for each in found["bare"]]
    starts = [less - tick * few for less, tick in zip(found["short"], ticks, strict=True)]
    ratios = [tick.cpu / step.cpu for tick, step in zip(ticks, steps, strict=True)]
    spread = f"ratios by round {min(ratios):.2f} to {max(ratios):.2f}"
    yield _row(
        f"{name}: run, CPU a tick",
        "us",
        _cpu(ticks, 1e6),
        "bare JSBSim loop",
        _cpu(steps, 1e6),
        ASKED,
        spread,
    )
    walls = [1e6 * tick.wall for tick in ticks], [1e6 * step.wall for step in steps]
    yield _row(f"{name}: run, wall a tick", "us", walls[0], "bare JSBSim loop", walls[1])
    what = f"{name}: start-up and end, warm process, CPU"
    yield _row(what, "ms", _cpu(starts, 1e3), "load_script and run_ic", _cpu(found["load"], 1e3))


def _cpu(costs: Sequence[Cost], factor: float) -> list[float]:
    return [factor * each.cpu for each in costs]


def _row(
    what: str,
    unit: str,
    samples: Sequence[float],
    reference: str,
    others: Sequence[float],
    asked: Asked | None = None,
    note: str = "",
) -> Row:
    return Row("run", what, median(samples), unit, samples, reference, median(others), asked, note)


def _run(scenario: Scenario, log: Path) -> Callable[[], Cost]:
    return lambda: cost(lambda: run_scenario(scenario, log))


def _ticks(scenario: Scenario, log: Path) -> int:
    """Ticks of a flight, which has to be a whole one."""
    result = run_scenario(scenario, log)
    if result.result != "ok":
        raise SystemExit(f"{scenario.name}: {result.result}: {result.reason}")
    return result.ticks
