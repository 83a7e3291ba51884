"""The tool that measures what a flight costs in seconds."""

import json
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from atlas_cueing.scenario import load_variants

ROOT = Path(__file__).parents[1]
TOOL = ROOT / "tools" / "benchmark"
sys.path.insert(0, str(TOOL.parent))  # where its modules lie

from benchmarks import (  # noqa: E402
    batches,
    kept,
    live,
    memory,
    plant,
    recorder,
    report,
    reviewing,
    stages,
    start_up,
    timing,
    whole_run,
)
from benchmarks.effort import FULL, QUICK, Bench, Effort  # noqa: E402
from benchmarks.machine import Stolen, build_kind, facts  # noqa: E402
from benchmarks.rows import Asked, Row  # noqa: E402
from benchmarks.timing import Cost  # noqa: E402

ONCE = Effort(1, 1, 2.0, 4.0, 2, 0.25, 1, 1, 2.0, ((120.0, 3.0), (120.0, 4.0)))


def measured(section: Any, folder: Path) -> list[Row]:
    """All rows of a section that measures as little as it can."""
    found = list(section.measure(Bench(ONCE, folder, lambda _: None)))
    assert len({row.what for row in found}) == len(found) > 0
    return found


@pytest.mark.parametrize(
    "section", [whole_run, stages, recorder, plant], ids=lambda module: module.__name__
)
def test_a_section_measures_what_it_names(section: Any, tmp_path: Path) -> None:
    """Every row is a positive number beside a positive reference, but for differences.

    So short a flight may hide their sign.
    """
    for row in measured(section, tmp_path):
        difference = section is whole_run or "less" in row.what
        assert row.value > 0.0 or difference, row
        assert row.reference_value is None or row.reference_value > 0.0, row
        assert row.verdict in ("met", "short") if row.asked else row.verdict == "", row


