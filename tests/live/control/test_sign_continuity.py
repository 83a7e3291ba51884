"""The one place that chooses the signs of quaternions in a live run."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from atlas_cueing.live.control.sign_continuity import SignContinuity
from atlas_cueing.live.input.source import no_vehicle
from atlas_cueing.rotation import IDENTITY, ZERO, Quat, exp
from atlas_cueing.signals import Cue

TURNS = [exp((0.3 * k, 0.1 * k, -0.2 * k)) for k in range(40)]  # more than two turns


def flipped(q: Quat, k: int) -> Quat:
    """The other sign of every third one, and of two in a row now and then."""
    w, x, y, z = q
    return (-w, -x, -y, -z) if k % 3 == 0 or k % 7 == 1 else q


def dots(quaternions: list[Quat]) -> list[float]:
    return [float(np.dot(a, b)) for a, b in pairwise(quaternions)]


def test_any_signs_of_the_vehicle_become_one_that_goes_on() -> None:
    signs = SignContinuity(IDENTITY)
    states = [replace(no_vehicle(k), q_NB=flipped(q, k)) for k, q in enumerate(TURNS)]
    got = [signs.vehicle(state) for state in states]
    assert min(dots([state.q_NB for state in got])) > 0.9
    assert got[0].q_NB[0] > 0.0, "from a level vehicle on"
    assert [replace(a, q_NB=b.q_NB) for a, b in zip(got, states, strict=True)] == states


def test_any_signs_of_the_cue_become_one_that_goes_on() -> None:
    signs = SignContinuity((-1.0, 0.0, 0.0, 0.0))
    cues = [Cue(k, flipped(q, k), ZERO, ZERO, ZERO, ZERO) for k, q in enumerate(TURNS)]
    got = [signs.cue(cue) for cue in cues]
    assert min(dots([cue.q_WS for cue in got])) > 0.9
    assert got[0].q_WS[0] < 0.0, "from the given orientation on"


def test_asking_twice_in_a_tick_changes_nothing() -> None:
    signs = SignContinuity(IDENTITY)
    state = replace(no_vehicle(0.0), q_NB=(-1.0, 0.0, 0.0, 0.0))
    assert signs.vehicle(state) == signs.vehicle(state) == no_vehicle(0.0)
