"""The supervisory controller of a live run, one tick at a time.

A tick reads the source, takes the state machine through the events of this tick, lets the platform
controller make the next motion, and has the guard check it.
"""

# mypyc: runs every tick

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from ...errors import VehicleError
from ...signals import Tick
from ..input.source import Source, SourceReading, no_vehicle
from .command import Command, command_of, standstill
from .guard import Guard
from .input_monitor import GOOD_TO_ENGAGE, InputMonitor
from .platform_controller import PlatformController
from .state_machine import BUTTON_EVENTS, Event, State

MOST_MISSED = 5  # deadlines in a row; with one more the platform is stopped
MOST_LATE = 0.020  # s that a tick may be late
_REMEDY = "what helps: --priority, a lower --rate, fewer programs beside it"

_FAULT_STATES = (State.FAULT_STOPPING, State.STOPPED)
_AWAY_FROM_PARK = (State.ENGAGING, State.RUNNING, State.HOLDING)
_REST_STATES = (State.PARKED, State.STOPPED)


@dataclass(frozen=True, slots=True)
class OperatorInputs:
    """What is requested of a live run from outside.

    buttons: returns the buttons pressed since the last call: engage, hold, park, reset.
    stop_requests: returns how often the process has been asked to end; the first request parks, the
        second stops at once.
    duration: s of real time until the platform parks by itself.
    attended: an operator can engage and reset; otherwise the run engages by itself and is over when
        it has parked or stopped.
    """

    buttons: Callable[[], Iterable[str]] = tuple
    stop_requests: Callable[[], int] = int
    duration: float = float("inf")
    attended: bool = False


