"""The flights that a worker keeps for the runs that follow, in bounded memory."""

from ..vehicles import KeptFlight

CAPACITY = 64 << 20  # bytes: an hour and three quarters at 120 Hz, or 12 minutes at 1 kHz


class KeptFlights:
    """Flights by what they are of; what was not asked for the longest goes first."""

    def __init__(self, capacity: int = CAPACITY) -> None:
        """Keep `capacity` bytes at most."""
        self.capacity = capacity
        self._flights: dict[str, KeptFlight] = {}  # the one used last comes last

    @property
    def size(self) -> int:
        """Bytes that are kept."""
        return sum(len(flight.rows) for flight in self._flights.values())

    def get(self, name: str) -> KeptFlight | None:
        """Give a flight; None when it is not there (any more)."""
        flight = self._flights.pop(name, None)
        if flight:
            self._flights[name] = flight
        return flight

    def put(self, name: str, flight: KeptFlight) -> None:
        """Keep a flight, and let others go as far as needed. One that is too large is not kept."""
        if len(flight.rows) > self.capacity:
            return
        self._flights.pop(name, None)
        while self.size + len(flight.rows) > self.capacity:
            del self._flights[next(iter(self._flights))]
        self._flights[name] = flight
