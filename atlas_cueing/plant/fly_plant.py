"""Flies the schedule of a log on the plant."""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np

from ..errors import InputError
from ..recording import Log
from ..rotation import Mat3, Quat, Vec3, geodesic
from ..rotations import Array
from ..scenario import Platform
from ..scenario.plant_table import PlantTable
from ..signals import CORRECTION
from .attitude_loop import FEEDBACKS, AttitudeLoop, LoopSettings
from .build_plant import PlantConstants, Start, build_plant
from .drive_command import Cubic, DriveCommand, hermite, plus
from .plant_felt import plant_felt
from .sphere_on_wheels import WORK, SphereOnWheels

_EVERY = 60  # ticks between two reports of progress
_TORQUES = ("t1_n_m", "t2_n_m", "t3_n_m")
_LARGEST_STEP = 0.05  # s; of a log. Slower ones leave the motion between their ticks open


@dataclass(frozen=True)
class PlantRun:
    """What the plant did.

    plant, correction: fields of `signals.PLANT` and `signals.CORRECTION`, a row a tick.
    work: J, of motors, stage, friction, damping and losses; throughput of motors and stage.
    energy_change: of what the sphere has stored, J. row_work: by springs at changes of rows, J.
    """

    feedback: str
    plant: Array
    correction: Array
    work: tuple[float, float, float, float]
    throughput: float
    energy_change: float
    row_work: float

    @property
    def energy_residual(self) -> float:
        """Energy that came from nowhere, J: the error of integration."""
        motors, stage, friction, losses = self.work
        return self.energy_change - (motors + stage - friction - losses + self.row_work)


def fly_plant(
    log: Log,
    platform: Platform,
    feedback: str = "none",
    table: PlantTable | None = None,
    progress: Callable[[float], None] | None = None,
) -> PlantRun:
    """Fly the wheels and the stage of a log on the plant of `platform`.

    feedback: one of FEEDBACKS. table: replaces `[plant]` of the platform. progress: called with the
    share done, 0 to 1.

    Raises InputError for a platform that makes no plant, and for a log with gaps, of one state, or
    whose first state the contacts cannot hold.
    """
    if feedback not in FEEDBACKS:
        raise InputError(f"feedback {feedback!r}, allowed: {', '.join(FEEDBACKS)}")
    flight = _Flight(_Schedule(log), build_plant(platform, table), platform, feedback)
    return flight.fly(progress or (lambda _: None))


class _Schedule:
    """Motion and wheels of a log, as lists of rows by tick."""

    def __init__(self, log: Log) -> None:
        time = log.column("/motion", "time_s")
        steps = np.diff(time)
        if not len(steps) or not (steps > 0.0).all() or not steps.max() <= _LARGEST_STEP:
            raise InputError(
                f"log {log.path}: allowed for a plant: at least two ticks, none more than"
                f" {_LARGEST_STEP:g} s after the other"
            )
        self.time: list[float] = (time - time[0]).tolist()
        self.q: list[Quat] = list(map(tuple, log.vector("/motion", "q_ws").tolist()))
        of_sphere, of_stage = log.vector("/motion", "w"), log.vector("/motion", "v")
        self.w: list[Vec3] = list(map(tuple, of_sphere.tolist()))
        self.alpha: list[Vec3] = list(map(tuple, log.vector("/motion", "alpha").tolist()))
        self.v: list[list[float]] = of_stage.tolist()
        self.a: list[list[float]] = log.vector("/motion", "a").tolist()
        self.speed: list[list[float]] = log.vector("/wheels", "w").tolist()
        self.acceleration: list[list[float]] = log.vector("/wheels", "a").tolist()
        ahead = np.zeros((len(time), 3))
        if "/loads" in log.tables:  # a schedule that knows its torques tells them to the drives
            ahead = np.stack([log.column("/loads", name) for name in _TORQUES], axis=1)
        self.torque: list[list[float]] = ahead.tolist()
        self.log_time: list[float] = time.tolist()
        numbers = (of_sphere, of_stage, ahead, log.vector("/wheels", "w"))
        if not all(np.isfinite(each).all() for each in numbers):
            raise InputError(f"log {log.path}: allowed for a plant: finite numbers only")


