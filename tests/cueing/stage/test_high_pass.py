"""The onset filter: inside its bounds whatever is asked, by itself and as a stage."""

import numpy as np
import pytest

from atlas_cueing.cueing import CLASSICAL_STAGE, StageParameters
from atlas_cueing.cueing.stage.high_pass import HighPass, demand_bound
from atlas_cueing.cueing.stage.stage_cueing import StageCueing
from atlas_cueing.rotation import IDENTITY, ZERO, Vec3
from atlas_cueing.signals import STANDARD_GRAVITY, StageLimits

LIMITS = StageLimits((1.0, 1.0, 0.75), (1.5, 1.5, 1.2), (6.0, 6.0, 5.0), (60.0, 60.0, 50.0))
HUGE = StageLimits((1e6,) * 3, (1e6,) * 3, (1e6,) * 3, (1e9,) * 3)
DTS = [1.0 / 1000.0, 1.0 / 120.0, 1.0 / 20.0]
CHOICES = [(1.5, 0.2, 5.0), (0.8, 0.1, 2.0), (4.0, 0.5, 5.0)]  # onset, recentre, bandwidth


def one_axis(choice: tuple[float, float, float]) -> StageParameters:
    """The same parameters on every axis."""
    onset, recentre, bandwidth = choice
    return StageParameters(
        onset=(onset,) * 3, recentre=(recentre,) * 3, bandwidth=bandwidth, planner="onset"
    )


def impulse(dt: float, choice: tuple[float, float, float], seconds: float) -> np.ndarray:
    """p, v, a after a demand of one for one tick, a row a tick, in the linear range."""
    onset = HighPass(dt, *choice, 1e9)
    onset.step(0.0)
    return np.array([onset.step(float(i == 0)) for i in range(int(seconds / dt))])


@pytest.mark.parametrize(
    ("dt", "choice"), [(1e-3, CHOICES[2]), *((dt, each) for dt in DTS[1:] for each in CHOICES)]
)
@pytest.mark.parametrize(
    "limit", [(1.0, 1.5, 6.0), (0.1, 10.0, 10.0), (10.0, 0.2, 10.0), (10.0, 10.0, 0.3)]
)
def test_the_worst_demand_stays_inside(
    dt: float, choice: tuple[float, float, float], limit: Vec3
) -> None:
    """Full demand whose sign is that of the impulse response run backwards.

    There is no worse for p, for v or for a.
    """
    response = impulse(dt, choice, 4.0 / choice[1])
    limits = StageLimits(*((x, x, x) for x in limit), (1e3,) * 3)
    used = []
    for which in range(3):
        cueing = StageCueing(dt, one_axis(choice), limits, ZERO)
        ask(cueing, 0.0)
        for sign in np.sign(response[::-1, which]):
            state = ask(cueing, 1e12 * float(sign))
            assert np.all(np.abs(state) <= limit)
        used.append(abs(state[which]) / limit[which])
    assert 0.3 < max(used) <= 1.0, (
        "one of the limits should be used by its own worst demand; nearly all needs a lasting one"
        " before"
    )


def ask(cueing: StageCueing, demand: float) -> Vec3:
    """p, v, a along x after a tick with a demand along x alone."""
    p, v, a = cueing.step(IDENTITY, ZERO, (demand, 0.0, -STANDARD_GRAVITY))
    return p[0], v[0], a[0]


@pytest.mark.parametrize(
    "choice",
    [
        (0.1, 5.0, 5.0),
        (0.8, 10.0, 5.0),
        (0.3, 1.0, 5.0),
        (1.5, 0.2, 0.05),
        (10.0, 0.0, 5.0),
        (1.0, 0.0, 5.0),
        (0.2, 0.2, 0.5),
    ],
    ids=str,
)
def test_the_travel_holds_whichever_pole_is_the_slowest(choice: tuple[float, float, float]) -> None:
    """A push for ever, then back, from rest in the centre.

    Of the onset, of the return, of the low-pass on the demand.
    """
    dt, cueing = 1.0 / 50.0, StageCueing(1.0 / 50.0, one_axis(choice), LIMITS, ZERO)
    ask(cueing, 0.0)
    path = [ask(cueing, sign * 1e6) for sign in (1.0, -1.0) for _ in range(int(60.0 / dt))]
    assert np.all(np.max(np.abs(path), axis=0) <= (1.0, 1.5, 6.0))


