"""The outside seams: what the pipeline asks of the world around it."""

from typing import Protocol

from ..rotation import Mat3, Quat, Vec3
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


class ContactRows(Protocol):
    """What contacts and drives can give: rows A x <= b, scaled, with 0 on the row.

    x: accelerations of the wheels (rad/s^2) and of the stage (m/s^2, W); A and b change with
    orientation and rate, and the wheels' speeds (rad/s) have the rate in them.
    """

    @property
    def sphere_from_wheels(self) -> Mat3:
        """J: the sphere's rate (rad/s, W) from the wheels' speeds."""

    def excess(
        self, q_WS: Quat, wheel_speed: Vec3, wheel_acceleration: Vec3, a_WS_W: Vec3
    ) -> float:
        """Give the largest A x - b of one state: above 0, something is asked that is not there."""

    def rows(self, q_WS: Quat, wheel_speed: Vec3, a_WS_W: Vec3) -> list[tuple[Vec3, float]]:
        """Give (row, bound) in the accelerations of the wheels alone, for this stage's."""

    def largest_excess(
        self, lowest: Vec3, highest: Vec3, speed: Vec3, a_lowest: Vec3, a_highest: Vec3
    ) -> float:
        """Give a bound on the excess in ANY orientation.

        lowest, highest: of the wheels' accelerations; speed: largest of each wheel, either way;
        a_lowest, a_highest: of the stage's acceleration.
        """

    def shortfall(self, q_WS: Quat) -> str:
        """Say in numbers what a rest in this orientation asks too much; empty if nothing."""


class Sink(Protocol):
    """The recorder of a run's ticks."""

    def append(self, tick: Tick) -> None:
        """Record one tick; times strictly increase."""

    def status(self, time: float, state: str, reason: str) -> None:
        """Record a change of state at `time` (s)."""

    def close(self, result: str, reason: str) -> None:
        """Finish: nothing comes after it."""
