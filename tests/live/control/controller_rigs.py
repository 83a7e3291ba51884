"""Rigs of a quick cueing, brought into a state."""

from atlas_cueing.live.control.state_machine import State

from ..rig import Rig

QUICK = ("cueing.stage.planner=onset",)


def rig_in(state: State, **options: object) -> Rig:
    rig = Rig(settings=QUICK, **options)  # type: ignore[arg-type]
    rig.bring_to(state)
    return rig


def changes_of(rig: Rig) -> list[tuple[str, str]]:
    return [(state, reason) for _, state, reason in rig.tape.statuses]
