"""One live run's platform: the state it is in, the course it is on, and the pipeline that carries it out."""

# mypyc: runs every tick

from collections.abc import Callable
from dataclasses import replace
from math import hypot, isfinite

from ...cueing import CueSource
from ...errors import PlanningError
from ...pipeline import Pipeline
from ...rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    apply,
    continuous,
    geodesic,
    integrate_base,
    norm,
    normalise,
    scale,
    subtract,
)
from ...signals import STANDARD_GRAVITY, Cue, Motion, Tick, VehicleState, WheelSpeeds
from .guard import Command
from .input_monitor import ENGAGE_TIME, RESUME_TIME
from .state_machine import Event, State, after
from .trajectories import (
    EngageTrajectory,
    FollowTrajectory,
    HoldTrajectory,
    ParkTrajectory,
    StopTrajectory,
    Trajectory,
    calm_time,
)

# rad/s, m/s, and a tenth of it per s^2: below this the platform stands (assumed; nobody feels it)
AT_REST = 1e-3
AT_HOME = 1e-3  # rad and m from upright in the centre
LONGEST_BLEND = 5.0  # s

_REST_FORCE: Vec3 = (0.0, 0.0, -STANDARD_GRAVITY)
_HOME = Cue(0.0, IDENTITY, ZERO, ZERO, ZERO, ZERO)


def no_vehicle(time: float) -> VehicleState:
    """What stands in the log while there is no input yet: level and at rest."""
    return VehicleState(time, IDENTITY, ZERO, _REST_FORCE)


class PlatformController:
    """Takes the platform from state to state, and gives every tick; it starts parked."""

    def __init__(
        self,
        new_pipeline: Callable[[], Pipeline],
        sphere_from_wheels: tuple[Vec3, Vec3, Vec3],
        travel: Vec3,
        dt: float,
    ):
        """new_pipeline: makes a fresh chain. sphere_from_wheels.

        J. travel of the stage in m, tick dt in s.
        """
        self._new_pipeline, self._J, self._travel, self._dt = (
            new_pipeline,
            sphere_from_wheels,
            travel,
            dt,
        )
        self.state = State.PARKED
        self._pipeline = new_pipeline()
        self._cueing: CueSource | None = None
        self._cue = _HOME
        self._motion = self._pipeline.smoothing.step(_HOME)
        self._course: Trajectory = HoldTrajectory(self._motion)
        self._asked = self._motion.q_WS  # by the cue of the last tick
        self._unused: CueSource | None = self._pipeline.cueing

    @property
    def blending(self) -> bool:
        """On its way to the cue, or on it."""
        return isinstance(self._course, EngageTrajectory | FollowTrajectory)

    @property
    def moving(self) -> bool:
        """Follows the cue or is not at rest."""
        return self.blending or not self._arrived()

    @property
    def fresh(self) -> bool:
        """Parked since it last followed a cue, so that the next one is a new one."""
        return self._cueing is None

    @property
    def motion(self) -> Motion:
        """The last motion."""
        return self._motion

    def handle(self, event: Event) -> bool:
        """Take one event; whether the state changed."""
        before, self.state = self.state, after(self.state, event)
        if self.state is before:
            return False
        self._enter(before)
        return True

    def begin(self, vehicle: VehicleState) -> None:
        """While engaging and not on the way yet: set out for the cue of this vehicle state."""
        fresh = self._cueing is None
        if self._cueing is None:
            self._cueing, self._unused = self._unused or self._new_pipeline().cueing, None
            self._cue = self._cueing.step(vehicle)
        way = subtract(self._cue.p_WS_W, self._motion.p_WS_W)
        calm = calm_time(geodesic(self._motion.q_WS, self._cue.q_WS), norm(way))
        duration = min(max(calm, ENGAGE_TIME if fresh else RESUME_TIME), LONGEST_BLEND)
        self._course = EngageTrajectory(self._motion, self._cue, self._dt, duration)

    def step(self, vehicle: VehicleState) -> Tick:
        """The next tick, in any state but those of a fault.

        Raises PlanningError for a cue that is not finite.
        """
        if self.blending and self._cueing:
            self._cue = self._cueing.step(vehicle)
        cue = self._signed(self._course.step(_at(self._cue, vehicle.time)))
        if not isfinite(hypot(*cue.q_WS, *cue.w_WS_W, *cue.p_WS_W, *cue.v_WS_W, *cue.a_WS_W)):
            raise PlanningError(f"a cue that is not finite: {cue}")
        self._motion = _timed(self._pipeline.smoothing.step(cue), vehicle.time)
        return Tick(vehicle, cue, self._motion, self._pipeline.wheels.speeds(self._motion))

    def stopping(self, before: Motion, vehicle: VehicleState, command: Command) -> Tick:
        """A tick that the guard made: the motion is what its command does to the platform, which moved as `before` a tick ago.

        The turn is J times the wheels' own, by the trapezoid less dt^2/12 of the change of
        acceleration (Euler-Maclaurin).
        """
        dt = self._dt
        w, alpha = apply(self._J, command.wheel_speed), apply(self._J, command.wheel_acceleration)
        bend = scale(dt * dt / 12.0, subtract(alpha, before.alpha_WS_W))
        turn = subtract(
            scale(
                0.5 * dt,
                (w[0] + before.w_WS_W[0], w[1] + before.w_WS_W[1], w[2] + before.w_WS_W[2]),
            ),
            bend,
        )
        q: Quat = normalise(integrate_base(before.q_WS, turn, before.w_WS_W, w, dt))
        p, v, a = command.p_WS_W, command.v_WS_W, command.a_WS_W
        self._motion = Motion(vehicle.time, q, w, alpha, p, v, a, (1.0, 1.0))
        wheels = WheelSpeeds(vehicle.time, command.wheel_speed, command.wheel_acceleration)
        return Tick(vehicle, self._signed(Cue(vehicle.time, q, w, p, v, a)), self._motion, wheels)

    def arrived(self) -> bool:
        """Whether what the state is about is done; drives home as soon as it stands."""
        if (
            self.state is State.PARKING
            and isinstance(self._course, StopTrajectory)
            and self._arrived()
        ):
            self._course = ParkTrajectory(self._motion, self._dt)
        match self.state:
            case State.ENGAGING:
                return isinstance(self._course, EngageTrajectory) and self._course.arrived
            case State.PARKING:
                return (
                    isinstance(self._course, ParkTrajectory)
                    and self._arrived()
                    and _is_home(self._motion)
                )
            case State.FAULT_STOPPING:
                return _is_still(self._motion)
        return False

    def _signed(self, cue: Cue) -> Cue:
        """The cue with the sign of q that goes on from the last one: a cueing and a way home know nothing of each other's."""
        self._asked = continuous(cue.q_WS, self._asked)
        return cue if self._asked is cue.q_WS else replace(cue, q_WS=self._asked)

    def _arrived(self) -> bool:
        return self._course.arrived and _is_at_rest(self._motion)

    def _enter(self, before: State) -> None:
        """What a new state begins with."""
        match self.state:
            case State.RUNNING:
                self._course = FollowTrajectory()
            case State.HOLDING | State.PARKING:
                if before is State.STOPPED:
                    self._restart()
                self._course = StopTrajectory(self._motion, self._dt, self._travel)
            case State.PARKED:
                self._cueing, self._course = None, HoldTrajectory(self._motion)
            case State.ENGAGING:
                self._course = HoldTrajectory(self._motion)

    def _restart(self) -> None:
        """After a fault: smoothing from where the guard's stop has ended, and cueing from nothing."""
        m = self._motion
        self._cueing, self._pipeline = None, self._new_pipeline()
        self._unused = self._pipeline.cueing
        self._motion = self._pipeline.smoothing.step(
            Cue(m.time, m.q_WS, ZERO, m.p_WS_W, ZERO, ZERO)
        )


