"""The tool that measures gain and phase.

Its arithmetic, and the pipeline's linear theory as a second derivation.
"""

from math import isnan, pi
from typing import Any

import numpy as np
import pytest
from frequency_tool import ROOT, tool
from scipy.linalg import expm

from atlas_cueing.cueing import (
    AttitudeParameters,
    BlendParameters,
    ClassicalParameters,
    CueSource,
    ForceParameters,
    HedgeParameters,
    PerceptualParameters,
    StillParameters,
)
from atlas_cueing.cueing.felt_turn import decaying_gain, lasting_gain
from atlas_cueing.pipeline import Pipeline
from atlas_cueing.run import build_pipeline
from atlas_cueing.scenario import Scenario, load_scenario
from atlas_cueing.signals import STANDARD_GRAVITY as G
from atlas_cueing.signals import Cue, VehicleState

SWEEP = ROOT / "scenarios" / "signal_sweep.toml"


RATE_HZ = 120.0


THREE = (0.631, 2.512, 6.31)  # rad/s


# The linear stage: the planner of the defaults learns from what it is shown, and has no frequency
# response.
ONSET = ("cueing.stage.planner=onset", "cueing.stage.onset_rad_s=2", "cueing.force_gain=0.4")


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """A shorter way to the settled state, for frequencies above 0.5 rad/s."""
    monkeypatch.setattr(tool, "_RAMP_S", 12.0)
    monkeypatch.setattr(tool, "_SETTLED_S", 24.0)


EQUAL = {"hedge": ("cueing.contrast=0",)}


"""Shares of a committee that are constant: else it learns, and has no frequency response."""


def scenario(method: str) -> Scenario:
    settings = [f"cueing.method={method}", *ONSET, *EQUAL.get(method, ())]
    return load_scenario(SWEEP, settings)


def measured(method: str, axis: str, frequency: float, follows: bool = False) -> dict[str, Any]:
    """Responses by answering axis."""
    size = 0.01 * min(frequency, 1.0) if axis.endswith("rate") else 0.1
    responses = tool.measure((scenario(method), tool.sine(axis, frequency, size, RATE_HZ, follows)))
    return {response.answer: response for response in responses}


def phasor(response: Any) -> complex:
    phase = 0.0 if isnan(response.phase_deg) else response.phase_deg
    return complex(response.gain * np.exp(1j * np.radians(phase)))


def low_pass(s: complex, omega: float) -> complex:
    return omega**2 / (s + omega) ** 2


def stage(s: complex, of: Scenario) -> complex:
    """Stage acceleration over what the head lacks, along x.

    The filter of `cueing/stage/high_pass.py`, in continuous time.
    """
    p = of.file.cueing.stage_parameters()
    corner = 2.0 * pi * p.bandwidth
    return (
        p.force_gain[0]
        * corner
        / (s + corner)
        * s
        / (s + p.recentre[0])
        * s**2
        / (s + p.onset[0]) ** 2
    )


def turning(s: complex, of: Scenario) -> tuple[complex, complex]:
    """Pitch rate of the cabin over that of the vehicle, and over the force x.

    The first with the force held; the second in rad/s per m/s^2.

    Linear for small angles, in continuous time.
    """
    match of.file.cueing.parameters():
        case HedgeParameters() as p:  # s x = mean of s x_i + H lambda (mean of x_i - x), at rest
            each = [response(s, law) for law in p.members()]
            mean = [sum(part) / len(each) for part in zip(*each, strict=True)]
            return mean[0], mean[1]
        case parameters:
            return response(s, parameters)


