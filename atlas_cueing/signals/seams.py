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
        """State at the present time; the first one has time 0."""

    def advance(self) -> bool:
        """Go one step on; False when the flight is over.

        Raises VehicleError when the model fails.
        """


class WheelDrive(Protocol):
    """Whatever turns an allowed motion into wheel speeds."""

    def speeds(self, motion: Motion) -> WheelSpeeds:
        """Wheel speeds and accelerations for this motion."""


class Sink(Protocol):
    """Whatever keeps the ticks."""

    def append(self, tick: Tick) -> None:
        """Keep one tick; times strictly increase."""

    def status(self, time: float, state: str, reason: str) -> None:
        """Keep a change of state at `time` (s)."""

    def close(self, result: str, reason: str) -> None:
        """Finish: nothing comes after it."""