def command_of(tick: Tick) -> Command:
    """What a tick asks of the drives."""
    m, wheels = tick.motion, tick.wheels
    return Command(m.time, wheels.speed, wheels.acceleration, m.p_WS_W, m.v_WS_W, m.a_WS_W)


def standing(motion: Motion) -> Command:
    """The command to stand where this motion is."""
    return Command(motion.time, ZERO, ZERO, motion.p_WS_W, ZERO, ZERO)


def _at(cue: Cue, time: float) -> Cue:
    return (
        cue
        if cue.time == time
        else Cue(time, cue.q_WS, cue.w_WS_W, cue.p_WS_W, cue.v_WS_W, cue.a_WS_W)
    )


def _timed(motion: Motion, time: float) -> Motion:
    """The motion with the tick's own time.

    After a restart smoothing's differs from it by rounding.
    """
    m = motion
    if m.time == time:
        return m
    return Motion(time, m.q_WS, m.w_WS_W, m.alpha_WS_W, m.p_WS_W, m.v_WS_W, m.a_WS_W, m.limited)


def _is_still(motion: Motion) -> bool:
    return not any((*motion.w_WS_W, *motion.alpha_WS_W, *motion.v_WS_W, *motion.a_WS_W))


def _is_at_rest(motion: Motion) -> bool:
    rate, bend = hypot(*motion.w_WS_W, *motion.v_WS_W), hypot(*motion.alpha_WS_W, *motion.a_WS_W)
    return rate < AT_REST and bend < 10.0 * AT_REST


def _is_home(motion: Motion) -> bool:
    return geodesic(motion.q_WS, IDENTITY) < AT_HOME and hypot(*motion.p_WS_W) < AT_HOME
