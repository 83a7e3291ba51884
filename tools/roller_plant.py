"""A sphere on wheels of free physical rollers, simulated by MuJoCo (extra `physics`).

It knows no Jacobian: a free sphere is pressed onto three wheels, each with rollers that spin freely
on hinges; only contacts with friction turn it. What it does with the wheels' speeds is measured.

Rollers are ellipsoids: their long half axis is sqrt(r rho), so that along the rim they have the
wheel's own radius of curvature r, and rho across it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from atlas_cueing.wheels import Geometry, OmniWheel, RollerRows, tilt

STEP = 5e-4  # s
SETTLING = 0.2  # s; contacts and rollers come to rest against each other
PRESS = 30.0  # N, downwards


@dataclass(frozen=True)
class Rolled:
    """What was measured at n ticks.

    omega (n, 3): wheel speeds, rad/s; w_W (n, 3): angular velocity of the sphere, rad/s, W; rows
    (n, 3): the row that carries most of each wheel, +1 or -1, 0 where none touches.
    """

    omega: np.ndarray
    w_W: np.ndarray
    rows: np.ndarray


def roll(
    geometry: Geometry, rows: Sequence[RollerRows], speeds: Sequence[float], duration: float
) -> Rolled:
    """Turn the wheels at constant `speeds` (rad/s) for `duration` (s) after settling.

    rows: of each wheel; an offset of 0 makes one row of all its rollers.
    """
    import mujoco

    model = mujoco.MjModel.from_xml_string(_world(geometry, rows))
    data = mujoco.MjData(model)
    data.ctrl[:] = speeds
    sphere = model.body("sphere").id
    data.xfrc_applied[sphere, 2] = -PRESS
    hinges = [model.jnt_dofadr[model.joint(f"wheel{k}").id] for k in range(3)]
    side = _sides(model)
    measured = []
    for k in range(round((SETTLING + duration) / STEP)):
        mujoco.mj_step(model, data)
        if k * STEP >= SETTLING:
            R = data.xmat[sphere].reshape(3, 3)
            measured.append(
                (data.qvel[hinges].copy(), R @ data.qvel[3:6], _touching(model, data, side))
            )
    omega, w_W, touching = (np.array(column) for column in zip(*measured, strict=True))
    return Rolled(omega, w_W, touching)


@dataclass(frozen=True)
class Comparison:
    """Relative errors of the sphere's angular velocity, predicted from the wheels' speeds.

    mean_error: of J omega against the mean rate. single_row, with_rows, rows_swapped: medians over
    the ticks of J omega, of C_s J omega with the rows s that touch, and with the other rows.
    rows_seen: how many combinations of rows touched.
    """

    mean_error: float
    single_row: float
    with_rows: float
    rows_swapped: float
    rows_seen: int


def comparison(
    geometry: Geometry, rolled: Rolled, corrections: Mapping[tuple[int, ...], np.ndarray]
) -> Comparison:
    """Compare what the sphere did with J, and with the corrections by rows (may be empty)."""
    single = rolled.omega @ np.array(geometry.sphere_from_wheels).T
    mean = rolled.w_W.mean(axis=0)
    rows = [tuple(row) for row in rolled.rows.tolist()]

    def median(sign: int) -> float:
        pairs = [
            (corrections[key] @ w, truth)
            for row, w, truth in zip(rows, single, rolled.w_W, strict=True)
            if (key := tuple(sign * side for side in row)) in corrections
        ]
        return float(np.median([_off(w, truth) for w, truth in pairs])) if pairs else float("nan")

    return Comparison(
        _off(single.mean(axis=0), mean),
        float(np.median([_off(w, truth) for w, truth in zip(single, rolled.w_W, strict=True)])),
        median(1),
        median(-1),
        len({row for row in rows if 0 not in row}),
    )


def _off(found: np.ndarray, truth: np.ndarray) -> float:
    return float(np.linalg.norm(found - truth) / np.linalg.norm(truth))


def _sides(model: object) -> dict[int, tuple[int, int]]:
    """Wheel and row (+1 or -1) of each roller's geom."""
    import mujoco

    found = {}
    for geom in range(model.ngeom):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM, geom) or ""
        if name.startswith("roller"):
            _, wheel, side, _ = name.split("_")
            found[geom] = int(wheel), int(side)
    return found


