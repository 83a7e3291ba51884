"""The bundled flights in three sets, apart by what they were used for.

A method, its constants or the default may have been chosen by looking at figures of the first two
sets, so that these figures flatter it. Nothing was chosen by those of the third: its flights were
picked by the vehicle alone, and written down before any method had flown them.
"""

from collections.abc import Sequence
from pathlib import Path

CONSTANTS = (
    "a4_split",
    "c172_head_wind",
    "c172_stalls",
    "c310_gusts",
    "camel_spin",
    "concorde_rotate",
    "dhc6_tight",
    "p51d_barrel",
    "p51d_tail_wind",
    "t37_points",
    "t38_aileron",
    "t6_sideslip",
    "x152",
    "x24b_glide",
)
"""Flights by which constants of methods were chosen."""

UNSEEN = (
    "a320_wind_shear",
    "ah1s_hover_turns",
    "b17_turns",
    "b747_go_around",
    "boeing314_gusts",
    "c130_gusts",
    "c182_spiral",
    "f15_break",
    "f22_flat_spin",
    "f4n_half_cuban",
    "f4n_runway",
    "global5000_turns",
    "j246_ascent",
    "md11_upset",
    "ov10_wing_over",
    "pa28_spiral",
    "pc7_aerobatics",
    "sgs126_thermal",
    "zlt_nt_moored",
)
"""Flights by which nothing was chosen."""

SETS = {
    "examples": "used for choosing methods and their constants",
    "constants": "used for choosing constants",
    "unseen": "not used for choosing anything",
}
"""What each set was used for."""


def set_of(scenario: Path) -> str:
    """The set of a scenario's file; any that is in no list is an example."""
    if scenario.stem in UNSEEN:
        return "unseen"
    return "constants" if scenario.stem in CONSTANTS else "examples"


def by_set(scenarios: Sequence[Path]) -> dict[str, list[Path]]:
    """The scenarios of each set that has some, in the order of `SETS`."""
    found = {name: [path for path in scenarios if set_of(path) == name] for name in SETS}
    return {name: paths for name, paths in found.items() if paths}
