"""Review and compare of a long log, beside reading it with the mcap library.

In fresh processes, start-up and all.
"""

import sys
from collections.abc import Iterator
from functools import partial
from statistics import median

from .effort import Bench
from .flights import signal_file
from .rows import Asked, Row
from .timing import fresh, interleaved

RATE = 120.0  # Hz
ASKED, ASKED_FOR = Asked(3.0), 600.0  # s of wall time, for a log of so many s
_READ = (
    "import sys; from mcap.reader import make_reader; sum(1 for _ in make_reader(open(sys.argv[1],"
    " 'rb')).iter_messages())"
)


def measure(bench: Bench) -> Iterator[Row]:
    """Wall and CPU of review, compare, and plain reading."""
    length, folder = bench.effort.log, bench.folder
    bench.say(f"review: flying {length:g} s twice")
    scenario = signal_file(folder, RATE, length)
    fresh(["run", scenario, "-o", "one.mcap", "--force"], folder)
    fresh(
        ["run", scenario, "-o", "other.mcap", "--force", "--set", "cueing.method=attitude"], folder
    )
    bench.say(f"review: {bench.effort.processes} rounds")
    works = {
        "review": partial(fresh, ["review", "one.mcap", "--json"], folder),
        "compare": partial(fresh, ["compare", "one.mcap", "other.mcap", "--json"], folder),
        "plain": partial(fresh, ["one.mcap"], folder, (sys.executable, "-c", _READ)),
    }
    found = interleaved(bench.effort.processes, works, warm=True)
    asked = ASKED if length == ASKED_FOR else None
    size = f"{length / 60:g} min at {RATE:g} Hz"
    for name, bound in (("review", asked), ("compare", None)):
        for clock in ("wall", "cpu"):
            samples, plain = (
                [getattr(cost, clock) for cost in found[each]] for each in (name, "plain")
            )
            title = (
                f"{name} of {size}{' and another' * (name == 'compare')},"
                f" {clock.replace('cpu', 'CPU')}"
            )
            judged = bound if clock == "wall" else None
            yield Row(
                "review",
                title,
                median(samples),
                "s",
                samples,
                "mcap reader, all messages",
                median(plain),
                judged,
            )
