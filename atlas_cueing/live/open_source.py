"""Opens the source that a scenario names."""

from ..run import open_vehicle
from ..scenario import Scenario
from ..vehicles import FlightgearFlight
from .input import FlightgearSource, Source, UdpReceiver, VehicleSource


def open_source(scenario: Scenario) -> Source:
    """Open a new source, ready to be read; close it after use.

    Raises InputError for what cannot fly (a model, log or port that is not available, a damaged
    log), and VehicleError for a model that fails in its first state.
    """
    flight = scenario.live_flight
    if isinstance(flight, FlightgearFlight):
        return FlightgearSource(UdpReceiver(flight.host, flight.port), flight.rate_hz)
    return VehicleSource(open_vehicle(scenario, live=True))
