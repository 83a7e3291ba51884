"""What a vehicle that people ride in never does; beyond it the model has failed."""

# mypyc: runs every tick

from dataclasses import dataclass

from ..errors import AtlasError
from ..rotation import norm
from ..signals import VehicleState
from ..signals.felt import STANDARD_GRAVITY


class PacketError(AtlasError):
    """A packet is not one of a vehicle that people ride in; the text says why."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """Bounds of a believable state; a state outside, or with a NaN, ends the flight.

    force: specific force at the pilot's eye, m/s^2. 50 g: more than the 46 g that a rider has
        survived on a rocket sled (Stapp, 1954), less than any crash into the ground.
    rate: body rate, rad/s. Eight turns a second; fast jets roll at 6 rad/s and small quadrotors at
        some 20.
    depth: of the centre of gravity below the ground, m; deeper than any vehicle is high, so it went
        through.
    height: above the ground, m. Beyond the geostationary orbit (3.6e7 m), where nothing here is
        meant to fly.
    """

    force: float = 50.0 * STANDARD_GRAVITY
    rate: float = 50.0
    depth: float = 10.0
    height: float = 1e8

    def objection(self, state: VehicleState, height: float) -> str:
        """Why a state at `height` (m above ground) is not believable; empty when it is.

        NaN never is.
        """
        force, rate = norm(state.f_B), norm(state.w_NB_B)
        turn = state.q_NB[0] + state.q_NB[1] + state.q_NB[2] + state.q_NB[3]
        if (
            force <= self.force
            and rate <= self.rate
            and -self.depth <= height <= self.height
            and turn == turn
        ):
            return ""
        return self._reason(force, rate, height)

    def _reason(self, force: float, rate: float, height: float) -> str:
        """Name the first quantity that is outside its bounds."""
        if not force <= self.force:
            return f"specific force {force:.4g} m/s^2, allowed: 0 <= force <= {self.force:.4g}"
        if not rate <= self.rate:
            return f"body rate {rate:.4g} rad/s, allowed: 0 <= rate <= {self.rate:.4g}"
        if not -self.depth <= height <= self.height:
            return (
                f"height above ground {height:.4g} m, allowed: {-self.depth:.4g} <= height <="
                f" {self.height:.4g}"
            )
        return "attitude is not a number"
