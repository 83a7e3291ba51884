"""Opens the source that a scenario names."""

from ipaddress import AddressValueError, IPv4Address

from ..errors import InputError
from ..run import open_vehicle
from ..scenario import Scenario
from ..vehicles import Bounds, FlightgearFlight, PacketFlight
from ..vehicles.flightgear import decode
from ..vehicles.packets import LONGEST_KEY, SHORTEST_KEY, Stream
from .input import PacketSource, PacketStream, Source, UdpReceiver, VehicleSource
from .input.packet_source import Decode
from .input.shared_key import read_key


def open_source(scenario: Scenario, listen: str | None = None) -> Source:
    """Open a new source, ready to be read; close it after use.

    listen: numeric IPv4 address of this machine that packets come to, in the place of the
    scenario's; 0.0.0.0 for all of them.

    Raises InputError for what cannot fly (a model, log, key or port that is not available, a
    damaged log, an address for a source without packets), and VehicleError for a model that fails
    in its first state.
    """
    flight = scenario.live_flight
    if isinstance(flight, FlightgearFlight | PacketFlight):
        return _of_packets(flight, _address(listen) if listen is not None else flight.host)
    if listen is not None:
        raise InputError(
            "--listen is for packets: source = 'flightgear' or 'packets', not for"
            f" {scenario.file.vehicle.source!r}"
        )
    return VehicleSource(open_vehicle(scenario, live=True))


def _of_packets(flight: FlightgearFlight | PacketFlight, host: str) -> PacketSource:
    place = f"UDP {host}:{flight.port}"
    if isinstance(flight, FlightgearFlight):
        stream = flightgear_stream(place, flight.rate_hz, flight.hold_after)
    else:
        decode = _own_packets(flight)
        stream = PacketStream(decode, place, flight.rate_hz, flight.hold_after)
    return PacketSource(UdpReceiver(host, flight.port), stream)


def flightgear_stream(place: str, rate_hz: float, hold_after: float) -> PacketStream:
    """Return what is known of FlightGear's packets, see PacketStream."""
    bounds = Bounds()
    return PacketStream(
        lambda content, arrival: (decode(content, arrival, bounds), None),
        place,
        rate_hz,
        hold_after,
    )


def _own_packets(flight: PacketFlight) -> Decode:
    if flight.key_file is None:
        return Stream(Bounds()).decode
    named = f"vehicle.key_file = {str(flight.key_file)!r}"
    key = read_key(flight.key_file, named)
    if not SHORTEST_KEY <= len(key) <= LONGEST_KEY:
        raise InputError(
            f"{named}: key of {len(key)} bytes, allowed: {SHORTEST_KEY} <= bytes <= {LONGEST_KEY}"
        )
    return Stream(Bounds(), key).decode


def _address(text: str) -> str:
    try:
        address = IPv4Address(text)
    except AddressValueError as error:
        raise InputError(
            f"--listen {text}: allowed: a numeric IPv4 address of this machine, or 0.0.0.0"
        ) from error
    if address.is_multicast:
        raise InputError(f"--listen {text}: allowed: the address of one machine, or 0.0.0.0")
    return str(address)
