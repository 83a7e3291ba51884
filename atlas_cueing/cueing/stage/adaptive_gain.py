"""The adaptive gain of the stage: how much of what it could do would be of use."""

# mypyc: runs every tick

from math import exp


class AdaptiveGain:
    """Share g, 0 to 1, of an imagined motion that would have left the least rms error lately.

    A demand d that is met by g times the acceleration a of an imagined stage leaves an error of
    mean square <d^2> - 2 g <d a> + g^2 <a^2>, least at g = <d a> / <a^2>. Where the demand lasts,
    what a stage gives now it takes back later with nothing gained, <d a> is small, and so is g: the
    lasting part belongs to the turn of the cabin. The idea of adapting a washout's gains to what
    they are good for is that of R. V. Parrish, J. E. Dieudonne, R. L. Bowles & D. J. Martin,
    "Coordinated Adaptive Washout for Motion Simulators", Journal of Aircraft 12(1), 1975; theirs
    follow a gradient.
    """

    def __init__(self, dt: float, memory: float, first: float, doubt: float) -> None:
        """Begin with the share `first`; ticks of dt (s) count for `memory` (s).

        The first share counts as much as experience with <a^2> = doubt (m^2/s^4).
        """
        self._forget = 1.0 - exp(-dt / memory)
        self._first, self._doubt = first, doubt
        self._useful = self._spent = 0.0
        self.share = first

    def update(self, demand: float, imagined: float) -> None:
        """Take in one tick: the demand and the imagined acceleration, both m/s^2."""
        self._useful += self._forget * (demand * imagined - self._useful)
        self._spent += self._forget * (imagined * imagined - self._spent)
        best = (self._useful + self._first * self._doubt) / (self._spent + self._doubt)
        self.share = min(max(best, 0.0), 1.0)
