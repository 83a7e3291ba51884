"""A vehicle that does what a test wants."""

from collections.abc import Callable
from pathlib import Path

from atlas_cueing.recording import read_log
from atlas_cueing.rotation import IDENTITY, Quat, Vec3
from atlas_cueing.signals import STANDARD_GRAVITY, VehicleState

Event = Callable[[int], None]

DT = 0.01


class Double:
    """A vehicle at rest for `ticks` steps, in whatever attitude.

    `event` is called at each step with its number.
    """

    def __init__(
        self,
        ticks: int = 100,
        event: Event = lambda _: None,
        attitude: Callable[[int], Quat] = lambda _: IDENTITY,
    ) -> None:
        self._ticks, self._event, self._attitude = ticks, event, attitude
        self._tick = 0
        self.rate: Vec3 = (0.0, 0.0, 0.0)

    @property
    def dt(self) -> float:
        return DT

    @property
    def state(self) -> VehicleState:
        return VehicleState(
            self._tick * DT, self._attitude(self._tick), self.rate, (0.0, 0.0, -STANDARD_GRAVITY)
        )

    def advance(self) -> bool:
        self._tick += 1
        self._event(self._tick)
        return self._tick <= self._ticks


def raising(error: BaseException, at: int) -> Event:
    def event(tick: int) -> None:
        if tick == at:
            raise error

    return event


def states(log: Path) -> list[tuple[float, str]]:
    return [(round(status.time, 9), status.state) for status in read_log(log).statuses]
