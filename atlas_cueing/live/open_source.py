"""Opens the source that a scenario names."""

from ..scenario import RecordedFlight, Scenario
from ..vehicles import FlightgearFlight, JsbsimVehicle, SignalFlight, SignalVehicle
from .input import FlightgearSource, Source, UdpReceiver, VehicleSource


def open_source(scenario: Scenario) -> Source:
    """Open a new source, ready to be read; close it after use.

    Raises InputError for what cannot fly (a model, log or port that is not available), LogError for
    a damaged log, and VehicleError for a model that fails in its first state.
    """
    flight = scenario.live_flight
    match flight:
        case FlightgearFlight():
            return FlightgearSource(UdpReceiver(flight.host, flight.port), flight.rate_hz)
        case RecordedFlight():
            return VehicleSource(flight.vehicle())
        case SignalFlight():
            return VehicleSource(SignalVehicle(flight))
        case _:
            with scenario.naming_file():
                return VehicleSource(JsbsimVehicle(flight))
