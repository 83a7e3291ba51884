"""Metrics that only some runs have, declared as those of `metric_table`.

`CONTACT_LOADS` are those of a platform with masses, `CONSISTENCY` those of one whose wheels can
roll without slip, `RELATIVE` those of a run beside another of the same flight.
"""

from .metric import Metric, Phrase, Shown
from .units import N_M, NUMBER, RAD, SHARE, WHEEL_RAD_S, WHEEL_RAD_S2, J, N, W

RELATIVE = (
    Metric(
        "mismatch_ratio",
        NUMBER,
        "R = max(M, 1) / max(M_still, 1), with M_still the mismatch of the same flight by method "
        "still on the same platform.",
        Shown.ERROR_HEADLINE | Shown.BATCH,
        meaning="how far that is beside not turning the cabin at all, which has 1: below 1 the "
        "method has won something",
    ),
)
"""Metrics that a run has only beside another run of the same flight."""

CONTACT_LOADS = (
    Metric(
        "traction_use_max",
        NUMBER,
        "Largest share of the friction in use by any wheel, |F| / (mu n); 100 without contact.",
        Shown.RUN_HEADLINE | Shown.BATCH,
        Phrase("traction", "at most {:.2f} of the friction in use"),
    ),
    Metric(
        "traction_slip",
        SHARE,
        "Ticks at which a wheel slips: it does not touch, or needs more than its friction.",
        Shown.RUN_HEADLINE | Shown.BATCH,
        Phrase("traction", "slip {:.2%}"),
    ),
    Metric("normal_min", N, "Least normal force of any wheel.", Shown.RUN_HEADLINE),
    Metric("normal_max", N, "Largest normal force of any wheel."),
    Metric(
        "lift_off",
        SHARE,
        "Ticks at which a wheel does not touch.",
        Shown.RUN_HEADLINE,
        Phrase("traction", "lift-off {:.2%} of the time"),
    ),
    Metric(
        "preload_needed",
        N,
        "Further force straight down with which no wheel slips; negative: a reserve.",
        Shown.RUN_HEADLINE | Shown.BATCH,
        Phrase("preload needed", "{:+z.2f} kN straight down", 1e-3),
    ),
    Metric(
        "wheel_torque_max",
        N_M,
        "Largest torque at any axle.",
        Shown.RUN_HEADLINE,
        Phrase("wheel torque", "at most {:.1f} N m"),
    ),
    Metric(
        "wheel_torque_rms",
        N_M,
        "Rms torque of the wheel where it is largest.",
        Shown.RUN_HEADLINE,
        Phrase("wheel torque", "{:.1f} N m rms"),
    ),
    Metric("motor_speed_max", WHEEL_RAD_S, "Largest speed of any motor."),
    Metric(
        "power_peak",
        W,
        "Largest power of all wheels together, at the axles.",
        Shown.RUN_HEADLINE,
        Phrase("power", "{:.2f} kW at most", 1e-3),
    ),
    Metric(
        "power_regenerated_peak",
        W,
        "Largest power of all wheels together that comes back.",
        Shown.RUN_HEADLINE,
        Phrase("power", "{:z.2f} kW back", 1e-3),
    ),
    Metric(
        "energy",
        J,
        "Energy from the axles to the motion, of each wheel for itself.",
        summary=Phrase("energy", "{:.1f} kJ", 1e-3),
    ),
    Metric(
        "energy_regenerated",
        J,
        "Energy from the motion to the axles, of each wheel for itself.",
        summary=Phrase("energy", "{:.1f} kJ back", 1e-3),
    ),
    Metric(
        "energy_supplied", J, "Energy from the supply, by the efficiency, less what it takes back."
    ),
)
"""Metrics of `ContactLoads`; a platform without masses has none of them."""

CONSISTENCY = (
    Metric(
        "wheel_speed_residual_max",
        WHEEL_RAD_S,
        "Largest difference of a logged wheel speed from J^-1 times the logged rate.",
    ),
    Metric(
        "wheel_acceleration_residual_max",
        WHEEL_RAD_S2,
        "Largest difference of a logged wheel acceleration from J^-1 times the logged one.",
    ),
    Metric(
        "orientation_drift_final",
        RAD,
        "Angle between the orientation from the wheels alone and the logged one, at the end.",
    ),
    Metric(
        "orientation_drift_max",
        RAD,
        "Largest angle between the orientation from the wheels alone and the logged one.",
    ),
)
"""Metrics of `Consistency`; a platform whose wheels cannot roll without slip has none of them."""
