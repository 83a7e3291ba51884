"""What flights ask of a layout: preload, wheel load, torque, power, speed, and its own figures."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, SlipConditionError
from ..loads import LoadModel, Loads, reserve
from ..loads.balance import loads_of_wrench
from ..rotations import Array
from ..scenario import Platform
from ..wheels import headroom, row_corrections, row_effect
from .layout import Layout, clearance, wheel_gap, with_layout
from .ridden import Ridden

Figures = dict[str, float]
_WITH_ROWS = 6  # wheels: there are 2^N combinations of rows


@dataclass(frozen=True, slots=True)
class Measured:
    """A layout with its figures over some ticks, and the ticks at which each of them is worst."""

    layout: Layout
    figures: Figures
    worst: NDArray[np.intp] = field(repr=False)


def measure(platform: Platform, layout: Layout, ridden: Ridden) -> Measured | None:
    """Measure a layout over ticks; None for one that cannot be built or driven.

    That is one whose drives cannot turn the sphere about every axis, whose contacts cannot hold it,
    or whose wheels meet. Names of the figures have their units:

    - preload_needed_n: further force straight down with which no wheel slips (9), negative: a
      reserve; at [traction] margin: preload_with_margin_n.
    - wheel_load_max_n: largest normal force, with the preload needed if it is positive.
    - torque_max_n_m, wheel_speed_max_rad_s: at the axle of any wheel; motor_torque_max_n_m,
      motor_speed_max_rad_s: through gear and efficiency, which counts against the motor while it
      brakes as well: 1 - efficiency^2 too much at most.
    - power_peak_w, regenerated_peak_w: of all wheels together, both positive.
    - condition_number; clearance_m, gap_m: room below and between the wheels.
    - sphere_rate_worst_rad_s, sphere_acceleration_worst_rad_s2: about the worst axis, within the
      limits of the wheels.
    - row_largest_correction: largest |C_s - 1| of wheels with two rows (11); 0 of others.
    """
    built = with_layout(platform, layout)
    gap = wheel_gap(built)
    try:
        model = built.load_model()
        shape = _of_geometry(built)  # also with every row of rollers touching the drives turn it
    except (InputError, SlipConditionError):
        return None
    if gap < 0.0:
        return None
    loads = loads_on(model, ridden)
    needed = float(loads.preload_needed.max())
    if not np.isfinite(needed):
        return None
    figures = _carried(model, loads, needed) | shape
    figures["gap_m"] = gap
    return Measured(layout, figures, _worst(loads))


def measure_fully(platform: Platform, layout: Layout, ridden: Ridden) -> Measured | None:
    """Measure as `measure`, with what only a chosen layout is asked for.

    - torque_rms_n_m: of the wheel that has most; slip_share, lift_share: of the ticks, as the
      platform is; a wheel that does not touch slips, as in the figures of a run; lift_off_m_s2: of
      the stage, worst horizontal direction; sphere acceleration by traction, worst axis;
      ripple_rms, of wheels with two rows.
    - preload_with_margin_n: as preload_needed_n, at the platform's margin of friction.
    """
    found = measure(platform, layout, ridden)
    if found is None:
        return None
    built = with_layout(platform, layout)
    model = built.load_model()
    loads = loads_on(model, ridden)
    able = reserve(model)
    touching = np.all(loads.normal > 0.0, axis=1)
    grip = model.friction / model.traction_margin
    gain = model.preload_gain
    missing = (np.abs(loads.drive) / grip - loads.normal)[:, gain > 0.0]
    more = {
        "torque_rms_n_m": float(np.sqrt(np.mean(loads.torque**2, axis=0)).max()),
        "preload_with_margin_n": float((missing / gain[gain > 0.0]).max()),
        "slip_share": float(np.mean(np.any(loads.traction_use > 1.0, axis=1))),
        "lift_share": float(np.mean(~touching)),
        "lift_off_m_s2": able.lift_off.worst,
        "acceleration_by_traction_rad_s2": able.by_traction.worst,
        "ripple_rms": _ripple(built),
    }
    return Measured(layout, found.figures | more, found.worst)


def loads_on(model: LoadModel, ridden: Ridden) -> Loads:
    """Give the loads of a model at the ticks."""
    drive = ridden.moment @ model.drive_from_moment.T
    return loads_of_wrench(model, ridden.moment, ridden.force, drive, ridden.w, ridden.alpha)


def _carried(model: LoadModel, loads: Loads, needed: float) -> Figures:
    power = loads.power.sum(axis=1)
    torque, speed = float(np.abs(loads.torque).max()), float(np.abs(loads.speed).max())
    motor = model.drive
    return {
        "preload_needed_n": needed,
        "wheel_load_max_n": float((loads.normal + max(needed, 0.0) * model.preload_gain).max()),
        "torque_max_n_m": torque,
        "wheel_speed_max_rad_s": speed,
        "motor_torque_max_n_m": torque / (motor.gear * motor.efficiency),
        "motor_speed_max_rad_s": motor.gear * speed,
        "power_peak_w": float(max(power.max(), 0.0)),
        "regenerated_peak_w": float(max(-power.min(), 0.0)),
    }


def _of_geometry(platform: Platform) -> Figures:
    geometry = platform.geometry()
    room = headroom(geometry, platform.limits_of_each_wheel())
    return {
        "condition_number": geometry.condition_number,
        "clearance_m": clearance(platform),
        "sphere_rate_worst_rad_s": room.worst_rate,
        "sphere_acceleration_worst_rad_s2": room.worst_acceleration,
        "row_largest_correction": _correction(platform),
    }


def has_rows(platform: Platform) -> bool:
    """Whether all wheels have two rows of rollers described, and few enough to try all."""
    return len(platform.wheel) <= _WITH_ROWS and all(wheel.rows for wheel in platform.wheel)


def _correction(platform: Platform) -> float:
    if not has_rows(platform):
        return 0.0
    rows = [wheel.rows for wheel in platform.wheel if wheel.rows]
    corrections = row_corrections(platform.geometry(), rows).values()
    return max(float(np.linalg.norm(each - np.eye(3), 2)) for each in corrections)


def _ripple(platform: Platform) -> float:
    if not has_rows(platform):
        return 0.0
    rows = [wheel.rows for wheel in platform.wheel if wheel.rows]
    return row_effect(platform.geometry(), rows).ripple


def _worst(loads: Loads) -> NDArray[np.intp]:
    """The ticks at which a figure is at its largest, each once."""
    power = loads.power.sum(axis=1)
    columns: list[Array] = [loads.preload_needed, power, -power]
    for each in (np.abs(loads.torque), np.abs(loads.speed), loads.normal, -loads.normal):
        columns += list(each.T)
    return np.unique([int(np.argmax(column)) for column in columns]).astype(np.intp)
