"""The source of a live run, read once a tick for as long as it does not fail."""

# mypyc: runs every tick

from ...signals import VehicleState
from ..input.source import Source, SourceReading, no_vehicle


class VehicleInput:
    """Reads a source, and keeps what is known of its vehicle.

    reading: what the source reported in the last tick.
    vehicle: as last known.
    heard: there has been a good sample.
    dropped: number of samples that the source refused up to now.
    """

    def __init__(self, source: Source) -> None:
        """Set up before the first reading."""
        self._source = source
        self._failed = self.heard = False
        self.vehicle = no_vehicle(0.0)
        self.dropped = 0
        self.reading = SourceReading(None, float("inf"), 0, 0, False, False, "")

    @property
    def absence(self) -> str:
        """Why there is no input, in words."""
        reading = self.reading
        return f"no good input: {reading.remark or reading.reason or 'nothing came'}"

    def vehicle_at(self, time: float) -> VehicleState:
        """Return the vehicle as last known, with this time (s)."""
        v = self.vehicle
        return v if v.time == time else VehicleState(time, v.q_NB, v.w_NB_B, v.f_B)

    def prepare(self, time: float) -> None:
        """Have the source do now what it can of a read at `time` (s)."""
        if not self._failed:
            self._source.prepare(time)

    def read(self, time: float, advance: bool) -> bool:
        """Read what there is at `time` (s); return whether the flight is over.

        advance: let a source go on that has a time of its own.

        What the source raises goes on; then it is not asked again.
        """
        if self._failed:
            return False
        try:
            self.reading = self._source.read(time, advance)
        except BaseException:
            self._failed = True
            raise
        self.dropped += self.reading.dropped
        self.heard |= self.reading.vehicle is not None
        self.vehicle = self.reading.vehicle or self.vehicle
        return self.reading.over
