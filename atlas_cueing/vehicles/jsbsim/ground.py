"""Starts on the ground.

The altitude is that of the centre of gravity, so the gear may be deep in it.
"""

from collections.abc import Iterator
from itertools import combinations
from math import ceil, isfinite, sqrt
from typing import TypeAlias

import jsbsim

from ...errors import StartError
from ...rotation import Vec3, cross, norm, subtract
from .flights import InitialConditions
from .readings import METRES_PER_FOOT

# Force of the ground in the first state, in weights (assumed). At rest it is 1; gear is built for
# landings of 2 to 3 (14 CFR 23.473); JSBSim's own aircraft, put to altitude 0, begin with 5 or
# more.
HARDEST_START = 2.0

_Unit: TypeAlias = dict[str, float]
_POSITION = ("x-position", "y-position", "z-position")
_SMALLEST_TRIANGLE = 1e-3  # square inches, twice the area; below it is rounding


def check_standing(fdm: jsbsim.FGFDMExec, initial: InitialConditions) -> None:
    """Refuse a first state that presses the gear into the ground far beyond the weight.

    It would be thrown into the air, with tens of g at once. Raises StartError that says how deep it
    is and what to do.
    """
    depth = METRES_PER_FOOT * max((unit["compression-ft"] for unit in _units(fdm)), default=0.0)
    force = _force(fdm) / fdm["inertia/weight-lbs"]
    if not depth > 0.0 or force <= HARDEST_START:
        return
    above = ceil(10.0 * (initial.altitude + depth)) / 10.0
    times = f"{force:.3g} times its weight" if isfinite(force) else "no finite force"
    raise StartError(
        f"initial.altitude_m = {initial.altitude:g}: it is that of the centre of gravity, so the"
        f" aircraft begins {depth:.3g} m in the ground, with {times} on its gear, allowed: at most"
        f" {HARDEST_START:g}; at rest trim = true sets it on its wheels, and altitude_m >="
        f" {above:g} is above the ground"
    )


def stand_objection(fdm: jsbsim.FGFDMExec) -> str:
    """Why a trim on the ground is not to be tried, as JSBSim would end the process.

    Else nothing.
    """
    if not isfinite(_force(fdm)):
        return "the force on its gear is not finite"
    return "" if _triangle(fdm) else "no three points of its gear make a triangle to stand on"


def has_flat_gear(fdm: jsbsim.FGFDMExec) -> bool:
    """Whether three or more points of the gear lie on one line: a trim then ends the process."""
    return fdm["gear/num-units"] >= 3 and not _triangle(fdm)


def _triangle(fdm: jsbsim.FGFDMExec) -> bool:
    points: list[Vec3] = [
        (unit["x-position"], unit["y-position"], unit["z-position"]) for unit in _units(fdm)
    ]
    sides = ((subtract(b, a), subtract(c, a)) for a, b, c in combinations(points, 3))
    return any(norm(cross(first, second)) > _SMALLEST_TRIANGLE for first, second in sides)


def _force(fdm: jsbsim.FGFDMExec) -> float:
    """Force of the ground, lbf."""
    return sqrt(sum(fdm[f"forces/fb{axis}-gear-lbs"] ** 2 for axis in "xyz"))


def _units(fdm: jsbsim.FGFDMExec) -> Iterator[_Unit]:
    """Wheels and other points that may touch the ground, in inches of the structural frame."""
    manager = fdm.get_property_manager()
    for index in range(int(fdm["gear/num-units"])):
        for kind in ("gear", "contact"):
            node = manager.get_node(f"{kind}/unit[{index}]")
            if node:
                yield {
                    name: fdm[f"{kind}/unit[{index}]/{name}"]
                    for name in (*_POSITION, "compression-ft")
                }
