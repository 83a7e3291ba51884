"""The supervisory controller of a live run, one tick at a time.

A tick reads the source, takes the state machine through the events of this tick, lets the platform
controller make the next motion, and has the guard check it.

A slot may be lost: there is no time left for its set point (`Slot`). A platform at rest then stands
where it is, and its course goes on later. One that moves stops, by the guard's stop from the last
command that went out; so do the drives, who derive the same stop from it. Whether a slot is lost is
looked at when the tick begins and again when its motion has been made, for that takes time, too.
"""

# mypyc: runs every tick

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from ...errors import VehicleError
from ...signals import Tick
from ..input.source import Source, SourceReading, no_vehicle
from .command import Command, command_of, standstill
from .drive_monitor import DriveMonitor
from .guard import Guard
from .homecoming import HOME_AFTER, Homecoming
from .input_monitor import GOOD_TO_ENGAGE, InputMonitor
from .platform_controller import PlatformController
from .slot import Slot
from .state_machine import BUTTON_EVENTS, Event, State

_REMEDY = "what helps: --priority, a longer --lead, a lower --rate, fewer programs beside it"

_FAULT_STATES = (State.FAULT_STOPPING, State.STOPPED)
_AWAY_FROM_PARK = (State.ENGAGING, State.RUNNING, State.HOLDING, State.WAITING)
_REST_STATES = (State.PARKED, State.STOPPED)


@dataclass(frozen=True, slots=True)
class OperatorInputs:
    """What is requested of a live run from outside.

    buttons: returns the buttons pressed since the last call: engage, hold, park, reset, stop.
    stop_requests: returns how often the process has been asked to end; the first request parks, the
        second stops at once.
    duration: s until the platform parks by itself.
    attended: an operator can engage and reset; otherwise the run engages by itself and is over when
        it has parked or stopped.
    losses: returns the helpers found dead since the last call: what to tell, and whether to park.
    carries: there are drives, which an unattended run does not leave (`homecoming`).
    """

    buttons: Callable[[], Iterable[str]] = tuple
    stop_requests: Callable[[], int] = int
    duration: float = float("inf")
    attended: bool = False
    losses: Callable[[], Iterable[tuple[str, bool]]] = tuple
    carries: bool = False


@dataclass(frozen=True, slots=True)
class RunOutcome:
    """How a run went.

    result: ok, vehicle_failed, input_lost, viewer_died, fault or stopped: the first thing that went
        wrong.
    reason: what went wrong, in words; empty for ok.
    faults: number of faults.
    dropped: number of samples that the source refused.
    """

    result: str = "ok"
    reason: str = ""
    faults: int = 0
    dropped: int = 0


