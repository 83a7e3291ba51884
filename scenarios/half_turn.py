"""An own cueing method: the cabin turns at a share of the vehicle's rates and keeps that turn."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field
from scipy.spatial.transform import Rotation


class HalfTurn:
    """Turns at a share of the vehicle's rates, from upright on."""

    version = "1.0"

    @dataclass(frozen=True)
    class Parameters:
        """Keys of `[cueing]` beside `method`."""

        gain: Annotated[float, Field(ge=0.0, le=1.0, description="share of the rates")] = 0.5

    def __init__(self, dt, parameters):
        self.dt, self.gain, self.cabin = dt, parameters.gain, Rotation.identity()

    def step(self, vehicle):
        """Give orientation q_WS and rate w_WS_W (rad/s) for the next vehicle state."""
        rate = self.gain * np.array(vehicle.w_NB_B) * (1, -1, -1)  # forward-left-up
        self.cabin = self.cabin * Rotation.from_rotvec(rate * self.dt)
        return self.cabin.as_quat(scalar_first=True), self.cabin.apply(rate)
