"""Rides on the simulated platform: each is flown, and then its schedule by one kind of loop."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import degrees
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

from .flying import Order

Kind = tuple[str, float | None]
"""Feedback, and latency of the fix, s, where there is one."""

FIGURES = (
    "orientation_error_end_rad",
    "orientation_error_max_rad",
    "slip_max_m_s",
    "energy_residual_j",
    "energy_throughput_j",
)
COLUMNS = ("flight", "method", "feedback", "latency_s", *FIGURES)
END, LARGEST = 0.1, 1.0  # deg, what is asked for


@dataclass(frozen=True)
class PlantOrder(Order):
    """A ride by a method of cueing, and the kind of loop that flies it on the plant."""

    method: str
    kind: Kind

    @property
    def words(self) -> str:
        """What is flown, for people."""
        feedback, latency = self.kind
        late = "" if latency is None else f", {1e3 * latency:g} ms"
        return f"{self.scenario.stem}, {self.method}: {feedback}{late}"

    def code(self) -> bytes:
        """What else the figures depend on."""
        return super().code() + repr((self.method, self.kind)).encode()


def fly_on_plant(order: PlantOrder) -> dict[str, Any]:
    """Fly the ride, then the plant; the log is thrown away, an error is the reason."""
    from atlas_cueing.errors import AtlasError
    from atlas_cueing.run import run_scenario
    from atlas_cueing.scenario import load_scenario

    with TemporaryDirectory() as folder:
        try:
            settings = (f"cueing.method={order.method}", *order.settings)
            scenario = load_scenario(order.scenario, settings)
            ride = run_scenario(scenario, Path(folder) / "ride.mcap")
            figures = _flown(ride.log, order.kind)
        except AtlasError as error:
            return {"result": "refused", "reason": str(error), "violations": []}
    told = ride.to_json()
    return {name: told[name] for name in ("result", "reason", "violations")} | {"figures": figures}


def _flown(log: Path, kind: Kind) -> list[float]:
    """FIGURES of one flight on the plant."""
    from atlas_cueing.plant import fly_plant, plant_figures, plant_table
    from atlas_cueing.review import open_run

    run, (feedback, latency) = open_run(log), kind
    late = [] if latency is None else [f"platform.plant.fix_latency_s={latency}"]
    flown = fly_plant(run.log, run.platform, feedback, plant_table(run.platform, late))
    figures = plant_figures(flown, run.log)
    return [figures[name] for name in FIGURES]


def table(rides: Mapping[PlantOrder, Mapping[str, Any]]) -> list[tuple]:
    """Rows of COLUMNS of the rides that were flown."""
    return [
        (order.scenario.stem, order.method, *order.kind, *ride["figures"])
        for order, ride in rides.items()
        if "figures" in ride
    ]


def summary(rows: Iterable[tuple]) -> list[str]:
    """A Markdown table: a line for each method and kind."""
    groups: dict[tuple[str, str, float | None], dict[str, Sequence[float]]] = {}
    for flight, *kind, latency, end, largest, slip, residual, throughput in rows:
        figures = (degrees(end), degrees(largest), slip, residual, throughput)
        groups.setdefault((kind[0], kind[1], latency), {})[flight] = figures
    heads = ("method", "feedback", "flights", "end, deg: median", "most", f"over {END:g}")
    heads += ("largest, deg: median", "most", f"over {LARGEST:g}", "worse than open")
    heads += ("slip, m/s: most", "energy residual: most")
    lines = [f"| {' | '.join(heads)} |", "|---|---|" + "---:|" * (len(heads) - 2)]
    for (method, feedback, latency), flights in groups.items():
        opened = next((f for k, f in groups.items() if k[:2] == (method, "none")), {})
        name = feedback if latency is None else f"{feedback}, {1e3 * latency:g} ms"
        lines.append(f"| {' | '.join([method, name, *_cells(flights, opened)])} |")
    return lines


def _cells(flights: Mapping[str, Sequence[float]], opened: Mapping[str, Sequence[float]]) -> list:
    """Figures of all flights of one kind; `opened`: of the open loop."""
    ends, largest, slips, residuals, throughputs = zip(*flights.values(), strict=True)
    worse = sum(f[1] > LARGEST and f[1] > opened[k][1] for k, f in flights.items() if k in opened)
    balance = max(abs(a) / max(b, 1.0) for a, b in zip(residuals, throughputs, strict=True))
    return [
        str(len(flights)),
        *(f"{median(ends):.3f}", f"{max(ends):.3f}", str(sum(x > END for x in ends))),
        *(f"{median(largest):.3f}", f"{max(largest):.2f}", str(sum(x > LARGEST for x in largest))),
        str(worse),
        f"{max(slips):.2f}",
        f"{balance:.0e}",
    ]