class LiveController:
    """Runs source, state machine, platform controller and guard, a tick at a time.

    `tick` never raises, and every command is inside every limit.

    reading: what the source reported in the last tick.
    """

    def __init__(
        self,
        platform: PlatformController,
        guard: Guard,
        source: Source,
        operator: OperatorInputs,
        drives: DriveMonitor | None = None,
    ) -> None:
        """Start before the first reading of the source; without `drives` nobody is listened to."""
        self._platform = platform
        self._guard = guard
        self._source = source
        self._operator = operator
        self._drives = drives
        self._monitor = InputMonitor()
        self._finishing = self._landing = self._source_failed = False
        # whether it was asked to engage, has had a good sample, and has set out to the cue
        self._asked = self._heard = self._set_out = False
        self._attended, self._input_lost = operator.attended, False
        self._requests = self._requests_before_fault = 0  # to end: up to now, before the fault
        # the last motion and command that went out
        self._last_motion = platform.motion
        self._last = standstill(platform.motion, platform.wheel_angle)
        guard.start(self._last)
        unattended = operator.carries and not operator.attended
        self._homecoming = Homecoming(unattended, platform.state is State.STOPPED)
        self._waiting: Tick | None = None  # made when it was too late for it; not gone out yet
        self._vehicle = no_vehicle(0.0)  # as last known
        self._changes: list[tuple[State, str]] = [(platform.state, "")]
        self._failures: list[tuple[str, str]] = []  # result and reason, in order
        self._faults = self._dropped = 0
        self.reading = SourceReading(None, float("inf"), 0, 0, False, False, "")

    @property
    def state(self) -> State:
        """The state the platform is in."""
        return self._platform.state

    @property
    def over(self) -> bool:
        """Whether the run is finished and the platform at rest for good, the drives as well.

        An attended one that a fault has stopped waits for its reset or for one more request to end.
        """
        if self.state is State.STOPPED and self._waits_for_reset():
            return False
        if not (self.state in _REST_STATES and self._finishing and self._guard.standing):
            return False
        if self.state is State.STOPPED:
            return not self._homecoming.stays(self._requests)
        return self._drives is None or self._drives.settled

    @property
    def outcome(self) -> RunOutcome:
        """How the run has gone up to now."""
        result, reason = self._failures[0] if self._failures else ("ok", "")
        if result == "ok" and self._asked and not self._heard:
            result, reason = "input_lost", self._absence()
        return RunOutcome(result, reason, self._faults, self._dropped)

    def engage(self) -> None:
        """Engage, as the operator's button does."""
        self._handle(Event.ENGAGE, "asked to engage")

    def take_changes(self) -> list[tuple[State, str]]:
        """Return the changes of state since the last call, each with its reason."""
        changes, self._changes = self._changes, []
        return changes

    def tick(self, slot: Slot) -> tuple[Tick, Command]:
        """Run the next tick; return what is recorded and what the drives get."""
        tick = None
        try:
            self._watch_drives(slot)
            if not self._landing:
                tick = self._make_tick(slot)
        except BaseException as error:  # noqa: BLE001
            # After any error the platform must come to a stop
            self._fail(_described(error))
        tick, command = self._guarded(slot.time, tick)
        if self._drives:
            self._drives.commanded(slot.due, command)
        return tick, command

    def _watch_drives(self, slot: Slot) -> None:
        """Hear the drives; what they tell may be a fault."""
        if self._drives is None:
            return
        if fault := self._drives.watch(slot.now(), self._platform.tracking):
            self._fail(fault)
        self._changes += [(self.state, note) for note in self._drives.notes()]

    def _make_tick(self, slot: Slot) -> Tick | None:
        """Handle the events of the slot and make its tick; None for one of the guard's stop."""
        standing, late = self._guard.standing, slot.late()
        put_off = standing and late > 0.0
        self._update_state(slot.time, put_off)
        if not standing:
            self._check_lateness(late)
        if self.state is State.STOPPED:
            good = late <= 0.0 and not (self._drives and self._drives.trouble)
            if self._homecoming.sets_out(slot.time, good):
                self._handle(Event.RESET, f"punctual for {HOME_AFTER:g} s: slowly home")
        if self.state in _FAULT_STATES:
            return None
        if self._finishing and self.state in _REST_STATES and not standing:
            self._landing = True
            return None
        if put_off:
            return self._stand(slot.time)
        tick = self._next_motion(slot.time)
        late = slot.late()
        if standing and late > 0.0:
            self._waiting = tick
            return self._stand(slot.time)
        self._check_lateness(late)
        return None if self.state in _FAULT_STATES else tick

    def _guarded(self, time: float, tick: Tick | None) -> tuple[Tick, Command]:
        """Return the tick with its command, if the guard lets it pass, or the next of its stop."""
        angle = self._platform.wheel_angle if self._waiting is None else self._last.wheel_angle
        if tick is not None and self.state not in _FAULT_STATES:
            command = self._guard.check(command_of(tick, angle), tick.motion.q_WS)
        else:
            tick, command = None, self._guard.stop(time)
        if tick is None or self._guard.stopping:
            if not self._landing:
                self._fail(self._guard.reason)
            vehicle = replace(self._vehicle, time=time)
            tick = self._platform.commanded_tick(
                self._last_motion, self._last.wheel_angle, vehicle, command
            )
            self._waiting = None
        self._last_motion, self._last = tick.motion, command
        return tick, command

    def _stand(self, time: float) -> Tick:
        """Return a tick that stands where the platform stands."""
        return self._platform.standing_tick(self._last_motion, replace(self._vehicle, time=time))

    def _next_motion(self, time: float) -> Tick:
        """Return the motion that waits to go out, or else the next one."""
        if self._waiting is None:
            return self._platform.step(replace(self._vehicle, time=time))
        tick, self._waiting = _retimed(self._waiting, time), None
        return tick

    def _update_state(self, time: float, put_off: bool) -> None:
        """Handle the events of this tick; one that is put off sets nothing in motion.

        The arrival comes first, since a source that raises keeps the rest from happening.
        """
        self._platform.start_next_trajectory()
        if self._platform.arrived:
            self._handle(Event.ARRIVED, "")
        self._handle_operator(time)
        self._read_source(time, self.state is State.RUNNING and not put_off)
        for event, reason in self._monitor.watch(
            time, self.state, self._platform.moving, self.reading
        ):
            self._handle(event, reason)
        self._tell_remark(time)
        if self._finishing and self.state in _AWAY_FROM_PARK:
            if self.state is State.WAITING and not self._set_out:
                self._failures.append(("input_lost", self._absence()))
            self._handle(Event.PARK, "the run is over")
        if not put_off:
            self._start_engaging(time)

    def _check_lateness(self, late: float) -> None:
        """Raise a fault when it is too late for the set point by `late` (s) of this slot."""
        if late > 0.0 and self.state not in _FAULT_STATES:
            self._fail(f"a set point came {1e3 * late:.1f} ms too late for the drives; {_REMEDY}")
            self._homecoming.note_fault(late=True)

    def _handle_operator(self, time: float) -> None:
        """Handle buttons, requests to end, and the end of the duration."""
        for name in self._operator.buttons():
            if name == "reset" and self._drives and self._drives.trouble:
                self._changes.append((self.state, f"not reset: {self._drives.trouble}"))
            elif name in BUTTON_EVENTS:
                self._handle(BUTTON_EVENTS[name], f"asked to {name}")
            elif name == "stop":
                self._stop_at_once("asked to stop")
        for text, parks in self._operator.losses():
            self._lose_helper(text, parks)
        requests = self._requests = self._operator.stop_requests()
        if requests > 0 and self.state is State.STOPPED and not self._failures:
            self._failures.append(("stopped", "asked to end where it stands, away from home"))
        if requests > 1:
            self._stop_at_once("asked to stop at once")
        self._finishing |= requests > 0 or time >= self._operator.duration

    def _stop_at_once(self, reason: str) -> None:
        if self.state not in _FAULT_STATES:
            self._failures.append(("stopped", reason))
            self._fail(reason)

    def _lose_helper(self, text: str, parks: bool) -> None:
        """Tell that a helper has died; without the operator's view, go home for good."""
        self._changes.append((self.state, text))
        if parks:
            self._failures.append(("viewer_died", text))
            self._attended, self._finishing = False, True
            self._homecoming = Homecoming(self._operator.carries, stopped=False)

    def _waits_for_reset(self) -> bool:
        """Whether an operator is there, and nobody has asked to end since the fault."""
        requests = self._requests
        return self._attended and requests < 2 and requests <= self._requests_before_fault

    def _read_source(self, time: float, advance: bool) -> None:
        """Read the source; a vehicle that fails ends the run as the end of its flight does.

        What else a source raises is a fault, and ends the run, too; neither is asked again.
        """
        if self._source_failed:
            return
        try:
            self.reading = self._source.read(time, advance)
        except VehicleError as error:
            self._failures.append(("vehicle_failed", str(error)))
            self._source_failed = self._finishing = True
        except BaseException:
            self._source_failed = self._finishing = True
            raise
        else:
            self._dropped += self.reading.dropped
        self._heard |= self.reading.vehicle is not None
        self._vehicle = self.reading.vehicle or self._vehicle
        self._finishing |= self.reading.over

    def _tell_remark(self, time: float) -> None:
        """Tell what the user should know of the input, as the state's new reason."""
        remark = self._monitor.remark(time, self.state, self.reading)
        if remark:
            self._changes.append((self.state, remark))

    def _absence(self) -> str:
        """Return why the ride had no input."""
        reading = self.reading
        return f"no good input: {reading.remark or reading.reason or 'nothing came'}"

    def _start_engaging(self, time: float) -> None:
        """Start to blend to the cue, once the input has been good for long enough.

        From then on only its present sender is believed.
        """
        waiting = self.state is State.ENGAGING and not self._platform.tracking
        waiting &= not (self._drives and self._drives.trouble)
        wanted = GOOD_TO_ENGAGE if self._platform.needs_cueing else 0.0
        if waiting and self.reading.vehicle and self._monitor.good_for(time) >= wanted:
            self._platform.start_engaging(self._vehicle)
            self._source.pin()
            self._set_out = True

    def _fail(self, reason: str) -> None:
        """Raise a fault, unless there is one already."""
        if self.state in _FAULT_STATES:
            return
        self._faults, self._landing = self._faults + 1, False
        self._homecoming.note_fault(late=False)
        self._requests_before_fault = self._requests
        self._failures.append(("fault", reason))
        self._handle(Event.FAULT, reason)

    def _handle(self, event: Event, reason: str) -> None:
        """Take one event to monitor, source and state machine; note a change of state."""
        if event is Event.ENGAGE:
            self._monitor.held = False
            self._asked = True
            if self.state is State.PARKED:  # perhaps the simulator has been started anew
                self._source.release()
        elif event is Event.HOLD:
            self._monitor.held = True
        if not self._platform.handle(event):
            return
        self._changes.append((self.state, reason))
        self._input_lost |= event is Event.LOST
        if event is Event.RESET:
            self._guard.start(standstill(self._last_motion, self._last.wheel_angle))
        if self.state is State.STOPPED:
            self._homecoming.note_stop(self._requests)
        if not self._attended and self.state in _REST_STATES and not self._finishing:
            self._end_unattended()

    def _end_unattended(self) -> None:
        """End the run that has parked or stopped by itself, unless somebody would be left there."""
        if self.state is State.STOPPED and self._homecoming.advice:
            self._changes.append((self.state, self._homecoming.advice))
            return
        if self._input_lost and not self._homecoming.homeward:
            self._failures.append(("input_lost", "parked, since the input was lost"))
        self._finishing = True


def _described(error: BaseException) -> str:
    """Return the error in words; one that cannot tell them is named."""
    try:
        return f"{type(error).__name__}: {error}"
    except BaseException:  # noqa: BLE001
        return type(error).__name__


def _retimed(tick: Tick, time: float) -> Tick:
    """Return the tick as one of another time (s)."""
    return Tick(
        replace(tick.vehicle, time=time),
        replace(tick.cue, time=time),
        replace(tick.motion, time=time),
        replace(tick.wheels, time=time),
    )