class _Flight:
    """A schedule on a plant, with its loop."""

    def __init__(
        self, schedule: _Schedule, plant: PlantConstants, platform: Platform, feedback: str
    ) -> None:
        s, table = schedule, plant.table
        x, y, z = s.torque[0]
        a = s.a[0]
        start = Start(s.q[0], s.w[0], s.alpha[0], (a[0], a[1], a[2]), (x, y, z))
        self._schedule, self._table, self._feedback = schedule, table, feedback
        self._sphere: SphereOnWheels = plant.at(start)
        self._head = platform.head_S
        inverse = plant.wheels_from_sphere
        limits = platform.wheel_limit_values()
        self._loop = AttitudeLoop(
            feedback,
            _settings(table),
            s.q[0],
            (_rows(np.linalg.inv(inverse).astype(np.float64)), _rows(inverse)),
            (limits.speed, limits.acceleration, limits.jerk),
        )

    def fly(self, progress: Callable[[float], None]) -> PlantRun:
        """All ticks of the schedule."""
        s, sphere, loop = self._schedule, self._sphere, self._loop
        first = sphere.energy(_three(s.v[0]))
        plant, correction = [], []
        last = len(s.time) - 1
        for k in range(last):
            h = s.time[k + 1] - s.time[k]
            command = self._command(k, h)
            if k == 0:
                plant.append(self._row(0, command, 0.0))
                correction.append(self._correction_row(0, before=True))
            sphere.advance(command, h, ceil(h / self._table.step_s - 1e-9))
            loop.measure(s.time[k + 1], sphere.orientation(), sphere.wheel_angles(), h)
            plant.append(self._row(k + 1, command, h))
            correction.append(self._correction_row(k + 1))
            if k % _EVERY == 0:
                progress(k / last)
        motors, stage, friction, losses, throughput = sphere.state[WORK : WORK + 5]
        change = sphere.energy(_three(s.v[last])) - first
        return PlantRun(
            self._feedback,
            np.array(plant),
            np.array(correction),
            (motors, stage, friction, losses),
            throughput,
            change,
            sphere.row_work,
        )

    def _command(self, k: int, h: float) -> DriveCommand:
        """Schedule and correction from tick k to the next."""
        s, loop = self._schedule, self._loop
        old = [(each.speed, each.acceleration) for each in loop.corrections]
        speed, acceleration, after = s.speed[k], s.acceleration[k], s.acceleration[k + 1]
        loop.correct(s.q[k], list(zip(speed, acceleration, after, strict=True)), h)
        wheels = []
        for i in range(3):
            scheduled = hermite(speed[i], acceleration[i], s.speed[k + 1][i], after[i], h)
            c, (w, a) = loop.corrections[i], old[i]
            wheels.append(plus(scheduled, hermite(w, a, c.speed, c.acceleration, h)))
        stage = [hermite(s.v[k][i], s.a[k][i], s.v[k + 1][i], s.a[k + 1][i], h) for i in range(3)]
        ahead, then = s.torque[k], s.torque[k + 1]
        growth = [(b - a) / h for a, b in zip(ahead, then, strict=True)]
        return DriveCommand(_cubics(wheels), _cubics(stage), _three(ahead), _three(growth))

    def _row(self, k: int, command: DriveCommand, t: float) -> list[float]:
        """The fields of /plant at tick k, which is t (s) into the command."""
        s, sphere, loop = self._schedule, self._sphere, self._loop
        q, estimate = sphere.orientation(), loop.estimate_WS
        known = self._feedback != "none"
        if not known:
            estimate = s.q[k]  # all that an open loop has is what it wanted
        return [
            s.log_time[k],
            *q,
            *sphere.rate_W(),
            *plant_felt(sphere, command, t, _three(s.a[k]), self._head),
            geodesic(s.q[k], q),
            *estimate,
            geodesic(estimate, q),
            *sphere.slips(),
            *sphere.normals(),
            *sphere.torques(command, t),
            *sphere.state[16:19],
            *loop.residual,
        ]

    def _correction_row(self, k: int, before: bool = False) -> list[float]:
        c = self._loop.corrections
        if before:
            return [self._schedule.log_time[k], *[0.0] * (len(CORRECTION.fields) - 1)]
        return [
            self._schedule.log_time[k],
            *(each.angle for each in c),
            *(each.speed for each in c),
            *(each.acceleration for each in c),
        ]


def _settings(table: PlantTable) -> LoopSettings:
    return LoopSettings(
        gain=table.attitude_gain_1_s,
        largest_rate=table.correction_rate_rad_s,
        gyro_bias=table.gyro_bias_rad_s,
        gyro_noise=table.gyro_noise_rad_sqrt_s,
        fix_rate=table.fix_rate_hz,
        fix_noise=table.fix_noise_rad,
        fix_latency=table.fix_latency_s,
        fix_gain=table.fix_gain,
        fix_bias_gain=table.fix_bias_gain,
        seed=table.seed,
        first_fix_gain=table.first_fix_gain,
        share=table.correction_share,
    )


def _rows(m: Array) -> Mat3:
    a, b, c = (_three(row) for row in m.tolist())
    return (a, b, c)


def _three(v: list[float]) -> Vec3:
    return (v[0], v[1], v[2])


def _cubics(cubics: list[Cubic]) -> tuple[Cubic, Cubic, Cubic]:
    a, b, c = cubics
    return (a, b, c)
