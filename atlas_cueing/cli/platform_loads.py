"""The figures and texts of `platform` beyond kinematics: limits, loads from rest, double rows."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .text import aligned

if TYPE_CHECKING:
    from ..loads import Reserve
    from ..scenario import Platform

_MOST_WITH_ROWS = 8  # wheels: there are 2^N combinations of rows


def sizes(platform: "Platform") -> dict[str, Any]:
    """Radii, limits and travel of a platform by name, the unit in the name."""
    wheels, stage = platform.limits_of_each_wheel(), platform.stage_limits
    return {
        "sphere_radius_m": platform.sphere.radius_m,
        "wheel_radius_m": tuple(wheel.radius_m for wheel in platform.wheel),
        "wheel_speed_limit_rad_s": wheels.speed,
        "wheel_acceleration_limit_rad_s2": wheels.acceleration,
        "wheel_jerk_limit_rad_s3": wheels.jerk,
        "stage_travel_m": stage.travel_m,
        "stage_speed_limit_m_s": stage.speed_m_s,
        "stage_acceleration_limit_m_s2": stage.acceleration_m_s2,
        "stage_jerk_limit_m_s3": stage.jerk_m_s3,
    }


def row_figures(platform: "Platform") -> dict[str, Any]:
    """Effect of wheels with two rows of rollers; empty unless the file describes all of them."""
    from ..wheels import row_effect, tilt

    rows = [wheel.rows for wheel in platform.wheel if wheel.rows]
    if len(rows) != len(platform.wheel) or not platform.geometry().slip_free:
        return {}
    if len(rows) > _MOST_WITH_ROWS:
        return {"row_tilt_rad": tuple(tilt(platform.sphere.radius_m, each) for each in rows)}
    effect = row_effect(platform.geometry(), rows)
    return {
        "row_tilt_rad": effect.tilt,
        "row_largest_correction": effect.largest_correction,
        "row_mean_correction": effect.mean_correction,
        "row_ripple_rms": effect.ripple,
        "row_drift_mean_rad_per_turn": effect.drift_mean,
        "row_drift_max_rad_per_turn": effect.drift_max,
    }


def load_figures(platform: "Platform", found: "Reserve") -> dict[str, Any]:
    """Loads of a platform from rest by name, the unit in the name.

    `sphere_acceleration_by_torque_...` are None where the platform names no torque.
    """
    model, torque = platform.load_model(), found.by_torque
    return {
        "mass_kg": model.body.mass,
        "com_m": model.body.com_S,
        "inertia_about_centre_kg_m2": model.body.inertia_S,
        "rest_normal_force_n": found.rest.normal.tolist(),
        "rest_support_force_n": found.rest.support.tolist(),
        "rest_wheel_torque_n_m": found.rest.torque.tolist(),
        "rest_traction_use": found.rest.traction_use.tolist(),
        "rest_all_in_contact": bool(found.rest.all_in_contact),
        "rest_preload_needed_n": float(found.rest.preload_needed),
        "lift_off_acceleration_along_axes_m_s2": found.lift_off.axes,
        "lift_off_acceleration_horizontal_m_s2": found.lift_off.worst,
        "sphere_acceleration_by_traction_about_axes_rad_s2": found.by_traction.axes,
        "sphere_acceleration_by_traction_about_worst_axis_rad_s2": found.by_traction.worst,
        "sphere_acceleration_by_torque_about_axes_rad_s2": torque and torque.axes,
        "sphere_acceleration_by_torque_about_worst_axis_rad_s2": torque and torque.worst,
        "preload_gain": found.preload_gain.tolist(),
        "wheel_space_inertia_kg_m2": found.wheel_space_inertia.tolist(),
    }


def loads_summary(figures: Mapping[str, Any]) -> list[str]:
    """The lines printed of figures by `load_figures` and `row_figures`."""
    plain = {name: value for name, value in figures.items() if not _is_matrix(value)}
    lines = aligned([(name, _text(value)) for name, value in plain.items()], "")
    for name, value in figures.items():
        if _is_matrix(value):
            lines += [name, *("  " + " ".join(f"{x + 0.0:12.6f}" for x in row) for row in value)]
    return lines


def _is_matrix(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) > 0 and isinstance(value[0], list | tuple)


def _text(value: Any) -> str:
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "  ".join(_text(x) for x in value) or "none"
    if value is None:
        return "not named by the platform"
    return f"{value + 0.0:.6g}" if isinstance(value, float) else str(value)
