"""Look-ahead: the lasting rate is that of a later state, and nothing else is known beforehand."""

from dataclasses import replace
from math import radians

import pytest

from atlas_cueing.cueing import HedgeParameters, PerceptualParameters
from atlas_cueing.cueing.look_ahead import LookAhead
from atlas_cueing.cueing.perceptual import PerceptualRotation
from atlas_cueing.errors import InputError
from atlas_cueing.rotation import IDENTITY, ZERO, Quat, Vec3, angle_between, flip, norm
from atlas_cueing.signals import VehicleState

from .bilinear_canals import Canals
from .test_felt_turn import LAW
from .test_perceptual import extra_rate, mirrored
from .vehicles import LEVEL, level_turn, manoeuvring, standing, up_in_cabin
from .wild_rides import wild_states

DT, AHEAD = 0.02, 0.5
TICKS = 25
Parameters = PerceptualParameters | HedgeParameters
BOTH = pytest.mark.parametrize("parameters", [PerceptualParameters(), HedgeParameters()])


def cues(
    parameters: Parameters, flight: list[VehicleState], ahead: float = AHEAD, dt: float = DT
) -> list[tuple[Quat, Vec3]]:
    """The cues of a whole flight that is known."""
    rotation = replace(parameters, look_ahead=ahead).rotation(dt, flight)
    return [rotation.step(vehicle) for vehicle in flight]


def test_each_state_is_met_by_the_one_ahead_and_at_the_end_by_the_last() -> None:
    flight = list(standing(IDENTITY, LEVEL, 0.1, 6))
    ahead = LookAhead(0.1, 0.21, flight)
    assert list(ahead.passed()) == flight[1:3]
    assert [ahead.step(vehicle) for vehicle in flight[1:]] == [*flight[3:], *[flight[-1]] * 2]


def test_a_flight_shorter_than_the_look_ahead_is_known_to_its_end() -> None:
    flight = list(standing(IDENTITY, LEVEL, 0.1, 3))
    ahead = LookAhead(0.1, 5.0, flight)
    assert list(ahead.passed()) == flight[1:]
    assert [ahead.step(vehicle) for vehicle in flight[1:]] == [flight[-1]] * 2


@BOTH
def test_without_look_ahead_a_known_flight_changes_no_bit(parameters: Parameters) -> None:
    flight = list(manoeuvring(DT, 6.0))
    unknown = parameters.rotation(DT)
    assert cues(parameters, flight, 0.0) == [unknown.step(vehicle) for vehicle in flight]


@BOTH
@pytest.mark.parametrize("changed", [100, 101, 180])
def test_a_state_is_known_so_long_before_and_no_longer(
    parameters: Parameters, changed: int
) -> None:
    """The flights are the same before the state `changed`; the cues before it less look-ahead."""
    flight = list(manoeuvring(DT, 4.0))
    other = [
        replace(v, f_B=(v.f_B[0] + 3.0, *v.f_B[1:])) if i >= changed else v
        for i, v in enumerate(flight)
    ]
    one, two = cues(parameters, flight), cues(parameters, other)
    first = next(i for i, (a, b) in enumerate(zip(one, two, strict=True)) if a != b)
    assert first == changed - TICKS


@BOTH
def test_after_the_end_the_last_state_goes_on(parameters: Parameters) -> None:
    flight = list(manoeuvring(DT, 3.0))
    longer = [*flight, *[flight[-1]] * TICKS]
    assert cues(parameters, longer)[: len(flight)] == cues(parameters, flight)


@BOTH
def test_a_turn_that_is_known_begins_with_less_error(parameters: Parameters) -> None:
    """A coordinated turn out of straight flight, whose force swings to the side within 1 s."""
    turn = list(level_turn(radians(40.0), 60.0, DT, 400))
    straight = list(standing(IDENTITY, LEVEL, DT, 100))
    flight = [
        VehicleState(i * DT, v.q_NB, v.w_NB_B, (0.0, share * 6.0, v.f_B[2]))
        for i, v in enumerate([*straight, *turn])
        for share in [min(max((i - 100) * DT, 0.0), 1.0)]
    ]

    def worst(ahead: float) -> float:
        return max(
            angle_between(up_in_cabin(q_WS), flip(v.f_B))
            for (q_WS, _), v in zip(cues(parameters, flight, ahead), flight, strict=True)
        )

    assert worst(AHEAD) < 0.9 * worst(0.0)


@BOTH
def test_a_mirrored_flight_gives_the_mirrored_cue(parameters: Parameters) -> None:
    flight = list(manoeuvring(DT, 10.0))
    one, other = cues(parameters, flight), cues(parameters, list(mirrored(iter(flight))))
    for ((a, b, c, d), (p, q, r)), (q_WS, w) in zip(one, other, strict=True):
        assert q_WS == pytest.approx((a, -b, c, -d), abs=1e-9)
        assert w == pytest.approx((-p, q, -r), abs=1e-9)


def test_no_more_is_felt_than_the_bound_for_any_flight() -> None:
    """It is on the wish, whatever the lasting rate is."""
    dt = 1.0 / 120.0
    flight = list(wild_states(5, 6000, dt))
    canals, bound = Canals(dt), 0.0
    for vehicle, cue in zip(flight, cues(PerceptualParameters(), flight, dt=dt), strict=True):
        w_S = flip(vehicle.w_NB_B)
        more = LAW.felt + LAW.rate_gain * norm(w_S) + LAW.error_gain * radians(180.0)
        bound = max(bound, min(more, LAW.extra))
        assert norm(canals.feel(extra_rate(cue, w_S))) <= bound * (1.0 + 1e-9) + 1e-9


@BOTH
def test_look_ahead_without_a_flight_is_refused(parameters: Parameters) -> None:
    with pytest.raises(InputError, match=r"look_ahead_s = 0\.5 needs the states of the whole"):
        replace(parameters, look_ahead=AHEAD).rotation(DT)


def test_the_cue_begins_aligned_at_rest() -> None:
    flight = list(standing(IDENTITY, (3.0, 0.0, -9.0), DT, 50))
    rotation = PerceptualRotation(DT, PerceptualParameters(look_ahead=AHEAD), flight)
    for vehicle in flight:
        q_WS, w = rotation.step(vehicle)
        assert angle_between(up_in_cabin(q_WS), flip(vehicle.f_B)) < 1e-9
        assert w == pytest.approx(ZERO, abs=1e-9)
