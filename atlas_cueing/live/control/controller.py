"""The supervisory controller of a live run, one tick at a time.

A tick reads the source, takes the state machine through the events of this tick, lets the platform
controller make the next motion, and has the guard check it.

A slot may be lost: there is no time left for its set point (`Slot`). A platform at rest then stands
where it is, and its course goes on later. One that moves stops, by the guard's stop from the last
command that went out; so do the drives, who derive the same stop from it. Whether a slot is lost is
looked at when the tick begins and again when its motion has been made, for that takes time, too.
"""

# mypyc: runs every tick

from ...errors import VehicleError
from ...signals import Tick
from ..input.source import Source, SourceReading
from .attitude_correction import AttitudeCorrection
from .command import Command
from .command_gate import CommandGate
from .drive_monitor import DriveMonitor
from .guard import Guard
from .homecoming import HOME_AFTER, Homecoming
from .input_monitor import GOOD_TO_ENGAGE, InputMonitor
from .operator_inputs import OperatorInputs
from .platform_controller import PlatformController
from .run_account import RunAccount, RunOutcome, described
from .slot import Slot, lateness_text
from .state_machine import BUTTON_EVENTS, Event, State
from .vehicle_input import VehicleInput

_FAULT_STATES = (State.FAULT_STOPPING, State.STOPPED)
_AWAY_FROM_PARK = (State.ENGAGING, State.RUNNING, State.HOLDING, State.WAITING)
_REST_STATES = (State.PARKED, State.STOPPED)


