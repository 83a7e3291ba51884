"""Every metric, declared once: name, unit, definition, and where it is shown.

`METRICS` lists the metrics of each class that computes some, in the order in which it gives them;
`Metrics` makes one of each class. Equations, frames and sources stand with the classes. To add a
metric, compute it in a class and declare it here; a new class becomes a new key.
"""

from collections.abc import Mapping

from .actuation import Actuation
from .coriolis import Coriolis
from .deviation import Deviation
from .duration import Duration
from .fidelity import Fidelity
from .metric import Cell, Metric, Phrase, Shown
from .mismatch import Mismatch
from .perceived import Perceived
from .run_columns import Figures
from .units import (
    COUNT,
    DURATION,
    JND,
    M_S,
    M_S2,
    NUMBER,
    RAD,
    RAD_S,
    RAD_S2,
    SHARE,
    WHEEL_RAD_S,
    WHEEL_RAD_S2,
    M,
    S,
    Unit,
)

_STATISTICS = {"rms": "Root mean square", "p95": "95 % quantile", "max": "Maximum"}


def _spread(
    quantity: str, unit: Unit, error: str, rms: Shown = Shown.LISTS_ONLY, row: str = ""
) -> tuple[Metric, ...]:
    """Rms, 95 % quantile and maximum of an `error`.

    rms: where the rms is shown; row: the title of their row in what `run` prints, "" for none.
    """
    return tuple(
        Metric(
            f"{quantity}_{statistic}",
            unit,
            f"{words} of {error}.",
            rms if statistic == "rms" else Shown.LISTS_ONLY,
            Cell(row, statistic) if row else None,
        )
        for statistic, words in _STATISTICS.items()
    )


def _axes(prefix: str, what: str) -> tuple[Metric, ...]:
    """Likeness of the pilot's and the rider's `what` along or about each axis of the cabin."""
    return tuple(
        metric for axis in "xyz" for metric in _axis(f"{prefix}_{axis}", f"{what}, axis {axis}")
    )


def _axis(prefix: str, what: str) -> tuple[Metric, ...]:
    both = f"the pilot's and the rider's {what}"
    return (
        Metric(f"{prefix}_correlation", NUMBER, f"Peak of the cross-correlation of {both}."),
        Metric(f"{prefix}_delay", S, f"Delay of the rider's {what}, where they correlate best."),
        Metric(f"{prefix}_missing", SHARE, f"Ticks with a cue for the pilot only: {what}."),
        Metric(f"{prefix}_false", SHARE, f"Ticks with a cue for the rider only: {what}."),
        Metric(f"{prefix}_scaled", SHARE, f"Ticks at which both have a cue, not alike: {what}."),
    )


def _turns(axis: str, letter: str) -> Metric:
    return Metric(
        f"turns_{axis}",
        NUMBER,
        f"Net turns of the cabin about its own {letter}, with sign.",
        Shown.RUN_HEADLINE,
        Phrase("net turns", f"{axis} {{:+z.2f}}"),
    )


def _mismatch(
    leg: str, text: str, meaning: str, definition: str, shown: Shown = Shown.ERROR_HEADLINE
) -> Metric:
    name = f"mismatch_{leg}" if leg else "mismatch"
    return Metric(name, JND, definition, shown, Phrase("mismatch", text), meaning)


