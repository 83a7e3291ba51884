"""Recorded data of others, brought into a log that this program plays.

A file of any format becomes columns (`readers`), a map says what they are (`flight_map`), their
stamps are put in order (`stamps`) and brought onto an even grid (`grid`, `spline_fit`), axes and
units become ours (`axes`, `column_units`), and an attitude is made where there is none
(`complementary_filter`). What comes out is a flight (`gridded_flight`) in a log of its own.
"""

from .flight_map import FlightMap
from .gridded_flight import GriddedFlight
from .import_flight import ImportedFlights, import_flight
from .load_map import known_maps, load_map
from .write_flight import metadata_of, write_flight

__all__ = [
    "FlightMap",
    "GriddedFlight",
    "ImportedFlights",
    "import_flight",
    "known_maps",
    "load_map",
    "metadata_of",
    "write_flight",
]
