"""The platform in motion: one self-contained HTML file with a play bar. The only place that knows viser.

viser draws what its server would send to a browser; the server is bound to the loopback, nobody calls it, and it is stopped as
soon as the file is written.
"""

from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError, OutputError
from ..rotation import multiply, shortest_arc
from .finding import Array
from .recorded_run import RecordedRun
from .review import Review
from .rotations import from_vector

RATE_HZ = 30.0  # frames; film has 24
MOST_FRAMES = 9000  # of a long flight, which gets fewer a second
TRACK = 0.04  # of the sphere's radius: thickness of what is drawn on it

_STAGE, _BASE, _CABIN = "/stage", "/stage/base", "/stage/cabin"
_SHELL, _RIDER, _NOSE, _LEFT, _WHEEL, _MARK = (
    (170, 190, 210),
    (60, 60, 70),
    (217, 115, 13),
    (31, 78, 121),
    (90, 100, 110),
    (192, 0, 0),
)


def write_replay(found: Review, file: Path) -> None:
    """Write the run as a 3D replay into `file`: sphere with its cockpit, wheels, stage in its travel.

    Raises InputError when viser is not installed or there is no motion to show, OutputError when the file cannot be written.
    """
    try:
        import viser
    except ModuleNotFoundError as error:
        raise InputError("3D replays need viser; install it with: pip install 'atlas_cueing[report]'") from error
    if not len(found.run.flight.time) or not np.isfinite(found.run.flight.motion_q_WS).all():
        raise InputError(f"log {found.run.log.path}: no motion to show, it has no ticks or numbers that are none")
    with redirect_stdout(StringIO()):  # a banner, and word of the end
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
        try:
            html = _replay(server, found.run)
        finally:
            server.stop()
    try:
        file.write_text(html, encoding="utf-8")
    except OSError as error:
        raise OutputError(f"page {file}: {error.strerror}") from error


def frames(time: Array) -> tuple[Array, float]:
    """Ticks to show, and the time from one frame to the next (s)."""
    duration = float(time[-1] - time[0])
    count = max(1, min(round(duration * RATE_HZ), MOST_FRAMES))
    shown = np.searchsorted(time, np.linspace(time[0], time[-1], count + 1)).clip(0, len(time) - 1)
    return shown, duration / count


def _replay(server: Any, run: RecordedRun) -> str:
    """Draw the platform at rest, then move it frame by frame."""
    scene, flight = server.scene, run.flight
    scene.set_up_direction("+z")
    radius = run.platform.sphere.radius_m
    server.initial_camera.position = (-2.1 * radius, -2.1 * radius, 1.4 * radius)
    server.initial_camera.look_at = (0.0, 0.0, 0.0)
    _draw_travel(scene, run)
    stage = scene.add_frame(_STAGE, show_axes=False)
    cabin = scene.add_frame(_CABIN, show_axes=False)
    _draw_cabin(scene, radius, run)
    wheels = [_draw_wheel(scene, run, k) for k in range(3)]
    recording = server.get_scene_serializer()
    shown, pause = frames(flight.time)
    spins = _spins(run)
    for tick in shown:
        stage.position, cabin.wxyz = flight.motion_p_W[tick], flight.motion_q_WS[tick]
        for (wheel, at_rest), spin in zip(wheels, spins[tick], strict=True):
            wheel.wxyz = multiply(at_rest, _about_z(spin))
        recording.insert_sleep(pause)
    html: str = recording.as_html()
    return html


def _spins(run: RecordedRun) -> Array:
    """How far each wheel has turned at each tick, rad, (n, 3)."""
    speed, h = run.flight.wheel_speed, np.diff(run.flight.time)[:, None]
    steps = 0.5 * h * (speed[:-1] + speed[1:])
    return np.concatenate([np.zeros((1, 3)), np.cumsum(np.nan_to_num(steps), axis=0)])


def _draw_travel(scene: Any, run: RecordedRun) -> None:
    """The box that the sphere's centre may move in, and a floor."""
    x, y, z = run.platform.stage_motion_limits().travel
    corners = np.array([(a, b, c) for a in (-x, x) for b in (-y, y) for c in (-z, z)])
    edges = [(i, j) for i in range(8) for j in range(i) if np.count_nonzero(corners[i] != corners[j]) == 1]
    points = np.array([[corners[i], corners[j]] for i, j in edges])
    scene.add_line_segments("/travel", points=points, colors=(120, 140, 160), thickness=0.2 * TRACK)
    radius = run.platform.sphere.radius_m
    scene.add_grid("/floor", width=8.0 * radius, height=8.0 * radius, cell_size=radius, position=(0.0, 0.0, -z - 1.6 * radius))


def _draw_cabin(scene: Any, radius: float, run: RecordedRun) -> None:
    """A shell one can look through, a horizon, a nose in front, a stripe on the left, and the rider's head."""
    scene.add_icosphere(f"{_CABIN}/shell", radius=radius, color=_SHELL, opacity=0.35)
    scene.add_icosphere(f"{_CABIN}/net", radius=radius * 1.002, color=_RIDER, wireframe=True, subdivisions=2)
    for name, colour, position, size in (
        ("nose", _NOSE, (radius, 0.0, 0.0), (3.0, 6.0, 3.0)),
        ("left", _LEFT, (0.0, radius, 0.0), (3.0, 3.0, 3.0)),
        ("crown", _MARK, (0.0, 0.0, radius), (3.0, 3.0, 3.0)),
        ("seat", _RIDER, (-0.1 * radius, 0.0, -0.3 * radius), (10.0, 10.0, 2.0)),
        ("back", _RIDER, (-0.3 * radius, 0.0, 0.0), (2.0, 10.0, 16.0)),
    ):
        dimensions = tuple(TRACK * radius * s for s in size)
        scene.add_box(f"{_CABIN}/{name}", color=colour, dimensions=dimensions, position=position)
    scene.add_icosphere(f"{_CABIN}/head", radius=0.08 * radius, color=_NOSE, position=run.platform.head_S)
    turn = np.linspace(0.0, 2.0 * np.pi, 73)
    ring = 1.005 * radius * np.column_stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)])
    scene.add_line_segments(
        f"{_CABIN}/horizon", points=np.stack([ring[:-1], ring[1:]], axis=1), colors=_NOSE, thickness=0.5 * TRACK * radius
    )


def _draw_wheel(scene: Any, run: RecordedRun, k: int) -> tuple[Any, Any]:
    """Wheel k with a mark on its rim; its frame, and the orientation that puts the frame's z along the wheel's axle.

    The rim moves along `drive` where it touches the sphere, so the wheel turns about -(contact x drive).
    """
    radius, wheel = run.platform.sphere.radius_m, run.platform.wheel[k]
    r, touch = wheel.radius_m, np.array(wheel.contact) / np.linalg.norm(wheel.contact)
    axle = -np.cross(touch, wheel.drive)
    at_rest = shortest_arc((0.0, 0.0, 1.0), (float(axle[0]), float(axle[1]), float(axle[2])))
    path = f"{_BASE}/wheel_{k + 1}"
    frame = scene.add_frame(path, show_axes=False, position=touch * (radius + r), wxyz=at_rest)
    scene.add_cylinder(f"{path}/tyre", radius=r, height=0.5 * r, color=_WHEEL)
    scene.add_box(f"{path}/mark", color=_MARK, dimensions=(1.9 * r, 0.2 * r, 0.56 * r))
    return frame, at_rest


def _about_z(angle: float) -> Any:
    w, x, y, z = from_vector(np.array([[0.0, 0.0, angle]]))[0].tolist()
    return (w, x, y, z)
