"""Platforms that keep traction, and what wheels need, derived here: W, about the centre of mass."""

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from atlas_cueing.loads import LoadModel, Preload
from atlas_cueing.rotations import Array
from atlas_cueing.scenario import load_platform
from atlas_cueing.signals import ContactRows, Cue
from atlas_cueing.smoothing import Smoothing
from atlas_cueing.wheels import Wheels

from .flights import Flight
from .platforms import Platform


class Blind:
    """Rows that take every stop for one that keeps them: nobody looks at it."""

    def __init__(self, rows: ContactRows) -> None:
        self.sphere_from_wheels, self.excess = rows.sphere_from_wheels, rows.excess
        self.rows, self.shortfall = rows.rows, rows.shortfall

    def largest_excess(self, *_: object) -> float:
        return -1.0


class Kept:
    """A preset with masses, whose motions keep traction.

    preload: straight down, N; halo: share of the preset's own preloads; blind: see `Blind`.
    """

    def __init__(
        self, preset: str, preload: float, halo: float = 1.0, *, blind: bool = False
    ) -> None:
        self._blind = blind
        file = load_platform(preset)
        down = Preload((0.0, 0.0, 1.0), preload)
        model = file.load_model()
        own = tuple(replace(each, force=halo * each.force) for each in model.preloads)
        self.model = replace(model, preloads=(*own, down) if preload else own)
        assert file.traction is not None
        keeping = file.traction.model_copy(update={"keep": True})
        file = file.model_copy(update={"traction": keeping})  # its stops are soft
        self.wheels = Wheels(file.geometry())
        self.limits = Platform(
            np.array(self.wheels.wheels_from_sphere),
            file.wheel_limit_values(),
            file.stage_limit_values(),
        )

    def smoothing(self, dt: float, *, kept: bool = True) -> Smoothing:
        stop = {} if kept else {"stop_share": 1.0}
        return Smoothing(
            dt=dt,
            wheels_from_sphere=self.wheels.wheels_from_sphere,
            sphere_from_wheels=self.wheels.sphere_from_wheels,
            wheel_limits=replace(self.limits.wheels, **stop),
            stage_limits=replace(self.limits.stage, **stop),
            contacts=self._rows() if kept else None,
        )

    def _rows(self) -> ContactRows:
        return Blind(self.model.kept_rows()) if self._blind else self.model.kept_rows()

    def fly(self, dt: float, cues: list[Cue], *, kept: bool = True) -> Flight:
        step = self.smoothing(dt, kept=kept).step
        x = np.array([
            (m.time, *m.q_WS, *m.w_WS_W, *m.alpha_WS_W, *m.p_WS_W, *m.v_WS_W, *m.a_WS_W, *m.limited)
            for m in map(step, cues)
        ])  # fmt: skip
        ends = (1, 5, 8, 11, 14, 17, 20)
        return Flight(dt, x[:, 0], *np.split(x[:, 1:], [end - 1 for end in ends[1:]], axis=1))


def demand(model: LoadModel, flight: Flight) -> tuple[Array, Array, Array]:
    """Share of the friction with its margin, normal forces (N) and torques (N m).

    (n, 3) each, and a normal force for each support after those of the wheels.
    """
    turn = Rotation.from_quat(np.roll(flight.q, -1, axis=1))
    m, c = model.body.mass, turn.apply(np.array(model.body.com_S))
    w, alpha = flight.w, flight.alpha
    head = flight.a + np.cross(alpha, c) + np.cross(w, np.cross(w, c))
    force = m * (head + np.array([0.0, 0.0, 9.80665]))
    c_S = np.array(model.body.com_S)
    central = np.array(model.body.inertia_S) - m * (c_S @ c_S * np.eye(3) - np.outer(c_S, c_S))
    inertia = turn.as_matrix() @ central @ turn.inv().as_matrix()
    spin = np.einsum("nij,nj->ni", inertia, w)
    moment = np.einsum("nij,nj->ni", inertia, alpha) + np.cross(w, spin) + np.cross(c, force)
    drive, normal = _contact_forces(model, moment, force)
    radius = np.array([wheel.radius for wheel in model.wheels])
    u, v = _ways(model)
    to_wheels = model.sphere_radius / radius[:, None] * np.cross(u[:3], v)
    speed, acceleration = w @ to_wheels.T, alpha @ to_wheels.T
    mu, J, b, k = np.array([
        (wheel.friction, wheel.inertia, wheel.viscous, wheel.coulomb) for wheel in model.wheels
    ]).T  # fmt: skip
    torque = radius * drive + J * acceleration + b * speed + k * np.sign(speed)
    touching = np.where(normal[:, :3] > 0.0, normal[:, :3], 1e-9)
    return np.abs(drive) * model.traction_margin / (mu * touching), normal, torque


def _ways(model: LoadModel) -> tuple[Array, Array]:
    """Contacts of wheels, then supports, and the wheels' drives."""
    touching = (*model.wheels, *model.supports)
    return np.array([each.contact for each in touching]), np.array([w.drive for w in model.wheels])


def _contact_forces(model: LoadModel, moment: Array, force: Array) -> tuple[Array, Array]:
    """Drive forces (n, 3) and normal forces (n, wheels and supports), N.

    Unknown together: drives F along v at R u, normal forces n along -u, displacement d on springs,

        R sum (u x v) F = M        sum v F - sum u n = f - preloads        n - k u . d = n_0
    """
    (u, v), count = _ways(model), len(model.wheels) + len(model.supports)
    stiff = np.array([each.stiffness for each in (*model.wheels, *model.supports)])
    alone = np.array([0.0, 0.0, 0.0, *(each.preload for each in model.supports)])
    pushed = -sum((p.force * np.array(p.contact) for p in model.preloads), np.zeros(3))
    matrix = np.block([
        [model.sphere_radius * np.cross(u[:3], v).T, np.zeros((3, count + 3))],
        [v.T, -u.T, np.zeros((3, 3))],
        [np.zeros((count, 3)), np.eye(count), -stiff[:, None] * u / stiff[0]],
    ])  # fmt: skip
    known = np.hstack([moment, force - pushed, np.tile(alone, (len(moment), 1))])
    found = np.linalg.solve(matrix, known.T).T
    return found[:, :3], found[:, 3 : 3 + count]
