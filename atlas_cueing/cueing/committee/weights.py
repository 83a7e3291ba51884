"""Shares of the members by what they have lost of late.

Each member i has a loss of late S_i, the loss l_i through a low pass, and a share p_i:

    S_i' = (l_i - S_i) / tau,   p_i ~ exp(-eta S_i),   eta = c / (min S + s_0)

So shares change smoothly, and only the ratios of the losses count while they are above s_0. For a
constant eta (exponential weights; Cesa-Bianchi & Lugosi, Prediction, Learning, and Games, 2006,
chapter 2, with forgetting) the mean loss sum p_i l_i over a time D is at most

    mean l_j + (1 + tau / D) ln(N) / eta + S_j(0) tau / D

for ANY of the N members j and any losses: F = -ln(mean exp(-eta S_i)) / eta has F' = sum p_i S_i',
and min S <= F <= S_j + ln(N) / eta. It holds tick by tick as well, as each share is that of the S
that already knows the tick's loss (F is concave). With the eta above, sum p_i S_i is at any instant
at most min S + (min S + s_0) ln(N) / c.
"""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, expm1


@dataclass(frozen=True, slots=True)
class WeightParameters:
    """Memory tau, s; contrast c; floor s_0 and start S(0) of all but the first, losses."""

    memory: float = 5.0
    contrast: float = 2.0
    floor: float = 1.0
    start: float = 100.0


WEIGHTS = WeightParameters()


class Weights:
    """Losses of late of some members, and their shares, which sum to 1."""

    def __init__(self, dt: float, parameters: WeightParameters, start: Sequence[float]) -> None:
        """Begin with the losses `start`, one for each member; dt in s."""
        self._contrast, self._floor = parameters.contrast, parameters.floor
        self._new = -expm1(-dt / parameters.memory)
        self.late = [float(loss) for loss in start]
        self.shares = [0.0 for _ in start]
        self._share()

    def step(self, losses: list[float]) -> None:
        """Take in the losses of the next tick, one for each member, held all through it."""
        for i in range(len(self.late)):  # enumerate and zip make objects of every number
            late = self.late[i]
            self.late[i] = late + self._new * (losses[i] - late)
        self._share()

    def _share(self) -> None:
        least = self.late[0]
        for late in self.late:
            if late < least:
                least = late
        eta, whole = self._contrast / (least + self._floor), 0.0
        for i in range(len(self.late)):
            part = exp(-eta * (self.late[i] - least))
            self.shares[i] = part
            whole += part
        for i in range(len(self.late)):
            self.shares[i] /= whole
