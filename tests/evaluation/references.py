"""The metrics again, from the columns of a whole run, by numpy and scipy.

Nothing is shared with the classes that compute them in blocks but the names and the thresholds.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy import signal
from scipy.spatial.transform import Rotation

from atlas_cueing.evaluation import RunColumns
from atlas_cueing.evaluation.correlation import WINDOW
from atlas_cueing.evaluation.cues import FORCE_THRESHOLD, GAIN_BAND, RATE_THRESHOLD

from .flights import G

Figures = dict[str, float]
NOD = 1.0  # rad/s
FORCE_UNIT, RATE_UNIT = 0.17, np.radians(3.0)


def norm(v: np.ndarray) -> np.ndarray:
    return np.linalg.norm(v, axis=-1)


def rms(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(x)))) if len(x) else 0.0


def quantile(x: np.ndarray, share: float) -> float:
    return float(np.quantile(x, share)) if len(x) else 0.0


def spread(name: str, unit: str, x: np.ndarray) -> Figures:
    return {
        f"{name}_rms_{unit}": rms(x),
        f"{name}_p95_{unit}": quantile(x, 0.95),
        f"{name}_max_{unit}": float(np.max(x, initial=0.0)),
    }


def rotations(q: np.ndarray) -> Rotation:
    return Rotation.from_quat(q, scalar_first=True)


def vehicle_attitude(flight: RunColumns) -> np.ndarray:
    """q_WS (n, 4) of a cabin that stands in W as the vehicle in N, its first heading left out."""
    vehicle, flip = rotations(flight.vehicle_q_NB), Rotation.from_euler("X", np.pi)
    heading = Rotation.from_euler("Z", vehicle[0].as_euler("ZYX")[0])
    q_WS = (flip * heading.inv() * vehicle * flip).as_quat(scalar_first=True)
    return q_WS * np.where(np.sum(q_WS * flight.motion_q_WS, axis=1) < 0.0, -1.0, 1.0)[:, None]


def deviation(flight: RunColumns) -> Figures:
    f, g = flight.vehicle_f_B, flight.felt_f
    counted = (norm(f) > 0.1 * G) & (norm(g) > 0.1 * G)
    angle = np.arctan2(norm(np.cross(f, g)), np.sum(f * g, axis=1))[counted]
    turn = rotations(vehicle_attitude(flight)).inv() * rotations(flight.motion_q_WS)
    return {
        **spread("force", "m_s2", norm(g - f)),
        **spread("direction", "rad", angle),
        "direction_counted_share": float(np.mean(counted)),
        **spread("rate", "rad_s", norm(flight.felt_w - flight.vehicle_w_B)),
        **spread("attitude", "rad", turn.magnitude()),
    }


def mismatch(flight: RunColumns) -> Figures:
    f, g = flight.vehicle_f_B, flight.felt_f
    dt = float(np.mean(np.diff(flight.time)))
    theta = np.arctan2(norm(np.cross(f, g)), np.sum(f * g, axis=1))
    w = [[sensed(CANALS, x, dt) for x in side.T] for side in (flight.felt_w, flight.vehicle_w_B)]
    squares = {
        "magnitude": (norm(g) - norm(f)) ** 2 / FORCE_UNIT**2,
        "direction": 4.0 * norm(f) * norm(g) * np.sin(theta / 2.0) ** 2 / FORCE_UNIT**2,
        "rate": np.sum((np.array(w[0]) - np.array(w[1])) ** 2, axis=0) / RATE_UNIT**2,
    }
    square = norm(g - f) ** 2 / FORCE_UNIT**2 + squares["rate"]
    ticks = min(round(10.0 / dt), len(square))
    windows = np.mean(np.lib.stride_tricks.sliding_window_view(square, ticks), axis=1)
    return {
        "mismatch": float(np.sqrt(np.mean(square))),
        **{f"mismatch_{leg}": float(np.sqrt(np.mean(part))) for leg, part in squares.items()},
        "mismatch_worst_10s": float(np.sqrt(np.max(windows))),
    }


def extra_rate(flight: RunColumns) -> Figures:
    rate = norm(flight.felt_w - flight.vehicle_w_B)[flight.limited[:, 0] == 0.0]
    return {
        "extra_rate_rms_rad_s": rms(rate),
        "extra_rate_p99_rad_s": quantile(rate, 0.99),
        "extra_rate_max_rad_s": float(np.max(rate, initial=0.0)),
    }


def turning(flight: RunColumns) -> Figures:
    figures: Figures = {}
    for name, w in (("coriolis", flight.felt_w), ("vehicle_coriolis", flight.vehicle_w_B)):
        coupling = norm(np.cross(w, [0.0, NOD, 0.0]))
        figures[f"{name}_rms_rad_s2"] = rms(coupling)
        figures[f"{name}_p95_rad_s2"] = quantile(coupling, 0.95)
    turns = np.trapezoid(flight.felt_w, flight.time, axis=0) / (2.0 * np.pi)
    names = ("turns_roll", "turns_pitch", "turns_yaw")
    return figures | dict(zip(names, turns.tolist(), strict=True))


def effort(flight: RunColumns) -> Figures:
    turn = rotations(flight.cue_q_WS).inv() * rotations(flight.motion_q_WS)
    distance = norm(flight.cue_p_W - flight.motion_p_W)
    added_w = np.diff(flight.motion_w_W - flight.cue_w_W, axis=0)
    alpha = norm(added_w) / np.diff(flight.time)
    near = np.array([np.convolve(flag, np.ones(3), "same") for flag in flight.limited.T]) > 0.5
    added_a = norm(flight.motion_a_W - flight.cue_a_W)[~near[1]]
    return {
        "cue_lag_rms_rad": rms(turn.magnitude()),
        "cue_lag_max_rad": float(np.max(turn.magnitude())),
        "cue_lag_rms_m": rms(distance),
        "cue_lag_max_m": float(np.max(distance)),
        "wheels_limited_share": float(np.mean(flight.limited[:, 0])),
        "stage_limited_share": float(np.mean(flight.limited[:, 1])),
        "added_angular_acceleration_rms_rad_s2": rms(alpha[~near[0, 1:]]),
        "added_stage_acceleration_rms_m_s2": rms(added_a),
        "wheel_speed_max_rad_s": float(np.max(np.abs(flight.wheel_speed))),
        "wheel_acceleration_max_rad_s2": float(np.max(np.abs(flight.wheel_acceleration))),
        "stage_travel_max_m": float(np.max(np.abs(flight.motion_p_W))),
        "stage_speed_max_m_s": float(np.max(np.abs(flight.motion_v_W))),
        "stage_acceleration_max_m_s2": float(np.max(np.abs(flight.motion_a_W))),
    }


def correlation(reference: np.ndarray, delayed: np.ndarray, dt: float) -> tuple[float, float]:
    """Peak and delay, with Pearson's correlation at each shift by itself."""
    n = len(reference)
    most = min(round(WINDOW / dt), n // 4)
    values = np.array(
        [
            np.corrcoef(reference[max(-s, 0) : n - max(s, 0)], delayed[max(s, 0) : n + min(s, 0)])[
                0, 1
            ]
            for s in range(-most, most + 1)
        ]
    )
    k = int(np.argmax(values))
    if not 0 < k < len(values) - 1:
        return float(values[k]), (k - most) * dt
    bend, slope, height = np.polyfit([-1.0, 0.0, 1.0], values[k - 1 : k + 2], 2)
    vertex = -0.5 * slope / bend
    return float(np.clip(height + 0.5 * slope * vertex, -1.0, 1.0)), (k - most + vertex) * dt


def cue_shares(vehicle: np.ndarray, platform: np.ndarray, threshold: float) -> Figures:
    """Shares of missing, false and scaled cues, tick by tick."""
    kinds = [_kind(a, b, threshold) for a, b in zip(vehicle, platform, strict=True)]
    return {kind: kinds.count(kind) / len(kinds) for kind in ("missing", "false", "scaled")}


def _kind(vehicle: float, platform: float, threshold: float) -> str:
    asked, given = abs(vehicle) > threshold, abs(platform) > threshold
    if asked and not given:
        return "missing"
    if given and (not asked or vehicle * platform < 0.0):
        return "false"
    low, high = GAIN_BAND
    return "scaled" if asked and not low <= platform / vehicle <= high else ""


CANALS = ([5.73 * 80.0, 0.0, 0.0], np.polymul([5.73, 1.0], [80.0, 1.0]))
OTOLITHS = (np.multiply(0.4, [10.0, 1.0]), np.polymul([5.0, 1.0], [0.016, 1.0]))
Organ = tuple[ArrayLike, ArrayLike]


def sensed(organ: Organ, u: np.ndarray, dt: float) -> np.ndarray:
    """Behind an organ in the steady state of the first value, by scipy's simulation."""
    system = signal.StateSpace(*signal.tf2ss(*organ))
    steady = -np.linalg.solve(system.A, system.B[:, 0] * u[0])
    return np.asarray(signal.lsim(system, u, np.arange(len(u)) * dt, X0=steady)[1])


def likeness(flight: RunColumns) -> Figures:
    quantities = ((*_force(flight), OTOLITHS), (*_rate(flight), CANALS))
    dt = float(np.mean(np.diff(flight.time)))
    errors: Figures = {}
    plain: Figures = {}
    behind: Figures = {}
    for name, unit, pilot, rider, threshold, organ in quantities:
        seen = [np.array([sensed(organ, x, dt) for x in side.T]).T for side in (pilot, rider)]
        errors |= spread(f"perceived_{name}", unit, norm(seen[1] - seen[0]))
        plain |= _axes(name, pilot, rider, threshold, dt)
        level = np.abs(np.polyval(organ[0], 3.0j) / np.polyval(organ[1], 3.0j))
        behind |= _axes(f"perceived_{name}", seen[0], seen[1], level * threshold, dt)
    return errors | plain | behind


def _force(flight: RunColumns) -> tuple[str, str, np.ndarray, np.ndarray, np.ndarray]:
    rest = np.array([0.0, 0.0, -G])
    both = (flight.vehicle_f_B - rest, flight.felt_f - rest)
    return ("force", "m_s2", *both, np.array(FORCE_THRESHOLD))


def _rate(flight: RunColumns) -> tuple[str, str, np.ndarray, np.ndarray, np.ndarray]:
    return ("rate", "rad_s", flight.vehicle_w_B, flight.felt_w, np.array(RATE_THRESHOLD))


def _axes(
    name: str, pilot: np.ndarray, rider: np.ndarray, threshold: np.ndarray, dt: float
) -> Figures:
    figures: Figures = {}
    for k, axis in enumerate("xyz"):
        peak, delay = correlation(pilot[:, k], rider[:, k], dt)
        figures[f"{name}_{axis}_correlation"], figures[f"{name}_{axis}_delay_s"] = peak, delay
        for kind, share in cue_shares(pilot[:, k], rider[:, k], threshold[k]).items():
            figures[f"{name}_{axis}_{kind}_share"] = share
    return figures


def perceived(flight: RunColumns) -> Figures:
    """Of ticks that are averaged by as many as fit into a sixtieth of a second."""
    dt = float(np.mean(np.diff(flight.time)))
    ticks = max(int(1.0 / 60.0 / dt + 1e-6), 1)
    columns = (flight.vehicle_f_B, flight.vehicle_w_B, flight.felt_f, flight.felt_w)
    steps = len(flight.time) // ticks
    f_p, w_p, f_r, w_r = (
        np.array([np.mean(x[k * ticks : (k + 1) * ticks], axis=0) for k in range(steps)])
        for x in columns
    )
    (up_p, turn_p), (up_r, turn_r) = (
        perception(f, w, ticks * dt) for f, w in ((f_p, w_p), (f_r, w_r))
    )
    tilt = np.arctan2(norm(np.cross(up_p, up_r)), np.sum(up_p * up_r, axis=1))
    return {
        "perceived_tilt_rms_rad": rms(tilt),
        "perceived_turn_rms_rad_s": rms(norm(turn_p - turn_r)),
    }


def perception(f: np.ndarray, w: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """Up and rate (n, 3) as Merfeld's observer has them, with the gains of Rader et al. (2009).

    In Merfeld's own terms: gravito-inertial force -f, gravity down; rates by the trapezoid, the
    turn to the force as it would go on from two steps.
    """
    Kw, Kfw, Kf, Ka, T = 3.0, 2.0, 2.0, -2.0, 5.73
    canals = np.array([sensed(CANALS, x, dt) for x in w.T]).T
    canals[0] = 0.0
    down = -f[0] / norm(f[0])
    store, turns = np.zeros(3), [np.zeros(3), np.zeros(3)]
    ups, rates = [-down], [np.zeros(3)]
    for k in range(1, len(f)):
        ahead = turns[-1] + 0.5 * (turns[-1] - turns[-2])
        drive = 0.5 * (canals[k] + canals[k - 1]) + Kfw / Kw * ahead
        # T v' = Kw (c + v + Kfw / Kw e) / (1 + Kw) - v
        before, a, b = store, Kw / (1.0 + Kw), dt / T
        store = (before * (1.0 - 0.5 * b * (1.0 - a)) + b * a * drive) / (1.0 + 0.5 * b * (1.0 - a))
        rate = drive + 0.5 * (before + store) + Kf * ahead
        down = Rotation.from_rotvec(-dt * rate).apply(down)
        down = down / norm(down)
        gif = -f[k]
        # a^ = Ka (gif - gif^), gif^ = G down - a^: solved for gif^
        expected = (G * down - Ka * gif) / (1.0 - Ka)
        axis = np.cross(gif, expected)
        angle = np.arctan2(norm(axis), gif @ expected)
        fading = min((norm(gif) / 0.063) ** 2, 1.0)
        turns.append(fading * angle * axis / max(norm(axis), 1e-300))
        ups.append(-down)
        rates.append(canals[k] + store + Kfw / Kw * turns[-1])
    return np.array(ups), np.array(rates)


def duration(flight: RunColumns) -> Figures:
    return {"ticks": float(len(flight.time)), "duration_s": float(np.ptp(flight.time))}


def metrics(flight: RunColumns) -> Figures:
    """All but those of the observers (`perceived`)."""
    parts: tuple[Callable[[RunColumns], Figures], ...] = (
        *(mismatch, deviation, extra_rate),
        *(likeness, turning, effort, duration),
    )
    return {name: value for part in parts for name, value in part(flight).items()}
