"""What a rider of one cabin would miss of what the vehicle's pilot feels, at one instant.

With u the cabin's up, f the vehicle's specific force, d the cabin's rate beyond the vehicle's and y
what the canals feel of it (d = z + y, z' = y / T):

    organs    g |f| |u - f / |f||^2 / force_unit^2 + |y|^2 / rate_unit^2
    observer  tilt^2 / tilt_unit^2 + |turn|^2 / rate_unit^2

The first is the mismatch of force direction and rate as `evaluation` has it, with |f_r| = g: the
direction leg (|f_r - f_p| at equal lengths) and the rate leg, squared, for one instant. In the
second, tilt is the angle between what the observers of rider and pilot take for up, and turn the
difference of the rates that they perceive (`perception.observer`). The loss is half of each, or the
first alone. Below `hold` the force has no direction, and its term fades.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import radians

from ...perception import Observer
from ...rotation import Vec3, angle_between, dot, norm, scale, subtract
from ...signals import STANDARD_GRAVITY
from ..tilt import fade_in


@dataclass(frozen=True, slots=True)
class LossParameters:
    """Errors that weigh the same, m/s^2, rad/s and rad; judge: `observer` or `organs` alone."""

    force_unit: float = 0.17
    rate_unit: float = radians(1.732)
    tilt_unit: float = radians(1.0)
    judge: str = "organs"


LOSS = LossParameters()


def organs_loss(parameters: LossParameters, up: Vec3, felt: Vec3, f_S: Vec3, hold: float) -> float:
    """Give the loss as the organs have it.

    Args:
        parameters: the units.
        up: W's up in the cabin, a unit vector (S).
        felt: what the canals feel of the cabin's rate beyond the vehicle's, rad/s (S).
        f_S: the vehicle's specific force, m/s^2 (S).
        hold: the force's direction fades below twice this, m/s^2.

    """
    force = norm(f_S)
    there = fade_in(force, hold)
    loss = dot(felt, felt) / (parameters.rate_unit * parameters.rate_unit)
    if there == 0.0:
        return loss
    off = subtract(up, scale(1.0 / force, f_S))
    unit = parameters.force_unit * parameters.force_unit
    return loss + there * STANDARD_GRAVITY * force * dot(off, off) / unit


def observer_loss(parameters: LossParameters, rider: Observer, pilot: Observer) -> float:
    """Give the loss by what rider and pilot perceive."""
    tilt = angle_between(rider.up, pilot.up) / parameters.tilt_unit
    turn = norm(subtract(rider.rate, pilot.rate)) / parameters.rate_unit
    return tilt * tilt + turn * turn
