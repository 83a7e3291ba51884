"""The figures of rides, by which methods are compared.

All are of `atlas_cueing.evaluation`, but R3, which asks what becomes of R for those who take false
rates for worse than M does. A rate error counts three times:

    M3^2 = mismatch_magnitude^2 + mismatch_direction^2 + (3 mismatch_rate)^2
    R = max(M, 1) / max(M_still, 1),   R3 = max(M3, 1) / max(M3_still, 1)

M_still and M3_still are of the same flight by method `still`. Ratios are averaged geometrically.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from math import degrees, exp, hypot, log
from random import Random

from atlas_cueing.evaluation import mismatch_ratio

STILL = "still"
WORSE = 1.0  # R above which a method has done harm
_DRAWS, _SEED = 5000, 1


@dataclass(frozen=True)
class Figures:
    """Of one ride.

    direction, rate, tilt, turn: rms errors of the force's direction (deg), of the rate behind the
    canals (deg/s), and of the observer's tilt (deg) and turn (deg/s); force: of specific force,
    m/s^2; M, worst: mismatch and its worst ten seconds; R, R3: beside `still`.
    """

    direction: float
    force: float
    rate: float
    M: float
    R: float
    R3: float
    worst: float
    tilt: float
    turn: float

    @property
    def observed(self) -> float:
        """The observer's errors in just noticeable units as M has them: 1 deg and 3 deg/s."""
        return hypot(self.tilt, self.turn / 3.0)


NAMES = tuple(field.name for field in fields(Figures))
RATIOS = ("R", "R3")


def figures(metrics: Mapping[str, float], still: Mapping[str, float]) -> Figures:
    """Of a ride with these metrics, beside those of `still`."""
    return Figures(
        direction=degrees(metrics["direction_rms_rad"]),
        force=metrics["force_rms_m_s2"],
        rate=degrees(metrics["perceived_rate_rms_rad_s"]),
        M=metrics["mismatch"],
        R=mismatch_ratio(metrics["mismatch"], still["mismatch"]),
        R3=mismatch_ratio(mismatch_3(metrics), mismatch_3(still)),
        worst=metrics["mismatch_worst_10s"],
        tilt=degrees(metrics["perceived_tilt_rms_rad"]),
        turn=degrees(metrics["perceived_turn_rms_rad_s"]),
    )


def mismatch_3(metrics: Mapping[str, float]) -> float:
    """M3: the mismatch in which a rate error counts three times."""
    legs = (metrics[f"mismatch_{leg}"] for leg in ("magnitude", "direction"))
    return hypot(*legs, 3.0 * metrics["mismatch_rate"])


def geometric_mean(values: Sequence[float]) -> float:
    """Of positive numbers."""
    return exp(sum(map(log, values)) / len(values))


def means(rides: Sequence[Figures]) -> dict[str, float]:
    """The mean of each figure, of ratios the geometric one, and of R and R3 together."""
    found = {
        name: geometric_mean(column) if name in RATIOS else sum(column) / len(column)
        for name in NAMES
        for column in [[getattr(ride, name) for ride in rides]]
    }
    return {**found, "together": (found["R"] * found["R3"]) ** 0.5}


def worse(rides: Sequence[Figures]) -> tuple[int, float]:
    """On how many flights a method is worse than `still` by R, and the largest R of all."""
    return sum(ride.R > WORSE for ride in rides), max(ride.R for ride in rides)


@dataclass(frozen=True)
class Paired:
    """One method beside another, flight by flight.

    ratio: geometric mean of the ratios; low, high: its interval of 90 % by bootstrap over flights;
    wins, losses: flights on which the ratio is below and above 1 by more than 1 %.
    """

    ratio: float
    low: float
    high: float
    wins: int
    losses: int


def paired(ones: Sequence[float], others: Sequence[float]) -> Paired:
    """Compare a figure of two methods on the same flights, in the same order."""
    logs = [log(one / other) for one, other in zip(ones, others, strict=True)]
    random = Random(_SEED)  # noqa: S311 - the same interval every time
    drawn = sorted(sum(random.choices(logs, k=len(logs))) / len(logs) for _ in range(_DRAWS))
    low, high = (exp(drawn[round(share * (_DRAWS - 1))]) for share in (0.05, 0.95))
    wins, losses = (sum(sign * x > log(1.01) for x in logs) for sign in (-1.0, 1.0))
    return Paired(exp(sum(logs) / len(logs)), low, high, wins, losses)
