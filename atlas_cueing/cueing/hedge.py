"""Method `hedge`: several methods run beside each other, and the cabin keeps with the best of late.

No single law is good everywhere: `force` wins in aerobatics, `perceptual` in ordinary and rough
flight, a cabin that stands `still` where force and rates contradict each other, and `blend` where
rates are all that counts. What each would lose is known as it happens (`committee.loss`), and the
committee loses not much more than the best of them does, whatever the flight (`committee.weights`).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..signals import VehicleState
from .blend import BlendParameters
from .committee.committee import COMMITTEE, Committee, CommitteeParameters
from .felt_turn import FELT_BOUND_KEYS, FELT_TURN
from .force import ForceParameters
from .look_ahead import LOOK_AHEAD
from .method import LookAheadParameters, Method, RotationParameters, rotation_of
from .parameter import Choice, Parameter, Range
from .perceptual import PerceptualParameters
from .stage.stage_parameters import GAIN
from .still import StillParameters
from .tilt import hold_of


@dataclass(frozen=True, slots=True)
class HedgeParameters:
    """Parameters of `hedge`; METHOD says what each is.

    committee: what all members share, and how they are judged and followed.
    look_ahead: of the member `perceptual`, s.
    """

    committee: CommitteeParameters = COMMITTEE
    look_ahead: float = 0.0

    def rotation(self, dt: float, flight: Sequence[VehicleState] = ()) -> Committee:
        """Make the rotation that begins at the first state.

        Args:
            dt: tick, s.
            flight: every state of the flight, dt apart; it may be empty without look-ahead.

        Raises InputError for look-ahead without a flight.

        """
        laws = [rotation_of(law, dt, flight) for law in self.members()]
        return Committee(dt, laws, self.committee)

    def members(self) -> Sequence[RotationParameters | LookAheadParameters]:
        """Give the laws that are asked; the first is trusted at the start.

        They have their own defaults but for the gain, the hold, and what is said of canals and of
        lasting rates.
        """
        gain, hold, turn = self.committee.rotation_gain, self.committee.hold, self.committee.turn
        own = replace(FELT_TURN, canals=turn.canals, lasting=turn.lasting)
        return (
            PerceptualParameters(
                rotation_gain=gain, hold=hold, turn=own, look_ahead=self.look_ahead
            ),
            ForceParameters(rotation_gain=gain, hold=hold),
            StillParameters(),
            BlendParameters(rotation_gain=gain, hold=hold),
        )


METHOD = Method(
    "hedge",
    "runs perceptual, force, still and blend beside each other and keeps with the best of late",
    HedgeParameters(),
    (
        Parameter(
            "rotation_gain",
            "committee.rotation_gain",
            GAIN,
            "factor on the vehicle's rates about the cabin's x, y, z",
            "one to one",
        ),
        Parameter(
            "contrast",
            "committee.weights.contrast",
            Range(0.0, 100.0),
            "how much a loss that is larger by its own size costs a member, in nepers of its share",
            "found; 1 to 10 made no difference",
        ),
        Parameter(
            "floor",
            "committee.weights.floor",
            Range(0.01, 1e6),
            "losses below this are all alike; 1 is one just noticeable error",
            "found; 1 to 4 made no difference",
        ),
        Parameter(
            "start",
            "committee.weights.start",
            Range(0.0, 1e6),
            "loss that all but perceptual begin with",
            "assumed: perceptual alone for some seconds",
        ),
        Parameter(
            "judge",
            "committee.loss.judge",
            Choice(("observer", "organs")),
            "who tells the loss: organs alone, or half of it an observer of tilt and turn",
            "found",
        ),
        Parameter(
            "memory_s",
            "committee.weights.memory",
            Range(0.01, 1e4),
            "time constant with which losses are forgotten",
            "found; 3 to 8 made no difference",
        ),
        Parameter(
            "force_unit_m_s2",
            "committee.loss.force_unit",
            Range(0.01, 100.0),
            "error of specific force across itself that counts as one",
            "what a pilot begins to notice (Reid & Nahon, UTIAS Report 296, 1985)",
        ),
        Parameter(
            "rate_unit_deg_s",
            "committee.loss.rate_unit",
            Range(0.01, 90.0),
            "error of felt angular rate that counts as one",
            "3 deg/s / sqrt(3): the same report, and a false turn counts three times",
        ),
        Parameter(
            "tilt_unit_deg",
            "committee.loss.tilt_unit",
            Range(0.01, 90.0),
            "error of perceived tilt that counts as one",
            "the force unit in gravity",
        ),
        Parameter(
            "response_rad_s",
            "committee.turn.response",
            Range(0.01, 10.0),
            "felt rate with which the cabin turns to the members' mean, for each rad away from it",
            "found",
        ),
        Parameter(
            "lasting_s",
            "committee.turn.lasting",
            Range(0.01, 1e6),
            "time constant with which perceptual expects the rate with the force to decay",
            "found",
        ),
        *(replace(key, field=f"committee.{key.field}") for key in FELT_BOUND_KEYS),
        replace(LOOK_AHEAD, description=f"of perceptual: {LOOK_AHEAD.description}"),
        hold_of("committee.hold"),
    ),
)
