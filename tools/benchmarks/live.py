"""The live loop at 1 kHz with everything on, and a bare sleeping loop in turns with it.

The ride is one of `atlas-cueing live --priority --json` in a process of its own: JSBSim, the
default method on a platform that keeps traction, guard, set points to a simulated platform and
statuses back, attitude correction, recorder. A tick's cost is from its wake-up until its set point
is sent, and its answer from its deadline until then; both are in the log, tick by tick. What
follows (the ring of the recorder, the vehicle's next step) is done before the next deadline. The
bare loop sleeps by the same clock and policy, and does nothing: its answer is that of the machine.
"""

import json
import subprocess
from collections.abc import Iterator, Mapping
from os import getloadavg
from pathlib import Path
from statistics import median
from time import monotonic, sleep
from typing import Any, NamedTuple

import numpy as np

from atlas_cueing.live.clock import MonotonicClock
from atlas_cueing.live.realtime import realtime_scheduling
from atlas_cueing.recording import read_log
from atlas_cueing.rotations import Array

from .effort import Bench
from .flights import STAGED, script_file
from .rows import Asked, Row
from .timing import COMMAND

RATE = 1000  # Hz
ASKED = Asked(300.0)  # us, p99.9 of a tick's cost, compiled, on a calm machine
_SETTLED = 10.0  # s of a ride's process; what it has then, it should have at the end
_OPTIONS = (
    *("--rate", str(RATE), "--priority", "--plant", "--feedback", "fix", "--lead", "80"),
    *("--set", "platform.preset=atlas-2.9m-halo", "--set", "platform.traction.keep=true"),
    *("--json", "--force"),
)
_SHARES = {"p50": 0.5, "p99": 0.99, "p99.9": 0.999, "max": 1.0}


class Ride(NamedTuple):
    """One ride: result, garbage collections, growth (MB), and of each tick cost and answer (us)."""

    result: str
    collections: int
    growth: float
    cost: Array
    answer: Array


def measure(bench: Bench) -> Iterator[Row]:
    """Cost and answer of a tick, memory and collections."""
    rides, bare = [], []
    for number in range(bench.effort.rides):
        bench.say(f"live: round {number + 1} of {bench.effort.rides}, {bench.effort.ride:g} s")
        bare.append(bare_loop(0.5 * bench.effort.ride))
        rides.append(_ride(bench.folder, bench.effort.ride))
    yield _cost(rides)
    for share in ("p50", "p99", "p99.9"):
        yield _answer(share, rides, bare)
    collections = max(ride.collections for ride in rides)
    yield Row("live", "garbage collections in a ride, most", collections, "", asked=Asked(0.0))
    growth = [ride.growth for ride in rides]
    note = f"resident memory of the loop's process, from {_settled(bench.effort.ride):g} s on"
    yield Row("live", "growth in a ride", median(growth), "MB", growth, note=note)


def bare_loop(seconds: float) -> Array:
    """Return the lateness of each slot of a loop that only sleeps, us."""
    clock, late = MonotonicClock(), np.zeros(round(seconds * RATE))
    with realtime_scheduling(priority=True):
        start = clock.now()
        for k in range(len(late)):
            deadline = start + (k + 1) / RATE
            clock.sleep_until(deadline)
            late[k] = 1e6 * (clock.now() - deadline)
    return late


def _ride(folder: Path, seconds: float) -> Ride:
    """Fly, and look at the process's memory meanwhile; quits when it does not fly to its end."""
    log, scenario = folder / "live.mcap", script_file(folder, STAGED, seconds)
    command = [*COMMAND, "live", scenario, "-o", log, "--duration", f"{seconds:g}", *_OPTIONS]
    with (folder / "said").open("w+") as said:
        process = subprocess.Popen(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=said
        )
        growth = _growth(process, seconds)
        told = process.communicate()[0]
        said.seek(0)
        if not told:
            raise SystemExit(f"live: exit status {process.returncode}\n{said.read()}")
    return _ridden(json.loads(told), growth, log)


def _ridden(told: Mapping[str, Any], growth: float, log: Path) -> Ride:
    timing = read_log(log).columns("/timing")
    late, cost = (1e6 * timing[name] for name in ("lateness_s", "cost_s"))
    collections = told["timing"]["garbage_collections"]
    return Ride(told["result"], collections, growth, cost, late + cost)


def _growth(process: "subprocess.Popen[bytes]", seconds: float) -> float:
    """Return how much memory it takes at the end of a ride beyond what it had early in it, MB."""
    found, begun = [], monotonic()
    while process.poll() is None and (now := monotonic() - begun) < seconds:
        if now >= _settled(seconds):
            found.append(_resident(process.pid))
        sleep(0.5)
    return (found[-1] - found[0]) / 1e6 if found else 0.0


def _settled(seconds: float) -> float:
    return min(_SETTLED, 0.5 * seconds)


def _resident(pid: int) -> int:
    """Return the resident memory of a process, bytes; 0 where the system does not tell."""
    status = Path(f"/proc/{pid}/status")
    return 1024 * int(status.read_text().split("VmRSS:")[1].split()[0]) if status.exists() else 0


def _cost(rides: list[Ride]) -> Row:
    samples = [float(np.quantile(ride.cost, 0.999)) for ride in rides]
    ended = sorted({ride.result for ride in rides} - {"ok"})
    told = [_percentiles(np.concatenate([ride.cost for ride in rides])), *ended]
    note = ", ".join([*told, f"load {getloadavg()[0]:.1f}"])
    what = "tick at 1 kHz, everything on: wake-up to set point sent, p99.9"
    return Row("live", what, median(samples), "us", samples, asked=ASKED, note=note)


def _answer(share: str, rides: list[Ride], bare: list[Array]) -> Row:
    q = _SHARES[share]
    samples = [float(np.quantile(ride.answer, q)) for ride in rides]
    beside = median(float(np.quantile(late, q)) for late in bare)
    note = f"of the bare loop: {_percentiles(np.concatenate(bare))}" if share == "p50" else ""
    what = f"deadline to set point sent, {share}"
    reference = "deadline to wake-up, bare"
    return Row("live", what, median(samples), "us", samples, reference, beside, note=note)


def _percentiles(times: Array) -> str:
    told = (f"{name} {np.quantile(times, q):.0f}" for name, q in _SHARES.items())
    return f"{', '.join(told)} of {len(times)}"
