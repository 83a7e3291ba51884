"""Executes the state of a live run: trajectories, and the pipeline that they go through."""

# mypyc: runs every tick

from collections.abc import Callable
from math import hypot, isfinite

from ...cueing import CueSource
from ...errors import PlanningError
from ...pipeline import Pipeline
from ...rotation import (
    ZERO,
    Mat3,
    Quat,
    Vec3,
    add,
    apply,
    geodesic,
    integrate_base,
    norm,
    normalise,
    subtract,
)
from ...signals import Cue, Motion, StageLimits, Tick, VehicleState, WheelLimits, WheelSpeeds
from .at_rest import is_at_home, is_at_rest, is_still
from .certified_axis import six_axes
from .command import Command, command_from
from .gentle_stop import GentleStop
from .input_monitor import ENGAGE_TIME, RESUME_TIME
from .pace import Pace
from .pose import Pose
from .sign_continuity import SignContinuity
from .state_machine import Event, State, next_state
from .trajectories import (
    EngageTrajectory,
    FollowTrajectory,
    HoldTrajectory,
    ParkTrajectory,
    Trajectory,
    calm_time,
    turn_home,
)

LONGEST_BLEND = 5.0  # s


class PlatformController:
    """Takes the platform from state to state, and makes every tick.

    It starts parked at home, and stopped anywhere else.

    state: the state the platform is in.
    wheel_angle: of each wheel with the last motion, rad, from that of the pose at the start.
    """

    def __init__(
        self,
        new_pipeline: Callable[[], Pipeline],
        wheels_from_sphere: Mat3,
        sphere_from_wheels: Mat3,
        wheel_limits: WheelLimits,
        stage_limits: StageLimits,
        dt: float,
        pose: Pose | None = None,
    ):
        """Build the first pipeline.

        Args:
            new_pipeline: makes a new pipeline, at rest.
            wheels_from_sphere: J^-1, rad/s of each wheel by rad/s of the sphere in W.
            sphere_from_wheels: J, the reverse.
            wheel_limits: of the wheels.
            stage_limits: of the stage.
            dt: tick, s.
            pose: where the platform stands; at home by default.
        """
        pose = pose or Pose()
        self._new_pipeline = new_pipeline
        self._J = sphere_from_wheels
        self._axes = six_axes(dt, wheel_limits, stage_limits)
        self._pace = Pace(wheels_from_sphere, self._axes)
        self._slowly = False  # on the way home
        self._dt = dt
        self.state = State.PARKED if pose.is_home else State.STOPPED
        self._pipeline = new_pipeline()
        self._cueing: CueSource | None = None
        self._unused_cueing: CueSource | None = self._pipeline.cueing
        self._cue = Cue(0.0, pose.q_WS, ZERO, pose.p_WS_W, ZERO, ZERO)
        self._motion = self._pipeline.smoothing.step(self._cue)
        # rad, of the wheels: where this smoothing has begun, and with the last motion
        self._first_angle = self.wheel_angle = pose.wheel_angle
        self._wheels = WheelSpeeds(0.0, ZERO, ZERO)  # with the last motion
        self._signs = SignContinuity(self._motion.q_WS)
        self._trajectory: Trajectory | GentleStop = HoldTrajectory(self._motion)

    @property
    def tracking(self) -> bool:
        """Whether it blends to the cue or follows it."""
        return isinstance(self._trajectory, EngageTrajectory | FollowTrajectory)

    @property
    def moving(self) -> bool:
        """Whether it tracks the cue or is not at rest."""
        return self.tracking or not self._trajectory_completed

    @property
    def needs_cueing(self) -> bool:
        """Whether the next engagement starts a new cueing: after parking and after a fault."""
        return self._cueing is None

    @property
    def has_not_left(self) -> bool:
        """Whether it is at home, and no cueing has moved it since it was parked."""
        return self._cueing is None and not self._slowly and is_at_home(self._motion)

    @property
    def motion(self) -> Motion:
        """The last motion."""
        return self._motion

    @property
    def arrived(self) -> bool:
        """Whether the motion that belongs to the state has been completed."""
        match self.state:
            case State.ENGAGING:
                return isinstance(self._trajectory, EngageTrajectory) and self._trajectory.arrived
            case State.PARKING:
                parking = not isinstance(self._trajectory, GentleStop)
                return parking and self._trajectory_completed and is_at_home(self._motion)
            case State.FAULT_STOPPING:
                return is_still(self._motion)
        return False

    def handle(self, event: Event) -> bool:
        """Take one event; return whether the state changed."""
        before, self.state = self.state, next_state(self.state, event)
        if self.state is before:
            return False
        self._enter_state(before)
        return True

    def start_engaging(self, vehicle: VehicleState) -> None:
        """Start to blend to the cue for this state of the vehicle, from rest."""
        vehicle = self._signs.vehicle(vehicle)
        self._leave_stop()
        blend_time = RESUME_TIME
        if self._cueing is None:
            blend_time = ENGAGE_TIME
            self._cueing, self._unused_cueing = self._take_cueing(), None
            self._cue = self._cueing.step(vehicle)
        gap = subtract(self._cue.p_WS_W, self._motion.p_WS_W)
        calm = calm_time(geodesic(self._motion.q_WS, self._cue.q_WS), norm(gap))
        duration = min(max(calm, blend_time), LONGEST_BLEND)
        self._trajectory = EngageTrajectory(self._motion, self._cue, self._dt, duration)

    def start_next_trajectory(self) -> None:
        """Start the way back to park as soon as a stop for parking has come to rest.

        A platform that has not left home stays as it is: there may be no drives to follow it.
        """
        stopping = isinstance(self._trajectory, GentleStop)
        if self.state is State.PARKING and stopping and self._trajectory_completed:
            self._leave_stop()
            if self.has_not_left:
                return
            q, p = self._motion.q_WS, self._motion.p_WS_W
            duration = self._pace.parking_time(turn_home(q), p, self._slowly)
            self._trajectory = ParkTrajectory(self._motion, self._dt, duration)

    def step(self, vehicle: VehicleState) -> Tick:
        """Return the next tick, in any state but those of a fault.

        Raises PlanningError for a cue that is not finite.
        """
        if isinstance(self._trajectory, GentleStop):
            command = command_from(vehicle.time, self._trajectory.next())
            return self.commanded_tick(self._motion, self.wheel_angle, vehicle, command, 0.0)
        vehicle = self._signs.vehicle(vehicle)
        if self.tracking and self._cueing:
            self._cue = self._cueing.step(vehicle)
        cue = self._signs.cue(self._trajectory.step(_cue_at(self._cue, vehicle.time)))
        if not isfinite(hypot(*cue.q_WS, *cue.w_WS_W, *cue.p_WS_W, *cue.v_WS_W, *cue.a_WS_W)):
            raise PlanningError(f"a cue that is not finite: {cue}")
        smoothing = self._pipeline.smoothing
        self._motion = _motion_at(smoothing.step(cue), vehicle.time)
        angle, speed, acceleration = smoothing.wheel_motion()
        self.wheel_angle = add(self._first_angle, angle)
        self._wheels = WheelSpeeds(vehicle.time, speed, acceleration)
        return Tick(vehicle, cue, self._motion, self._wheels)

    def standing_tick(self, before: Motion, vehicle: VehicleState) -> Tick:
        """Return a tick that stands still at the motion before it, which is at rest."""
        q, p, time = before.q_WS, before.p_WS_W, vehicle.time
        cue = self._signs.cue(Cue(time, q, ZERO, p, ZERO, ZERO))
        wheels = WheelSpeeds(time, ZERO, ZERO)
        return Tick(self._signs.vehicle(vehicle), cue, _motion_at(before, time), wheels)

    def commanded_tick(
        self,
        before: Motion,
        angle_before: Vec3,
        vehicle: VehicleState,
        command: Command,
        limited: float = 1.0,
    ) -> Tick:
        """Return the tick of a command that no smoothing has made: the motion of the platform.

        The turn of the sphere is J times the wheels' own.

        Args:
            before: motion of the platform a tick ago.
            angle_before: of the wheels, a tick ago, rad.
            vehicle: state of the vehicle, with the time of this tick.
            command: of a stop.
            limited: whether the motion is another than was asked for, 1 or 0.
        """
        w, alpha = apply(self._J, command.wheel_speed), apply(self._J, command.wheel_acceleration)
        turn = apply(self._J, subtract(command.wheel_angle, angle_before))
        q: Quat = normalise(integrate_base(before.q_WS, turn, before.w_WS_W, w, self._dt))
        p, v, a = command.p_WS_W, command.v_WS_W, command.a_WS_W
        self.wheel_angle = command.wheel_angle
        self._motion = Motion(vehicle.time, q, w, alpha, p, v, a, (limited, limited))
        self._wheels = WheelSpeeds(vehicle.time, command.wheel_speed, command.wheel_acceleration)
        cue = self._signs.cue(Cue(vehicle.time, q, w, p, v, a))
        return Tick(self._signs.vehicle(vehicle), cue, self._motion, self._wheels)

    @property
    def _trajectory_completed(self) -> bool:
        return self._trajectory.arrived and is_at_rest(self._motion)

    def _enter_state(self, before: State) -> None:
        """Start the trajectory of a new state."""
        match self.state:
            case State.RUNNING:
                self._trajectory = FollowTrajectory()
            case State.HOLDING | State.PARKING:
                if before is State.STOPPED:
                    self._restart()
                self._slowly = before is State.STOPPED
                stopping = before in (State.HOLDING, State.PARKING)
                if not (stopping and isinstance(self._trajectory, GentleStop)):
                    self._trajectory = self._new_stop()
            case State.PARKED:
                self._cueing, self._trajectory = None, HoldTrajectory(self._motion)
            case State.ENGAGING | State.WAITING:
                self._leave_stop()
                self._trajectory = HoldTrajectory(self._motion)

    def _new_stop(self) -> GentleStop:
        """Return a stop from the last motion."""
        m, wheels = self._motion, self._wheels
        turns = zip(self.wheel_angle, wheels.speed, wheels.acceleration, strict=True)
        rails = zip(m.p_WS_W, m.v_WS_W, m.a_WS_W, strict=True)
        return GentleStop(self._axes, [*turns, *rails], self._dt)

    def _leave_stop(self) -> None:
        """Have smoothing begin where a stop has ended, which it did not make."""
        if isinstance(self._trajectory, GentleStop):
            m = self._motion
            self._first_angle = self.wheel_angle
            self._pipeline.smoothing.begin(Cue(m.time, m.q_WS, ZERO, m.p_WS_W, ZERO, ZERO))
            self._trajectory = HoldTrajectory(m)

    def _take_cueing(self) -> CueSource:
        """Return the cueing that no engagement has used yet, or a new one."""
        return self._unused_cueing or self._new_pipeline().cueing

    def _restart(self) -> None:
        """After a fault: smoothing from where the guard's stop has ended, and a new cueing."""
        m = self._motion
        self._cueing, self._pipeline = None, self._new_pipeline()
        self._first_angle = self.wheel_angle
        self._unused_cueing = self._pipeline.cueing
        self._motion = self._pipeline.smoothing.step(
            Cue(m.time, m.q_WS, ZERO, m.p_WS_W, ZERO, ZERO)
        )


def _cue_at(cue: Cue, time: float) -> Cue:
    if cue.time == time:
        return cue
    return Cue(time, cue.q_WS, cue.w_WS_W, cue.p_WS_W, cue.v_WS_W, cue.a_WS_W)


def _motion_at(motion: Motion, time: float) -> Motion:
    """Return the motion with the tick's own time.

    After a restart smoothing's time differs from it by rounding.
    """
    m = motion
    if m.time == time:
        return m
    return Motion(time, m.q_WS, m.w_WS_W, m.alpha_WS_W, m.p_WS_W, m.v_WS_W, m.a_WS_W, m.limited)
