"""Writes the platform in motion as one self-contained HTML file with a play bar.

viser draws what its server would send to a browser; the server is bound to the loopback, it has no
clients, and it is stopped as soon as the file is written.
"""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..atomic_file import write_page
from ..errors import OutputError
from ..evaluation import RunColumns
from ..rotations import Array
from ..scenario import Platform
from .forces import largest_g
from .recorded_motion import RecordedMotion
from .scene import Scene
from .server import check_viser, close_server, open_server

if TYPE_CHECKING:
    from viser import ViserServer

RATE_HZ = 30.0  # frames; film has 24
MOST_FRAMES = 9000  # of a long flight, which gets fewer a second


def write_replay(platform: Platform, flight: RunColumns, file: str | Path) -> None:
    """Write the flight as a 3D replay into `file`.

    It shows the sphere with its cockpit, the wheels, and the stage in its travel.

    Raises InputError when viser is not installed or there is no motion to show, OutputError when
    the file cannot be written.
    """
    check_viser("report")
    motion, largest = RecordedMotion(flight, platform), largest_g(flight.vehicle_f_B, flight.felt_f)
    shown, pause = frames(flight.time)
    server = open_server(0)
    try:
        html = _replay(server, Scene(server, platform, largest), motion, shown, pause)
    finally:
        close_server(server)
    try:
        write_page(file, html)
    except OSError as error:
        raise OutputError(f"page {file}: {error.strerror}") from error


def frames(time: Array) -> tuple[Array, float]:
    """Return the ticks to show, and the time from one frame to the next (s)."""
    duration = float(time[-1] - time[0])
    count = max(1, min(round(duration * RATE_HZ), MOST_FRAMES))
    shown = np.searchsorted(time, np.linspace(time[0], time[-1], count + 1)).clip(0, len(time) - 1)
    return shown, duration / count


def _replay(
    server: "ViserServer", scene: Scene, motion: RecordedMotion, shown: Array, pause: float
) -> str:
    """Return the page of a scene that is moved frame by frame."""
    recording = server.get_scene_serializer()
    for tick in shown:
        scene.show(motion.pose(int(tick)))
        recording.insert_sleep(pause)
    return recording.as_html()
