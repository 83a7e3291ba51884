"""What a flight may cost, in counts that are the same on every machine.

Calls of Python functions and builtins stand for time: the bounds are twice what the code needed
when they were set, so that they meet a stage that does its work twice, not one that grows by a
line.
"""

import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
from installed import PACKAGE, ROOT

from atlas_cueing.cueing.stage.mpc_qp import MpcProblem
from atlas_cueing.cueing.stage.mpc_unconstrained import Plan
from atlas_cueing.recording import McapRecorder
from atlas_cueing.run import build_pipeline, open_vehicle
from atlas_cueing.scenario import Scenario, load_scenario
from atlas_cueing.signals import Tick, VehicleState

TOOL = ROOT / "tools" / "benchmark"
sys.path.insert(0, str(TOOL.parent))  # where its modules lie

from benchmarks.machine import build_kind  # noqa: E402

RATE_HZ = 120.0
CHUNK = 32  # ticks
# Calls a tick as they were, in a flight of c1722 at 120 Hz.
CUEING = {
    "attitude": 121,
    "blend": 146,
    "force": 134,
    "perceptual": 159,
    "hedge": 832,
    "classical": 73,
    "still": 64,
}
SMOOTHING, WHEELS, RECORDING = 145, 4, 23
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

interpreted = pytest.mark.skipif(
    build_kind() == "compiled", reason="the compiled build: nobody sees its calls"
)


def scenario(folder: Path, duration: float, method: str = "blend") -> Scenario:
    file = folder / f"{method}.toml"
    file.write_text(SCRIPT.format(duration=duration, method=method))
    return load_scenario(file)


def flight(of: Scenario) -> list[VehicleState]:
    vehicle = open_vehicle(of)
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
    pipeline = build_pipeline(of, 1.0 / RATE_HZ)
    cueing, cues = calls(pipeline.cueing.step, states)
    smoothing, motions = calls(pipeline.smoothing.step, cues)
    wheels, speeds = calls(pipeline.wheels.speeds, motions)
    ticks = [Tick(*parts) for parts in zip(states, cues, motions, speeds, strict=True)]
    recorder = McapRecorder(
        log, head_S=of.platform.head_S, metadata={}, attachments={}, chunk_ticks=CHUNK
    )
    recording, _ = calls(recorder.append, ticks)
    recorder.abandon()
    return {"cueing": cueing, "smoothing": smoothing, "wheels": wheels, "recording": recording}


@interpreted
@pytest.mark.parametrize("method", CUEING)
def test_calls_of_a_tick(method: str, tmp_path: Path) -> None:
    of = scenario(tmp_path, 4.0, method)
    found = stage_calls(of, flight(of), tmp_path / "log.mcap")
    bounds = {
        "cueing": CUEING[method],
        "smoothing": SMOOTHING,
        "wheels": WHEELS,
        "recording": RECORDING,
    }
    assert {
        name: count for name, count in found.items() if not 0.0 < count <= ROOM * bounds[name]
    } == {}


@interpreted
def test_a_tick_costs_the_same_however_long_the_flight(tmp_path: Path) -> None:
    """Ten times the ticks, ten times the calls: nothing is searched or gone through again."""
    of = scenario(tmp_path, 16.0)
    states = flight(of)
    short, long = (
        stage_calls(of, states[:count], tmp_path / "log.mcap") for count in (6 * CHUNK, 60 * CHUNK)
    )
    assert short == pytest.approx(long, rel=0.05)


@interpreted
def test_plans_of_a_second(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    of, solved = scenario(tmp_path, 4.0), 0
    states, solve = flight(of), MpcProblem.solve

    def counted(*arguments: Any) -> Plan | None:
        nonlocal solved
        solved += 1
        return solve(*arguments)

    monkeypatch.setattr(MpcProblem, "solve", counted)
    pipeline = build_pipeline(of, 1.0 / RATE_HZ)
    for state in states:
        pipeline.step(state)
    assert 0 < solved <= ROOM * SOLVES * 4.0


def test_a_recorder_keeps_a_chunk_and_no_more(tmp_path: Path) -> None:
    """Memory held after 4000 ticks is that after 400, but for the index of the chunks.

    That is 30 bytes a tick of 700.
    """
    of = scenario(tmp_path, 1.0)
    pipeline = build_pipeline(of, 1.0 / RATE_HZ)
    ticks = [pipeline.step(state) for state in flight(of)]
    recorder = McapRecorder(
        tmp_path / "log.mcap",
        head_S=of.platform.head_S,
        metadata={},
        attachments={},
        chunk_ticks=CHUNK,
    )
    held = {}
    tracemalloc.start()
    try:
        for number in range(4001):
            tick = ticks[number % len(ticks)]
            state = VehicleState(
                number / RATE_HZ, tick.vehicle.q_NB, tick.vehicle.w_NB_B, tick.vehicle.f_B
            )
            recorder.append(Tick(state, tick.cue, tick.motion, tick.wheels))
            if number in (400, 4000):
                held[number] = tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()
        recorder.abandon()
    assert held[4000] - held[400] < 30 * 3600


def modules(*arguments: str, folder: Path) -> set[str]:
    """First names of all modules loaded when a command has ended; those of this package whole."""
    code = (
        "import sys; from atlas_cueing.cli import main; status = main(sys.argv[1:]);"
        "print(*sorted(sys.modules), file=sys.stderr); sys.exit(status)"
    )
    command = [sys.executable, "-c", code, *arguments]
    told = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=60, check=True
    ).stderr.split()
    return {name if name.startswith("atlas_cueing.") else name.split(".")[0] for name in told}


HEAVY = {
    "clarabel",
    "dask",
    "distributed",
    "foxglove",
    "matplotlib",
    "plotly",
    "scipy",
    "viser",
    "websockets",
}
NUMBERS = {
    "daqp",
    "google",
    "jsbsim",
    "mcap",
    "numpy",
    "pydantic",
    "ruckig",
    "tomli_w",
    "zstandard",
}


def test_help_loads_no_more_than_the_command_line(tmp_path: Path) -> None:
    loaded = modules("--help", folder=tmp_path)
    assert loaded & (HEAVY | NUMBERS) == set()
    assert {name for name in loaded if name.startswith("atlas_cueing.")} <= {
        f"atlas_cueing.{name}"
        for name in (
            "cli",
            "errors",
            "printable",
            *(f"cli.{file.stem}" for file in (PACKAGE / "cli").glob("*.py")),
        )
    }


def test_a_run_loads_nothing_of_reports_and_clusters(tmp_path: Path) -> None:
    scenario(tmp_path, 0.25)
    loaded = modules("run", "blend.toml", folder=tmp_path)
    assert loaded & HEAVY == set()
    assert loaded >= NUMBERS - {"tomli_w"}
