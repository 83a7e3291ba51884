"""Moment and force against the inverse dynamics of MuJoCo, on random bodies in random motion."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.loads import LoadModel, Part, body_of, inertia_tensor
from atlas_cueing.loads.balance import required_wrench

from .models import random_states, ring

mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed (extra physics)")
RNG = np.random.default_rng(200)
BODIES = 200


def random_parts() -> list[Part]:
    parts = []
    for _ in range(3):
        points = RNG.normal(size=(5, 3)) * 0.3
        I = sum(p @ p * np.eye(3) - np.outer(p, p) for p in points) * RNG.uniform(0.5, 20.0)  # noqa: E741
        elements = [I[0, 0], I[1, 1], I[2, 2], I[0, 1], I[0, 2], I[1, 2]]
        com = tuple((RNG.normal(size=3) * 0.2).tolist())
        parts.append(Part(float(RNG.uniform(5.0, 200.0)), com, inertia_tensor(elements)))
    return parts


def world(parts: list[Part]) -> str:
    """The parts as bodies welded to a free one whose origin is the sphere's centre."""

    def numbers(values: object) -> str:
        return " ".join(repr(float(x)) for x in values)

    inner = ""
    for part in parts:
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = part.inertia_S
        full = numbers((xx, yy, zz, xy, xz, yz))
        inner += (
            f'<body pos="{numbers(part.com_S)}"><inertial pos="0 0 0" mass="{part.mass!r}"'
            f' fullinertia="{full}"/></body>'
        )
    return (
        '<mujoco><option gravity="0 0 -9.80665"/><worldbody><body><freejoint/>'
        '<inertial pos="0 0 0" mass="1e-9" diaginertia="1e-12 1e-12 1e-12"/>'
        f"{inner}</body></worldbody></mujoco>"
    )


def test_inverse_dynamics() -> None:
    """MuJoCo's free joint: force in W; rates and moment in the body's own axes."""
    worst = np.zeros(2)
    for _ in range(BODIES):
        parts = random_parts()
        model = mujoco.MjModel.from_xml_string(world(parts))
        data, state = mujoco.MjData(model), random_states(RNG, 1)
        M, F = required_wrench(LoadModel("x", 1.0, body_of(parts), ring(3, 0.7)), **state)
        q = state["q_WS"][0]
        R = Rotation.from_quat(q, scalar_first=True)
        data.qpos[3:7] = q
        data.qvel[3:6] = R.inv().apply(state["w_WS_W"][0])
        data.qacc[:3] = state["a_WS_W"][0]
        data.qacc[3:6] = R.inv().apply(state["alpha_WS_W"][0])
        mujoco.mj_inverse(model, data)
        found = (R.apply(data.qfrc_inverse[3:6]), data.qfrc_inverse[:3])
        for k, (theirs, ours) in enumerate(zip(found, (M[0], F[0]), strict=True)):
            worst[k] = max(worst[k], np.linalg.norm(theirs - ours) / np.linalg.norm(ours))
    assert worst[0] < 1e-9, worst
    assert worst[1] < 1e-9, worst
