"""What a flight may cost, in counts that are the same on every machine; and the tool that measures it in seconds.

Calls of Python functions and builtins stand for time: the bounds are twice what the code needed when they were set, so that
they meet a stage that does its work twice, not one that grows by a line.
"""

import json
import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import asdict
from io import StringIO
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
from rich.console import Console

from atlas_cueing.cueing.horizon_problem import HorizonProblem
from atlas_cueing.recording import McapRecorder
from atlas_cueing.scenario import Scenario, build, load_scenario, load_variants
from atlas_cueing.signals import Tick, VehicleState
from atlas_cueing.vehicles import JsbsimVehicle

ROOT = Path(__file__).parents[1]
TOOL = ROOT / "tools" / "benchmark"
sys.path.insert(0, str(TOOL.parent))  # where its modules lie

from benchmarks import batches, memory, recorder, report, reviewing, stages, start_up, timing, whole_run  # noqa: E402
from benchmarks.effort import FULL, QUICK, Bench, Effort  # noqa: E402
from benchmarks.machine import Stolen, build_kind, facts  # noqa: E402
from benchmarks.rows import Asked, Row  # noqa: E402
from benchmarks.timing import Cost  # noqa: E402

RATE_HZ = 120.0
CHUNK = 32  # ticks
# Calls a tick as they were, in a flight of c1722 at 120 Hz.
CUEING = {"attitude": 106, "blend": 127, "force": 120, "classical": 83}
SMOOTHING, WHEELS, RECORDING = 157, 6, 44
SOLVES = 180  # a second: three axes, 60 plans each
ROOM = 2.0

SCRIPT = """
name = "counted"
duration_s = {duration}
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
[cueing]
method = "{method}"
"""
ONCE = Effort(1, 1, 2.0, 4.0, 2, 0.25, 1, ((120.0, 3.0), (120.0, 4.0)))

interpreted = pytest.mark.skipif(build_kind() == "compiled", reason="the compiled build: nobody sees its calls")


def scenario(folder: Path, duration: float, method: str = "blend") -> Scenario:
    file = folder / f"{method}.toml"
    file.write_text(SCRIPT.format(duration=duration, method=method))
    return load_scenario(file)


def flight(of: Scenario) -> list[VehicleState]:
    vehicle = JsbsimVehicle(of.flight)
    states = [vehicle.state]
    while vehicle.advance():
        states.append(vehicle.state)
    return states


