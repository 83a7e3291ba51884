"""Holds the cabin's attitude to the schedule, by what its sensors tell.

Wheels slip and creep, and rolling is not holonomic: wheel angles do not tell the orientation. The
estimate q_hat(t_s) (`attitude_estimate`) is of the time t_s of the newest status. A set point made
now is due later, at t_d, and what was added between is on its way already:

    e_S = log(q_hat(t_s)^-1 q_ref(t_s)) - sum over (t_s, t_d] of R_ref^T J dc
    Omega_c = R_ref(t_d) K e_S, less far away (`attitude_loop`),   wheels: J^-1 Omega_c

with q_ref the schedule, and dc what a tick adds to the wheels' angles; so the delay does not make
the loop ring. An error turns with the sphere, and is constant in axes S of the schedule. The
angles, speeds and accelerations sent are schedule + correction (`corrected_wheel`), inside the
platform's limits together; the schedule itself is not changed by it.

Nothing is corrected while the schedule stands: at rest nothing moves. In a fault the sum flies the
certified stop from its own last set point, as the drives do, and the correction is what remains
beside the schedule's own. While the platform moves, a gyro that falls silent is a fault, and so are
fixes that contradict it, and a cabin that is lost; without fixes nothing more is corrected. At rest
each of them is a reason not to set out.
"""

# mypyc: runs every tick

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, inf, radians
from typing import Final

from ...plant.attitude_loop import correction_rate, sphere_acceleration
from ...rotation import (
    ZERO,
    Mat3,
    Quat,
    Vec3,
    add,
    apply,
    conjugate,
    exp,
    log,
    multiply,
    norm,
    rotate,
    scale,
    subtract,
)
from .attitude_estimate import AttitudeEstimate, EstimateSettings
from .certified_axis import AxisLimits
from .command import Command, axes_of, command_from
from .corrected_wheel import CorrectedWheel
from .drive_status import DriveStatus
from .pose import Pose

MOST_ERROR: Final = radians(30.0)  # of the cabin, by slip or by a sensor that fails (assumed)
_KEPT: Final = 1024  # ticks: a second at 1 kHz


@dataclass(frozen=True, slots=True)
class CorrectionSettings:
    """How errors are taken away.

    gain: of the correction, 1/s. largest_rate: of the sphere by the correction, rad/s.
    share: of the wheels' acceleration limits that the correction uses for itself.
    """

    gain: float
    largest_rate: float
    share: float
    estimate: EstimateSettings


@dataclass(slots=True, init=False)
class _Sent:
    """A tick that was sent.

    due: ns. q_WS: the schedule's orientation. added_S: rotation vector, axes S of the schedule, of
    all that was added up to then.
    """

    due: Final[int]
    q_WS: Final[Quat]
    added_S: Final[Vec3]

    def __init__(self, due: int, q_WS: Quat, added_S: Vec3) -> None:
        self.due = due
        self.q_WS = q_WS
        self.added_S = added_S


