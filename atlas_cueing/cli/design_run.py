"""A design from its folder to its files: check, search with progress, table, page and platform."""

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from ..errors import AtlasError, InputError, OutputError
from .design_table import exceeded, searched_on, table_text
from .progress import shown_share
from .text import one_json, say

if TYPE_CHECKING:
    from ..design import FlightName, Front, Layout, Problem
    from ..scenario import Platform

PLATFORM, LAYOUTS, PAGE_NAME = "platform.toml", "layouts.json", "index.html"
_BEGINS = {
    PLATFORM: b"# designed by atlas-cueing design",
    LAYOUTS: b'{\n  "designed_from"',
    PAGE_NAME: b"<!doctype html><!-- atlas_cueing -->",
}
_LINE_EVERY = 10.0  # s between two plain lines of progress


class DesignStoppedError(AtlasError):
    """The user stopped a design; what is done is kept."""


class DesignRun:
    """One `design` command: `platform` began with `name`, results go to a folder."""

    def __init__(
        self,
        name: str,
        platform: "Platform",
        folder: Path,
        logs: Sequence[Path],
        *,
        preloaded: bool,
        choose: int | None,
    ) -> None:
        from ..batch import open_store
        from ..scenario import presets

        self._name, self._platform, self._folder = name, platform, folder
        self._source = presets().get(name, Path(name))
        self._logs = logs
        self._preloaded = preloaded
        self._choose = choose
        if "://" in str(folder):
            raise InputError(f"-o {folder}: is a URL, allowed: a folder of this machine")
        self._store = open_store(str(folder))
        self._stamp = ""

    def check(self) -> None:
        """Refuse a folder that cannot be written, or whose files are not of an earlier design.

        Raises OutputError. Makes nothing.
        """
        self._store.check()
        for file, begins in _BEGINS.items():
            path = self._folder / file
            if path.exists() and path.samefile(self._source):
                raise OutputError(f"{path}: is the platform that is read; choose another folder")
            if path.exists() and not path.read_bytes()[:100].startswith(begins):
                raise OutputError(
                    f"{path}: is not of an earlier design, and would be replaced; choose another"
                    " folder, or give it another name"
                )

    def check_same(self, stamp: str) -> None:
        """Refuse a folder with another finished design; `stamp` is of all this one depends on.

        Raises OutputError. The same design again (with another --choose, say) is let through.
        """
        self._stamp = stamp
        there = [name for name in _BEGINS if self._store.has(name)]
        if there and _stamp_in(self._store.read([LAYOUTS]).get(LAYOUTS, b"")) != stamp:
            raise OutputError(
                f"{self._store.where(there[0])}: is of an earlier design of other logs or options,"
                f" and would be replaced; choose another folder, or remove its {', '.join(_BEGINS)}"
            )

    def search(
        self,
        problem: "Problem",
        asked: "Sequence[Layout]",
        searches: int,
        seed: int,
        jobs: int,
        cluster: str | None,
    ) -> "Front":
        """Search, with progress on stderr. Raises DesignStoppedError when the user stops it."""
        from ..design import Kept, search_front, spread
        from ..run import StopRequest

        with (
            self._store.opened(),
            spread(jobs, cluster) as crew,
            StopRequest() as stop,
            _told() as tell,
        ):

            def told(what: str, share: float) -> None:
                """Show progress, and end when that is wanted."""
                if stop.requested:
                    raise DesignStoppedError(
                        f"stopped in {what}; the same command goes on from there"
                    )
                tell(what, share)

            return search_front(
                problem,
                problem.ridden,
                asked,
                searches=searches,
                seed=seed,
                crew=crew,
                kept=Kept(self._store),
                tell=told,
            )

    def finish(self, front: "Front", flights: "Sequence[FlightName]", *, as_json: bool) -> str:
        """Write platform, layouts and page; return what is printed.

        Raises InputError for a --choose that the table does not have; what was searched is kept.
        """
        from ..design import design_page

        if self._choose is not None and self._choose >= len(front.rated):
            raise InputError(
                f"--choose {self._choose}: the table has {len(front.rated)} rows, allowed: 0 to"
                f" {len(front.rated) - 1}; what was searched is kept in {self._folder}, so that"
                " the same command with another row takes no search"
            )
        if self._choose is not None:
            front = replace(front, chosen=self._choose)
        built, notes = self._designed(front)
        table = one_json(self._json(front, flights, notes))
        page = design_page(front, f"{self._platform.name}: layouts", flights, notes)
        self._store.write(PLATFORM, built.encode())
        self._store.write(LAYOUTS, table.encode())
        self._store.write(PAGE_NAME, page.encode(errors="replace"))
        return table if as_json else table_text(front, notes, self._folder)

    def _json(
        self, front: "Front", flights: "Sequence[FlightName]", notes: Sequence[str]
    ) -> dict[str, object]:
        return {
            "designed_from": self._platform.name,
            "stamp": self._stamp,
            "platform": str(self._folder / PLATFORM),
            "objectives": list(front.objectives),
            "chosen": front.chosen,
            "ticks": front.ticks,
            "worst_ticks": front.worst_ticks,
            "worst_ticks_gap": front.gap,
            "rounds": front.rounds,
            "notes": list(notes),
            "flights": [
                {
                    "log": each.log,
                    "scenario": each.scenario,
                    "method": each.method,
                    "platform": each.platform,
                    "ticks": each.ticks,
                }
                for each in flights
            ],
            "layouts": [row.to_json() for row in front.rated],
        }

    def _exceeded(self, front: "Front") -> list[str]:
        """What the rides ask of the chosen layout beyond its limits, and which rows keep them."""
        from ..design import with_layout

        beyond = [exceeded(with_layout(self._platform, r.layout), r.figures) for r in front.rated]
        if not (notes := beyond[front.chosen]):
            return []
        within = ", ".join(str(k) for k, each in enumerate(beyond) if not each)
        return [*notes, f"rows within all limits of the platform (--choose): {within or 'none'}"]

    def _designed(self, front: "Front") -> tuple[str, list[str]]:
        """The text of the chosen platform, and what is to be said of it."""
        from ..design import with_layout
        from ..scenario.designed_platform import designed_text

        row = front.rated[front.chosen]
        platform = with_layout(self._platform, row.layout)
        name = f"{self._platform.name.removesuffix('-designed')}-designed"
        changes: dict[str, object] = {"name": name}
        force = max(row.figures["preload_with_margin_n"], 0.0)
        if self._preloaded and force > 0.0:
            from ..scenario.load_tables import PreloadTable

            more = PreloadTable(contact=(0.0, 0.0, 1.0), force_n=float(round(force + 0.5)))
            changes["preload"] = (*(platform.preload or ()), more)
        notes = [*self._exceeded(front), *searched_on(front)]
        lines = (
            f"designed by atlas-cueing design from {self._platform.name}, over"
            f" {len(self._logs)} rides of {front.ticks} ticks",
            f"layout: elevation {row.layout.elevation:.4g} deg, skew {row.layout.skew:.4g} deg,"
            f" azimuth {row.layout.azimuth:.4g} deg",
            f"on these rides: preload needed {row.figures['preload_needed_n']:.0f} N, torque"
            f" {row.figures['torque_max_n_m']:.0f} N m, wheel load"
            f" {row.figures['wheel_load_max_n']:.0f} N",
            *notes,
        )
        remark = "designed by atlas-cueing design"
        return designed_text(
            self._source, platform.model_copy(update=changes), remark, lines
        ), notes


def check_choice(choose: int | None, most: int) -> None:
    """Raise InputError for a row that a table of `most` rows at most cannot have."""
    if choose is not None and choose >= most:
        raise InputError(
            f"--choose {choose}: the table will have at most {most} rows (the platform's, those of"
            f" --also, one for each of --searches), allowed: 0 to {most - 1}"
        )


def _stamp_in(table: bytes) -> object:
    """The stamp of a finished design; None where there is none to be read."""
    try:
        found = json.loads(table)
    except (ValueError, RecursionError):
        return None
    return found.get("stamp") if isinstance(found, dict) else None


@contextmanager
def _told() -> Iterator[Callable[[str, float], None]]:
    """A function to call with what is done and its share: a bar, or a line now and then."""
    if sys.stderr.isatty():
        with shown_share("design") as bar:
            yield lambda _, share: bar(share)
        return
    last = perf_counter()

    def line(what: str, _: float) -> None:
        """Say where the work is, at most every few seconds."""
        nonlocal last
        if perf_counter() - last >= _LINE_EVERY:
            last = perf_counter()
            say(what)

    yield line
