"""What a run asks of the contacts and drives of a platform with masses."""

import numpy as np

from ..loads import LARGEST_USE, LoadModel, Loads, balance
from ..rotations import Array
from .run_columns import RunColumns, Tail

LARGEST_FORCE = 1e12
"""N; what stands for a preload that no force would be enough for."""


class ContactLoads:
    """Traction, normal forces, torques and power of the logged motion (`loads.balance`).

    - traction_use_max: largest share of friction in use by any wheel, 100 where one does not touch;
    - traction_slip_share: share of ticks at which a wheel slips: it does not touch, or its use
      exceeds 1;
    - normal_min_n, normal_max_n: of any wheel; lift_off_share: share of ticks at which one does not
      touch;
    - preload_needed_n: largest further force straight down with which no wheel slips, negative for
      a reserve, 0 where no wheel slips nor carries any of it;
    - wheel_torque_max_n_m, wheel_torque_rms_n_m: at the axles; of the wheel with the largest rms;
    - power_peak_w, power_regenerated_peak_w: of all wheels together, to and from the motion;
    - energy_j, energy_regenerated_j: to and from the motion at each axle, summed (trapezoids);
      energy_supplied_j: what the supply gives, by gear and motor of `efficiency`, less what it
      takes back;
    - motor_speed_max_rad_s: by the gear.
    """

    def __init__(self, model: LoadModel) -> None:
        """Begin without ticks."""
        self._model = model
        self._ticks = 0
        self._slipping, self._lifted = 0, 0
        self._use, self._normal = 0.0, (np.inf, 0.0)
        self._preload = -np.inf
        self._torque, self._speed = 0.0, 0.0
        self._torque_squares: Array = np.zeros(len(model.wheels))
        self._peak: Array = np.zeros(2)  # W, motoring and regenerating
        self._energy: Array = np.zeros(3)  # J, motoring, regenerating and from the supply
        self._tail = Tail(1)

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        with np.errstate(all="ignore"):
            loads = balance(
                self._model,
                block.motion_q_WS,
                block.motion_w_W,
                block.motion_alpha_W,
                block.motion_a_W,
            )
        self._add_contacts(loads)
        self._add_drives(loads, block.time)

    def _add_contacts(self, loads: Loads) -> None:
        use, normal = np.minimum(loads.traction_use, LARGEST_USE), loads.normal
        self._ticks += len(use)
        self._slipping += int(np.sum(~np.all(use <= 1.0, axis=1)))
        self._lifted += int(np.sum(~np.all(normal > 0.0, axis=1)))
        self._use = float(np.maximum(self._use, use.max()))
        least, most = self._normal
        self._normal = min(least, float(normal.min())), max(most, float(normal.max()))
        self._preload = max(self._preload, float(loads.preload_needed.max()))

    def _add_drives(self, loads: Loads, time: Array) -> None:
        self._torque = float(np.maximum(self._torque, np.abs(loads.torque).max()))
        self._speed = float(np.maximum(self._speed, np.abs(loads.speed).max()))
        self._torque_squares += np.einsum("ij,ij->j", loads.torque, loads.torque)
        together = loads.power.sum(axis=1)
        self._peak = np.maximum(self._peak, [together.max(), 0.0 - together.min()])
        out, back = (np.maximum(power, 0.0).sum(axis=1) for power in (loads.power, -loads.power))
        t, *flows = self._tail.joined(time, out, back, self._supply(loads.power))
        for k, flow in enumerate(flows):
            self._energy[k] += float(np.sum(0.5 * (flow[1:] + flow[:-1]) * np.diff(t)))

    def _supply(self, power: Array) -> Array:
        """Power (n,) that the supply gives, W, from that at the axles (n, N)."""
        drive = self._model.drive
        back = drive.efficiency if drive.regeneration else 0.0
        flow: Array = np.where(power > 0.0, power / drive.efficiency, back * power).sum(axis=1)
        return flow

    def figures(self) -> dict[str, float]:
        """All figures of the ticks so far; 0 without ticks."""
        count, empty = max(self._ticks, 1), self._ticks == 0
        least, most = self._normal
        rms = np.sqrt(self._torque_squares / count)
        preload = float(np.clip(self._preload, -LARGEST_FORCE, LARGEST_FORCE))
        motoring, regenerated, supplied = self._energy.tolist()
        return {
            "traction_use_max": self._use,
            "traction_slip_share": self._slipping / count,
            "normal_min_n": 0.0 if empty else least,
            "normal_max_n": most,
            "lift_off_share": self._lifted / count,
            "preload_needed_n": 0.0 if empty or preload == -LARGEST_FORCE else preload,
            "wheel_torque_max_n_m": self._torque,
            "wheel_torque_rms_n_m": float(rms.max()),
            "motor_speed_max_rad_s": self._model.drive.gear * self._speed,
            "power_peak_w": float(self._peak[0]),
            "power_regenerated_peak_w": float(self._peak[1]),
            "energy_j": motoring,
            "energy_regenerated_j": regenerated,
            "energy_supplied_j": supplied,
        }


def load_violations(figures: dict[str, float], model: LoadModel) -> list[str]:
    """List what exceeds a limit of drives and contacts that the platform names, a line each."""
    drive = model.drive
    loads = [wheel.load_limit for wheel in model.wheels if wheel.load_limit is not None]
    limits = {
        "wheel_torque_max_n_m": (drive.torque, "N m"),
        "wheel_torque_rms_n_m": (drive.torque_rms, "N m"),
        "motor_speed_max_rad_s": (drive.motor_speed, "rad/s"),
        "normal_max_n": (min(loads, default=None), "N"),
    }
    return [
        f"{name} = {figures[name]:.6g}, allowed: at most {limit:.6g} {unit}"
        for name, (limit, unit) in limits.items()
        if limit is not None and not figures[name] <= limit * (1.0 + 1e-9)
    ]


def traction_lines(figures: dict[str, float], model: LoadModel) -> list[str]:
    """Say where wheels slip or lift off, and what preload would hold them; none if they do not.

    A use above the platform's margin is said too.
    """
    use, slips = figures["traction_use_max"], figures["traction_slip_share"]
    most = 1.0 / model.traction_margin
    if not slips > 0.0:
        line = f"traction: {use:.3f} of the friction in use at most, {most:.3f} with the margin"
        return [f"{line} of {model.traction_margin:g}"] if use > most else []
    lines = [
        f"traction: a wheel slips on {slips:.2%} of the ticks;"
        f" {_preload(figures['preload_needed_n'])}"
    ]
    if figures["lift_off_share"] > 0.0:
        lines.append(
            f"traction: a wheel lifts off on {figures['lift_off_share']:.2%} of the ticks, normal"
            f" force {figures['normal_min_n']:.6g} N at the least"
        )
    return lines


def _preload(needed: float) -> str:
    if needed >= LARGEST_FORCE:
        return "no force straight down would hold it"
    return f"{needed:.6g} N more straight down on the sphere would hold it"