@pytest.mark.parametrize("start", [1e6, 1.0, -50.0])
@pytest.mark.parametrize(
    "parameters", [one_axis((1.5, 0.2, 5.0)), one_axis((1.5, 0.0, 5.0)), CLASSICAL_STAGE], ids=str
)
def test_the_travel_holds_whatever_demand_was_there_at_the_start(
    parameters: StageParameters, start: float
) -> None:
    """A demand that is there at the start counts as lasting.

    Without a return to the centre it does so for ever, and the opposite demand is twice as far
    off.
    """
    dt, cueing = 1.0 / 50.0, StageCueing(1.0 / 50.0, parameters, LIMITS, ZERO)
    ask(cueing, start)
    path = [
        ask(cueing, sign * start * 1e6) for sign in (-1.0, 1.0, -1.0) for _ in range(int(20.0 / dt))
    ]
    assert np.max(np.abs(path), axis=0)[0] <= min(1.0, parameters.travel[0])
    assert np.all(np.max(np.abs(path), axis=0)[1:] <= (1.5, 6.0))


def test_onset_and_return_are_the_axis_s_own() -> None:
    """Three axes, three filters: each is that of its own numbers, with the others' changed."""
    whole = StageParameters(onset=(1.0, 2.0, 3.0), recentre=(0.3, 0.1, 0.0), planner="onset")
    states = []
    for parameters in (
        whole,
        one_axis((1.0, 0.3, 5.0)),
        one_axis((2.0, 0.1, 5.0)),
        one_axis((3.0, 0.0, 5.0)),
    ):
        cueing = StageCueing(0.01, parameters, HUGE, ZERO)
        cueing.step(IDENTITY, ZERO, (0.0, 0.0, -STANDARD_GRAVITY))
        states.append(
            [cueing.step(IDENTITY, ZERO, (0.1, -0.1, -STANDARD_GRAVITY - 0.1)) for _ in range(300)][
                -1
            ]
        )
    mixed, *single = states
    for axis in range(3):
        assert [x[axis] for x in mixed] == pytest.approx([x[axis] for x in single[axis]], abs=1e-12)
    assert len({round(abs(single[axis][0][axis]), 6) for axis in range(3)}) == 3


@pytest.mark.parametrize("onset", [0.5, 1.5, 4.0])
def test_the_bound_is_that_of_the_filter_s_l1_norms(onset: float) -> None:
    """Norms of impulse responses of 1, s, s^2 over (s + onset)^2, under twice the bound."""
    t = np.linspace(0.0, 40.0 / onset, 400_001)
    decay, dt = np.exp(-onset * t), t[1]
    norms = [
        float(np.sum(np.abs(kernel)) * dt)
        for kernel in (t * decay, (1.0 - onset * t) * decay, onset * (onset * t - 2.0) * decay)
    ]
    norms[2] += 1.0  # the part of s^2 / (s + onset)^2 that passes at once
    assert demand_bound(onset, 1.0, 1e9, 1e9) == pytest.approx(0.5 / norms[0], rel=1e-3)
    assert demand_bound(onset, 1e9, 1.0, 1e9) == pytest.approx(0.5 / norms[1], rel=1e-3)
    assert demand_bound(onset, 1e9, 1e9, 1.0) == pytest.approx(0.5 / norms[2], rel=1e-3)


def test_a_small_onset_is_given_whole_and_a_lasting_one_comes_back_unfelt() -> None:
    """Acceleration at once as demanded.

    When braking is over, less than 0.063 m/s^2, for ever, and back to the centre.
    """
    dt, demand = 1.0 / 120.0, 0.3
    for size in (demand, 1e6):
        cueing, a = StageCueing(dt, one_axis((2.0, 0.2, 5.0)), LIMITS, ZERO), []
        cueing.step(IDENTITY, ZERO, (0.0, 0.0, -STANDARD_GRAVITY))
        for _ in range(int(60.0 / dt)):
            p, _, now = cueing.step(IDENTITY, ZERO, (size, 0.0, -STANDARD_GRAVITY))
            a.append(now[0])
        if size == demand:
            assert max(a) == pytest.approx(demand, rel=0.35)
        assert max(a) == pytest.approx(max(a[: int(0.3 / dt)]))  # the onset is at the onset
        assert np.max(np.abs(a[int(8.0 / dt) :])) < 0.063
        assert abs(p[0]) < 1e-3
        assert cueing.step(IDENTITY, ZERO, (size, 0.0, -STANDARD_GRAVITY))[0][1:] == (0.0, 0.0)


def test_the_high_frequency_part_is_the_limited_demand_without_what_lasts() -> None:
    """After a step of the demand it decays with the return to the centre.

    A huge one is cut down to the bound first.
    """
    dt, recentre = 0.01, 0.5
    for size, most in ((0.1, 0.1), (1e9, 2.0)):
        onset = HighPass(dt, 1.0, recentre, 50.0, 2.0)
        onset.step(0.0)
        high_frequency = []
        for _ in range(int(4.0 / recentre / dt)):
            onset.step(size)
            high_frequency.append(onset.high_frequency)
        assert max(high_frequency) == pytest.approx(most, rel=0.02)
        assert high_frequency[-1] == pytest.approx(most * np.exp(-4.0), rel=0.02)
