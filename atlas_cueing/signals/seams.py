"""The outside seams: what the pipeline asks of the world around it."""

from typing import Protocol

from .states import Motion, Tick, VehicleState, WheelSpeeds


class Vehicle(Protocol):
    """A source of vehicle states at a fixed step."""

    @property
    def dt(self) -> float:
        """Time between two states, s."""

    @property
    def state(self) -> VehicleState:
        """Give the state at the present time; the first one has time 0."""

    def advance(self) -> bool:
        """Go one step on; False when the flight is over.

        Raises VehicleError when the model fails.
        """


class WheelDrive(Protocol):
    """The drive that turns an allowed motion into wheel speeds."""

    def speeds(self, motion: Motion) -> WheelSpeeds:
        """Give the wheel speeds and accelerations for this motion."""


class Sink(Protocol):
    """The recorder of a run's ticks."""

    def append(self, tick: Tick) -> None:
        """Record one tick; times strictly increase."""

    def status(self, time: float, state: str, reason: str) -> None:
        """Record a change of state at `time` (s)."""

    def close(self, result: str, reason: str) -> None:
        """Finish: nothing comes after it."""
