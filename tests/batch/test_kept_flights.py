"""Flights that a worker keeps: in bounded memory; the one asked for longest ago goes first."""

from atlas_cueing.batch.kept_flights import CAPACITY, KeptFlights
from atlas_cueing.vehicles import KeptFlight


def flight(size: int) -> KeptFlight:
    """A flight of `size` bytes."""
    return KeptFlight(0.1, bytes(size))


def test_what_was_not_asked_for_the_longest_goes_first() -> None:
    flights, long = KeptFlights(300), [flight(100) for _ in range(4)]
    for name, each in zip("abc", long, strict=False):
        flights.put(name, each)
    assert flights.get("a") is long[0]
    flights.put("d", long[3])
    assert flights.get("b") is None
    assert [flights.get(name) for name in "acd"] == [long[0], long[2], long[3]]


def test_memory_is_bounded_by_several_long_flights() -> None:
    flights = KeptFlights(1000)
    for k in range(50):
        flights.put(f"{k}", flight(100 + 17 * k))
        assert flights.get(f"{k}")
        assert flights.size <= 1000
    flights.put("large", flight(1001))
    assert flights.get("large") is None
    assert flights.get("49")  # it took nobody's place
    flights.put("49", flight(1000))
    assert flights.size == 1000
    assert CAPACITY <= 100e6  # README: at most 64 MB
