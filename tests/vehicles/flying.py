"""Flights for the tests of this folder."""

import warnings
from pathlib import Path

import jsbsim
import numpy as np
from numpy.typing import NDArray

from atlas_cueing.signals import Vehicle, VehicleState
from atlas_cueing.vehicles import AircraftFlight, InitialConditions, LimitedDuration, TimedInput

CRUISE = InitialConditions(altitude=1500.0, airspeed=55.0, trim=True)


def cessna(*inputs: TimedInput, initial: InitialConditions = CRUISE) -> AircraftFlight:
    """A Cessna 172 in level flight, with timed inputs."""
    return AircraftFlight("c172x", initial, inputs)


def fly(vehicle: Vehicle, duration: float = 2.0) -> list[VehicleState]:
    """All states of a flight, which is over after `duration` s at the latest."""
    vehicle = LimitedDuration(vehicle, duration)
    states = [vehicle.state]
    while vehicle.advance():
        states.append(vehicle.state)
    return states


def write_script(
    path: Path,
    events: str = "",
    extra: str = "",
    aircraft: str = "c172x",
    initialize: str = "reset01",
) -> Path:
    """A JSBSim script of 2 s at 100 Hz with these events, and elements beside its run."""
    path.write_text(
        f'<runscript name="test"><use aircraft="{aircraft}" initialize="{initialize}"/>{extra}'
        f'<run start="0" end="2" dt="0.01">{events}</run></runscript>'
    )
    return path


def event(name: str, value: str, time: float = 0.5) -> str:
    """A script's event that sets a property at `time` (s) to a number or a function's value."""
    inside = (
        f' value="{value}"/>'
        if not value.startswith("<")
        else f"><function>{value}</function></set>"
    )
    return (
        f'<event name="e"><condition>simulation/sim-time-sec ge {time}</condition><set'
        f' name="{name}"{inside}<notify/></event>'
    )


def body_from_north(fdm: jsbsim.FGFDMExec) -> NDArray[np.float64]:
    """JSBSim's own matrix of attitude, from north-east-down to body axes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PendingDeprecationWarning)  # of numpy.matrix
        return np.asarray(fdm.get_propagate().get_Tl2b())
