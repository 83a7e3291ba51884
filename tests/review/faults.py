"""Faults to put into a clean log, each with what review has to say of it."""

from collections.abc import Callable

import numpy as np

from .corrupting import Columns

AT = 300  # tick of a fault
Change = Callable[[Columns], None]


def add(name: str, amount: float, at: int | slice = AT) -> Change:
    def change(columns: Columns) -> None:
        columns[name][at] += amount

    return change


def put(name: str, value: float) -> Change:
    def change(columns: Columns) -> None:
        columns[name][AT] = value

    return change


def drop(*topics: str, ticks: slice = slice(AT, AT + 3)) -> Change:
    """Messages lost: of the given topics, or of all."""

    def change(columns: Columns) -> None:
        for name in columns:
            if not topics or name.split()[0] in topics:
                columns[name] = np.delete(columns[name], ticks)

    return change


def turn(topic: str, quaternion: str, angle: float, at: slice) -> Change:
    """A turn of the orientation about x, from some tick on."""

    def change(columns: Columns) -> None:
        w, x, y, z = (columns[f"{topic} {quaternion}_{c}"] for c in "wxyz")
        c, s = np.cos(0.5 * angle), np.sin(0.5 * angle)
        w[at], x[at], y[at], z[at] = (
            c * w[at] - s * x[at],
            c * x[at] + s * w[at],
            c * y[at] - s * z[at],
            c * z[at] + s * y[at],
        )

    return change


def flip(topic: str, quaternion: str) -> Change:
    def change(columns: Columns) -> None:
        for c in "wxyz":
            columns[f"{topic} {quaternion}_{c}"][AT:] *= -1.0

    return change


def scale(topic: str, quaternion: str, factor: float) -> Change:
    def change(columns: Columns) -> None:
        for c in "wxyz":
            columns[f"{topic} {quaternion}_{c}"][AT] *= factor

    return change


def later(topic: str, seconds: float, at: slice = slice(AT, None)) -> Change:
    """Time moved, of one topic or (empty) of all."""

    def change(columns: Columns) -> None:
        for name in columns:
            if name.endswith(" time_s") and name.startswith(topic):
                columns[name][at] += seconds

    return change


def swap(columns: Columns) -> None:
    """Two ticks in the wrong order."""
    for values in columns.values():
        values[[AT, AT + 1]] = values[[AT + 1, AT]]


STEP = 1.0 / 120.0
DEGREE = np.pi / 180.0
# What was put in, the check that has to say so, where, and at which tick (None: of the whole log).
FAULTS: dict[str, tuple[Change, str, str, int | None]] = {
    "NaN in the motion": (put("/motion wy_rad_s", np.nan), "not a number", "/motion wy_rad_s", AT),
    "infinite force": (put("/vehicle fz_m_s2", np.inf), "not a number", "/vehicle fz_m_s2", AT),
    "NaN as a flag": (
        put("/motion stage_limited", np.nan),
        "not a number",
        "/motion stage_limited",
        AT,
    ),
    "flag of a half": (put("/motion wheels_limited", 0.5), "no flag", "/motion wheels_limited", AT),
    "wheel speed off by 1e-6": (
        add("/wheels w2_rad_s", 1e-6),
        "not J^-1 of the motion",
        "/wheels w2_rad_s",
        AT,
    ),
    "wheel acceleration off by 1e-6": (
        add("/wheels a3_rad_s2", 1e-6),
        "not J^-1 of the motion",
        "/wheels a3_rad_s2",
        AT,
    ),
    "two wheels exchanged": (
        lambda c: c.update(
            {"/wheels w1_rad_s": c["/wheels w2_rad_s"], "/wheels w2_rad_s": c["/wheels w1_rad_s"]}
        ),
        "not J^-1 of the motion",
        "/wheels w1_rad_s",
        None,
    ),
    "orientation stepped by 0.01 deg": (
        turn("/motion", "q_ws", 0.01 * DEGREE, slice(AT, None)),
        "orientation is not the integral of Omega",
        "/motion q_ws",
        AT,
    ),
    "orientation creeps by 0.01 deg a second": (
        lambda c: turn("/motion", "q_ws", 0.01 * DEGREE * c["/motion time_s"], slice(None))(c),
        "orientation is not the integral of the wheels",
        "/motion q_ws",
        None,
    ),
    "body rates for base rates": (
        lambda c: c.update(
            {
                f"/motion w{a}_rad_s": s * c[f"/felt w{a}_rad_s"]
                for a, s in zip("xyz", (1, -1, -1), strict=True)
            }
        ),
        "orientation is not the integral of Omega",
        "/motion q_ws",
        None,
    ),
    "norm off by 1e-6": (scale("/motion", "q_ws", 1.0 + 1e-6), "norm", "/motion q_ws", AT),
    "norm of the vehicle off by 1e-6": (
        scale("/vehicle", "q_nb", 1.0 - 1e-6),
        "norm",
        "/vehicle q_nb",
        AT,
    ),
    "sign flips": (flip("/motion", "q_ws"), "sign flips", "/motion q_ws", AT),
    "sign of the vehicle flips": (flip("/vehicle", "q_nb"), "sign flips", "/vehicle q_nb", AT),
    "vehicle's attitude jumps unsaid": (
        turn("/vehicle", "q_nb", 1.0 * DEGREE, slice(AT, None)),
        "attitude jumps and no state tells of it",
        "/vehicle q_nb",
        AT,
    ),
    "felt force off by 1e-6": (
        add("/felt fy_m_s2", 1e-6),
        "not what the motion makes the rider feel",
        "/felt fy_m_s2",
        AT,
    ),
    "felt rate off by 1e-6": (
        add("/felt wz_rad_s", 1e-6),
        "not what the motion makes the rider feel",
        "/felt wz_rad_s",
        AT,
    ),
    "direction off by 1e-5": (
        add("/felt direction_error_rad", 1e-5),
        "not what the motion makes the rider feel",
        "/felt direction_error_rad",
        AT,
    ),
    "stage stepped by 0.1 mm": (
        add("/motion px_m", 1e-4, slice(AT, None)),
        "not the integral of its speed",
        "/motion px_m",
        AT,
    ),
    "stage speed stepped by 1 cm/s": (
        add("/motion vz_m_s", 1e-2, slice(AT, None)),
        "not the integral of its acceleration",
        "/motion vz_m_s",
        AT,
    ),
    "three ticks lost": (drop(), "gap", "/motion time_s", AT + 3),
    "three ticks lost on one topic": (drop("/wheels"), "ticks lost", "/wheels", AT),
    "time stretched by a twentieth of a tick": (
        later("", 0.05 * STEP, slice(AT, AT + 1)),
        "uneven time",
        "/motion time_s",
        None,
    ),
    "time runs back": (swap, "time runs back", "/motion time_s", None),
    "one topic late": (later("/cue", 1e-4), "time differs from /motion", "/cue time_s", None),
}