@dataclass(frozen=True, slots=True)
class RunOutcome:
    """How a run went.

    result: ok, vehicle_failed, input_lost, fault or stopped: the first thing that went wrong.
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
        self, platform: PlatformController, guard: Guard, source: Source, operator: OperatorInputs
    ) -> None:
        """Start parked, before the first reading of the source."""
        self._platform = platform
        self._guard = guard
        self._source = source
        self._operator = operator
        self._monitor = InputMonitor()
        self._finishing = False
        self._last_motion = platform.motion  # of the last command that went out
        self._vehicle = no_vehicle(0.0)  # as last known
        self._changes: list[tuple[State, str]] = [(State.PARKED, "")]
        self._failures: list[tuple[str, str]] = []  # result and reason, in order
        self._faults = self._dropped = 0
        self.reading = SourceReading(None, float("inf"), 0, 0, False, False, "")

    @property
    def state(self) -> State:
        """The state the platform is in."""
        return self._platform.state

    @property
    def over(self) -> bool:
        """Whether the run is finished and the platform at rest for good."""
        return self.state in _REST_STATES and self._finishing

    @property
    def outcome(self) -> RunOutcome:
        """How the run has gone up to now."""
        result, reason = self._failures[0] if self._failures else ("ok", "")
        return RunOutcome(result, reason, self._faults, self._dropped)

    def engage(self) -> None:
        """Engage, as the operator's button does."""
        self._handle(Event.ENGAGE, "asked to engage")

    def take_changes(self) -> list[tuple[State, str]]:
        """Return the changes of state since the last call, each with its reason."""
        changes, self._changes = self._changes, []
        return changes

    def tick(
        self, time: float, elapsed: float, lateness: float, missed_in_a_row: int
    ) -> tuple[Tick, Command]:
        """Run the next tick; return what is recorded and what the drives get.

        Args:
            time: of the platform, s.
            elapsed: real time since the loop's start, s.
            lateness: from the tick's deadline to its beginning, s.
            missed_in_a_row: deadlines missed one after the other up to now.
        """
        tick = None
        try:
            self._update_state(elapsed)
            self._check_timing(lateness, missed_in_a_row)
            if self.state not in _FAULT_STATES:
                tick = self._platform.step(replace(self._vehicle, time=time))
        except Exception as error:  # noqa: BLE001
            # After any error the platform must come to a stop
            self._fail(f"{type(error).__name__}: {error}")
        command = self._guard.check(command_of(tick)) if tick else self._guard.stop(time)
        if tick is None or self._guard.stopping:
            self._fail(self._guard.reason)
            vehicle = replace(self._vehicle, time=time)
            tick = self._platform.guard_tick(self._last_motion, vehicle, command)
        self._last_motion = tick.motion
        return tick, command

    def _update_state(self, elapsed: float) -> None:
        """Handle the events of this tick.

        The arrival comes first, since a source that raises keeps the rest from happening.
        """
        self._platform.start_next_trajectory()
        if self._platform.arrived:
            self._handle(Event.ARRIVED, "")
        self._handle_operator(elapsed)
        self._read_source(elapsed)
        for event, reason in self._monitor.watch(
            elapsed, self.state, self._platform.moving, self.reading
        ):
            self._handle(event, reason)
        if self._finishing and self.state in _AWAY_FROM_PARK:
            self._handle(Event.PARK, "the run is over")
        self._start_engaging(elapsed)

    def _check_timing(self, lateness: float, missed_in_a_row: int) -> None:
        if lateness > MOST_LATE:
            late, most = 1e3 * lateness, 1e3 * MOST_LATE
            self._fail(
                f"a tick began {late:.1f} ms late, allowed: at most {most:.0f} ms; {_REMEDY}"
            )
        elif missed_in_a_row > MOST_MISSED:
            self._fail(
                f"{missed_in_a_row} deadlines missed in a row, allowed: at most {MOST_MISSED};"
                f" {_REMEDY}"
            )

    def _handle_operator(self, elapsed: float) -> None:
        """Handle buttons, requests to end, and the end of the duration."""
        for name in self._operator.buttons():
            if name in BUTTON_EVENTS:
                self._handle(BUTTON_EVENTS[name], f"asked to {name}")
        stop_requests = self._operator.stop_requests()
        if stop_requests > 1 and self.state not in _FAULT_STATES:
            self._failures.append(("stopped", "asked to stop at once"))
            self._fail("asked to stop at once")
        self._finishing |= stop_requests > 0 or elapsed >= self._operator.duration

    def _read_source(self, elapsed: float) -> None:
        """Read the source; a vehicle that fails ends the run as the end of its flight does."""
        try:
            self.reading = self._source.read(elapsed, self.state is State.RUNNING)
        except VehicleError as error:
            self._failures.append(("vehicle_failed", str(error)))
            self._finishing = True
        else:
            self._dropped += self.reading.dropped
        self._vehicle = self.reading.vehicle or self._vehicle
        self._finishing |= self.reading.over

    def _start_engaging(self, elapsed: float) -> None:
        """Start to blend to the cue, once the input has been good for long enough."""
        waiting = self.state is State.ENGAGING and not self._platform.tracking
        wanted = GOOD_TO_ENGAGE if self._platform.needs_cueing else 0.0
        if waiting and self.reading.vehicle and self._monitor.good_for(elapsed) >= wanted:
            self._platform.start_engaging(self._vehicle)

    def _fail(self, reason: str) -> None:
        """Raise a fault, unless there is one already."""
        if self.state in _FAULT_STATES:
            return
        self._faults += 1
        self._failures.append(("fault", reason))
        self._handle(Event.FAULT, reason)

    def _handle(self, event: Event, reason: str) -> None:
        """Take one event to monitor, source and state machine; note a change of state."""
        if event is Event.ENGAGE:
            self._monitor.held = False
            self._source.pin()
        elif event is Event.HOLD:
            self._monitor.held = True
        if not self._platform.handle(event):
            return
        self._changes.append((self.state, reason))
        if event is Event.RESET:
            self._guard.start(standstill(self._last_motion))
        if not self._operator.attended and self.state in _REST_STATES and not self._finishing:
            self._failures.append(("input_lost", "parked, since the input was lost"))
            self._finishing = True
