"""What happens between two ticks: every step is one of three known motions.

This file works them out for itself.
"""

import numpy as np
from ruckig import ControlInterface, InputParameter, Ruckig, RuckigError, Trajectory

from atlas_cueing.rotations import Array
from atlas_cueing.smoothing import AxisSmoothing, Stop
from atlas_cueing.smoothing.axis import Step

SUBSTEPS = 10


class Recorder(AxisSmoothing):
    """An Axis that keeps (displacement, v, a) at ten points of its last step, in rows."""

    def __init__(
        self,
        dt: float,
        speed: float,
        acceleration: float,
        jerk: float,
        stop_share: float = 1.0,
    ) -> None:
        super().__init__(dt, speed, acceleration, jerk, stop_share)
        self.times = np.linspace(0.0, dt, SUBSTEPS + 1)
        self.path = np.zeros((SUBSTEPS + 1, 3))
        self._jerks = np.linalg.inv([[dt / 2.0, dt / 2.0], [3.0 * dt**2 / 8.0, dt**2 / 8.0]])
        self.kinds = {"halves": 0, "ruckig": 0, "stop": 0}

    def towards(self, v: float, a: float, v_target: float, a_target: float) -> Step:
        step = super().towards(v, a, v_target, a_target)
        halves = self._two_halves(v, a, step.v, step.a)
        if self._admissible(halves) and self._fits(halves, step):
            self._keep("halves", halves)
        else:
            planned = ruckig_path(v, a, *self.clip(v_target, a_target), self)
            assert self._fits(planned, step), (v, a, v_target, a_target, step)
            self._keep("ruckig", planned)
        return step

    def stopping(self, v: float, a: float) -> Step:
        step = super().stopping(v, a)
        stop = Stop.plan(v, a, self.acceleration, self.jerk)
        path = np.array([stop.at(t) for t in self.times])
        assert self._fits(path, step)
        self._keep("stop", path)
        return step

    def _two_halves(self, v: float, a: float, v1: float, a1: float) -> Array:
        """Path of two halves of constant jerk from (v, a) to (v1, a1)."""
        j1, j2 = self._jerks @ [a1 - a, v1 - v - a * self.dt]
        first, second = (
            np.minimum(self.times, 0.5 * self.dt),
            np.maximum(self.times - 0.5 * self.dt, 0.0),
        )
        return np.stack(coast(*coast(0.0, v, a, j1, first), j2, second), axis=1)

    def _admissible(self, path: Array) -> bool:
        """Whether jerk and acceleration stay inside their limits, but for rounding."""
        a = path[:, 2]
        return bool(
            np.max(np.abs(a)) <= self.acceleration * (1.0 + 1e-10)
            and np.max(np.abs(np.diff(a))) <= self.jerk * self.dt / SUBSTEPS * (1.0 + 1e-8)
        )

    def _fits(self, path: Array, step: Step) -> bool:
        """Whether the path ends where the step does.

        Within a millionth of what the jerk could do, and rounding.
        """
        near = (
            1e-6 * self.jerk * self.dt**3 + 1e-13,
            1e-6 * self.jerk * self.dt**2 + 1e-12,
            1e-9 * self.acceleration,
        )
        ends = (step.displacement, step.v, step.a)
        return all(
            abs(x - y) <= tolerance
            for x, y, tolerance in zip(path[-1].tolist(), ends, near, strict=True)
        )

    def _keep(self, kind: str, path: Array) -> None:
        self.kinds[kind] += 1
        self.path = path


def coast(
    p: float | Array, v: float | Array, a: float | Array, j: float, t: Array
) -> tuple[Array, Array, Array]:
    return p + v * t + a * t**2 / 2.0 + j * t**3 / 6.0, v + a * t + j * t**2 / 2.0, a + j * t


def ruckig_path(v: float, a: float, v_target: float, a_target: float, axis: AxisSmoothing) -> Array:
    inputs, trajectory = InputParameter(1), Trajectory(1)
    inputs.control_interface = ControlInterface.Velocity
    inputs.minimum_duration = axis.dt
    inputs.current_velocity, inputs.current_acceleration = [v], [a]
    inputs.target_velocity, inputs.target_acceleration = [v_target], [a_target]
    inputs.max_velocity, inputs.max_acceleration, inputs.max_jerk = (
        [axis.speed],
        [axis.acceleration],
        [axis.jerk],
    )
    try:
        Ruckig(1, axis.dt).calculate(inputs, trajectory)
    except (RuckigError, ValueError):
        return np.full((SUBSTEPS + 1, 3), np.nan)
    return np.array(
        [[x[0] for x in trajectory.at_time(t)] for t in np.linspace(0.0, axis.dt, SUBSTEPS + 1)]
    )
