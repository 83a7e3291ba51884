"""JSBSim as a vehicle."""

# mypyc: runs every tick

from math import inf

from ...errors import VehicleError
from ...signals import VehicleState
from ..bounds import Bounds
from .flights import AircraftFlight, ScriptFlight
from .inputs import InputPlayer
from .library import JSBSIM_ERRORS, one_line
from .loading import load
from .readings import Readings
from .start import initialise, start_aircraft

MOST_RESETS = 10  # of a script, so that it ends; of JSBSim's own one script resets, once (assumed)


class JsbsimVehicle:
    """A flight in JSBSim, one state a step, the first at time 0.

    Built and advanced in one thread (JSBSim logs per thread).

    Time is the number of steps times dt, whatever the script does to JSBSim's own clock. A script
    that trims or resets in mid-run makes the attitude jump; nothing is smoothed here. One that
    resets again and again, so that its end never comes, fails.

    Building it raises InputError for what can never fly (it does not load, unknown property, bad
    number, no trim, a start in the ground) and VehicleError at time 0 for a first state out of
    bounds.
    """

    def __init__(self, flight: ScriptFlight | AircraftFlight, bounds: Bounds | None = None) -> None:
        self._bounds = Bounds() if bounds is None else bounds
        self._fdm = load(flight)
        self._dt = self._fdm.get_delta_t()
        self._step = 0
        self._resets_left: float = MOST_RESETS if isinstance(flight, ScriptFlight) else inf
        self._inputs = InputPlayer((), self._fdm)
        if isinstance(flight, ScriptFlight):
            initialise(self._fdm)
        else:
            self._inputs = start_aircraft(self._fdm, flight)
        self._readings = Readings(self._fdm)
        self._state = self._read(0)

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._dt

    @property
    def state(self) -> VehicleState:
        """The present state; the last good one after a failure."""
        return self._state

    def advance(self) -> bool:
        """Go one step on; False at the end of the script.

        Raises VehicleError, with `state` left at the last good one, when JSBSim fails or its state
        is out of bounds.
        """
        self._inputs.play(self._step * self._dt)
        running = self._run((self._step + 1) * self._dt)
        if running:
            self._state = self._read(self._step + 1)
            self._step += 1
        return running

    def _run(self, time: float) -> bool:
        """Let JSBSim step to `time`; False at the end of its script."""
        clock = self._fdm.get_sim_time()
        try:
            running = self._fdm.run()
        except JSBSIM_ERRORS as error:
            raise VehicleError(time, f"JSBSim: {one_line(error)}") from error
        if running and self._fdm.get_sim_time() <= clock:
            self._check_clock(clock, time)
        return running

    def _check_clock(self, before: float, time: float) -> None:
        """Count the steps of a script that stops or sets back the clock: it must end too."""
        if self._fdm.get_sim_time() == before:
            raise VehicleError(
                time, "JSBSim's clock stands still; a script that holds it never ends"
            )
        self._resets_left -= 1
        if self._resets_left < 0:
            back = f"has set JSBSim's clock back more than {MOST_RESETS} times (simulation/reset)"
            raise VehicleError(time, f"the script {back}, so its end never comes")

    def _read(self, step: int) -> VehicleState:
        """State after so many steps; VehicleError when it is out of bounds."""
        time = step * self._dt
        try:
            state = self._readings.state(time)
        except (ValueError, ZeroDivisionError) as error:
            raise VehicleError(time, f"attitude or gravity is not finite: {error}") from error
        objection = self._bounds.objection(state, self._readings.height())
        if objection:
            raise VehicleError(time, objection)
        return state
