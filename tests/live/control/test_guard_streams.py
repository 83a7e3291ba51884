"""Whole streams of commands.

What the pipeline makes passes untouched; for any other demand the output keeps every limit.
"""

from collections.abc import Iterator
from dataclasses import fields, replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from smoothing.cues import wild
from smoothing.platforms import PLATFORMS

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.rotation import ZERO, Vec3, apply
from atlas_cueing.run import build_pipeline, open_vehicle
from atlas_cueing.scenario import load_scenario
from atlas_cueing.signals import Motion, Tick

from .guard_states import STAGE, STANDING, WHEELS, State, coast, command, excess, limits, states

SCENARIOS = Path(__file__).parents[3] / "scenarios"
FIELDS = [field.name for field in fields(Command)]
ROUGH = 3e-6  # share of a limit: the guard's room, and the rounding of third differences over 1 ms


def of(tick: Tick, angle: Vec3) -> Command:
    m, wheels = tick.motion, tick.wheels
    return Command(m.time, wheels.speed, wheels.acceleration, m.p_WS_W, m.v_WS_W, m.a_WS_W, angle)


@pytest.mark.parametrize(
    ("name", "method"),
    [("f16_rolls", "force"), ("c172_elevator_doublet", "blend"), ("signal_all_axes", "force")],
)
def test_flights_pass_untouched(name: str, method: str) -> None:
    scenario = load_scenario(SCENARIOS / f"{name}.toml", [f"cueing.method={method}"])
    vehicle = open_vehicle(scenario)
    pipeline = build_pipeline(scenario, vehicle.dt)
    guard = Guard(
        vehicle.dt, scenario.platform.wheel_limit_values(), scenario.platform.stage_limit_values()
    )
    for _ in range(1000):
        one = of(pipeline.step(vehicle.state), pipeline.smoothing.wheel_motion()[0])
        assert guard.check(one) is one, guard.reason
        assert vehicle.advance()
    assert not guard.standing


@pytest.mark.parametrize("dt", [1.0 / 1000.0, 1.0 / 120.0, 1.0 / 50.0])
@pytest.mark.parametrize("name", ["equilateral", "orthogonal"])
def test_smoothing_of_wild_cues_passes_untouched(name: str, dt: float) -> None:
    """At the limits most of the time, with each of smoothing's three kinds of step."""
    platform = PLATFORMS[name]
    x, y, z = (tuple(row) for row in platform.wheels_from_sphere.tolist())
    smoothing, guard = platform.smoothing(dt), Guard(dt, platform.wheels, platform.stage)

    def driven(m: Motion) -> Command:
        return Command(
            m.time,
            apply((x, y, z), m.w_WS_W),
            apply((x, y, z), m.alpha_WS_W),
            m.p_WS_W,
            m.v_WS_W,
            m.a_WS_W,
            smoothing.wheel_motion()[0],
        )

    for cue in wild(dt, 1000, np.random.default_rng(11)):
        one = driven(smoothing.step(cue))
        assert guard.check(one) is one, guard.reason


def hostile(dt: float, random: np.random.Generator, guard: Guard) -> Iterator[Command]:
    """Spells of jerk that is legal, or nearly, on every axis, with a wrong command now and then."""
    asked = states(guard._last)
    jerk = np.array([limits(k)[2] for k in range(6)])
    size = random.choice([0.3, 1.0, 1.0, 1.0 + 2e-6, 1.01])
    while True:
        share = size * random.choice([-1.0, 0.0, 1.0, 0.5], 6) * random.choice([0.05, 1.0], 6)
        for _ in range(int(10.0 ** random.uniform(0.0, 2.2))):
            asked = [coast(state, j, dt) for state, j in zip(asked, share * jerk, strict=True)]
            asked = (
                [soothed(k, state, dt) for k, state in enumerate(asked)]
                if random.random() < 0.02
                else asked
            )
            one = command(guard._last.time + dt, asked)
            yield one if random.random() > 0.005 else wrong(one, random)


def soothed(axis: int, state: State, dt: float) -> State:
    """A small step aside, about what the jerk could make of it."""
    p, v, a = state
    j = limits(axis)[2]
    return p + 1e-3 * j * dt**3, v - 0.1 * j * dt**2, a


def wrong(one: Command, random: np.random.Generator) -> Command:
    """One field of it anything."""
    field = str(random.choice(FIELDS))
    junk = [np.nan, np.inf, -np.inf, 1e308, 0.0, *(10.0 ** random.uniform(-6.0, 3.0, 3))]
    value = tuple(float(x) for x in random.choice(junk, 3))
    return replace(
        one,
        **{
            field: (
                float(random.choice([one.time - 1.0, one.time, np.nan, *junk]))
                if field == "time"
                else value
            )
        },
    )


@pytest.mark.parametrize(("dt", "seed"), [(1.0 / 1000.0, 1), (1.0 / 120.0, 2), (1.0 / 30.0, 3)])
def test_of_hostile_commands_nothing_comes_out_that_breaks_a_limit(dt: float, seed: int) -> None:
    random, guard, passed, stops = np.random.default_rng(seed), Guard(dt, WHEELS, STAGE), 0, 0
    ticks = 0
    while ticks < 5000:
        guard.start(
            replace(
                STANDING,
                time=float(random.uniform(-1e3, 1e3)),
                p_WS_W=(0.5, -0.3, 0.2) if stops % 2 else ZERO,
            )
        )
        outputs = [guard._last]
        for one in islice(hostile(dt, random, guard), 5000):
            outputs.append(guard.check(one))
            passed += outputs[-1] is one
            if guard.standing and guard.stopping:
                break
        assert guard.standing
        ticks, stops = ticks + len(outputs), stops + 1
        assert excess(dt, outputs) <= ROUGH, guard.reason
    assert stops > 10
    assert passed > 500
