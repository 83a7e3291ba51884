"""A first scenario for a user to change: it flies as it is, and says what else there is."""

import re
from collections.abc import Iterator
from typing import Final

from ..cueing import DEFAULT_METHOD
from ..errors import InputError
from .keys import keys

_NAME: Final = re.compile(r"\w[\w.-]{0,99}")
_HEAD: Final = """\
# Fly it: atlas-cueing run {name}.toml; every key: atlas-cueing keys
name = "{name}"
duration_s = 20.0                # an aircraft flies on for ever; a script has an end of its own

[vehicle]
aircraft = "f16"                 # others: atlas-cueing list aircraft; or script = "c172_cross_wind"
input = [                        # what can be set: atlas-cueing list properties f16
    {{ time_s = 2.0, property = "fcs/aileron-cmd-norm", value = 0.5, ramp_s = 0.5 }},
    {{ time_s = 6.0, property = "fcs/aileron-cmd-norm", value = 0.0, ramp_s = 0.5 }},
]

[vehicle.initial]
altitude_m = 4000.0
airspeed_m_s = 220.0             # true airspeed
trim = true

[platform]
preset = "atlas-2.9m"            # or file = "my_platform.toml"

[cueing]
method = "{method}"                 # keys of the others: atlas-cueing keys cueing
"""


def new_scenario(name: str) -> str:
    """Write the text of a scenario called `name`. Raises InputError for what is no name."""
    if not _NAME.fullmatch(name):
        raise InputError(f"name = {name!r}, allowed: letters, digits, '.', '_' and '-'")
    return _HEAD.format(name=name, method=DEFAULT_METHOD) + "\n".join(_defaults()) + "\n"


def _defaults() -> Iterator[str]:
    """The keys of the default method as comments, with their defaults."""
    for entry in keys("cueing."):
        _, *within = entry.key.split(".")
        mine = DEFAULT_METHOD in entry.of.replace(",", "").split()
        if mine and len(within) == 1 and entry.default is not None and within[0] != "method":
            yield f"# {within[0]} = {entry.written}  # {entry.allowed}; {entry.meaning}"
