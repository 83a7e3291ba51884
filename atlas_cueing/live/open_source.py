"""Opens the source that a scenario names."""

from ..run import open_vehicle
from ..scenario import Scenario
from ..vehicles import Bounds, FlightgearFlight
from ..vehicles.flightgear import decode
from .input import PacketSource, PacketStream, Source, UdpReceiver, VehicleSource


def open_source(scenario: Scenario) -> Source:
    """Open a new source, ready to be read; close it after use.

    Raises InputError for what cannot fly (a model, log or port that is not available, a damaged
    log), and VehicleError for a model that fails in its first state.
    """
    flight = scenario.live_flight
    if isinstance(flight, FlightgearFlight):
        return _of_packets(flight)
    return VehicleSource(open_vehicle(scenario, live=True))


def _of_packets(flight: FlightgearFlight) -> PacketSource:
    receiver = UdpReceiver(flight.host, flight.port)
    place = f"UDP {flight.host}:{flight.port}"
    return PacketSource(receiver, flightgear_stream(place, flight.rate_hz, flight.hold_after))


def flightgear_stream(place: str, rate_hz: float, hold_after: float) -> PacketStream:
    """Return what is known of FlightGear's packets, see PacketStream."""
    bounds = Bounds()
    return PacketStream(
        lambda content, arrival: (decode(content, arrival, bounds), None),
        place,
        rate_hz,
        hold_after,
    )
