"""What a build of the package computes, as hashes.

Python compiled_probe.py FOLDER, run with the build on the path.

Whole flights (the bytes of their logs), smoothing under hostile cues and the guard under spoilt
commands (every number). And what its types are to a Python user.
"""

import hashlib
import inspect
import json
import pickle
import random
import sys
from collections.abc import Iterator
from copy import copy, deepcopy
from dataclasses import fields, replace
from math import inf, nan
from pathlib import Path

import numpy as np

from atlas_cueing import rotation
from atlas_cueing.cueing import CAUSAL_METHODS
from atlas_cueing.errors import PlanningError
from atlas_cueing.live.control.command import Command, command_of
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.pipeline import Pipeline
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import load_platform, load_scenario
from atlas_cueing.signals import Cue, Motion, Tick, Timing, VehicleState, WheelSpeeds
from atlas_cueing.smoothing import Smoothing, axis
from atlas_cueing.wheels import Wheels

SCENARIO = """
name = "{name}"
duration_s = {duration}
{vehicle}
[platform]
preset = "atlas-2.9m"
[cueing]
method = "{method}"
"""
AIRCRAFT = """
[vehicle]
aircraft = "f16"
initial = { altitude_m = 3000.0, airspeed_m_s = 200.0 }
input = [{ time_s = 1.0, property = "fcs/aileron-cmd-norm", value = 0.5, ramp_s = 0.2 }]
"""
SCRIPT = '[vehicle]\nscript = "c172_elevator_doublet"'
FLIGHTS = [("f16", 4.0, AIRCRAFT, method) for method in CAUSAL_METHODS]
FLIGHTS += [("doublet", 25.0, SCRIPT, "blend")]
AWKWARD = (nan, inf, -inf, 1e300, -1e200, 1e-300, 0.0, -0.0, 1e6)
TICKS = 20_000
SPOILT = 15_000  # the tick whose command makes the guard stop


def flown(folder: Path) -> Iterator[tuple[str, str]]:
    for name, duration, vehicle, method in FLIGHTS:
        file, log = folder / f"{name}.toml", folder / f"{name}_{method}.mcap"
        file.write_text(
            SCENARIO.format(name=name, duration=duration, vehicle=vehicle, method=method)
        )
        result = run_scenario(load_scenario(file), log)
        yield (
            log.name,
            f"{result.result} {result.ticks} {hashlib.sha256(log.read_bytes()).hexdigest()}",
        )


def loaded() -> str:
    """A hash of the loads of wild motions, tick by tick."""
    randomly, total = random.Random(5), hashlib.sha256()
    platform = load_platform("atlas-2.9m-halo")
    per_tick, wheels = platform.load_model().per_tick(), Wheels(platform.geometry())
    for k in range(TICKS):
        vectors = [tuple(randomly.gauss(0.0, 3.0) for _ in range(3)) for _ in range(6)]
        q = rotation.exp(vectors[0])  # type: ignore[arg-type]
        motion = Motion(k / 120.0, q, *vectors[1:], (0.0, 0.0))  # type: ignore[arg-type]
        found = per_tick.loads(motion, wheels.speeds(motion))
        total.update(
            repr((found.drive, found.normal, found.torque, found.power, found.use)).encode()
        )
    return total.hexdigest()


def cues(randomly: random.Random) -> Iterator[Cue]:
    """Cues that wander, jump, and are now and then none."""
    q = rotation.IDENTITY
    for k in range(TICKS):
        vector = [tuple(randomly.gauss(0.0, 3.0) for _ in range(3)) for _ in range(4)]
        q = rotation.normalise(rotation.multiply(rotation.exp(rotation.scale(0.01, vector[0])), q))  # type: ignore[arg-type]
        if randomly.random() < 0.01:
            q = rotation.exp(rotation.scale(3.0, vector[1]))  # type: ignore[arg-type]
        numbers = [*q, *(x for v in vector for x in v)]
        if randomly.random() < 0.05:
            numbers[randomly.randrange(len(numbers))] = randomly.choice(AWKWARD)
        a, b, c, d, *rest = numbers
        triples = [(rest[i], rest[i + 1], rest[i + 2]) for i in range(0, 12, 3)]
        yield Cue(k / 120.0, (a, b, c, d) if k else rotation.IDENTITY, *triples)


