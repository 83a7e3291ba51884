"""`[plant]` of a platform file: what only a simulated platform needs to be told.

Nobody has published any of it for a sphere on omni wheels, so every default is an assumption; the
description of a key says why.
"""

from typing import Annotated

from pydantic import Field

from .tables import ScenarioTable, number, whole


class PlantTable(ScenarioTable):
    """`[plant]`: contacts, drives and sensors of the simulated platform."""

    contact_stiffness_n_m: Annotated[float, number(1e3, 1e9)] = Field(
        default=2e6, description="assumed: 0.5 mm under 1 kN; for wheels without stiffness_n_m"
    )
    contact_damping_ratio: Annotated[float, number(0.0, 2.0)] = Field(
        default=0.1,
        description="assumed: of the sphere on its contacts, a little as of hard rubber",
    )
    bristle_stiffness_1_m: Annotated[float, number(1.0, 1e5)] = Field(
        default=600.0, description="assumed: friction of 0.5 is reached 0.8 mm from rest"
    )
    bristle_damping_s_m: Annotated[float, number(0.0, 100.0)] = Field(
        default=0.5, description="assumed: damps a wheel of 25 kg that rocks on its contact"
    )
    creep_stiffness: Annotated[float, number(1.0, 1e9)] = Field(
        default=20.0, description="assumed: 1 % of creep carries 0.2 of the normal force, rubber"
    )
    static_friction_ratio: Annotated[float, number(1.0, 10.0)] = Field(
        default=1.0, description="assumed: sticking holds no more than sliding, the cautious choice"
    )
    stribeck_speed_m_s: Annotated[float, number(1e-4, 10.0)] = Field(
        default=0.05, description="assumed: where sticking ends, if it holds more"
    )
    servo_bandwidth_rad_s: Annotated[float, number(1.0, 1e3)] = Field(
        default=60.0,
        description="assumed: of the wheels' speed, 10 Hz, as drives of this size have",
    )
    servo_angle_rate_1_s: Annotated[float, number(0.0, 1e3)] = Field(
        default=15.0, description="assumed: of the wheels' angle, a quarter of the speed's"
    )
    gyro_bias_rad_s: Annotated[float, number(0.0, 1.0)] = Field(
        default=0.00122,
        description="assumed: 0.07 deg/s, a tactical MEMS unit that was not calibrated",
    )
    gyro_noise_rad_sqrt_s: Annotated[float, number(0.0, 1.0)] = Field(
        default=1.7e-4, description="assumed: angle random walk of 0.01 deg/s per root hertz, MEMS"
    )
    fix_rate_hz: Annotated[float, number(0.01, 1e4)] = Field(
        default=10.0, description="assumed: a slow camera that sees marks on the sphere"
    )
    fix_noise_rad: Annotated[float, number(0.0, 1.0)] = Field(
        default=0.0019, description="assumed: 0.11 deg about each axis"
    )
    fix_latency_s: Annotated[float, number(0.0, 2.0)] = Field(
        default=0.0, description="assumed: none; a camera has 20 to 50 ms"
    )
    fix_gain: Annotated[float, number(0.0, 1.0)] = Field(
        default=0.03,
        description="assumed: share of a fix that is believed in the long run, by both noises",
    )
    first_fix_gain: Annotated[float, number(0.0, 1.0)] = Field(
        default=0.2, description="assumed: of the first one, while the gyro's bias is not known"
    )
    fix_bias_gain: Annotated[float, number(0.0, 1.0)] = Field(
        default=0.00045,
        description="assumed: share that is taken for bias, fix_gain^2 / 2 for damping",
    )
    attitude_gain_1_s: Annotated[float, number(0.0, 100.0)] = Field(
        default=4.0, description="assumed: an error fades in a quarter of a second"
    )
    correction_rate_rad_s: Annotated[float, number(0.0, 10.0)] = Field(
        default=0.5, description="assumed: the sphere is not corrected faster than that"
    )
    correction_share: Annotated[float, number(0.001, 1.0)] = Field(
        default=0.1,
        description="assumed: of the wheels' acceleration limits, gentle for riders",
    )
    step_s: Annotated[float, number(1e-6, 0.01)] = Field(
        default=1e-3, description="numerical; half of it changes no figure that is shown"
    )
    seed: Annotated[int, whole(0, 2**31)] = Field(default=0, description="of the noise")
