"""Rides of many flights by many methods, flown by a few processes and kept for the next time."""

import json
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import atlas_cueing
from atlas_cueing.cueing.own.sources import installed_methods

Ride = Mapping[str, Any]
"""What came of one: result, reason, violations, ticks, duration_s, metrics, limit_use."""


@dataclass(frozen=True)
class Order:
    """A ride to fly: the scenario's file, and settings as `--set` takes them."""

    scenario: Path
    settings: tuple[str, ...]

    @property
    def words(self) -> str:
        """What is flown, for people."""
        return f"{self.scenario.stem}: {', '.join(self.settings)}"

    @property
    def method_file(self) -> Path | None:
        """The file of a method of one's own, from where the tool was called."""
        method = next((t for t in self.settings if t.startswith("cueing.method=")), "")
        file, colon, _ = method.partition("=")[2].rpartition(":")
        return Path(file) if colon else None

    def code(self) -> bytes:
        """What stands for the code of a method that is not the package's own."""
        if self.method_file:
            return self.method_file.read_bytes()
        names = {text.partition("=")[2] for text in self.settings}
        packages = (p.dist for name, p in installed_methods().items() if name in names)
        return "".join(f"{p.name} {p.version}" for p in packages if p).encode()


OrderT = TypeVar("OrderT", bound=Order)


def fly(order: Order) -> dict[str, Any]:
    """Fly it here, its log thrown away; an error becomes the reason."""
    from atlas_cueing.errors import AtlasError
    from atlas_cueing.run import run_scenario
    from atlas_cueing.scenario import load_scenario

    with TemporaryDirectory() as folder:
        try:
            trusted = bool(order.method_file)  # who asks for a program by its name trusts it
            scenario = load_scenario(order.scenario, order.settings, trust_models=trusted)
            return run_scenario(scenario, Path(folder) / "ride.mcap").to_json()
        except AtlasError as error:
            return {"result": "refused", "reason": str(error)}


class Kept:
    """Rides in a folder, one JSON file each, good as long as program and scenario are the same."""

    def __init__(self, folder: Path) -> None:
        """Keep them in `folder`, which may have to be made."""
        self._folder = folder / _program()
        self._folder.mkdir(parents=True, exist_ok=True)

    def get(self, order: Order) -> dict[str, Any] | None:
        """The ride as it was flown before; None for none."""
        try:
            ride: dict[str, Any] = json.loads(self._file(order).read_text())
        except (OSError, ValueError):
            return None
        return ride

    def put(self, order: Order, ride: Ride) -> None:
        """Keep a ride; one that is cut off by a kill is flown again."""
        self._file(order).write_text(json.dumps(ride))

    def _file(self, order: Order) -> Path:
        settings = "\n".join(order.settings).encode()
        of = sha256(order.scenario.read_bytes() + settings + order.code()).hexdigest()
        return self._folder / f"{order.scenario.stem}-{of[:16]}.json"


def _program() -> str:
    """A name for the program as it is: changed sources make other rides."""
    root, digest = Path(atlas_cueing.__file__).parent, sha256()
    for path in sorted(root.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def flown(
    orders: Iterable[OrderT],
    kept: Kept,
    jobs: int,
    tell: Callable[[str], object],
    fly_one: Callable[[OrderT], dict[str, Any]] = fly,
) -> dict[OrderT, dict[str, Any]]:
    """Fly what is not kept, so many at a time; `tell` gets a line for each.

    fly_one: by which a worker flies an order.
    """
    wanted = list(dict.fromkeys(orders))
    rides = {order: ride for order in wanted if (ride := kept.get(order)) is not None}
    todo = [order for order in wanted if order not in rides]
    tell(f"{len(wanted)} rides, {len(rides)} of them flown before")
    with ProcessPoolExecutor(jobs) as pool:
        running = {pool.submit(fly_one, order): order for order in todo}
        for done in as_completed(running):
            order = running[done]
            rides[order] = done.result()
            kept.put(order, rides[order])
            came = rides[order]["result"]
            tell(f"[{len(rides)}/{len(wanted)}] {order.words}{'' if came == 'ok' else f': {came}'}")
    return {order: rides[order] for order in wanted}


def faults(rides: Mapping[Order, Ride]) -> list[str]:
    """A line for each ride that did not fly to its end or broke a limit."""
    return [
        f"{order.words}: {ride['result']}: {ride['reason'] or '; '.join(ride['violations'])}"
        for order, ride in rides.items()
        if ride["result"] != "ok" or ride["violations"]
    ]


def to_stderr(line: str) -> None:
    """Say it, beside a page that may go to stdout."""
    print(line, file=sys.stderr, flush=True)


def by_method(scenarios: Sequence[Path], methods: Sequence[str]) -> list[Order]:
    """Every flight by every method with its defaults."""
    return [Order(path, (f"cueing.method={name}",)) for path in scenarios for name in methods]
