"""Commands to send: any at all, and a smooth swing."""

from math import cos, sin

from hypothesis import strategies as st

from atlas_cueing.live.control.command import Command
from atlas_cueing.rotation import ZERO, Vec3

REST = Command(0.0, ZERO, ZERO, ZERO, ZERO, ZERO, ZERO)

_vec3 = st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * 3)
any_command = st.builds(Command, st.floats(0.0, 1e6), _vec3, _vec3, _vec3, _vec3, _vec3, _vec3)


def swinging(t: float) -> Command:
    """All derivatives of a smooth swing of everything, at time t."""

    def three(value: float) -> Vec3:
        return (value, 0.5 * value, -value)

    s, c = sin(2.0 * t), cos(2.0 * t)
    return Command(
        *(t, three(5.0 * s), three(10.0 * c), three(0.3 * s), three(0.6 * c), three(-1.2 * s)),
        three(-2.5 * c),
    )
