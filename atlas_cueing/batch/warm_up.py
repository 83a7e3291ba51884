"""What a run makes when it first needs it, made once for all children of a worker.

Models of a scenario's keys, protobuf classes, modules of numpy: a child that is forked after this
has them, and makes them no more, which would be a third of what a ride of a minute takes.
"""

import tempfile
from contextlib import suppress
from pathlib import Path

from ..cueing import METHODS
from ..errors import AtlasError
from ..run import run_scenario
from ..scenario import load_scenario
from .run_id import run_id

_RIDE = """\
name = "warm_up"
duration_s = 0.1
[vehicle]
source = "signal"
[[vehicle.signal]]
axis = "force_y"
shape = "step"
amplitude_m_s2 = 1.0
time_s = 0.0
duration_s = 0.1
ramp_s = 0.01
[platform]
preset = "atlas-2.9m"
"""


def warm_up() -> str:
    """Fly a tenth of a second, and give its result; "" where it fails, of which runs will tell."""
    with suppress(AtlasError, OSError), tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "scenario.toml")
        file.write_text(_RIDE, "utf-8")
        for method in METHODS:  # each has a table of keys of its own
            load_scenario(file, [f"cueing.method={method}"])
        scenario = load_scenario(file)
        run_id(scenario)
        return run_scenario(scenario, Path(folder, "warm_up.mcap")).result
    return ""
