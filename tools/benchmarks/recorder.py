"""What recording costs a tick and a message.

Beside it is the mcap library's own writer, with the same messages made already.
"""

from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median

import numpy as np

from atlas_cueing.recording import McapRecorder
from atlas_cueing.scenario import Scenario
from atlas_cueing.signals import Tick

from .effort import Bench
from .flights import STAGED, script_scenario
from .peers import read_plain, write_plain
from .rows import Asked, Row
from .stages import flown
from .timing import cost, each, interleaved, without_garbage

ASKED = Asked(5.0)  # us a message
_CHUNK = 512 * 1024  # bytes, about those of a chunk of ours


def measure(bench: Bench) -> Iterator[Row]:
    """Recording a tick, recording a message."""
    bench.say(f"recording: {bench.effort.rounds} rounds")
    scenario = script_scenario(bench.folder, STAGED, bench.effort.flight)
    ticks, log, plain = flown(scenario), bench.folder / "recorded.mcap", bench.folder / "plain.mcap"
    record(scenario, ticks, log)
    messages = read_plain(log)
    works = {
        "ours": lambda: cost(lambda: record(scenario, ticks, log)),
        "plain": lambda: cost(lambda: write_plain(messages, plain, _CHUNK)),
    }
    passes: list[list[int]] = []
    with without_garbage():
        found = interleaved(bench.effort.rounds, works)
        for _ in range(bench.effort.rounds):
            record(
                scenario, ticks, log, lambda recorder: passes.append(each(recorder.append, ticks))
            )
    ours, theirs = ([1e6 * each.cpu for each in found[name]] for name in ("ours", "plain"))
    appended = np.min(passes, axis=0) / 1e3
    note = (
        f"append: median {np.median(appended):.1f}, p99.9 {np.quantile(appended, 0.999):.0f} (a"
        " chunk of 512 ticks)"
    )
    for what, count, asked in (("a tick", len(ticks), None), ("a message", len(messages), ASKED)):
        samples, other = [time / count for time in ours], median(theirs) / count
        reference = f"mcap.Writer, zstd, {what}"
        yield Row(
            "recording",
            f"recording {what}",
            median(samples),
            "us",
            samples,
            reference,
            other,
            asked,
            note,
        )
        note = f"{len(messages) / len(ticks):.2f} messages a tick; {_sizes(log, plain, len(ticks))}"


def record(
    scenario: Scenario,
    ticks: list[Tick],
    log: Path,
    append: Callable[[McapRecorder], object] | None = None,
) -> None:
    """Write a whole log, from opening it to its name.

    `append` does what lies between, by default a plain loop.
    """
    recorder = McapRecorder(
        log, head_S=scenario.platform.head_S, metadata={}, attachments=scenario.attachments()
    )
    recorder.status(0.0, "running", "")
    if append:
        append(recorder)
    else:
        for tick in ticks:
            recorder.append(tick)
    recorder.close("ok", "")


def _sizes(log: Path, plain: Path, ticks: int) -> str:
    ours, theirs = (path.stat().st_size / ticks for path in (log, plain))
    return f"{ours:.0f} bytes a tick in the file, {theirs:.0f} by mcap.Writer"
