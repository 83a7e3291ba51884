"""Platforms that keep traction, and what wheels need, derived here: W, about the centre of mass."""

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from atlas_cueing.loads import LoadModel, Preload
from atlas_cueing.rotations import Array
from atlas_cueing.scenario import load_platform
from atlas_cueing.signals import Cue
from atlas_cueing.smoothing import Smoothing
from atlas_cueing.wheels import Wheels

from .flights import Flight
from .platforms import Platform


class Kept:
    """A preset with masses and a vertical preload (N), whose motions keep traction."""

    def __init__(self, preset: str, preload: float) -> None:
        file = load_platform(preset)
        down = Preload((0.0, 0.0, 1.0), preload)
        model = file.load_model()
        self.model = replace(model, preloads=(*model.preloads, down)) if preload else model
        self.wheels = Wheels(file.geometry())
        self.limits = Platform(
            np.array(self.wheels.wheels_from_sphere),
            file.wheel_limit_values(),
            file.stage_limit_values(),
        )

    def smoothing(self, dt: float, *, kept: bool = True) -> Smoothing:
        return Smoothing(
            dt=dt,
            wheels_from_sphere=self.wheels.wheels_from_sphere,
            sphere_from_wheels=self.wheels.sphere_from_wheels,
            wheel_limits=self.limits.wheels,
            stage_limits=self.limits.stage,
            contacts=self.model.kept_rows() if kept else None,
        )

    def fly(self, dt: float, cues: list[Cue], *, kept: bool = True) -> Flight:
        step = self.smoothing(dt, kept=kept).step
        x = np.array([
            (m.time, *m.q_WS, *m.w_WS_W, *m.alpha_WS_W, *m.p_WS_W, *m.v_WS_W, *m.a_WS_W, *m.limited)
            for m in map(step, cues)
        ])  # fmt: skip
        ends = (1, 5, 8, 11, 14, 17, 20)
        return Flight(dt, x[:, 0], *np.split(x[:, 1:], [end - 1 for end in ends[1:]], axis=1))


def demand(model: LoadModel, flight: Flight) -> tuple[Array, Array, Array]:
    """Share of the friction with its margin, normal force (N) and torque (N m), (n, 3) each."""
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
    # six contact forces balance moment and force: drives along v at R u, normal forces along -u
    u = np.array([wheel.contact for wheel in model.wheels])
    v = np.array([wheel.drive for wheel in model.wheels])
    columns = np.block([
        [model.sphere_radius * np.cross(u, v).T, np.zeros((3, 3))],
        [v.T, -u.T],
    ])  # fmt: skip
    pushed = -sum((p.force * np.array(p.contact) for p in model.preloads), np.zeros(3))
    found = np.linalg.solve(columns, np.hstack([moment, force - pushed]).T).T
    drive, normal = found[:, :3], found[:, 3:]
    radius = np.array([wheel.radius for wheel in model.wheels])
    to_wheels = model.sphere_radius / radius[:, None] * np.cross(u, v)
    speed, acceleration = w @ to_wheels.T, alpha @ to_wheels.T
    mu, J, b, k = np.array([
        (wheel.friction, wheel.inertia, wheel.viscous, wheel.coulomb) for wheel in model.wheels
    ]).T  # fmt: skip
    torque = radius * drive + J * acceleration + b * speed + k * np.sign(speed)
    use = np.abs(drive) * model.traction_margin / (mu * np.where(normal > 0.0, normal, 1e-9))
    return use, normal, torque
