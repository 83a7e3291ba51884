"""A vehicle known in closed form, and files of it as others write them.

Euler angles and specific force are sums of sines, below a tenth of the rates used here. Body rates
are those of the angles: p = phi' - psi' sin(theta), and so on.
"""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

G = 9.80665


@dataclass(frozen=True)
class Truth:
    """The vehicle at times (n,), s: q_NB (n, 4) scalar first, rates, force, FRD, and angles."""

    time: np.ndarray
    q_NB: np.ndarray
    w_B: np.ndarray
    f_B: np.ndarray
    angles: np.ndarray  # roll, pitch, yaw

    @property
    def rotation(self) -> Rotation:
        """R_NB."""
        return Rotation.from_quat(np.roll(self.q_NB, -1, axis=1))


def truth(time: np.ndarray, fastest_hz: float = 4.0) -> Truth:
    """The vehicle, whose fastest content is at `fastest_hz` (the force; angles a quarter of it)."""
    a, b = 2 * np.pi * fastest_hz, 0.5 * np.pi * fastest_hz
    roll, droll = 0.4 * np.sin(b * time), 0.4 * b * np.cos(b * time)
    pitch, dpitch = 0.1 * np.sin(0.7 * b * time + 1.0), 0.07 * b * np.cos(0.7 * b * time + 1.0)
    yaw, dyaw = 0.3 * time + 0.2 * np.sin(0.3 * b * time), 0.3 + 0.06 * b * np.cos(0.3 * b * time)
    w = np.column_stack(
        [
            droll - dyaw * np.sin(pitch),
            dpitch * np.cos(roll) + dyaw * np.sin(roll) * np.cos(pitch),
            -dpitch * np.sin(roll) + dyaw * np.cos(roll) * np.cos(pitch),
        ]
    )
    f = np.column_stack(
        [
            np.sin(a * time),
            0.8 * np.sin(0.6 * a * time + 0.5) + 0.2 * np.sin(0.1 * a * time),
            -G + 0.9 * np.sin(0.8 * a * time + 2.0),
        ]
    )
    xyzw = Rotation.from_euler("ZYX", np.column_stack([yaw, pitch, roll])).as_quat()
    return Truth(time, np.roll(xyzw, 1, axis=1), w, f, np.column_stack([roll, pitch, yaw]))


def flu(vectors: np.ndarray) -> np.ndarray:
    """FRD vectors in forward-left-up."""
    return vectors * np.array([1.0, -1.0, -1.0])


def q_enu_flu(flown: Truth) -> np.ndarray:
    """The attitude as ROS has it (REP 103), by rotation matrices: (n, 4), x, y, z, w."""
    enu_from_ned = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    frd_from_flu = np.diag([1.0, -1.0, -1.0])
    return Rotation.from_matrix(enu_from_ned @ flown.rotation.as_matrix() @ frd_from_flu).as_quat()


def write_csv(path: Path, header: list[str], *columns: np.ndarray) -> Path:
    """A CSV file of columns (n,) or (n, k)."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(np.column_stack(columns).tolist())
    return path


PLAIN = ["time_s", "fx", "fy", "fz", "wx", "wy", "wz", "qw", "qx", "qy", "qz"]


def plain_csv(path: Path, flown: Truth) -> Path:
    """The layout of the map `csv`."""
    return write_csv(path, PLAIN, flown.time, flown.f_B, flown.w_B, flown.q_NB)
