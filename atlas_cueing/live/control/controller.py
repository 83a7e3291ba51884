"""One tick of a live run, whatever happens: what is seen, what follows from it, what is flown, and what goes to the drives."""

# mypyc: runs every tick

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from ...errors import VehicleError
from ...rotation import continuous
from ...signals import Tick, VehicleState
from ..input.source import Source, SourceReading
from .guard import Command, Guard
from .input_monitor import GOOD_TO_ENGAGE, InputMonitor
from .platform_controller import PlatformController, command_of, no_vehicle, standing
from .state_machine import Event, State

MOST_MISSED = 5  # deadlines in a row; with one more the platform is stopped
MOST_LATE = 0.020  # s that a tick may be late
_REMEDY = "what helps: --priority, a lower --rate, fewer programs beside it"

_ASKED = {"engage": Event.ENGAGE, "hold": Event.HOLD, "park": Event.PARK, "reset": Event.RESET}
_FAULT = (State.FAULT_STOPPING, State.STOPPED)
_AWAY = (State.ENGAGING, State.RUNNING, State.HOLDING)


@dataclass(frozen=True, slots=True)
class OperatorInputs:
    """What is asked from outside.

    buttons: what the operator has pressed since the last call: engage, hold, park, reset.
    signals: how often the process has been asked to end; the first parks, the second stops at once.
    duration: s of real time until the platform parks by itself.
    attended: somebody can engage and reset; otherwise the run engages by itself and is over when it
        has parked or stopped.
    """

    buttons: Callable[[], Iterable[str]] = tuple
    signals: Callable[[], int] = int
    duration: float = float("inf")
    attended: bool = False


@dataclass(slots=True)
class RunOutcome:
    """How a run ended: result is ok, vehicle_failed, input_lost, fault or stopped.

    `faults` and `dropped` samples counted.
    """

    result: str = "ok"
    reason: str = ""
    faults: int = 0
    dropped: int = 0

    def because(self, result: str, reason: str) -> None:
        """Keep the first thing that went wrong."""
        if self.result == "ok":
            self.result, self.reason = result, reason


class LiveController:
    """Holds ride, guard and source together.

    `tick` never raises, and every command is inside every limit.
    """

    def __init__(
        self, ride: PlatformController, guard: Guard, source: Source, wishes: OperatorInputs
    ) -> None:
        """Parked, with nothing heard of the vehicle yet."""
        self._ride, self._guard, self._source, self._wishes = ride, guard, source, wishes
        self._supervisor = InputMonitor()
        self._finishing = False
        self._before = ride.motion  # of the last command that went out
        self._known = no_vehicle(0.0)  # as in the last tick
        self.intake = SourceReading(None, float("inf"), 0, 0, False, False, "")
        self.changes: list[tuple[State, str]] = [(State.PARKED, "")]  # not told yet
        self.ended = RunOutcome()

    @property
    def state(self) -> State:
        """The state the platform is in."""
        return self._ride.state

    @property
    def over(self) -> bool:
        """Nothing will move any more."""
        return self.state in (State.PARKED, State.STOPPED) and self._finishing

    def engage(self) -> None:
        """As if the operator had pressed it."""
        self._supervisor.held = False
        self._source.pin()
        self._take(Event.ENGAGE, "asked to engage")

    def tick(
        self, time: float, elapsed: float, lateness: float, missed_in_a_row: int
    ) -> tuple[Tick, Command]:
        """The next tick, at `time` of the platform and `elapsed` of the clock (s), that began `lateness` s too late."""
        tick, vehicle = None, replace(self._known, time=time)
        try:
            self._judge(elapsed)
            self._judge_punctuality(lateness, missed_in_a_row)
            vehicle = self._known = self._vehicle(time)
            tick = None if self.state in _FAULT else self._ride.step(vehicle)
        except Exception as error:  # noqa: BLE001
            # Whatever went wrong, the platform must come to a stop
            self._fail(f"{type(error).__name__}: {error}")
        command = self._guard.check(command_of(tick)) if tick else self._guard.stop(time)
        if tick is None or self._guard.stopping:
            self._fail(self._guard.reason)
            tick = self._ride.stopping(self._before, vehicle, command)
        self._before = tick.motion
        return tick, command

    def _judge(self, elapsed: float) -> None:
        """Everything that may change the state.

        Arrivals first, since a source that raises keeps the rest from happening.
        """
        if self._ride.arrived():
            self._take(Event.ARRIVED, "")
        self._listen(elapsed)
        self._read(elapsed)
        for event, reason in self._supervisor.watch(
            elapsed, self.state, self._ride.moving, self.intake
        ):
            self._take(event, reason)
        if self._finishing and self.state in _AWAY:
            self._take(Event.PARK, "the run is over")
        self._set_out(elapsed)

    def _judge_punctuality(self, lateness: float, missed_in_a_row: int) -> None:
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

    def _listen(self, elapsed: float) -> None:
        """To the operator, to signals, and to the clock."""
        for name in self._wishes.buttons():
            if name == "engage":
                self.engage()
            elif name in _ASKED:
                self._supervisor.held |= name == "hold"
                self._take(_ASKED[name], f"asked to {name}")
        asked_to_end = self._wishes.signals()
        if asked_to_end > 1 and self.state not in _FAULT:
            self.ended.because("stopped", "asked to stop at once")
            self._fail("asked to stop at once")
        self._finishing |= asked_to_end > 0 or elapsed >= self._wishes.duration

    def _read(self, elapsed: float) -> None:
        """The vehicle; one that fails ends the run as its end does."""
        try:
            self.intake = self._source.read(elapsed, self.state is State.RUNNING)
            self.ended.dropped += self.intake.dropped
        except VehicleError as error:
            self.ended.because("vehicle_failed", str(error))
            self._finishing = True
        self._finishing |= self.intake.over

    def _set_out(self, elapsed: float) -> None:
        """Leave for the cue, as soon as the input has been good for long enough."""
        waiting = self.state is State.ENGAGING and not self._ride.blending
        enough = GOOD_TO_ENGAGE if self._ride.fresh else 0.0
        if waiting and self.intake.vehicle and self._supervisor.good_for(elapsed) >= enough:
            self._ride.begin(self.intake.vehicle)

    def _vehicle(self, time: float) -> VehicleState:
        """What is known of the vehicle, as at `time`.

        The first attitude takes the sign that goes on from none.
        """
        known = self.intake.vehicle or self._known
        return replace(known, time=time, q_NB=continuous(known.q_NB, self._known.q_NB))

    def _fail(self, reason: str) -> None:
        """Into the fault, if not there yet."""
        if self.state in _FAULT:
            return
        self.ended.faults += 1
        self.ended.because("fault", reason)
        self._take(Event.FAULT, reason)

    def _take(self, event: Event, reason: str) -> None:
        """One event; a change of state is to be told, and the end of an unattended run comes with standing still."""
        if not self._ride.handle(event):
            return
        self.changes.append((self.state, reason))
        if event is Event.RESET:
            self._guard.start(standing(self._before))
        if (
            not self._wishes.attended
            and self.state in (State.PARKED, State.STOPPED)
            and not self._finishing
        ):
            self.ended.because("input_lost", "parked, since the input was lost")
            self._finishing = True
