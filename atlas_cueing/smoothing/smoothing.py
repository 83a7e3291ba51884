"""Smoothing: sphere and stage side by side."""

# mypyc: runs every tick

from math import inf, sqrt
from typing import Final

from ..errors import InputError, PlanningError
from ..rotation import Mat3, Vec3, norm
from ..signals import ContactRows, Cue, Motion, StageLimits, WheelLimits
from .sphere import SphereSmoothing
from .stage import StageSmoothing
from .traction import KeptTraction

_UNIT: Final = 1e-6  # a quaternion whose norm is off by more is no orientation
# rad/s; no cue of a cabin needs more, and the arithmetic stays far from overflow below it
_ABSURD_RATE: Final = 1e3


class Smoothing:
    """Turns cues into motion inside the limits of wheels and stage, at a fixed tick.

    It starts at rest in the first cue's orientation and position. For any cue, every motion
    keeps every limit; a cue that is no cue (not finite, no rotation, absurd) is answered with the
    certified stop. Motion times are its own: start + n dt.
    """

    def __init__(
        self,
        *,
        dt: float,
        wheels_from_sphere: Mat3,
        sphere_from_wheels: Mat3,
        wheel_limits: WheelLimits,
        stage_limits: StageLimits,
        contacts: ContactRows | None = None,
    ) -> None:
        """Start at rest; dt in s; the maps are J^-1 and J of the platform.

        contacts: what they and the drives can give, if motions have to keep it.

        Raises ValueError for limits that leave no room to move.
        """
        self._dt = dt
        self._sphere = SphereSmoothing(dt, wheels_from_sphere, sphere_from_wheels, wheel_limits)
        self._stage = StageSmoothing(dt, stage_limits)
        self._contacts = contacts
        self._kept = (
            None if contacts is None else KeptTraction(dt, contacts, self._sphere, self._stage)
        )
        self._start: float | None = None
        self._ticks = 0

    def step(self, cue: Cue) -> Motion:
        """Give the motion at the cue's time, one tick after the last one."""
        if self._start is None:
            return self.begin(cue)
        self._ticks += 1
        if self._kept is None:
            sphere_met, stage_met = self._turn(cue), self._stage.step(cue)
        else:
            sphere_met, stage_met = self._keep(self._kept, cue)
        return self._motion(self._start + self._ticks * self._dt, sphere_met, stage_met)

    def wheel_motion(self) -> tuple[Vec3, Vec3, Vec3]:
        """Give the wheels' angle, speed and acceleration (rad, s) of the last motion.

        The angles are exact sums of the wheels' own displacements, from zero at the start.
        """
        return self._sphere.wheel_motion

    def begin(self, cue: Cue) -> Motion:
        """Give the motion at rest in the cue's orientation and position; from there it goes on.

        Raises PlanningError for a cue that is no orientation, and InputError for one in which the
        platform would not be safe at rest.
        """
        if not _is_orientation(cue):
            raise PlanningError(f"the first cue must be an orientation; got {cue}")
        if self._contacts is not None and (short := self._contacts.shortfall(cue.q_WS)):
            q = ", ".join(f"{x:.6g}" for x in cue.q_WS)
            raise InputError(
                f"[traction] keep = true, but at rest in the first pose, q_WS = ({q}), {short};"
                " give more preload or friction, or another start"
            )
        self._start, self._ticks = cue.time, 0
        self._sphere.start(cue)
        self._stage.start(cue)
        return self._motion(cue.time, True, True)

    def _turn(self, cue: Cue) -> bool:
        try:
            if _is_orientation(cue):
                return self._sphere.step(cue)
        except PlanningError:
            pass
        self._sphere.stop()
        return False

    def _keep(self, kept: KeptTraction, cue: Cue) -> tuple[bool, bool]:
        """Follow the cue for one tick with traction kept; return what was met."""
        sphere, (x, y, z) = self._sphere, self._stage.axes
        near = False
        try:
            if _is_orientation(cue):
                turns, near = sphere.wanted(cue)
            else:
                turns = sphere.stopping()
        except PlanningError:
            turns = sphere.stopping()
        p, v, a = cue.p_WS_W, cue.v_WS_W, cue.a_WS_W
        (mx, near_x), (my, near_y), (mz, near_z) = (
            x.wanted(p[0], v[0], a[0]),
            y.wanted(p[1], v[1], a[1]),
            z.wanted(p[2], v[2], a[2]),
        )
        (one, two, three), (mx, my, mz) = kept.choose(turns, (mx, my, mz))
        sphere.fly(one, two, three)
        x.fly(mx)
        y.fly(my)
        z.fly(mz)
        return (
            near and one.met and two.met and three.met,
            near_x and near_y and near_z and mx.met and my.met and mz.met,
        )

    def _motion(self, time: float, sphere_met: bool, stage_met: bool) -> Motion:
        sphere, stage = self._sphere, self._stage
        return Motion(
            time,
            sphere.q_WS,
            sphere.w_WS_W,
            sphere.alpha_WS_W,
            stage.p_WS_W,
            stage.v_WS_W,
            stage.a_WS_W,
            (0.0 if sphere_met else 1.0, 0.0 if stage_met else 1.0),
        )


def _is_orientation(cue: Cue) -> bool:
    """Whether the cue's rotation can be followed at all."""
    w, x, y, z = cue.q_WS
    unit = abs(sqrt(w * w + x * x + y * y + z * z) - 1.0) <= _UNIT
    return unit and -inf < cue.time < inf and norm(cue.w_WS_W) <= _ABSURD_RATE