def calls(step: Callable[[Any], Any], items: Sequence[Any]) -> tuple[float, list[Any]]:
    """Calls for each item, of Python functions and of builtins; and what the steps gave."""
    count = 0

    def note(_frame: FrameType, event: str, _argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        given = [step(item) for item in items]
    finally:
        sys.setprofile(before)
    return count / len(items), given


def stage_calls(of: Scenario, states: Sequence[VehicleState], log: Path) -> dict[str, float]:
    """Calls a tick of every stage of one flight."""
    pipeline = build(of, 1.0 / RATE_HZ)
    cueing, cues = calls(pipeline.cueing.step, states)
    smoothing, motions = calls(pipeline.smoothing.step, cues)
    wheels, speeds = calls(pipeline.wheels.speeds, motions)
    ticks = [Tick(*parts) for parts in zip(states, cues, motions, speeds, strict=True)]
    recorder = McapRecorder(log, head_S=of.platform.head_S, metadata={}, attachments={}, chunk_ticks=CHUNK)
    recording, _ = calls(recorder.append, ticks)
    recorder.abandon()
    return {"cueing": cueing, "smoothing": smoothing, "wheels": wheels, "recording": recording}


@interpreted
@pytest.mark.parametrize("method", CUEING)
def test_calls_of_a_tick(method: str, tmp_path: Path) -> None:
    of = scenario(tmp_path, 4.0, method)
    found = stage_calls(of, flight(of), tmp_path / "log.mcap")
    bounds = {"cueing": CUEING[method], "smoothing": SMOOTHING, "wheels": WHEELS, "recording": RECORDING}
    assert {name: count for name, count in found.items() if not 0.0 < count <= ROOM * bounds[name]} == {}


@interpreted
def test_a_tick_costs_the_same_however_long_the_flight(tmp_path: Path) -> None:
    """Ten times the ticks, ten times the calls: nothing is searched or gone through again."""
    of = scenario(tmp_path, 16.0)
    states = flight(of)
    short, long = (stage_calls(of, states[:count], tmp_path / "log.mcap") for count in (6 * CHUNK, 60 * CHUNK))
    assert short == pytest.approx(long, rel=0.05)


@interpreted
def test_plans_of_a_second(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    of, solved = scenario(tmp_path, 4.0), 0
    states, solve = flight(of), HorizonProblem.solve

    def counted(*arguments: Any) -> list[float] | None:
        nonlocal solved
        solved += 1
        return solve(*arguments)

    monkeypatch.setattr(HorizonProblem, "solve", counted)
    pipeline = build(of, 1.0 / RATE_HZ)
    for state in states:
        pipeline.step(state)
    assert 0 < solved <= ROOM * SOLVES * 4.0


def test_a_recorder_keeps_a_chunk_and_no_more(tmp_path: Path) -> None:
    """Memory held after 4000 ticks is that after 400, but for the index of the chunks: 30 bytes a tick of 700."""
    of = scenario(tmp_path, 1.0)
    pipeline = build(of, 1.0 / RATE_HZ)
    ticks = [pipeline.step(state) for state in flight(of)]
    recorder = McapRecorder(tmp_path / "log.mcap", head_S=of.platform.head_S, metadata={}, attachments={}, chunk_ticks=CHUNK)
    held = {}
    tracemalloc.start()
    try:
        for number in range(4001):
            tick = ticks[number % len(ticks)]
            state = VehicleState(number / RATE_HZ, tick.vehicle.q_NB, tick.vehicle.w_NB_B, tick.vehicle.f_B)
            recorder.append(Tick(state, tick.cue, tick.motion, tick.wheels))
            if number in (400, 4000):
                held[number] = tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()
        recorder.abandon()
    assert held[4000] - held[400] < 30 * 3600


def modules(*arguments: str, folder: Path) -> set[str]:
    """First names of all that is loaded when a command has ended, and those of this package in full."""
    code = (
        "import sys; from atlas_cueing.cli import main; status = main(sys.argv[1:]);"
        "print(*sorted(sys.modules), file=sys.stderr); sys.exit(status)"
    )
    command = [sys.executable, "-c", code, *arguments]
    told = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=True).stderr.split()
    return {name if name.startswith("atlas_cueing.") else name.split(".")[0] for name in told}


HEAVY = {"clarabel", "dask", "distributed", "foxglove", "matplotlib", "plotly", "scipy", "viser", "websockets"}
NUMBERS = {"daqp", "google", "jsbsim", "mcap", "numpy", "pydantic", "ruckig", "tomli_w", "zstandard"}


def test_help_loads_no_more_than_the_command_line(tmp_path: Path) -> None:
    loaded = modules("--help", folder=tmp_path)
    assert loaded & (HEAVY | NUMBERS) == set()
    assert {name for name in loaded if name.startswith("atlas_cueing.")} <= {
        f"atlas_cueing.{name}"
        for name in ("cli", "errors", *(f"cli.{file.stem}" for file in (ROOT / "atlas_cueing/cli").glob("*.py")))
    }


def test_a_run_loads_nothing_of_reports_and_clusters(tmp_path: Path) -> None:
    scenario(tmp_path, 0.25)
    loaded = modules("run", "blend.toml", folder=tmp_path)
    assert loaded & HEAVY == set()
    assert loaded >= NUMBERS - {"tomli_w"}


# The tool.


def measured(section: Any, folder: Path) -> list[Row]:
    """All rows of a section that measures as little as it can."""
    found = list(section.measure(Bench(ONCE, folder, lambda _: None)))
    assert len({row.what for row in found}) == len(found) > 0
    return found


@pytest.mark.parametrize("section", [whole_run, stages, recorder], ids=lambda module: module.__name__)
def test_a_section_measures_what_it_names(section: Any, tmp_path: Path) -> None:
    """Every row a positive number beside a positive reference, but for differences: so short a flight may hide their sign."""
    for row in measured(section, tmp_path):
        difference = section is whole_run or "less" in row.what
        assert row.value > 0.0 or difference, row
        assert row.reference_value is None or row.reference_value > 0.0, row
        assert row.verdict in ("met", "short") if row.asked else row.verdict == "", row


class Processes:
    """Stands for `fresh`: looks at the scenario, starts nothing, and takes two seconds of the wall's and one of the CPU's."""

    def __init__(self) -> None:
        self.commands: list[str] = []

    def __call__(self, arguments: Sequence[str | Path], folder: Path, *_command: Sequence[str]) -> Cost:
        verb, *rest = arguments
        self.commands.append(str(verb))
        if verb in ("run", "batch"):
            assert load_variants(Path(rest[0]))
        if "-o" in rest:
            (folder / rest[rest.index("-o") + 1]).touch()
        (folder / "peak").write_text(str(10**6 * (100 + len(self.commands))))
        return Cost(1.0, 2.0 + ("2" in rest))


@pytest.mark.parametrize(
    ("section", "commands", "values"),
    [
        (reviewing, ["run", "run", *2 * ["review", "compare", "one.mcap"]], [2.0, 1.0, 2.0, 1.0]),
        (start_up, 2 * ["--help", "platform", "run", "pass", "import numpy, jsbsim"], [2.0] * 5),
        (batches, 3 * ["batch"] + ["batch"], [40.0]),
        (memory, ["run", "run"], [101.0, 102.0, 3600.0]),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_a_section_of_processes(
    section: Any, commands: list[str], values: list[float], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it starts, in turns after a warm round, and what it makes of two seconds each."""
    processes = Processes()
    monkeypatch.setattr(section, "fresh", processes)
    found = measured(section, tmp_path)
    assert processes.commands == commands
    assert [row.value for row in found] == pytest.approx(values)


def test_every_bound_that_was_asked_has_its_row() -> None:
    assert [asked.text("us") for asked in (whole_run.ASKED, stages.ASKED, recorder.ASKED, batches.ASKED)] == [
        "≤ 2x (goal 1.5x)",
        "≤ 40 us",
        "≤ 5 us",
        "≥ 1.8x",
    ]
    assert [asked.text("s") for asked in (start_up.HELP, start_up.RUN, reviewing.ASKED)] == ["≤ 0.3 s", "≤ 0.8 s", "≤ 3 s"]
    assert memory.ASKED.text("MB") == "≤ 300 MB"
    assert FULL.rounds >= 5 <= QUICK.rounds
    assert FULL.log == reviewing.ASKED_FOR


@pytest.mark.parametrize(
    ("asked", "value", "reference", "verdict"),
    [
        (Asked(2.0, of_ratio=True), 39.0, 20.0, "met"),
        (Asked(2.0, of_ratio=True), 41.0, 20.0, "short"),
        (Asked(40.0), 39.0, 1.0, "met"),
        (Asked(40.0), 41.0, 100.0, "short"),
        (Asked(1.8, of_ratio=True, at_least=True), 19.0, 10.0, "met"),
        (Asked(1.8, of_ratio=True, at_least=True), 17.0, 10.0, "short"),
        (Asked(2.0, of_ratio=True), 1.0, None, ""),
        (None, 1.0, 1.0, ""),
    ],
)
def test_verdict(asked: Asked | None, value: float, reference: float | None, verdict: str) -> None:
    assert Row("run", "it", value, "us", reference="other", reference_value=reference, asked=asked).verdict == verdict


def test_rounds_are_interleaved_and_a_warm_one_does_not_count() -> None:
    order: list[str] = []

    def work(name: str) -> Callable[[], Cost]:
        def run() -> Cost:
            order.append(name)
            return Cost(float(len(order)), 0.0)

        return run

    found = timing.interleaved(2, {"a": work("a"), "b": work("b")}, warm=True)
    assert "".join(order) == "ababab"
    assert [cost.cpu for cost in found["a"]] == [3.0, 5.0]
    assert [cost.cpu for cost in found["b"]] == [4.0, 6.0]


def test_a_long_flight_less_a_short_one() -> None:
    assert (Cost(10.0, 21.0) - Cost(4.0, 5.0)) / 2.0 == Cost(3.0, 8.0)
    assert Cost(3.0, 8.0) * 2.0 == Cost(6.0, 16.0)


def test_a_process_of_its_own(tmp_path: Path) -> None:
    """Its own time and no more; one that fails ends the benchmark, with what it said."""
    spent = timing.fresh([], tmp_path, [sys.executable, "-c", "sum(range(10**6))"])
    assert min(spent.cpu, spent.wall) > 0.0
    failing = [sys.executable, "-c", "import sys; print('no such', sys.argv[1]); sys.exit(2)"]
    with pytest.raises(SystemExit, match="exit status 2\nno such file"):
        timing.fresh(["file"], tmp_path, failing)


def test_the_table_and_the_json_say_the_same() -> None:
    found = [
        Row("run", "a run", 30.0, "us", [29.0, 30.0, 31.0], "bare", 20.0, Asked(2.0, of_ratio=True), "as noted"),
        Row("start", "a start", 1.5, "s", asked=Asked(0.3)),
    ]
    told = json.loads(report.to_json(found, facts(), 0.25, asdict(ONCE)))
    assert [(row["ratio"], row["verdict"]) for row in told["rows"]] == [(1.5, "met"), (None, "short")]
    assert told["rows"][0]["samples"] == [29.0, 30.0, 31.0]
    assert (told["code"], told["stolen_share"], told["effort"]["rounds"]) == (build_kind(), 0.25, 1)
    text = StringIO()
    report.print_table(found, facts(), 0.25, Console(file=text))
    lines = text.getvalue().splitlines()
    assert lines[0] == f"code: {build_kind()}"
    shown = next(line for line in lines if "a run" in line)
    assert [cell.strip() for cell in shown.split("│")[1:-1]] == ["a run", "30 us", "bare 20", "1.50", "≤ 2x", "met", "as noted"]
    assert "25% of the processors taken away" in lines[-1]


def test_time_taken_away_is_a_share() -> None:
    share = Stolen().share()
    assert share is None or 0.0 <= share <= 1.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [(["--only", "everything"], "invalid choice: 'everything'"), (["--json", "no/such.json"], "no such folder")],
)
def test_wrong_usage(arguments: list[str], message: str, tmp_path: Path) -> None:
    told = subprocess.run(
        [sys.executable, str(TOOL), *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False
    )
    assert (told.returncode, told.stdout) == (2, "")
    assert message in told.stderr