def smoothed() -> tuple[str, str]:
    """Hashes of all motions with their wheels, and of all commands.

    What the guard let through, and then its stop.
    """
    platform, dt = load_platform("atlas-2.9m"), 1.0 / 120.0
    limits = platform.wheel_limit_values(), platform.stage_limit_values()
    wheels, guard = Wheels(platform.geometry()), Guard(dt, *limits)
    smoothing = Smoothing(
        dt=dt,
        wheels_from_sphere=wheels.wheels_from_sphere,
        sphere_from_wheels=wheels.sphere_from_wheels,
        wheel_limits=limits[0],
        stage_limits=limits[1],
    )
    motions, commands = hashlib.sha256(), hashlib.sha256()
    for k, cue in enumerate(cues(random.Random(8))):
        try:
            motion = smoothing.step(cue)
        except PlanningError as error:
            motions.update(str(error).encode())
            continue
        speeds = wheels.speeds(motion)
        motions.update(repr((motion, speeds)).encode())
        command = Command(
            motion.time,
            speeds.speed,
            speeds.acceleration,
            motion.p_WS_W,
            motion.v_WS_W,
            motion.a_WS_W,
            smoothing.wheel_motion()[0],
        )
        if k == SPOILT:
            command = replace(command, v_WS_W=(nan, 0.0, 0.0))
        commands.update(repr((guard.check(command), guard.reason)).encode())
    return motions.hexdigest(), commands.hexdigest()


STATE = VehicleState(0.5, (1.0, 0.0, 0.0, 0.0), (0.1, 0.2, 0.3), (0.0, 0.0, -9.8))
CUE = Cue(0.5, STATE.q_NB, *(((0.0, 1.0, 2.0),) * 4))
MOTION = Motion(0.5, STATE.q_NB, *(((0.0, 1.0, 2.0),) * 5), (1.0, 0.0))
WHEELS = WheelSpeeds(0.5, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
SIGNALS = (
    STATE,
    CUE,
    MOTION,
    WHEELS,
    Tick(STATE, CUE, MOTION, WHEELS),
    Timing(*map(float, range(9))),
    Command(0.5, *(((0.0, 1.0, 2.0),) * 6)),
)
DOCUMENTED = (Pipeline, Pipeline.step, rotation.rotate, Smoothing.step, Guard, *map(type, SIGNALS))


def is_final(signal: object) -> bool:
    """Whether its time cannot be set anew."""
    try:
        signal.time = 1.0  # type: ignore[attr-defined]
    except AttributeError:
        return True
    return False


def as_python() -> list[str]:
    """What a Python user meets of signals and of what steps them: copies, words, signatures."""
    found = []
    for signal in SIGNALS:
        copies = copy(signal), deepcopy(signal), pickle.loads(pickle.dumps(signal))  # noqa: S301
        assert all(each == signal and type(each) is type(signal) for each in copies)
        assert replace(signal) == signal
        if Path(rotation.__file__).suffix == ".so":
            assert is_final(signal)
        found.append(f"{signal} {[item.name for item in fields(signal)]}")
    command = command_of(SIGNALS[4], (1.0, 2.0, 3.0))  # type: ignore[arg-type]
    assert command == deepcopy(command) == pickle.loads(pickle.dumps(command))  # noqa: S301
    vectors = (np.array(vector) for vector in (STATE.q_NB, STATE.w_NB_B, STATE.f_B))
    assert VehicleState(np.float64(0.5), *vectors) == STATE
    assert VehicleState(0.5, [1, 0, 0, 0], [0.1, 0.2, 0.3], [0, 0, -9.8]) == STATE
    for vectors in ((STATE.q_NB[:3], STATE.w_NB_B, STATE.f_B), (STATE.q_NB, [1.0], STATE.f_B)):
        try:
            VehicleState(0.5, *vectors)
        except (TypeError, ValueError):
            found.append("refused")
    for thing in DOCUMENTED:
        names = [n for n in inspect.signature(thing).parameters if n != "self"]
        found.append(f"{thing.__name__}{names}: {inspect.getdoc(thing)}")
    found += [str(module.__doc__) for module in (rotation, axis)]
    return found


if __name__ == "__main__":
    found = {
        "python": as_python(),
        "code": Path(rotation.__file__).suffix,
        **dict(flown(Path(sys.argv[1]))),
        "smoothing": smoothed(),
        "loads": loaded(),
    }
    sys.stdout.write(json.dumps(found))
