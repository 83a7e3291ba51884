"""How alike pilot's and rider's motion are, axis by axis, as they are and as they are perceived."""

from dataclasses import dataclass

import numpy as np

from ..rotation import ZERO, Vec3
from ..signals import STANDARD_GRAVITY
from .correlation import correlation
from .cues import FORCE_THRESHOLD, RATE_THRESHOLD, cue_shares
from .flight import Array, Flight
from .statistics import spread
from .vestibular import CANALS, OTOLITHS, Organ

VARIATION = 0.01
"""Standard deviation below which a signal does not vary, as a share of its axis' threshold (assumed)."""


@dataclass(frozen=True, slots=True)
class _Quantity:
    """One of the two things felt: its name and unit, value at rest, thresholds of its axes, and the organ that senses it."""

    name: str
    unit: str
    rest: Vec3
    threshold: Vec3
    organ: Organ


_FORCE = _Quantity("force", "m_s2", (0.0, 0.0, -STANDARD_GRAVITY), FORCE_THRESHOLD, OTOLITHS)
_RATE = _Quantity("rate", "rad_s", ZERO, RATE_THRESHOLD, CANALS)


def likeness(flight: Flight) -> dict[str, float]:
    """Figures of specific force and angular rate along each axis of the cabin (forward x, right y, down z), also as perceived.

    - ..._correlation and ..._delay_s: peak of the cross-correlation and how late the platform is there (`correlation`), both 0
      when pilot's or rider's signal varies by no more than `VARIATION` of the threshold;
    - ..._missing_share, ..._false_share, ..._scaled_share: cues by `cue_shares`, as departures from rest upright.

    Names begin with force_x and so on; with perceived_force_x where both signals have gone through the otoliths, or the canals,
    at rest in the first tick's steady state before it. The thresholds are the same there: they are the organs', at their
    output. perceived_force_rms_m_s2, perceived_rate_rms_rad_s, ..._p95_..., ..._max_... are the error vector's length then.

    Ticks are taken as evenly spaced.
    """
    pairs = ((_FORCE, flight.vehicle_f_B, flight.felt_f), (_RATE, flight.vehicle_w_B, flight.felt_w))
    n = len(flight.time)
    dt = float(flight.time[-1] - flight.time[0]) / (n - 1) if n > 1 else 1.0
    plain: dict[str, float] = {}
    errors: dict[str, float] = {}
    perceived: dict[str, float] = {}
    for quantity, vehicle, platform in pairs:
        square = np.zeros(n)
        for i, axis in enumerate("xyz"):
            pilot, rider = vehicle[:, i] - quantity.rest[i], platform[:, i] - quantity.rest[i]
            plain |= _alike(f"{quantity.name}_{axis}", pilot, rider, quantity.threshold[i], dt)
            pilot, rider = quantity.organ.sense(pilot, dt), quantity.organ.sense(rider, dt)
            perceived |= _alike(f"perceived_{quantity.name}_{axis}", pilot, rider, quantity.threshold[i], dt)
            square += (rider - pilot) ** 2
        errors |= spread(f"perceived_{quantity.name}", quantity.unit, np.sqrt(square))
    return errors | plain | perceived


def _alike(name: str, pilot: Array, rider: Array, threshold: float, dt: float) -> dict[str, float]:
    peak, delay = correlation(pilot, rider, dt, VARIATION * threshold)
    shares = {f"{name}_{kind}_share": share for kind, share in cue_shares(pilot, rider, threshold).items()}
    return {f"{name}_correlation": peak, f"{name}_delay_s": delay, **shares}