class Processes:
    """Stands for `fresh`: looks at the scenario and starts nothing.

    It takes two seconds of the wall's clock and one of the CPU's.
    """

    def __init__(self) -> None:
        self.commands: list[str] = []

    def __call__(
        self, arguments: Sequence[str | Path], folder: Path, *_command: Sequence[str]
    ) -> Cost:
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
    section: Any,
    commands: list[str],
    values: list[float],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What it starts, in turns after a warm round, and what it makes of two seconds each."""
    processes = Processes()
    monkeypatch.setattr(section, "fresh", processes)
    found = measured(section, tmp_path)
    assert processes.commands == commands
    assert [row.value for row in found] == pytest.approx(values)


def test_every_bound_that_was_asked_has_its_row() -> None:
    assert [
        asked.text("us") for asked in (whole_run.ASKED, stages.ASKED, recorder.ASKED, batches.ASKED)
    ] == [
        "≤ 2x (goal 1.5x)",
        "≤ 40 us",
        "≤ 5 us",
        "≥ 1.8x",
    ]
    assert [asked.text("s") for asked in (start_up.HELP, start_up.RUN, reviewing.ASKED)] == [
        "≤ 0.3 s",
        "≤ 0.35 s",
        "≤ 3 s",
    ]
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
    assert (
        Row(
            "run", "it", value, "us", reference="other", reference_value=reference, asked=asked
        ).verdict
        == verdict
    )


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
        Row(
            "run",
            "a run",
            30.0,
            "us",
            [29.0, 30.0, 31.0],
            "bare",
            20.0,
            Asked(2.0, of_ratio=True),
            "as noted",
        ),
        Row("start", "a start", 1.5, "s", asked=Asked(0.3)),
    ]
    told = json.loads(report.to_json(found, facts(), 0.25, asdict(ONCE)))
    assert [(row["ratio"], row["verdict"]) for row in told["rows"]] == [
        (1.5, "met"),
        (None, "short"),
    ]
    assert told["rows"][0]["samples"] == [29.0, 30.0, 31.0]
    assert (told["code"], told["stolen_share"], told["effort"]["rounds"]) == (build_kind(), 0.25, 1)
    text = StringIO()
    report.print_table(found, facts(), 0.25, Console(file=text))
    lines = text.getvalue().splitlines()
    assert lines[0] == f"code: {build_kind()}"
    shown = next(line for line in lines if "a run" in line)
    assert [cell.strip() for cell in shown.split("│")[1:-1]] == [
        "a run",
        "30 us",
        "bare 20",
        "1.50",
        "≤ 2x",
        "met",
        "as noted",
    ]
    assert "25% of the processors taken away" in lines[-1]


def row(ratio: float, *, at_least: bool = False, samples: Sequence[float] = ()) -> Row:
    """A row of this ratio, whose reference is 10."""
    asked = Asked(1.0, of_ratio=True, at_least=at_least)
    return Row("run", "it", 10.0 * ratio, "us", samples, "bare", 10.0, asked)


@pytest.mark.parametrize(
    ("now", "says"),
    [
        (row(2.05), []),
        (row(2.5), ["WORSE: run: it: 2.50 times bare, 2.00 at abc"]),
        (row(1.5), ["better: run: it: 1.50 times bare, 2.00 at abc"]),
        (row(1.5, at_least=True), ["WORSE: run: it: 1.50 times bare, 2.00 at abc"]),
        (row(2.3, samples=[10.0, 20.0, 25.0, 30.0, 40.0]), []),  # half of 10 over 25: up to 2.4
        (Row("run", "it", 99.0, "us"), []),
        (Row("run", "other", 99.0, "us", (), "bare", 1.0), []),
    ],
)
def test_what_became_worse_than_the_kept_ratios(now: Row, says: list[str], tmp_path: Path) -> None:
    file = tmp_path / "figures.json"
    assert kept.read(file, "compiled") == {}
    kept.keep(file, "compiled", "abc", [row(2.0)])
    kept.keep(file, "Python", "def", [row(7.0)])
    assert kept.changes(kept.read(file, "compiled"), [now]) == says
    assert kept.read(file, "compiled, quick") == {}


def test_what_is_not_measured_stays_kept(tmp_path: Path) -> None:
    file = tmp_path / "figures.json"
    kept.keep(file, "compiled", "abc", [row(2.0), replace(row(3.0), what="other")])
    kept.keep(file, "compiled", "def", [row(1.0)])
    found = kept.read(file, "compiled")
    assert {name: (each["ratio"], each["commit"]) for name, each in found.items()} == {
        "run: it": (1.0, "def"),
        "run: other": (3.0, "abc"),
    }


def test_the_kept_figures_name_rows_that_there_are() -> None:
    """Where a row is named anew, what is kept of it would never be looked at again."""
    sections = {"run", "stages", "recording", "review", "plant", "batch", "start", "memory"}
    for kind in json.loads(kept.FILE.read_text()).values():
        assert {name.split(":")[0] for name in kind} <= sections
        assert all(each["ratio"] > 0.0 and each["commit"] for each in kind.values())


def test_time_taken_away_is_a_share() -> None:
    share = Stolen().share()
    assert share is None or 0.0 <= share <= 1.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--only", "everything"], "invalid choice: 'everything'"),
        (["--json", "no/such.json"], "there is no folder"),
    ],
)
def test_wrong_usage(arguments: list[str], message: str, tmp_path: Path) -> None:
    told = subprocess.run(
        [sys.executable, str(TOOL), *arguments],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (told.returncode, told.stdout) == (2, "")
    assert message in told.stderr


def test_the_live_loop_is_put_beside_a_bare_one(tmp_path: Path) -> None:
    """A ride of two seconds, by the command itself."""
    rows = {row.what: row for row in measured(live, tmp_path)}
    shares = [rows[f"deadline to set point sent, {share}"] for share in ("p50", "p99", "p99.9")]
    assert [row.value for row in shares] == sorted(row.value for row in shares)
    assert all(row.ratio for row in shares)
    cost = rows["tick at 1 kHz, everything on: wake-up to set point sent, p99.9"]
    assert 0.0 < cost.value <= shares[-1].value
    assert rows["garbage collections in a ride, most"].verdict == "met"


def test_a_live_ride_that_cannot_begin_ends_the_benchmark(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live, "_OPTIONS", ("--rate", "1"))
    with pytest.raises(SystemExit, match=r"exit status 2\n.*rate"):
        measured(live, tmp_path)
