"""A log that holds a flight and nothing else, as one that was imported: what it is, and its state.

There are no limits to judge it by. What can be judged is whether it can be flown: finite numbers,
rotations, equal steps, believable forces and rates, and rates that explain the attitude.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import tomli_w

from ..errors import InputError
from ..printable import printable, utf8
from ..recording import Log
from ..rotations import Array, exp, geodesic, length, multiply
from ..scenario import presets, regular_vehicle
from ..scenario.overrides import parse_overrides
from .attachments import PLATFORM

FLIGHT = "/vehicle"
_CUED = ("/cue", "/motion", "/wheels")
_NAMED = ("origin", "map", "attitude", "force_at", "grid")  # of the metadata of an imported flight
_LONGEST_NAME = 60  # characters


@dataclass(frozen=True, slots=True)
class FlightReview:
    """What is known of a flight that nobody has cued yet.

    findings: why it cannot be flown as it is. metrics: figures by name, the unit in the name.
    """

    log: Log
    findings: tuple[str, ...]
    metrics: dict[str, float]

    @property
    def clean(self) -> bool:
        """Whether it can be flown."""
        return not self.findings

    @property
    def verdict(self) -> str:
        """The verdict as text: clean, or how many findings."""
        count = len(self.findings)
        return f"{count} finding{'s' * (count > 1)}" if count else "clean"

    def to_json(self) -> dict[str, object]:
        """The review as JSON, units in the names."""
        return {
            "verdict": self.verdict,
            "kind": "flight",
            "log": str(self.log.path),
            "findings": list(self.findings),
            "violations": [],
            "metadata": dict(self.log.metadata),
            "notes": list(self.log.notes),
            "metrics": self.metrics,
        }

    def rows(self) -> list[tuple[str, str]]:
        """Names and values to be shown to people."""
        figures, told = self.metrics, self.log.metadata
        flown = f"{figures['duration_s']:.2f} s, {figures['states']:.0f} states"
        return [
            ("verdict", self.verdict),
            ("log", str(self.log.path)),
            ("holds", "a flight alone, not cued yet (/vehicle)"),
            ("flight", f"{flown}, step {1e3 * figures['step_s']:.4f} ms"),
            *((name.replace("_", " "), told[name]) for name in _NAMED if told.get(name)),
            ("force", f"{figures['force_rms_m_s2']:.3f} m/s^2 rms"),
            ("rate", f"{np.degrees(figures['rate_rms_rad_s']):.3f} deg/s rms"),
            (
                "attitude",
                f"{np.degrees(figures['attitude_rate_rms_rad_s']):.3f} deg/s rms that the rates do"
                " not explain",
            ),
            *(("note", note) for note in self.log.notes),
            *(("finding", finding) for finding in self.findings),
            ("next", f"atlas-cueing recue {self.log.path} --set platform.preset=NAME -o NEW.mcap"),
        ]


def is_flight_alone(log: Log) -> bool:
    """Whether a log has a flight, and neither a cue nor a motion."""
    return FLIGHT in log.tables and not any(topic in log.tables for topic in _CUED)


def review_flight(log: Log) -> FlightReview:
    """Judge a flight that nobody has cued.

    Raises LogError when a field of `/vehicle` is missing.
    """
    return FlightReview(log, tuple(_objections(log)), _figures(log))


def scenario_of_flight(log: Log, settings: Sequence[str]) -> str:
    """Return the scenario (TOML) that cues a flight alone, as far as the log tells it.

    The platform is the one in the log, or the one that the `KEY=VALUE` settings name. Raises
    InputError when there is none.
    """
    keys = {key[:2] for key in parse_overrides(settings)}
    platform = {"file": PLATFORM} if PLATFORM in log.attachments else {}
    if not platform and not keys & {("platform", "preset"), ("platform", "file")}:
        raise InputError(
            f"{log.path}: the log holds a flight without a platform; name one with --set"
            f" platform.preset=NAME, allowed: {', '.join(sorted(presets()))}; or with --set"
            " platform.file=FILE"
        )
    name = printable(utf8(log.metadata.get("scenario", "") or log.path.stem))[:_LONGEST_NAME]
    flight = {"source": "recording", "log": f"{_fit(printable(utf8(log.path.stem)))}.mcap"}
    return tomli_w.dumps({"name": _fit(name), "vehicle": flight, "platform": platform})


def _fit(name: str) -> str:
    """The name with what no scenario may be called by left out."""
    kept = "".join(c if c.isalnum() or c in " ._-" else "_" for c in name).strip(" .")
    return kept or "flight"


def _objections(log: Log) -> list[str]:
    try:
        regular_vehicle(log)
    except InputError as error:
        return list(error.lines)
    return []


def _figures(log: Log) -> dict[str, float]:
    time, q_NB = log.column(FLIGHT, "time_s"), log.vector(FLIGHT, "q_nb")
    w, f = log.vector(FLIGHT, "w"), log.vector(FLIGHT, "f")
    steps = np.diff(time)
    with np.errstate(all="ignore"):  # what is not finite is found, and has no figures
        return {
            "states": float(len(time)),
            "duration_s": float(np.sum(steps)),
            "step_s": float(np.median(steps)) if len(steps) else 0.0,
            "force_rms_m_s2": _rms(length(f)),
            "force_max_m_s2": float(np.max(length(f), initial=0.0)),
            "rate_rms_rad_s": _rms(length(w)),
            "rate_max_rad_s": float(np.max(length(w), initial=0.0)),
            "attitude_rate_rms_rad_s": _unexplained(steps, q_NB, w),
        }


def _unexplained(steps: Array, q_NB: Array, w_B: Array) -> float:
    """Rms, rad/s, of the turn between two states that the mean of their rates does not make."""
    turn = exp(0.5 * steps[:, None] * (w_B[:-1] + w_B[1:]))
    return _rms(geodesic(multiply(q_NB[:-1], turn), q_NB[1:]) / steps) if len(steps) else 0.0


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else 0.0