class LiveController:
    """Runs source, state machine, platform controller and guard, a tick at a time.

    `tick` never raises, and every command is inside every limit.
    """

    def __init__(
        self,
        platform: PlatformController,
        guard: Guard,
        source: Source,
        operator: OperatorInputs,
        drives: DriveMonitor | None = None,
        attitude: AttitudeCorrection | None = None,
    ) -> None:
        """Start before the first reading of the source; without `drives` nobody is listened to.

        attitude: corrects what the drives get.
        """
        self._platform = platform
        self._gate = CommandGate(platform, guard, attitude)
        self._source, self._input = source, VehicleInput(source)
        self._account = RunAccount(platform.state)
        self._operator = operator
        self._drives = drives
        self._monitor = InputMonitor()
        # the last two: whether it was asked to engage, and has set out to the cue
        self._finishing = self._landing = self._asked = self._set_out = False
        self._attended, self._input_lost = operator.attended, False
        self._requests = 0  # to end, up to now
        unattended = operator.carries and not operator.attended
        self._homecoming = Homecoming(unattended, platform.state is State.STOPPED)

    @property
    def state(self) -> State:
        """The state the platform is in."""
        return self._platform.state

    @property
    def over(self) -> bool:
        """Whether the run is finished and the platform at rest for good, the drives as well.

        An attended one that a fault has stopped waits for its reset or for one more request to end.
        """
        waits = self._attended and self._homecoming.waits(self._requests)
        if self.state is State.STOPPED and waits:
            return False
        if not (self.state in _REST_STATES and self._finishing and self._gate.settled):
            return False
        if self.state is State.STOPPED:
            return not self._homecoming.stays(self._requests)
        return self._drives is None or self._drives.settled

    @property
    def reading(self) -> SourceReading:
        """What the source reported in the last tick."""
        return self._input.reading

    @property
    def outcome(self) -> RunOutcome:
        """How the run has gone up to now."""
        missed = self._asked and not self._input.heard
        return self._account.outcome(self._input.dropped, self._input.absence if missed else "")

    def engage(self) -> None:
        """Engage, as the operator's button does."""
        self._handle(Event.ENGAGE, "asked to engage")

    def take_changes(self) -> list[tuple[State, str]]:
        """Return the changes of state since the last call, each with its reason."""
        return self._account.take_changes()

    def tick(self, slot: Slot) -> tuple[Tick, Command]:
        """Run the next tick; return what is recorded and what the drives get."""
        tick = None
        try:
            self._watch_drives(slot)
            if not self._landing:
                tick = self._make_tick(slot)
            elif self._operator.stop_requests() > 1:
                self._stop_at_once("asked to stop at once")
        except BaseException as error:  # noqa: BLE001 - after any the platform must stop
            self._fail(described(error))
        tick, command = self._guarded(slot, tick)
        if self._drives:
            self._drives.commanded(slot.due, command)
        return tick, command

    def prepare(self, time: float) -> None:
        """Step the vehicle ahead of the tick at `time` (s): its dearest part can be done early."""
        if self.state is State.RUNNING and not self._finishing:
            self._input.prepare(time)

    def _watch_drives(self, slot: Slot) -> None:
        """Hear the drives; what they tell may be a fault."""
        if self._drives is None:
            return
        if fault := self._drives.watch(slot.now(), self._platform.tracking):
            self._fail(fault)
        for note in self._drives.notes():
            self._account.tell(self.state, note)

    def _make_tick(self, slot: Slot) -> Tick | None:
        """Handle the events of the slot and make its tick; None for one of the guard's stop."""
        standing, late = self._gate.standing, slot.late()
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
            return self._gate.stand(self._input.vehicle_at(slot.time))
        tick = self._gate.next_motion(self._input.vehicle_at(slot.time))
        late = slot.late()
        if standing and late > 0.0:
            self._gate.keep(tick)
            return self._gate.stand(self._input.vehicle_at(slot.time))
        self._check_lateness(late)
        return None if self.state in _FAULT_STATES else tick

    def _guarded(self, slot: Slot, tick: Tick | None) -> tuple[Tick, Command]:
        """Return the tick with its command, if the guard lets it pass, or the next of its stop."""
        if self.state in _FAULT_STATES:
            tick = None
        command = self._gate.release(slot.time, tick)
        tick, stopped = self._gate.sent(tick, command, self._input.vehicle_at(slot.time))
        command = self._gate.corrected(slot.due, tick, command)
        if stopped and not self._landing:
            self._fail(self._gate.reason)
        return tick, command

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
            time, self.state, self._platform.moving, self._input.reading
        ):
            self._handle(event, reason)
        if remark := self._monitor.remark(time, self.state, self._input.reading):
            self._account.tell(self.state, remark)
        if self._finishing and self.state in _AWAY_FROM_PARK:
            if self.state is State.ENGAGING and not (self._set_out or self._monitor.good):
                self._handle(Event.ABSENT, self._input.absence)
            if self.state is State.WAITING and not self._set_out:
                self._account.fail("input_lost", self._input.absence)
            self._handle(Event.PARK, "the run is over")
        if not put_off:
            self._start_engaging(time)

    def _check_lateness(self, late: float) -> None:
        """Raise a fault when it is too late for the set point by `late` (s) of this slot."""
        if late > 0.0 and self.state not in _FAULT_STATES:
            self._fail(lateness_text(late, self._operator.carries))
            self._homecoming.note_lateness()

    def _handle_operator(self, time: float) -> None:
        """Handle buttons, requests to end, and the end of the duration."""
        for name in self._operator.buttons():
            if name == "reset" and self._drives and self._drives.trouble:
                self._account.tell(self.state, f"not reset: {self._drives.trouble}")
            elif name in BUTTON_EVENTS:
                self._handle(BUTTON_EVENTS[name], f"asked to {name}")
            elif name == "stop":
                self._stop_at_once("asked to stop")
        for text, parks in self._operator.losses():
            self._lose_helper(text, parks)
        requests = self._requests = self._operator.stop_requests()
        if requests > 0 and self.state is State.STOPPED and not self._account.failed:
            self._account.fail("stopped", "asked to end where it stands, away from home")
        if requests > 1:
            self._stop_at_once("asked to stop at once")
        self._finishing |= requests > 0 or time >= self._operator.duration

    def _stop_at_once(self, reason: str) -> None:
        if self.state not in _FAULT_STATES:
            self._account.fail("stopped", reason)
            self._fail(reason)

    def _lose_helper(self, text: str, parks: bool) -> None:
        """Tell that a helper has died; without the operator's view, go home for good."""
        self._account.tell(self.state, text)
        if parks:
            self._account.fail("viewer_died", text)
            self._attended, self._finishing = False, True
            self._homecoming = Homecoming(self._operator.carries, stopped=False)

    def _read_source(self, time: float, advance: bool) -> None:
        """Read the source; a vehicle that fails ends the run as the end of its flight does.

        What else a source raises is a fault, and ends the run, too.
        """
        try:
            self._finishing |= self._input.read(time, advance)
        except VehicleError as error:
            self._account.fail("vehicle_failed", str(error))
            self._finishing = True
        except BaseException:
            self._finishing = True
            raise

    def _start_engaging(self, time: float) -> None:
        """Start to blend to the cue, once the input has been good for long enough.

        From then on only its present sender is believed.
        """
        waiting = self.state is State.ENGAGING and not self._platform.tracking
        waiting &= not (self._drives and self._drives.trouble)
        wanted = GOOD_TO_ENGAGE if self._platform.needs_cueing else 0.0
        if waiting and self._input.reading.vehicle and self._monitor.good_for(time) >= wanted:
            self._platform.start_engaging(self._input.vehicle)
            self._source.pin()
            self._set_out = True

    def _fail(self, reason: str) -> None:
        """Raise a fault, unless there is one already."""
        if self.state in _FAULT_STATES:
            return
        self._account.faults, self._landing = self._account.faults + 1, False
        # a platform that never left home needs no second request: nobody hangs there
        self._homecoming.note_fault(0 if self._platform.has_not_left else self._requests)
        self._account.fail("fault", reason)
        self._handle(Event.FAULT, reason)

    def _handle(self, event: Event, reason: str) -> None:
        """Take one event to monitor, source and state machine; note a change of state."""
        if event is Event.ENGAGE:
            self._monitor.held, self._asked = False, True
            if self.state is State.PARKED:  # perhaps the simulator has been started anew
                self._source.release()
        elif event is Event.HOLD:
            self._monitor.held = True
        if not self._platform.handle(event):
            return
        self._account.tell(self.state, reason)
        self._input_lost |= event is Event.LOST
        if event is Event.RESET:
            self._gate.restart()
        if self.state is State.STOPPED:
            self._homecoming.note_stop()
        if not self._attended and self.state in _REST_STATES and not self._finishing:
            self._end_unattended()

    def _end_unattended(self) -> None:
        """End the run that has parked or stopped by itself, unless somebody would be left there."""
        if self.state is State.STOPPED and self._homecoming.advice:
            self._account.tell(self.state, self._homecoming.advice)
            return
        if self._input_lost and not self._homecoming.homeward:
            self._account.fail("input_lost", "parked, since the input was lost")
        self._finishing = True
