"""The picture is true: wheels touch and turn the right way, nothing cuts into the sphere."""

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.scenario import Platform, load_platform, presets
from atlas_cueing.viewer.scene import Pose, Scene

BESIDE = "/bridge/carriage/telescope/top"
REST = Pose(
    (1.0, 0.0, 0.0, 0.0),
    (0.0, 0.0, 0.0),
    (0.0, 0.0, 0.0),
    (0.0, 0.0, -9.80665),
    (0.0, 0.0, -9.80665),
)


def node(server: Any, path: str) -> Any:
    found = server.scene.get_handle_by_name(path)
    assert found is not None, path
    return found


def place(server: Any, path: str) -> tuple[np.ndarray, Rotation]:
    """Position and orientation of a node in W, through all frames above it."""
    at, turned, names = np.zeros(3), Rotation.identity(), path.split("/")[1:]
    for k in range(len(names)):
        frame = node(server, "/" + "/".join(names[: k + 1]))
        at = at + turned.apply(frame.position)
        turned = turned * Rotation.from_quat(frame.wxyz, scalar_first=True)
    return at, turned


def points(server: Any, path: str) -> np.ndarray:
    """Vertices of a mesh in W, with more of them along all edges."""
    at, turned = place(server, path)
    mesh = node(server, path)
    a, b = (
        turned.apply(np.asarray(mesh.vertices)[np.asarray(mesh.faces)[:, k]]) + at for k in (0, 2)
    )
    return np.vstack([a + s * (b - a) for s in np.linspace(0.0, 1.0, 9)])


def test_sphere_and_stage_are_where_the_pose_says(server: Any, platform: Platform) -> None:
    scene, rng = Scene(server, platform), np.random.default_rng(1)
    for _ in range(10):
        p, q = rng.uniform(-1.0, 1.0, 3), Rotation.random(rng=rng)
        scene.show(
            Pose(q.as_quat(scalar_first=True), p, (0.0, 0.0, 0.0), REST.vehicle_f, REST.felt_f)
        )
        at, turned = place(server, f"{BESIDE}/cabin")
        assert at == pytest.approx(p)
        assert (turned * q.inv()).magnitude() < 1e-6
        for name, share in (
            ("/bridge", (1, 0, 0)),
            ("/bridge/carriage", (1, 1, 0)),
            ("/bridge/carriage/telescope", (1, 1, 0.5)),
        ):
            assert place(server, name)[0] == pytest.approx(p * share)


@pytest.mark.parametrize("preset", presets())
def test_a_wheel_touches_the_sphere_and_moves_it_along_its_drive(server: Any, preset: str) -> None:
    platform = load_platform(preset)
    scene = Scene(server, platform)
    radius, step = platform.sphere.radius_m, 1e-4
    for k, table in enumerate(platform.wheel):
        contact, drive = np.array(table.wheel().contact), np.array(table.wheel().drive)
        path = f"{BESIDE}/wheel_{k + 1}"
        scene.show(REST)
        centre, before = place(server, path)
        assert np.linalg.norm(centre) == pytest.approx(radius + table.radius_m)
        assert centre / np.linalg.norm(centre) == pytest.approx(contact)
        angles = [0.0, 0.0, 0.0]
        angles[k] = step
        scene.show(Pose(REST.q_WS, REST.p_W, angles, REST.vehicle_f, REST.felt_f))
        rim = before.inv().apply(radius * contact - centre)
        moved = place(server, path)[1].apply(rim) - before.apply(rim)
        assert moved == pytest.approx(
            step * table.radius_m * drive, abs=1e-3 * step * table.radius_m
        )


@pytest.mark.parametrize("preset", presets())
def test_nothing_cuts_into_the_sphere(server: Any, preset: str) -> None:
    platform = load_platform(preset)
    Scene(server, platform).show(REST)
    radius = platform.sphere.radius_m
    for k in range(3):
        rollers = np.linalg.norm(points(server, f"{BESIDE}/wheel_{k + 1}/rollers"), axis=1)
        assert rollers.min() == pytest.approx(radius, rel=0.01)  # it touches
        assert np.linalg.norm(points(server, f"{BESIDE}/wheel_{k + 1}/hub"), axis=1).min() > radius
        assert (
            np.linalg.norm(points(server, f"{BESIDE}/wheel_{k + 1}_motor"), axis=1).min() > radius
        )
    assert np.linalg.norm(points(server, f"{BESIDE}/arms"), axis=1).min() > radius
    assert points(server, f"{BESIDE}/inner")[:, 2].max() < -radius


