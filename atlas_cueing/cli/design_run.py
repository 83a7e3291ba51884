"""A design from its folder to its files: check, search with progress, table, page and platform."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from ..errors import AtlasError, InputError, OutputError
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

        Raises InputError for a --choose that the table does not have.
        """
        from ..design import design_page

        if self._choose is not None and self._choose >= len(front.rated):
            raise InputError(f"--choose {self._choose}: allowed: 0 to {len(front.rated) - 1}")
        if self._choose is not None:
            front = replace(front, chosen=self._choose)
        built, notes = self._designed(front)
        table = one_json(self._json(front, flights, notes))
        page = design_page(front, f"{self._platform.name}: layouts", flights, notes)
        self._store.write(PLATFORM, built.encode())
        self._store.write(LAYOUTS, table.encode())
        self._store.write(PAGE_NAME, page.encode(errors="replace"))
        return table if as_json else _table(front, notes, self._folder)

    def _json(
        self, front: "Front", flights: "Sequence[FlightName]", notes: Sequence[str]
    ) -> dict[str, object]:
        return {
            "designed_from": self._platform.name,
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
        notes = [*_exceeded(platform, row.figures), *_searched_on(front)]
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


def _exceeded(platform: "Platform", figures: dict[str, float]) -> list[str]:
    """What the rides ask of the chosen layout beyond what its file names."""
    drive, wheels = platform.drive, platform.wheel
    limits = [
        ("torque_max_n_m", drive.torque_n_m if drive else None, "drive.torque_n_m"),
        ("torque_rms_n_m", drive.torque_rms_n_m if drive else None, "drive.torque_rms_n_m"),
        (
            "motor_speed_max_rad_s",
            drive.motor_speed_rad_s if drive else None,
            "drive.motor_speed_rad_s",
        ),
        (
            "wheel_speed_max_rad_s",
            min(platform.limits_of_each_wheel().speed),
            "wheel_limits.speed_rad_s",
        ),
        (
            "wheel_load_max_n",
            min((each.load_limit_n for each in wheels if each.load_limit_n), default=None),
            "wheel.load_limit_n",
        ),
    ]
    return [
        f"these rides ask more of the chosen layout than {key} = {limit:.6g}: {figures[name]:.6g}"
        for name, limit, key in limits
        if limit is not None and figures[name] > limit
    ]


def _searched_on(front: "Front") -> list[str]:
    return [
        f"searched at the {front.worst_ticks} worst of {front.ticks} ticks, measured at all: at"
        f" most {100.0 * front.gap:.2g} % worse there"
    ]


def _table(front: "Front", notes: Sequence[str], folder: Path) -> str:
    from ..design.design_page import cell, name_of, shown_columns

    columns = shown_columns(front)
    rows = [["layout", *(f"{head} {unit}".strip() for _, head, unit, _, _ in columns)]]
    for k, row in enumerate(front.rated):
        cells = [cell(row, key, factor, decimals) for key, _, _, factor, decimals in columns]
        rows.append([name_of(front, k), *cells])
    words = [head.split() for head in rows[0]]
    tall = max(map(len, words))
    heads = [[*[""] * (tall - len(each)), *each] for each in words]
    lines = [[head[k] for head in heads] for k in range(tall)] + rows[1:]
    widths = [max(len(line[k]) for line in lines) for k in range(len(rows[0]))]
    shown = [
        "  ".join(
            [
                f"{line[0]:<{widths[0]}}",
                *(f"{c:>{w}}" for c, w in zip(line[1:], widths[1:], strict=True)),
            ]
        )
        for line in lines
    ]
    return "\n".join([*shown, *(f"remark: {note}" for note in notes), f"written: {folder}"])


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
