"""Figures of a flight on the plant, by name, the unit in the name."""

from typing import Any

import numpy as np

from ..recording import Log
from ..rotations import Array
from ..signals import PLANT, direction_error
from .fly_plant import PlantRun

DEFINITIONS = {
    "orientation_error_end_rad": "angle between the sphere and /motion at the end",
    "orientation_error_max_rad": "its largest",
    "orientation_error_rms_rad": "its root mean square",
    "estimate_error_max_rad": "largest angle between the sphere and where the loop believes it is",
    "slip_max_m_s": "largest slip of a wheel against the sphere, creep included, at the ticks",
    "lift_off_share": "share of ticks at which a wheel does not touch",
    "normal_force_min_n": "least normal force of a wheel",
    "wheel_torque_max_n_m": "largest torque of a drive",
    "felt_force_error_rms_m_s2": "what the rider really feels against /felt",
    "felt_direction_error_max_rad": "largest angle between the two",
    "felt_rate_error_rms_rad_s": "turning rate of the cabin against /felt",
    "correction_rate_max_rad_s": "largest that the loop adds to the speed of a wheel",
    "motor_work_j": "of the drives, in less out",
    "stage_work_j": "of the stage",
    "friction_loss_j": "by slip in the contacts",
    "other_losses_j": "by damping of contacts and at the axles",
    "row_change_work_j": "by springs when another row of rollers takes over",
    "energy_change_j": "of the moving sphere, its wheels and springs",
    "energy_residual_j": "energy change less all work: the error of integration",
    "energy_throughput_j": "integral of the sizes of all power of drives and stage",
}


def plant_figures(run: PlantRun, log: Log) -> dict[str, Any]:
    """Figures of DEFINITIONS; `log` is what was flown."""
    error, column = _of(run, "error_rad"), _of(run, "estimate_error_rad")
    slip, normal, torque = (_wheels(run, *name) for name in _OF_WHEELS)
    motors, stage, friction, losses = run.work
    found = {
        "orientation_error_end_rad": error[-1],
        "orientation_error_max_rad": error.max(),
        "orientation_error_rms_rad": np.sqrt(np.mean(error**2)),
        "estimate_error_max_rad": column.max(),
        "slip_max_m_s": np.abs(slip).max(),
        "lift_off_share": np.mean((normal <= 0.0).any(axis=1)),
        "normal_force_min_n": normal.min(),
        "wheel_torque_max_n_m": np.abs(torque).max(),
        **_felt(run, log),
        "correction_rate_max_rad_s": np.abs(run.correction[:, 4:7]).max(),
        "motor_work_j": motors,
        "stage_work_j": stage,
        "friction_loss_j": friction,
        "other_losses_j": losses,
        "row_change_work_j": run.row_work,
        "energy_change_j": run.energy_change,
        "energy_residual_j": run.energy_residual,
        "energy_throughput_j": run.throughput,
    }
    return {name: float(value) for name, value in found.items()}


_OF_WHEELS = (("s", "m_s"), ("n", "n"), ("t", "n_m"))


def _felt(run: PlantRun, log: Log) -> dict[str, Any]:
    """What the rider really feels against what the log says that he does."""
    said, really = log.vector("/felt", "f"), _vector(run, "f", "m_s2")
    away = np.linalg.norm(really - said, axis=1)
    turned = np.linalg.norm(_vector(run, "w", "rad_s") - log.vector("/motion", "w"), axis=1)
    return {
        "felt_force_error_rms_m_s2": np.sqrt(np.mean(away**2)),
        "felt_direction_error_max_rad": direction_error(said, really).max(),
        "felt_rate_error_rms_rad_s": np.sqrt(np.mean(turned**2)),
    }


def _of(run: PlantRun, field: str) -> Array:
    column: Array = run.plant[:, PLANT.fields.index(field)]
    return column


def _wheels(run: PlantRun, name: str, unit: str) -> Array:
    return np.stack([_of(run, f"{name}{k}_{unit}") for k in (1, 2, 3)], axis=1)


def _vector(run: PlantRun, name: str, unit: str) -> Array:
    return np.stack([_of(run, f"{name}{axis}_{unit}") for axis in "xyz"], axis=1)
