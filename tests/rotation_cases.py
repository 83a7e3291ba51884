"""What tests of rotations begin with."""

import numpy as np
from hypothesis import strategies as st
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from atlas_cueing import rotation as rot

number = st.floats(-1.0, 1.0, allow_subnormal=False)

vector = st.tuples(number, number, number)

direction = vector.filter(lambda v: rot.norm(v) > 0.1).map(
    lambda v: rot.scale(1.0 / rot.norm(v), v)
)

quaternion = (
    st.tuples(number, number, number, number)
    .filter(lambda q: np.hypot.reduce(q) > 0.1)
    .map(rot.normalise)
)


def scipy(q: ArrayLike) -> Rotation:
    return Rotation.from_quat(np.roll(np.asarray(q, dtype=float), -1, axis=-1))
