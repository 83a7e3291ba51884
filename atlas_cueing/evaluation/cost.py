"""One number for how far the rider's motion is from the pilot's.

It is what method `preview` makes least.
"""

from math import hypot

from ..cueing import PreviewParameters

_UNITS = PreviewParameters()


def combined(force_rms: float, rate_rms: float) -> dict[str, float]:
    """The cost of errors at the rider's head, from their root mean squares over a run.

    force_rms: of |felt - vehicle specific force|, m/s^2; rate_rms: of |felt - vehicle rate|, rad/s.

    - cost_force = force_rms / force_unit and cost_rate = rate_rms / rate_unit;
    - cost = sqrt(cost_force^2 + cost_rate^2).

    The units are those of `PreviewParameters`, what a pilot begins to notice: a cost of 1 is an
    error at that threshold, all the way. A direction of the force that is off by 1 deg costs 1
    where the force is gravity's, and 3 deg/s beyond the vehicle's cost 1.
    """
    force, rate = force_rms / _UNITS.force_unit, rate_rms / _UNITS.rate_unit
    return {"cost": hypot(force, rate), "cost_force": force, "cost_rate": rate}