def response(s: complex, parameters: object) -> tuple[complex, complex]:
    """What `turning` says, of one law.

    `target` is the pitch whose gravity is the force, per m/s^2.
    """
    target = 1.0 / G
    match parameters:
        case StillParameters():
            return 0.0, 0.0
        case PerceptualParameters() as p:
            return perceptual_in_ticks(s, p, 1.0 / RATE_HZ)
        case AttitudeParameters():
            return 1.0, 0.0
        case BlendParameters() as p:  # s x = w + H (s L target - w + (target - x) / T)
            slow = low_pass(s, 1.0 / p.turn.smoothing)
            back = s + slow / p.turn.time
            low = low_pass(s, p.bandwidth)
            return (
                s * (1.0 - slow * low) / back,
                s * slow * (s * low + 1.0 / p.turn.time) / back * target,
            )
        case ForceParameters() as p:
            return 0.0, s * low_pass(s, p.bandwidth) * target
        case ClassicalParameters() as p:
            washout = s**2 / (s + p.high_pass[1]) ** 2
            return (
                p.rotation_gain[1] * washout,
                s * p.tilt_gain[0] * low_pass(s, p.tilt_low_pass) * target,
            )
    raise AssertionError(parameters)


def perceptual(s: complex, p: PerceptualParameters) -> tuple[complex, complex]:
    """Of e = target - x, w_L = L (s target - w), y = H (lambda e + k_w w_L - k z), z = y / (T s).

    The cabin turns with s x = w + y + z.
    """
    turn, target = p.turn, 1.0 / G
    slow, low = low_pass(s, 1.0 / turn.smoothing), low_pass(s, p.bandwidth)
    ahead = decaying_gain(turn.response, turn.canals, turn.lasting)
    back = lasting_gain(turn.response, turn.canals)
    whole = 1.0 + 1.0 / (turn.canals * s)  # (y + z) / y
    closed = 1.0 + slow * (back / (turn.canals * s) + turn.response * whole / s)
    return (
        1.0 - whole * slow * (turn.response / s + ahead * low) / closed,
        whole * slow * (turn.response + ahead * low * s) / closed * target,
    )


def perceptual_in_ticks(s: complex, p: PerceptualParameters, dt: float) -> tuple[complex, complex]:
    """What `perceptual` says, of the difference equations, with 1 / d for a tick's delay.

    Integrals are trapezoids I, and both filters are stepped exactly with their target held for the
    tick (H; L and its rate L'). A tick's wish is made before the tick's own extra turn: of
    e = target - (x - (1 + 1 / d) dt / 2 (y + z)) and of the z of a tick before. That delay in the
    loop and the held targets are all that is between this and continuous time, either alone up to
    1.2 ticks, and 1.2, 1.0 and 0.5 ticks together at 0.6, 2.5 and 6.3 rad/s.
    """
    turn, target, d = p.turn, 1.0 / G, np.exp(s * dt)
    half = 0.5 * dt * (1.0 + 1.0 / d)
    integral = half / (1.0 - 1.0 / d)
    slow, _ = damped_in_ticks(d, 1.0 / turn.smoothing, dt)
    low, low_rate = damped_in_ticks(d, p.bandwidth, dt)
    ahead = decaying_gain(turn.response, turn.canals, turn.lasting)
    back = lasting_gain(turn.response, turn.canals) * integral / turn.canals / d
    whole = 1.0 + integral / turn.canals  # (y + z) / y
    closed = 1.0 + slow * (back + turn.response * (integral - half) * whole)
    return (
        1.0 - whole * slow * (turn.response * integral + ahead * low) / closed,
        whole * slow * (turn.response + ahead * low_rate) / closed * target,
    )


def damped_in_ticks(d: complex, omega: float, dt: float) -> np.ndarray:
    """Value and rate of critical damping x'' = omega^2 (u - x) - 2 omega x' per u, u held."""
    a = np.array([[0.0, 1.0], [-omega * omega, -2.0 * omega]])
    step = expm(a * dt)
    held = np.linalg.solve(a, (step - np.eye(2)) @ np.array([0.0, omega * omega]))
    answer: np.ndarray = np.linalg.solve(np.eye(2) - step / d, held)
    return answer


