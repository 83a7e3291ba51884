"""Start-up of the commands in fresh processes, beside the interpreter's and the libraries'."""

import sys
from collections.abc import Iterator
from functools import partial
from statistics import median

from .effort import Bench
from .flights import script_file
from .rows import Asked, Row
from .timing import fresh, interleaved

HELP, RUN = Asked(0.3), Asked(0.35)  # s of wall time
_PYTHON = (sys.executable, "-c")


def measure(bench: Bench) -> Iterator[Row]:
    """Wall times, with processor times beside them.

    Where the host gives the processor to others, those are the steadier.
    """
    bench.say(f"start: {bench.effort.processes} rounds")
    second = script_file(bench.folder, "c1722", 1.0)
    commands = {
        "--help": ["--help"],
        "platform atlas-2.9m": ["platform", "atlas-2.9m"],
        "run of 1 s of flight": ["run", second, "-o", "second.mcap", "--force"],
    }
    plain = {"python -c pass": "pass", "import numpy, jsbsim": "import numpy, jsbsim"}
    works = {name: partial(fresh, arguments, bench.folder) for name, arguments in commands.items()}
    works |= {name: partial(fresh, [code], bench.folder, _PYTHON) for name, code in plain.items()}
    found = interleaved(bench.effort.processes, works, warm=True)
    beside = dict(
        zip(commands, ("python -c pass", "python -c pass", "import numpy, jsbsim"), strict=True)
    )
    asked = {"--help": HELP, "run of 1 s of flight": RUN}
    for name in works:
        samples = [cost.wall for cost in found[name]]
        reference = beside.get(name, "")
        other = median(cost.wall for cost in found[reference]) if reference else None
        note = f"CPU {median(cost.cpu for cost in found[name]):.2f} s"
        title = f"atlas-cueing {name}" if name in commands else name
        yield Row(
            "start",
            f"{title}, wall",
            median(samples),
            "s",
            samples,
            reference,
            other,
            asked.get(name),
            note,
        )
