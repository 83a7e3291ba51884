"""What is printed about a run and about a platform."""

from typing import Any

from ..batch import RunResult
from ..rotation import Mat3, Vec3
from ..scenario import Platform
from ..wheels import headroom
from .text import aligned


def run_summary(result: RunResult) -> str:
    """Result, metrics and limit use of a run, for people."""
    speed = result.duration / result.wall if result.wall > 0.0 else 0.0
    head = [
        ("result", f"{result.result}  {result.reason}".rstrip()),
        ("log", str(result.log)),
        ("ticks", str(result.ticks)),
        ("duration", f"{result.duration:.2f} s, flown at {speed:.1f} times real time"),
        ("violations", str(len(result.evaluation.violations))),
    ]
    metrics = [(name, f"{value:.6g}") for name, value in result.evaluation.metrics.items()]
    use = [(name, f"{100.0 * value:.4f} %") for name, value in result.evaluation.limit_use.items()]
    return "\n".join([*aligned(head, ""), "metrics", *aligned(metrics), "largest use of each limit", *aligned(use)])


def kinematics(platform: Platform) -> dict[str, Any]:
    """Kinematics of a platform by name, unit in the name; `sphere_from_wheels` is None for a singular geometry."""
    geometry = platform.geometry()
    room = headroom(geometry, platform.wheel_speed_limits())
    return {
        "name": platform.name,
        "induced_rows": geometry.induced_rows,
        "wheels_from_sphere": geometry.wheels_from_sphere,
        "sphere_from_wheels": geometry.sphere_from_wheels if geometry.slip_free else None,
        "determinant": geometry.determinant,
        "condition_number": geometry.condition_number,
        "slip_free": geometry.slip_free,
        "sphere_rate_about_axes_rad_s": room.rate,
        "sphere_rate_about_worst_axis_rad_s": room.worst_rate,
        "sphere_acceleration_about_axes_rad_s2": room.acceleration,
        "sphere_acceleration_about_worst_axis_rad_s2": room.worst_acceleration,
    }


def platform_summary(figures: dict[str, Any]) -> str:
    """The same for people."""
    inverse: Mat3 | None = figures["sphere_from_wheels"]
    numbers = [(name, _number(value)) for name, value in figures.items() if not _is_matrix(name)]
    return "\n".join(
        [
            *aligned(numbers, ""),
            "induced rows, frame W (Eq. 11)",
            *_rows(figures["induced_rows"]),
            "wheels from sphere, J^-1 (Eq. 22)",
            *_rows(figures["wheels_from_sphere"]),
            "sphere from wheels, J (Eq. 18)",
            *(_rows(inverse) if inverse else ["  none: the geometry is singular"]),
        ]
    )


def _is_matrix(name: str) -> bool:
    return name in ("induced_rows", "wheels_from_sphere", "sphere_from_wheels")


def _rows(matrix: Mat3) -> list[str]:
    return [_row(row) for row in matrix]


def _row(row: Vec3) -> str:
    # Adding zero takes the sign off a negative zero.
    return "  " + " ".join(f"{x + 0.0:12.6f}" for x in row)


def _number(value: Any) -> str:
    if isinstance(value, tuple):
        return "  ".join(f"{x:.6g}" for x in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)