METRICS: Mapping[type[Figures], tuple[Metric, ...]] = {
    Mismatch: (
        _mismatch(
            "",
            "{:.2f} JND",
            "how far the ride is from the flight, as far as a head feels it: 1 is an error that is "
            "just noticed, all the way",
            "M = sqrt(mean |f_r - f_p|^2 / (0.17 m/s2)^2 + mean |C(w_r - w_p)|^2 / (3 deg/s)^2): "
            "specific force f and angular rate w of rider less pilot, the rate behind the "
            "semicircular canals C, in just noticeable differences (Reid & Nahon 1985).",
            Shown.ERROR_HEADLINE | Shown.BATCH,
        ),
        _mismatch(
            "magnitude",
            "magnitude {:.2f}",
            "its leg of the size of the force, which no turn of the cabin changes",
            "Leg of M by the size of the force, which no turn of the cabin changes: "
            "sqrt(mean (|f_r| - |f_p|)^2) / 0.17 m/s2.",
        ),
        _mismatch(
            "direction",
            "direction {:.2f}",
            "its leg of the direction of the force, which the cabin can keep by turning",
            "Leg of M by the direction of the force, theta the angle between both: "
            "sqrt(mean 4 |f_r| |f_p| sin^2(theta / 2)) / 0.17 m/s2.",
        ),
        _mismatch(
            "rate",
            "rate {:.2f}",
            "its leg of the turning that is felt and is not the vehicle's",
            "Leg of M by the angular rate behind the canals, 5.73 s with adaptation of 80 s "
            "(Telban & Cardullo 2005): sqrt(mean |C(w_r - w_p)|^2) / 3 deg/s.",
        ),
        _mismatch(
            "worst_10s",
            "worst 10 s {:.2f}",
            "the worst ten seconds of it, which riders remember",
            "Largest M of any 10 s; of a shorter run its M.",
            Shown.ERROR_HEADLINE | Shown.BATCH,
        ),
    ),
    Deviation: (
        *_spread(
            "force",
            M_S2,
            "the specific force felt by the rider less that felt by the pilot",
            Shown.ERROR_HEADLINE | Shown.BATCH,
            "specific force",
        ),
        *_spread(
            "direction",
            RAD,
            "the angle between the specific forces felt by rider and pilot",
            Shown.ERROR_HEADLINE | Shown.BATCH,
            "force direction",
        ),
        Metric("direction_counted", SHARE, "Ticks at which both forces have a direction."),
        *_spread(
            "rate",
            RAD_S,
            "the angular rate of the rider less that of the pilot",
            Shown.ERROR_HEADLINE | Shown.BATCH,
            "angular rate",
        ),
        *_spread(
            "attitude",
            RAD,
            "the angle from the vehicle's attitude to the cabin's, heading at the start left out",
            Shown.ERROR_HEADLINE,
            "attitude",
        ),
        *(
            Metric(
                f"extra_rate_{statistic}",
                RAD_S,
                f"{words} of the rate error over the ticks at which no wheel is limited.",
            )
            for statistic, words in (
                ("rms", "Root mean square"),
                ("p99", "99 % quantile"),
                ("max", "Maximum"),
            )
        ),
    ),
    Fidelity: (
        *_spread(
            "perceived_force",
            M_S2,
            "the error of specific force behind the otoliths",
            Shown.ERROR_HEADLINE,
        ),
        *_spread(
            "perceived_rate",
            RAD_S,
            "the error of angular rate behind the semicircular canals",
            Shown.ERROR_HEADLINE,
        ),
        *_axes("force", "specific force"),
        *_axes("rate", "angular rate"),
        *_axes("perceived_force", "specific force behind the otoliths"),
        *_axes("perceived_rate", "angular rate behind the canals"),
    ),
    Perceived: (
        Metric(
            "perceived_tilt_rms",
            RAD,
            "Rms angle between the up that rider and pilot perceive, by an observer of tilt and "
            "turn in the dark (Rader, Oman & Merfeld 2009).",
            Shown.ERROR_HEADLINE | Shown.BATCH,
            Phrase("perceived", "tilt {:.2f} deg", RAD.factor),
            "a second opinion, by a model of perception: how far the tilt that the rider makes of "
            "it is from the pilot's",
        ),
        Metric(
            "perceived_turn_rms",
            RAD_S,
            "Rms difference of the angular rates that rider and pilot perceive, by the same "
            "observer.",
            Shown.ERROR_HEADLINE | Shown.BATCH,
            Phrase("perceived", "turn {:.2f} deg/s", RAD_S.factor),
            "likewise of the turning",
        ),
    ),
    Coriolis: (
        Metric("coriolis_rms", RAD_S2, "Rms cross-coupling that a nod gives the rider."),
        Metric("coriolis_p95", RAD_S2, "95 % quantile of the rider's cross-coupling."),
        Metric("vehicle_coriolis_rms", RAD_S2, "Rms cross-coupling that a nod gives the pilot."),
        Metric("vehicle_coriolis_p95", RAD_S2, "95 % quantile of the pilot's cross-coupling."),
        _turns("roll", "x"),
        _turns("pitch", "y"),
        _turns("yaw", "z"),
    ),
    Actuation: (
        Metric("cue_lag_rms", RAD, "Rms angle from the cue's orientation to the motion's."),
        Metric(
            "cue_lag_max",
            RAD,
            "Largest angle from the cue's orientation to the motion's.",
            summary=Phrase("lag behind cue", "at most {:.3f} deg", RAD.factor),
        ),
        Metric("cue_lag_rms", M, "Rms distance from the cue's position to the motion's."),
        Metric(
            "cue_lag_max",
            M,
            "Largest distance from the cue's position to the motion's.",
            summary=Phrase("lag behind cue", "{:.2f} mm", 1e3),
        ),
        Metric(
            "wheels_limited",
            SHARE,
            "Ticks at which a limit of the wheels kept the motion from the cue.",
            Shown.RUN_HEADLINE | Shown.BATCH,
            Phrase("limited", "wheels {:.2%}"),
        ),
        Metric(
            "stage_limited",
            SHARE,
            "Ticks at which a limit of the stage kept the motion from the cue.",
            Shown.RUN_HEADLINE | Shown.BATCH,
            Phrase("limited", "stage {:.2%} of the time"),
        ),
        Metric(
            "added_angular_acceleration_rms",
            RAD_S2,
            "Rms angular acceleration that smoothing adds to the cue while no wheel is limited.",
        ),
        Metric(
            "added_stage_acceleration_rms",
            M_S2,
            "Rms acceleration that smoothing adds to the cue while the stage is not limited.",
        ),
        Metric("wheel_speed_max", WHEEL_RAD_S, "Largest speed of any wheel."),
        Metric("wheel_acceleration_max", WHEEL_RAD_S2, "Largest acceleration of any wheel."),
        Metric("stage_travel_max", M, "Largest distance along an axis of the stage."),
        Metric("stage_speed_max", M_S, "Largest speed along an axis of the stage."),
        Metric("stage_acceleration_max", M_S2, "Largest acceleration along an axis of the stage."),
    ),
    Duration: (
        Metric("ticks", COUNT, "Ticks of the run."),
        Metric("duration", DURATION, "Time from the first tick to the last."),
    ),
}
