"""Method `still`: upright and not turning, with the stage of every method."""

from hypothesis import given

from atlas_cueing.cueing import StageParameters, StillParameters, build_cueing
from atlas_cueing.rotation import IDENTITY, ZERO, Quat, Vec3
from atlas_cueing.signals import StageLimits, VehicleState

from .vehicles import LEVEL, wild

LIMITS = StageLimits((1.0, 1.0, 0.75), (1.5, 1.5, 1.2), (6.0, 6.0, 5.0), (60.0, 60.0, 50.0))


@given(sequence=wild(490.0, 50.0))
def test_it_stands_upright_whatever_the_vehicle_does(
    sequence: list[tuple[Quat, Vec3, Vec3]],
) -> None:
    rotation = StillParameters().rotation(0.01)
    for i, state in enumerate(sequence):
        assert rotation.step(VehicleState(0.01 * i, *state)) == (IDENTITY, ZERO)


def test_the_stage_moves_as_with_every_method() -> None:
    cueing = build_cueing(StillParameters(), StageParameters(), LIMITS, ZERO, 0.01)
    cueing.step(VehicleState(0.0, IDENTITY, ZERO, LEVEL))
    pushed = (1.0, LEVEL[1], LEVEL[2])
    cues = [cueing.step(VehicleState(0.01 * i, IDENTITY, ZERO, pushed)) for i in range(1, 100)]
    assert max(cue.a_WS_W[0] for cue in cues) > 0.3
    assert all(cue.q_WS == IDENTITY for cue in cues)
