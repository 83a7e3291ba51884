"""What a method pays in felt rate for direction: a curve a family, one parameter swept in each."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import degrees
from pathlib import Path
from typing import Any

from .flying import Order, Ride

SWEPT: Mapping[str, tuple[str, Sequence[float]]] = {
    "attitude": ("", ()),
    "blend": ("align_rate_deg_s", (0.5, 1.0, 3.0, 6.0, 12.0, 25.0)),
    "force": ("align_rate_deg_s", (6.0, 12.0, 25.0, 60.0, 180.0)),
    "perceptual": ("felt_rate_deg_s", (1.0, 3.0, 5.0, 8.0, 15.0, 30.0)),
    "hedge": ("felt_rate_deg_s", (1.0, 3.0, 5.0, 8.0, 15.0, 30.0)),
    "classical": ("tilt_rate_deg_s", (1.0, 3.0, 6.0, 12.0, 25.0)),
    "still": ("", ()),
}
"""The key of each family that is swept, "" for none, and its values."""


@dataclass(frozen=True)
class Point:
    """A value of the swept key (None: its default), and mean errors: deg, and felt deg/s."""

    value: float | None
    direction: float
    rate: float


def orders(
    scenarios: Sequence[Path], methods: Sequence[str]
) -> dict[str, dict[float | None, list[Order]]]:
    """The rides of each family by value."""
    return {
        name: {
            value: [Order(path, _settings(name, value)) for path in scenarios]
            for value in (None, *SWEPT[name][1])
        }
        for name in methods
        if name in SWEPT
    }


def _settings(name: str, value: float | None) -> tuple[str, ...]:
    method = f"cueing.method={name}"
    return (method,) if value is None else (method, f"cueing.{SWEPT[name][0]}={value}")


def curves(
    asked: Mapping[str, Mapping[float | None, Sequence[Order]]], rides: Mapping[Order, Ride]
) -> dict[str, list[Point]]:
    """The points of each family; a value with a ride that failed has none."""
    found: dict[str, list[Point]] = {}
    for name, values in asked.items():
        for value, wanted in values.items():
            metrics = [
                rides[order]["metrics"] for order in wanted if rides[order]["result"] == "ok"
            ]
            if len(metrics) == len(wanted):
                direction, rate = (
                    degrees(sum(m[figure] for m in metrics) / len(metrics))
                    for figure in ("direction_rms_rad", "perceived_rate_rms_rad_s")
                )
                found.setdefault(name, []).append(Point(value, direction, rate))
    return found


def draw(points: Mapping[str, Sequence[Point]], title: str, file: Path) -> None:
    """Draw the curves into a file, of the kind that its name ends in; defaults are filled."""
    import matplotlib as mpl

    mpl.use("Agg")
    mpl.rcParams["svg.hashsalt"] = "atlas"  # the same bytes for the same picture
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(8.0, 5.5), layout="constrained")
    for name, family in points.items():
        swept = sorted((p for p in family if p.value is not None), key=lambda p: p.value or 0.0)
        (line,) = axes.plot(
            [p.rate for p in swept], [p.direction for p in swept], "o-", ms=4, mfc="white"
        )
        for point in (swept[0], swept[-1]) if swept else ():
            axes.annotate(
                f"{point.value:g}",
                (point.rate, point.direction),
                xytext=(4, 4),
                textcoords="offset points",
                fontsize=7,
            )
        key = f", {SWEPT[name][0].replace('_deg_s', ', deg/s').replace('_', ' ')}" if swept else ""
        default = next(p for p in family if p.value is None)
        axes.plot(
            default.rate, default.direction, "o", ms=9, color=line.get_color(), label=f"{name}{key}"
        )
    axes.set(
        xlabel="felt rate that is not the vehicle's, rms, deg/s",
        ylabel="direction of the force, rms, deg",
        title=title,
    )
    axes.set_xlim(left=0.0), axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    axes.legend(title="large: default", fontsize=8)
    figure.savefig(file, dpi=130, metadata=_undated(file))
    plt.close(figure)


def _undated(file: Path) -> dict[str, Any]:
    return {"Date": None} if file.suffix == ".svg" else {}
