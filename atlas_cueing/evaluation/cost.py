"""One number for how far the rider's motion is from the pilot's: what method `preview` makes least."""

from collections.abc import Mapping
from math import hypot

from ..cueing import PreviewParameters
from .deviation import deviation
from .run_columns import RunColumns

_UNITS = PreviewParameters()


def cost(flight: RunColumns) -> dict[str, float]:
    """The root mean square, over the flight, of the errors of specific force and angular rate at the rider's head.

    - cost: sqrt( mean |felt - vehicle specific force|^2 / force_unit^2 + mean |felt - vehicle rate|^2 / rate_unit^2 );
    - cost_force, cost_rate: the two terms by themselves, so that cost^2 = cost_force^2 +
        cost_rate^2.

    The units are those of `PreviewParameters`, what a pilot begins to notice: a cost of 1 is an
    error at that threshold, all the way. A direction of the force that is off by 1 deg costs 1
    where the force is gravity's, and 3 deg/s beyond the vehicle's cost 1.
    """
    return cost_of(deviation(flight))


def cost_of(deviations: Mapping[str, float]) -> dict[str, float]:
    """The cost for figures of `deviation` that are known already."""
    return combined(deviations["force_rms_m_s2"], deviations["rate_rms_rad_s"])


def combined(force_rms: float, rate_rms: float) -> dict[str, float]:
    """The cost for rms errors of force (m/s^2) and rate (rad/s) that are known already."""
    force, rate = force_rms / _UNITS.force_unit, rate_rms / _UNITS.rate_unit
    return {"cost": hypot(force, rate), "cost_force": force, "cost_rate": rate}
