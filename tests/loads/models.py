"""Load models of the oracle's cases, and random ones."""

import json
from math import cos, pi, radians, sin
from pathlib import Path
from typing import Any

import numpy as np

from atlas_cueing.loads import (
    Body,
    LoadModel,
    Part,
    Preload,
    Support,
    WheelContact,
    body_of,
    inertia_tensor,
)
from atlas_cueing.wheels import OmniWheel

ORACLES = json.loads((Path(__file__).parents[1] / "oracles" / "loads.json").read_text())["cases"]


def of_kind(kind: str) -> list[dict[str, Any]]:
    return [case for case in ORACLES if case["kind"] == kind]


def unit(v: Any) -> tuple[float, float, float]:
    x, y, z = (np.array(v) / np.linalg.norm(v)).tolist()
    return (x, y, z)


def model_of(case: dict[str, Any]) -> LoadModel:
    wheels = [
        OmniWheel.along(
            tuple(w["contact"]),
            tuple(w["drive"]),
            w["radius_m"] * cos(radians(w.get("roller_deg", 0.0))),
        )
        for w in case["geometry"]["wheel"]
    ]
    return LoadModel(
        name=case["name"],
        sphere_radius=case["geometry"]["sphere_radius_m"],
        body=body_of(
            [
                Part(p["mass_kg"], tuple(p["com_m"]), inertia_tensor(p["inertia_kg_m2"]))
                for p in case["parts"]
            ]
        ),
        wheels=tuple(
            WheelContact(
                w.contact,
                w.drive,
                w.radius,
                case["mu"],
                case["wheel_inertia_kg_m2"],
                case["wheel_viscous_n_m_s"],
            )
            for w in wheels
        ),
        preloads=tuple(Preload(unit(p["contact"]), p["force_n"]) for p in case.get("preload", ())),
        supports=tuple(
            Support(unit(s["contact"]), s["stiffness_ratio"], s["preload_n"])
            for s in case.get("support", ())
        ),
    )


def state_of(case: dict[str, Any]) -> dict[str, np.ndarray]:
    s = case["state"]
    q = np.array(s["q_ws"])
    return {
        "q_WS": q / np.linalg.norm(q),
        "w_WS_W": np.array(s["w_rad_s"]),
        "alpha_WS_W": np.array(s["alpha_rad_s2"]),
        "a_WS_W": np.array(s["a_m_s2"]),
    }


class Platform:
    """A platform that is nothing but its load model."""

    def __init__(self, model: LoadModel) -> None:
        self._model = model

    def load_model(self) -> LoadModel:
        return self._model


def ring(
    count: int, elevation: float, skew: float = 0.0, radius: float = 0.15, **more: float
) -> tuple[WheelContact, ...]:
    """Wheels evenly around z, `elevation` rad below the equator, drives turned by `skew`."""
    wheels = []
    for k in range(count):
        azimuth = 2.0 * pi * k / count
        out = np.array([cos(azimuth), sin(azimuth), 0.0])
        along = np.array([sin(azimuth), -cos(azimuth), 0.0])
        u = cos(elevation) * out - sin(elevation) * np.array([0.0, 0.0, 1.0])
        v = cos(skew) * along + sin(skew) * np.cross(u, along)
        wheels.append(WheelContact(unit(u), unit(v), radius, more.get("friction", 0.5)))
    return tuple(wheels)


def point_mass(mass: float = 100.0, inertia: float = 20.0) -> Body:
    return Body(mass, (0.0, 0.0, 0.0), inertia_tensor([inertia] * 3))


def random_states(rng: np.random.Generator, n: int) -> dict[str, np.ndarray]:
    q = rng.standard_normal((n, 4))
    return {
        "q_WS": q / np.linalg.norm(q, axis=1, keepdims=True),
        "w_WS_W": rng.normal(size=(n, 3)) * 3.0,
        "alpha_WS_W": rng.normal(size=(n, 3)) * 4.0,
        "a_WS_W": rng.normal(size=(n, 3)) * 3.0,
    }


def random_body(rng: np.random.Generator) -> Body:
    parts = []
    for _ in range(3):
        points = rng.normal(size=(4, 3)) * 0.3
        inertia = sum(p @ p * np.eye(3) - np.outer(p, p) for p in points)
        rows = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        com = tuple((rng.normal(size=3) * 0.1).tolist())
        parts.append(Part(float(rng.uniform(20.0, 200.0)), com, inertia_tensor(rows.tolist())))
    return body_of(parts)