@pytest.mark.parametrize("frequency", THREE)
def test_difference_equations_go_to_continuous_time_in_first_order(frequency: float) -> None:
    s, p = 1j * frequency, PerceptualParameters()
    exact = np.array(perceptual(s, p))
    coarse, fine = (np.abs(np.array(perceptual_in_ticks(s, p, dt)) - exact) for dt in (1e-4, 5e-5))
    assert coarse / fine == pytest.approx(np.full(2, 2.0), rel=0.01)


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("frequency", THREE)
def test_perceptual_turns_as_its_difference_equations_say(frequency: float) -> None:
    """Without a tick's tolerance; up to 2e-4 was seen, of small angles."""
    s, of = 1j * frequency, scenario("perceptual")
    from_rate, from_force = turning(s, of)
    for axis, theory, scale in (
        ("pitch_rate", from_rate, 1.0),
        ("force_x", from_force, frequency / G),
    ):
        found = phasor(measured("perceptual", axis, frequency)["pitch_rate"])
        assert abs(found - theory) / scale < 1e-3


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("frequency", THREE)
@pytest.mark.parametrize(
    "method", ["attitude", "blend", "force", "classical", "perceptual", "hedge"]
)
def test_all_four_relations_are_those_of_the_theory(method: str, frequency: float) -> None:
    """With the force held, rates and forces are independent.

    The four are one column each of the linear pipeline.
    """
    s, of = 1j * frequency, scenario(method)
    from_rate, from_force = turning(s, of)
    onset = stage(s, of)
    tilted = from_force / s * G  # share of the force that gravity stands for
    wanted = {
        ("pitch_rate", "pitch_rate"): (from_rate, 1.0),
        ("pitch_rate", "force_x"): (from_rate / s * G * (1.0 - onset), G / frequency),
        ("force_x", "pitch_rate"): (from_force, frequency / G),
        ("force_x", "force_x"): (tilted + onset * (1.0 - tilted), 1.0),
    }
    found = {axis: measured(method, axis, frequency) for axis in ("pitch_rate", "force_x")}
    for (driven, answer), (theory, scale) in wanted.items():
        response = found[driven][answer]
        # of a tick's delay
        assert abs(phasor(response) - theory) / scale < 0.01 + 0.4 * frequency / RATE_HZ
        assert response.limited_share == 0.0


@pytest.mark.usefixtures("quick")
def test_a_force_that_follows_is_the_force_of_the_attitude() -> None:
    """Superposition, as the vehicle's description says.

    Rotation with its force = rotation alone + the force g / s.
    """
    w = 2.512
    alone, force = measured("blend", "pitch_rate", w), measured("blend", "force_x", w)
    for answer, response in measured("blend", "pitch_rate", w, follows=True).items():
        both = phasor(alone[answer]) + G / (1j * w) * phasor(force[answer])
        assert abs(phasor(response) - both) < 0.01 * max(1.0, abs(both))
        own = complex(1.0) if answer == "pitch_rate" else G / (1j * w)
        pilot = response.pilot_gain * np.exp(1j * np.radians(response.pilot_phase_deg))
        assert abs(pilot - own) < 2e-3 * abs(own)


class Late:
    """Cueing that is one tick late."""

    def __init__(self, cueing: CueSource) -> None:
        self._cueing = cueing
        self._before: VehicleState | None = None

    def step(self, vehicle: VehicleState) -> Cue:
        before, self._before = self._before or vehicle, vehicle
        return self._cueing.step(before)


def late_pipeline(scenario: Scenario, dt: float) -> Pipeline:
    built = build_pipeline(scenario, dt)
    return Pipeline(Late(built.cueing), built.smoothing, built.wheels)


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize(("pipeline", "ticks"), [(build_pipeline, 0.0), (late_pipeline, 1.0)])
def test_a_delay_is_measured_in_ticks(
    monkeypatch: pytest.MonkeyPatch, pipeline: Any, ticks: float
) -> None:
    """Motion and state of one tick belong together: no delay. A tick too late would be seen."""
    monkeypatch.setattr(tool, "build_pipeline", pipeline)
    points = [measured("attitude", "yaw_rate", w)["yaw_rate"] for w in (2.512, 15.85)]
    assert tool.delay_ticks(points, RATE_HZ) == pytest.approx(ticks, abs=0.01)