def _touching(model: object, data: object, side: dict[int, tuple[int, int]]) -> np.ndarray:
    """The row of each wheel that carries most."""
    import mujoco

    carried, force = np.zeros((3, 2)), np.zeros(6)
    for k in range(data.ncon):
        wheel, row = side[
            max(data.contact[k].geom1, data.contact[k].geom2, key=lambda g: g in side)
        ]
        mujoco.mj_contactForce(model, data, k, force)
        carried[wheel, (1 - row) // 2] += force[0]
    return np.where(carried.max(axis=1) > 0.0, np.where(carried[:, 0] >= carried[:, 1], 1, -1), 0)


def _world(geometry: Geometry, rows: Sequence[RollerRows]) -> str:
    R = geometry.sphere_radius
    wheels = "".join(
        _wheel(k, wheel, each, R)
        for k, (wheel, each) in enumerate(zip(geometry.wheels, rows, strict=True))
    )
    drives = "".join(f'<velocity joint="wheel{k}" kv="5"/>' for k in range(3))
    return f"""<mujoco>
      <option timestep="{STEP}" gravity="0 0 0" cone="elliptic" impratio="100"
              integrator="implicitfast" solver="Newton" tolerance="1e-12"/>
      <default><geom condim="3" friction="1 0 0" solref="0.002 1"
                     solimp="0.99 0.999 1e-5"/></default>
      <worldbody>
        <body name="sphere"><freejoint/>
          <geom name="sphere" type="sphere" size="{R}" mass="1" contype="1" conaffinity="0"/>
        </body>{wheels}
      </worldbody>
      <actuator>{drives}</actuator></mujoco>"""


def _wheel(k: int, wheel: OmniWheel, rows: RollerRows, R: float) -> str:
    """A wheel on its hinge, its axle where its rollers just touch the sphere in its place."""
    u, b, rho = np.array(wheel.contact), np.array(wheel.induced), rows.profile_radius
    axle = ((R + rho) * cos(tilt(R, rows)) + wheel.radius - rho) * u
    # a positive speed moves the rim that touches along the drive: -b x (-r u) = r v
    sides = (1, -1) if rows.offset > 0.0 else (1,)
    rollers = "".join(
        _roller(k, side, number, wheel, rows, u, b)
        for side in sides
        for number in range(rows.rollers)
    )
    return f"""<body name="wheel{k}" pos="{_numbers(axle)}">
      <joint name="wheel{k}" type="hinge" axis="{_numbers(-b)}" armature="0.01"/>
      <inertial pos="0 0 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>{rollers}</body>"""


def _roller(
    k: int, side: int, number: int, wheel: OmniWheel, rows: RollerRows, u: np.ndarray, b: np.ndarray
) -> str:
    """A roller at its place on the rim, free about the tangent of the rim."""
    r, rho = wheel.radius, rows.profile_radius
    angle = 2.0 * pi * (number + (0.0 if side > 0 else 0.5)) / rows.rollers
    v = np.array(wheel.drive)
    out = -cos(angle) * u + sin(angle) * v
    tangent = sin(angle) * u + cos(angle) * v
    place = (r - rho) * out + side * rows.offset * b
    return f"""<body pos="{_numbers(place)}" xyaxes="{_numbers(tangent)} {_numbers(b)}">
      <joint type="hinge" axis="1 0 0" armature="1e-7" damping="0"/>
      <geom name="roller_{k}_{side}_{number}" type="ellipsoid" mass="0.005"
            size="{(r * rho) ** 0.5} {rho} {rho}" contype="0" conaffinity="1"/></body>"""


def _numbers(v: np.ndarray) -> str:
    return " ".join(repr(float(x)) for x in v)
