"""The source for a vehicle that owns its time, as JSBSim, test signals, or a recording."""

# mypyc: runs every tick

from ...rotation import ZERO
from ...signals import Vehicle, VehicleState
from .discontinuity import discontinuity
from .interpolation import Interpolation
from .source import SourceReading

# of the model in one read: 50 ms at 1000 Hz, about a millisecond of JSBSim (assumed)
MAX_STEPS = 50


class VehicleSource:
    """Reads a vehicle at any time between its steps, without delay.

    The model is stepped just past the time of the read. The vehicle's time begins at 0 with the
    first read and goes on with the clock, but for reads that do not advance: then the vehicle
    stands still, with its attitude and force and no rates. So it does after its last state. A model
    too slow for the clock, or a gap between two reads, costs at most MAX_STEPS steps a read; what
    is left over is not made up for, and the vehicle's time falls behind.

    A step that the next read will need can be made before it, when there is time (`prepare`).

    A jump between two steps is not interpolated: its end is returned as soon as it has begun.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self._now: float | None = None  # the loop's time
        self._start = vehicle.state.time
        self._elapsed = 0.0  # of the vehicle's own time
        self._next = vehicle.state
        self._between: Interpolation | None = None  # none across a jump, and before the first step
        # what the step made ahead has returned or raised; None when there is none
        self._ahead: bool | None = None
        self._failure: BaseException | None = None
        self._over = False
        self._jump = ""

    def read(self, time: float, advance: bool) -> SourceReading:
        """Read the state at `time` (s), see `Source`.

        Raises what the vehicle raises, when it is stepped past its last good state.
        """
        self._jump = ""
        if advance and not self._over:
            self._elapsed += 0.0 if self._now is None else time - self._now
            self._follow(self._start + self._elapsed)
        self._now = time
        state = self._at(self._start + self._elapsed, time)
        if self._over or not advance:
            state = VehicleState(state.time, state.q_NB, ZERO, state.f_B)
        return SourceReading(state, 0.0, 0, 0, bool(self._jump), self._over, self._jump)

    def prepare(self, time: float) -> None:
        """Make a step ahead, if a read at `time` (s) that advances will need one."""
        if self._over or self._now is None or self._ahead is not None:
            return
        if self._next.time > self._start + self._elapsed + time - self._now:
            return
        try:
            self._ahead = self._vehicle.advance()
        except BaseException as error:  # noqa: BLE001 - raised by the read that needs the step
            self._ahead, self._failure = False, error

    def pin(self) -> None:
        """Do nothing: there is only one sender."""

    def release(self) -> None:
        """Do nothing: there is only one sender."""

    def close(self) -> None:
        """Do nothing: there is nothing to release."""

    def _follow(self, time: float) -> None:
        """Step the vehicle until `time` (its own) lies between its last two states."""
        for _ in range(MAX_STEPS):
            if self._next.time > time:
                return
            if not self._advance():
                self._over = True
                self._elapsed = self._next.time - self._start
                return
            self._step(self._vehicle.state)
        self._elapsed = min(self._elapsed, self._next.time - self._start)

    def _advance(self) -> bool:
        """Step the vehicle, or take the step that was made ahead."""
        if self._ahead is None:
            return self._vehicle.advance()
        ahead, failure = self._ahead, self._failure
        self._ahead = self._failure = None
        if failure is not None:
            raise failure
        return ahead

    def _step(self, state: VehicleState) -> None:
        jump = discontinuity(self._next, state)
        self._between = None if jump else Interpolation(self._next, state)
        self._next = state
        self._jump = jump or self._jump

    def _at(self, time: float, called: float) -> VehicleState:
        if self._between:
            return self._between.at(time, called)
        state = self._next
        return VehicleState(called, state.q_NB, state.w_NB_B, state.f_B)
