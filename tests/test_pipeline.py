from atlas_cueing.cueing import BlendParameters, Cueing, StageParameters, build_cueing
from atlas_cueing.pipeline import Pipeline
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.scenario import load_platform
from atlas_cueing.signals import STANDARD_GRAVITY, Motion, VehicleState, WheelSpeeds
from atlas_cueing.smoothing import Smoothing
from atlas_cueing.wheels import Wheels

DT = 0.01
PLATFORM = load_platform("atlas-2.9m")
WHEELS = Wheels(PLATFORM.geometry())


class SpyDrive:
    """Wheels that remember what they were given."""

    def __init__(self) -> None:
        self.motions: list[Motion] = []

    def speeds(self, motion: Motion) -> WheelSpeeds:
        self.motions.append(motion)
        return WHEELS.speeds(motion)


def cueing() -> Cueing:
    return build_cueing(
        BlendParameters(), StageParameters(), PLATFORM.stage_limit_values(), PLATFORM.head_S, DT
    )


def smoothing() -> Smoothing:
    return Smoothing(
        dt=DT,
        wheels_from_sphere=WHEELS.wheels_from_sphere,
        sphere_from_wheels=WHEELS.sphere_from_wheels,
        wheel_limits=PLATFORM.wheel_limit_values(),
        stage_limits=PLATFORM.stage_limit_values(),
    )


def states() -> list[VehicleState]:
    return [
        VehicleState(n * DT, IDENTITY, (0.0, 0.0, 0.01 * n), (0.1, 0.0, -STANDARD_GRAVITY))
        for n in range(20)
    ]


def test_each_stage_is_given_what_the_one_before_made() -> None:
    """Step by step by hand, with stages of its own: the same cue, motion and wheel speeds."""
    drive = SpyDrive()
    pipeline = Pipeline(cueing(), smoothing(), drive)
    by_hand, allowed = cueing(), smoothing()
    for state in states():
        tick = pipeline.step(state)
        cue = by_hand.step(state)
        motion = allowed.step(cue)
        assert (tick.vehicle, tick.cue, tick.motion, tick.wheels) == (
            state,
            cue,
            motion,
            WHEELS.speeds(motion),
        )
        assert drive.motions[-1] == motion
    assert len(drive.motions) == 20
    assert tick.motion.w_WS_W != ZERO


def test_a_block_is_the_same_ticks_as_step_by_step() -> None:
    one, other = (Pipeline(cueing(), smoothing(), WHEELS) for _ in range(2))
    by_step = [one.step(state) for state in states()]
    by_block = [*other.block(states()[:7]), *other.block([]), *other.block(states()[7:])]
    assert by_block == by_step