@pytest.mark.parametrize("preset", presets())
@pytest.mark.parametrize("share", [-1.0, 0.0, 1.0])
def test_the_telescope_holds_together_over_the_travel(
    server: Any, preset: str, share: float
) -> None:
    platform = load_platform(preset)
    p = tuple(share * travel for travel in platform.stage_limit_values().travel)
    Scene(server, platform).show(Pose(REST.q_WS, p, (0.0, 0.0, 0.0), REST.vehicle_f, REST.felt_f))
    parent = "/bridge/carriage"
    sleeve, middle, inner = (
        points(server, path)[:, 2]
        for path in (f"{parent}/sleeve", f"{parent}/telescope/middle", f"{BESIDE}/inner")
    )
    floor = node(server, "/floor").position[2]
    assert floor < sleeve.min() <= middle.min() < sleeve.max()
    assert middle.min() <= inner.min() < middle.max()


@pytest.mark.parametrize("size", [0.0, 1e-311, 1e-3, 2.0, 9.80665, 29.0, 300.0])
def test_the_arrow_is_the_force(server: Any, platform: Platform, size: float) -> None:
    """Forward, right, down becomes forward, left, up.

    Of a flight that is not known, 2 g is the longest.
    """
    f = size * np.array((0.48, 0.6, -0.64))
    Scene(server, platform).show(Pose(REST.q_WS, REST.p_W, REST.wheel_angle, f, REST.felt_f))
    _, turned = place(server, f"{BESIDE}/cabin/head/pilot")
    tip = node(server, f"{BESIDE}/cabin/head/pilot/tip").position
    shown = min(size / 9.80665 / 2.0, 1.0) * 0.9 * platform.sphere.radius_m
    assert np.linalg.norm(tip) == pytest.approx(shown, abs=1e-6)
    if size > 0.01:
        assert turned.apply(tip) == pytest.approx(shown * np.array((0.48, -0.6, 0.64)), abs=1e-5)
    _, upright = place(server, f"{BESIDE}/cabin/head/felt")
    assert upright.apply((0.0, 0.0, 1.0)) == pytest.approx([0.0, 0.0, 1.0])


@pytest.mark.parametrize("preset", presets())
@pytest.mark.parametrize("largest", [0.0, 1.0, 2.9, 7.5])
def test_the_largest_force_stays_in_the_picture(server: Any, preset: str, largest: float) -> None:
    """For any stage and attitude the head of the longest arrow is in a picture of 4 to 3."""
    platform, rng = load_platform(preset), np.random.default_rng(2)
    scene = Scene(server, platform, largest)
    travel = np.array(platform.stage_limit_values().travel)
    camera = server.initial_camera
    ahead = (camera.look_at - camera.position) / np.linalg.norm(camera.look_at - camera.position)
    right = np.cross(ahead, (0.0, 0.0, 1.0)) / np.linalg.norm(np.cross(ahead, (0.0, 0.0, 1.0)))
    for p in (
        np.array((x, y, z)) * travel for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)
    ):
        q, along = Rotation.random(rng=rng), rng.normal(size=3)
        along = np.array((0.0, 0.0, 1.0)) if rng.random() < 0.5 else along / np.linalg.norm(along)
        f = largest * 9.80665 * q.inv().apply(along) * (1, -1, -1)
        scene.show(Pose(q.as_quat(scalar_first=True), p, (0.0, 0.0, 0.0), f, REST.felt_f))
        head = place(server, f"{BESIDE}/cabin/head/pilot/tip/name")[0] - camera.position
        half = np.tan(0.5 * camera.fov) * (head @ ahead)
        assert abs(head @ np.cross(right, ahead)) < 0.95 * half
        assert abs(head @ right) < 4.0 / 3.0 * 0.95 * half


def test_arrows_tell_whose_they_are_and_how_large(server: Any, platform: Platform) -> None:
    scene = Scene(server, platform, 2.9)
    labels = [node(server, f"{BESIDE}/cabin/head/{name}/tip/name") for name in ("pilot", "felt")]
    scene.show(Pose(REST.q_WS, REST.p_W, REST.wheel_angle, (0.0, 0.0, -28.44), REST.felt_f))
    assert [label.text for label in labels] == ["vehicle 2.9 g", "rider 1.0 g"]
    assert (
        node(server, "/scale").text
        == "arrows are specific force: 1 g = 0.45 m, at most 1.30 m (2.9 g)"
    )
    # where both arrows are the same, the labels still stand apart
    assert len({label.anchor for label in labels}) == 2


def test_a_pose_with_a_number_that_is_none_cannot_be_drawn() -> None:
    assert REST.finite
    assert not Pose((1.0, 0.0, 0.0, float("nan")), *(REST.p_W,) * 4).finite
    assert not Pose(
        REST.q_WS, REST.p_W, REST.wheel_angle, REST.vehicle_f, (0.0, float("inf"), 0.0)
    ).finite
