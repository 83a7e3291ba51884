"""A member: what the canals of its rider feel of the turn that the vehicle does not make."""

from math import cos, sin
from math import exp as expm

import pytest

from atlas_cueing.cueing.committee.loss import LOSS
from atlas_cueing.cueing.committee.member import Member, Pilot
from atlas_cueing.rotation import Quat, Vec3, exp
from atlas_cueing.signals import VehicleState

from ..vehicles import LEVEL

W, CANALS = 0.9, 5.73  # rad/s, s


class Swinging:
    """A law that swings about the vertical at the rate sin(W t), from the first state on."""

    def __init__(self, dt: float) -> None:
        self._dt, self._tick = dt, -1

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:  # noqa: ARG002 - as every law
        self._tick += 1
        t = self._tick * self._dt
        return exp((0.0, 0.0, (1.0 - cos(W * t)) / W)), (0.0, 0.0, sin(W * t))


def error(dt: float) -> float:
    """Largest error of what is felt, rad/s, against the solution of z' = (w - z) / T from rest.

    z = a sin - b cos + b exp(-t / T), a = 1 / (1 + (W T)^2), b = W T a.
    """
    member = Member(dt, Swinging(dt), LOSS, CANALS, 1.5)
    pilot = Pilot(dt, (0.0, 0.0, 0.0), LEVEL)
    a = 1.0 / (1.0 + (W * CANALS) ** 2)
    b, largest = W * CANALS * a, 0.0
    for i in range(round(20.0 / dt)):
        t = i * dt
        member.step(VehicleState(t, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), LEVEL), pilot)
        used_to = a * sin(W * t) - b * cos(W * t) + b * expm(-t / CANALS)
        largest = max(largest, abs(member.felt[2] - (sin(W * t) - used_to)))
        assert member.felt[:2] == pytest.approx((0.0, 0.0), abs=1e-12)
    return largest


def test_the_canals_are_of_second_order_in_the_tick() -> None:
    coarse, fine = error(0.1), error(0.05)
    assert coarse < 2e-4
    assert coarse / fine == pytest.approx(4.0, rel=0.1)
