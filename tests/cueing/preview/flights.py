"""Flights to plan for, and the plan as arrays."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import pi, radians, sin

import numpy as np

from atlas_cueing.cueing import PreviewParameters
from atlas_cueing.cueing.preview.motion_plan import plan_motion
from atlas_cueing.rotation import ZERO, Quat, Vec3, exp, from_euler
from atlas_cueing.signals import STANDARD_GRAVITY, Cue, StageLimits, VehicleState, felt

DT = 0.02
LIMITS = StageLimits((1.0, 1.0, 0.75), (1.5, 1.5, 1.2), (6.0, 6.0, 5.0), (60.0, 60.0, 50.0))
HEAD: Vec3 = (0.1, 0.0, 0.6)
DEFAULT = PreviewParameters()
QUICK = replace(DEFAULT, planning_rate=10.0)
EAST_ISH = from_euler(1.0, 0.0, 0.0)
FAST = PreviewParameters(rate=pi, smoothing=0.1)
G = STANDARD_GRAVITY


@dataclass(frozen=True)
class Planned:
    """A plan in columns, and what its rider feels less what the pilot feels (FRD)."""

    cues: list[Cue]
    q: np.ndarray
    w: np.ndarray
    p: np.ndarray
    v: np.ndarray
    a: np.ndarray
    force_error: np.ndarray
    rate_error: np.ndarray


def planned(
    states: Sequence[VehicleState],
    parameters: PreviewParameters = DEFAULT,
    limits: StageLimits = LIMITS,
    head: Vec3 = ZERO,
    dt: float = DT,
) -> Planned:
    """Plan and play, tick by tick."""
    plan = plan_motion(states, parameters, limits, head, dt)
    cues = [plan.step(state) for state in states]
    q, w, p, v, a = (
        np.array([getattr(cue, name) for cue in cues])
        for name in ("q_WS", "w_WS_W", "p_WS_W", "v_WS_W", "a_WS_W")
    )
    alpha = np.gradient(w, dt, axis=0) if len(w) > 1 else np.zeros_like(w)
    f, rate = felt(q, w, alpha, a, head)
    wanted_f, wanted_w = (
        np.array([state.f_B for state in states]),
        np.array([state.w_NB_B for state in states]),
    )
    return Planned(cues, q, w, p, v, a, f - wanted_f, rate - wanted_w)


def cost(
    force_error: np.ndarray, rate_error: np.ndarray, parameters: PreviewParameters = DEFAULT
) -> float:
    """As evaluation has it, derived again."""
    force, rate = (np.mean(np.sum(x**2, axis=1)) for x in (force_error, rate_error))
    return float(np.sqrt(force / parameters.force_unit**2 + rate / parameters.rate_unit**2))


def flying(
    seconds: float, force: Callable[[float], Vec3], rate: Callable[[float], Vec3] = lambda _: ZERO
) -> list[VehicleState]:
    """A vehicle with these forces (m/s^2) and body rates (rad/s) of time, whatever its attitude."""
    return [
        VehicleState(i * DT, (1.0, 0.0, 0.0, 0.0), rate(i * DT), force(i * DT))
        for i in range(round(seconds / DT) + 1)
    ]


def tilting(
    seconds: float = 20.0, angle: float = radians(20.0), start: Quat = EAST_ISH
) -> list[VehicleState]:
    """The force swings to one side, faster than gravity turns at 3 deg/s, and stays."""

    def force(t: float) -> Vec3:
        over = angle * min(max((t - 8.0) / 1.0, 0.0), 1.0)
        return (0.0, G * sin(over), -G * float(np.cos(over)))

    return [replace(state, q_NB=start) for state in flying(seconds, force)]


def rolling(seconds: float = 12.0, rate: float = 1.0) -> list[VehicleState]:
    """Aileron rolls with the force along the seat all the way round."""

    def roll(t: float) -> float:
        return rate if 3.0 < t < 3.0 + 4.0 * pi / rate else 0.0

    states, angle = [], 0.0
    for i in range(round(seconds / DT) + 1):
        states.append(
            VehicleState(i * DT, exp((angle, 0.0, 0.0)), (roll(i * DT), 0.0, 0.0), (0.0, 0.0, -G))
        )
        angle += 0.5 * DT * (roll(i * DT) + roll((i + 1) * DT))
    return states
