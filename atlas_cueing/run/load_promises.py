"""Limits of a platform that promise more than its contacts and drives can give."""

from math import inf

from ..loads import Reserve, reserve
from ..loads.reserve import Reach
from ..scenario import Platform
from ..wheels import headroom

_AXES = "xyz"


def broken_promises(platform: Platform, found: Reserve | None = None) -> list[str]:
    """List what the limits allow and contacts or drives cannot give from rest, a line each.

    found: the platform's reserve, where it is known already.

    Raises InputError for a platform without masses.
    """
    model = platform.load_model()
    found = found or reserve(model)
    room = headroom(platform.geometry(), platform.limits_of_each_wheel())
    promised = Reach(room.acceleration, room.worst_acceleration)
    lines = _at_rest(platform, found)
    stage = platform.stage_limits.acceleration_m_s2
    lines += _beyond("stage_limits.acceleration_m_s2", "along", stage, found.lift_off.axes,
                     "m/s2 a wheel lifts off")  # fmt: skip
    lines += _sphere(promised, found.by_traction, "a wheel slips")
    if found.by_torque is not None:
        lines += _sphere(promised, found.by_torque, "the torque of a drive ends")
    motor, gear = model.drive.motor_speed, model.drive.gear
    fastest = gear * max(platform.limits_of_each_wheel().speed)
    if motor is not None and fastest > motor:
        lines.append(
            f"wheel_limits.speed_rad_s needs {fastest:.4g} rad/s of a motor, which ends at"
            f" {motor:.4g}"
        )
    return lines


def _at_rest(platform: Platform, found: Reserve) -> list[str]:
    lines, rest = [], found.rest
    for k, wheel in enumerate(platform.wheel):
        normal, most = float(rest.normal[k]), wheel.load_limit_n
        if not normal > 0.0:
            lines.append(f"wheel.{k} does not touch at rest: normal force {normal:.4g} N")
        if most is not None and normal > most:
            lines.append(f"wheel.{k} carries {normal:.4g} N at rest, load_limit_n = {most:.4g}")
        if normal > 0.0 and not rest.traction_use[k] <= 1.0:
            lines.append(f"wheel.{k} slips at rest: traction use {rest.traction_use[k]:.3g}")
    return lines


def _sphere(promised: Reach, given: Reach, what: str) -> list[str]:
    key = "wheel_limits.acceleration_rad_s2, rad/s2 of the sphere"
    lines = _beyond(key, "about", promised.axes, given.axes, f"rad/s2 {what}")
    if given.worst < promised.worst:
        lines.append(
            f"{key} about the worst axis: {promised.worst:.4g} is allowed, but from"
            f" {given.worst:.4g} rad/s2 {what}"
        )
    return lines


def _beyond(
    key: str, how: str, promised: tuple[float, ...], given: tuple[float, ...], what: str
) -> list[str]:
    return [
        f"{key} {how} {axis}: {limit:.4g} is allowed, but from {most:.4g} {what}"
        for axis, limit, most in zip(_AXES, promised, given, strict=True)
        if most < limit < inf
    ]