class AttitudeCorrection:
    """Estimate and correction of one ride.

    error: angle between estimate and schedule of the same time, rad, at the newest status.
    correction: of the angle of each wheel in the last command, rad.
    """

    def __init__(
        self,
        settings: CorrectionSettings,
        matrices: tuple[Mat3, Mat3],
        axes: Sequence[AxisLimits],
        dt: float,
        pose: Pose | None = None,
    ) -> None:
        """Stand at `pose`, at home by default.

        matrices: J and J^-1. axes: limits of the wheels, others may follow. dt: tick, s.
        """
        pose = pose or Pose()
        self._settings: Final[CorrectionSettings] = settings
        self._J: Final[Mat3] = matrices[0]
        self._J_inverse: Final[Mat3] = matrices[1]
        self._wheels: Final[list[CorrectedWheel]] = [
            CorrectedWheel(limits, dt, angle, settings.share)
            for limits, angle in zip(axes[:3], pose.wheel_angle, strict=True)
        ]
        one, two, three = axes[:3]
        most = one.acceleration, two.acceleration, three.acceleration
        self._acceleration: Final[float] = settings.share * sphere_acceleration(matrices[1], most)
        self._schedule: list[Vec3] = [(angle, 0.0, 0.0) for angle in pose.wheel_angle]
        self._estimate: Final[AttitudeEstimate] = AttitudeEstimate(settings.estimate, pose.q_WS)
        self._sent: deque[_Sent] = deque(maxlen=_KEPT)
        self._q_WS = pose.q_WS  # of the schedule, with the last command
        self._added_S: Vec3 = ZERO
        self._seen_error_S: Vec3 = ZERO
        self._seen_added_S: Vec3 = ZERO
        self._stands = True  # the schedule, with the last command
        self._breach = ""  # of a limit by the sum
        self._origin = 0.0  # s, time of the run when the clock shows 0
        self.correction: Vec3 = ZERO
        self.error = 0.0
        self._largest_error = self._largest_rate = 0.0

    @property
    def standing(self) -> bool:
        """Whether schedule and correction together are at rest."""
        return all(wheel.standing for wheel in self._wheels)

    @property
    def fault(self) -> str:
        """Why a platform that moves has to stop; empty otherwise."""
        if self.error > MOST_ERROR:
            return (
                f"by its sensors the cabin is {degrees(self.error):.1f} deg from its schedule,"
                f" allowed: {degrees(MOST_ERROR):.0f} deg"
            )
        return self._breach or self._estimate.fault

    @property
    def trouble(self) -> str:
        """Why nothing is corrected; empty when it is."""
        return self.fault or self._estimate.trouble

    def figures(self) -> dict[str, float]:
        """Return what was seen and done, by name, the unit in the name."""
        return {
            "estimated_error_max_deg": degrees(self._largest_error),
            "correction_rate_max_rad_s": self._largest_rate,
            "fixes": self._estimate.fixes,
            "fixes_refused": self._estimate.fixes_refused,
        }

    def row(self) -> tuple[float, ...]:
        """Return the numbers of /correction and /estimate of the last tick, without their times."""
        one, two, three = (
            subtract(wheel.state, schedule)
            for wheel, schedule in zip(self._wheels, self._schedule, strict=True)
        )
        q, age = self._estimate.q_WS, self._estimate.fix_age
        time = self._estimate.time
        seen = self._origin + 1e-9 * time if time else -1.0
        return (
            *(one[0], two[0], three[0], one[1], two[1], three[1], one[2], two[2], three[2]),
            *(seen, q[0], q[1], q[2], q[3], self.error, age if age < inf else -1.0),
        )

    def hear(self, status: DriveStatus) -> None:
        """Take what the cabin's sensors have told."""
        if self._estimate.hear(status) and self._sent:
            self._compare(status.time)

    def corrected(self, due: int, command: Command, q_WS: Quat, *, stopping: bool) -> Command:
        """Return what the drives get: the command of the schedule, corrected.

        Args:
            due: when the drives shall have it, ns.
            command: of the schedule.
            q_WS: orientation of the schedule that belongs to it.
            stopping: the schedule flies the certified stop.
        """
        axes = axes_of(command)
        schedule, stood = axes[:3], self._stands
        self._stands = not any(v or a for _, v, a in axes)
        if stopping or (stood and self._stands) or self._breach:
            for wheel in self._wheels:
                wheel.stop()
        else:
            self._follow(schedule)
        self._schedule = schedule
        one, two, three = self._wheels
        angle = (one.state[0], two.state[0], three.state[0])
        correction = subtract(angle, command.wheel_angle)
        turn_W = apply(self._J, subtract(correction, self.correction))
        self.correction, self._q_WS = correction, q_WS
        self._added_S = add(self._added_S, rotate(conjugate(q_WS), turn_W))
        self._sent.append(_Sent(due, q_WS, self._added_S))
        self._origin = command.time - 1e-9 * due
        self._note_rate()
        return command_from(command.time, [one.state, two.state, three.state, *axes[3:]])

    def restart(self) -> None:
        """After a fault: correct again."""
        self._breach = ""

    def _follow(self, schedule: Sequence[Vec3]) -> None:
        """Go on along the schedule; one wheel that has to stop is a reason for all."""
        wanted = self._wanted()
        for i in range(3):
            breach = self._wheels[i].follow(self._schedule[i], schedule[i], wanted[i])
            if breach and not self._breach:
                self._breach = f"schedule and correction together: {breach}"

    def _wanted(self) -> Vec3:
        """Return the speeds of the correction, rad/s."""
        if self.trouble:
            return ZERO
        on_its_way = subtract(self._added_S, self._seen_added_S)
        error, s = subtract(self._seen_error_S, on_its_way), self._settings
        rate_S = correction_rate(error, s.gain, s.largest_rate, self._acceleration)
        return apply(self._J_inverse, rotate(self._q_WS, rate_S))

    def _compare(self, time: int) -> None:
        """Hold the estimate against the schedule of the same time (ns)."""
        sent = self._sent
        while len(sent) > 1 and sent[1].due <= time:
            sent.popleft()
        q_WS, self._seen_added_S = _at(sent, time)
        self._seen_error_S = log(multiply(conjugate(self._estimate.q_WS), q_WS))
        self.error = norm(self._seen_error_S)
        self._largest_error = max(self._largest_error, self.error)

    def _note_rate(self) -> None:
        one, two, three = self._wheels
        s = self._schedule
        speeds = one.state[1] - s[0][1], two.state[1] - s[1][1], three.state[1] - s[2][1]
        self._largest_rate = max(self._largest_rate, norm(apply(self._J, speeds)))


def _at(sent: Sequence[_Sent], time: int) -> tuple[Quat, Vec3]:
    """Return orientation and what was added at `time` (ns), between two ticks."""
    one = sent[0]
    if len(sent) < 2 or time <= one.due:
        return one.q_WS, one.added_S
    other = sent[1]
    share = min((time - one.due) / (other.due - one.due), 1.0)
    turn = log(multiply(conjugate(one.q_WS), other.q_WS))
    added = scale(share, subtract(other.added_S, one.added_S))
    return multiply(one.q_WS, exp(scale(share, turn))), add(one.added_S, added)
