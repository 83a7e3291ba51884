"""Where the cabin is, as its sensors tell through the drives' status packets.

A status carries the gyro's integral up to its time, and the newest fix from outside with its own
time; `plant.AttitudeObserver` makes an estimate of them. A fix that is far off what the gyro says
is not believed: two sensors that contradict each other tell nothing.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import degrees, inf, radians
from typing import Final

from ...plant.attitude_observer import AttitudeObserver
from ...rotation import Quat, conjugate, geodesic, log, multiply, scale
from .drive_status import CabinSensors, DriveStatus

LIVE_FEEDBACKS: Final = ("none", "gyro", "fix")
MOST_APART: Final = radians(10.0)  # of a fix and the estimate of its time (assumed)
MOST_REFUSED: Final = 3  # fixes in a row that may be that far off (assumed)
FIX_TIMEOUT: Final = 2.0  # s that a platform is corrected by the gyro alone (assumed)
_NS: Final = 1e-9
_EARLIER: Final = 0.02  # s, before the first status: the observer begins there, at rest


@dataclass(frozen=True, slots=True)
class EstimateSettings:
    """How the sensors are believed.

    uses_fix: fixes are believed, not the gyro alone.
    fix_gain, fix_bias_gain: shares of a fix, 0 to 1. fix_rate: expected, Hz.
    memory: longest age of a fix that is used, s. first_fix_gain: of the first, which counts more.
    """

    uses_fix: bool
    fix_gain: float
    fix_bias_gain: float
    fix_rate: float
    memory: float = 1.0
    first_fix_gain: float = 0.0


class AttitudeEstimate:
    """Estimate of one ride.

    time: of the newest status, ns; 0 before the first.
    q_WS: orientation then.
    fixes, fixes_refused: up to now.
    """

    def __init__(self, settings: EstimateSettings, q_WS: Quat) -> None:
        """Start at rest at a known orientation, before the first status."""
        s = settings
        self._uses_fix: Final[bool] = s.uses_fix
        self._observer: Final[AttitudeObserver] = AttitudeObserver(
            q_WS, s.fix_gain, s.fix_bias_gain, 1.0 / s.fix_rate, s.memory, s.first_fix_gain
        )
        self.q_WS = q_WS
        self.fixes = self.fixes_refused = 0
        self._first = 0  # ns, where the observer's time begins
        self.time = 0
        self._turned: Quat = (1.0, 0.0, 0.0, 0.0)
        self._seen = self._believed = 0  # ns, of the newest fix, and of the newest believed
        self._apart = 0.0  # rad, of the last fix refused
        self._refused_in_a_row = 0
        self._blind = True  # the newest status told of no gyro

    @property
    def fix_age(self) -> float:
        """Age of the newest fix that was believed, at the newest status, s; inf before any."""
        return _NS * (self.time - self._believed) if self._believed else inf

    @property
    def fault(self) -> str:
        """Why a platform that moves by this estimate has to stop; empty otherwise."""
        if self._blind:
            return "the drives tell of no gyro in the cabin, which the correction needs"
        if self._refused_in_a_row >= MOST_REFUSED:
            return (
                f"the last {self._refused_in_a_row} fixes are not where the gyro says, by"
                f" {degrees(self._apart):.1f} deg, allowed: {degrees(MOST_APART):.0f} deg"
            )
        return ""

    @property
    def trouble(self) -> str:
        """Why the estimate is not to be used; empty when it is."""
        if not self.fault and self._uses_fix and self.fix_age > FIX_TIMEOUT:
            late = "yet" if self.fix_age == inf else f"for {FIX_TIMEOUT:g} s"
            return f"no fix of the cabin has come {late}: nothing is corrected"
        return self.fault

    def hear(self, status: DriveStatus) -> bool:
        """Take what the cabin's sensors have told; return whether that was something new."""
        sensors = status.sensors
        self._blind = sensors is None
        if sensors is None or status.time <= self.time:
            return False
        if not self._first:
            self._first = self.time = status.time - round(_EARLIER / _NS)
            self._turned = sensors.turned
        self._turn(status.time, sensors)
        self._take_fix(sensors)
        self.q_WS = self._observer.q_WS
        return True

    def _turn(self, time: int, sensors: CabinSensors) -> None:
        """Turn the estimate by what the gyro has integrated since the last status."""
        dt = _NS * (time - self.time)
        turn = log(multiply(conjugate(self._turned), sensors.turned))
        self._observer.turn(self._seconds(time), scale(1.0 / dt, turn), dt)
        self.time, self._turned = time, sensors.turned

    def _take_fix(self, sensors: CabinSensors) -> None:
        """Give a new fix to the observer, unless the gyro says that it cannot be."""
        if not self._uses_fix or sensors.fix_WS is None or sensors.seen == self._seen:
            return
        self._seen, taken = sensors.seen, self._seconds(sensors.seen)
        then = self._observer.at(taken)
        if then is None:
            return
        apart = geodesic(then, sensors.fix_WS)
        self.fixes += 1
        if apart > MOST_APART:
            self.fixes_refused, self._apart = self.fixes_refused + 1, apart
            self._refused_in_a_row += 1
            return
        self._refused_in_a_row, self._believed = 0, sensors.seen
        self._observer.take_fix(taken, sensors.fix_WS)

    def _seconds(self, time: int) -> float:
        return _NS * (time - self._first)
