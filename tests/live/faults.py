"""Everything that can go wrong in a live run, to be done to a rig, with the state that follows."""

from collections.abc import Callable, Mapping
from math import nan
from typing import NoReturn

from atlas_cueing.live.control.state_machine import State
from atlas_cueing.rotation import ZERO
from atlas_cueing.smoothing.traction import KeptTraction

from .rig import Rig

Fault = Callable[[Rig], None]
ALL = frozenset(State)
FAULTS = frozenset({State.FAULT_STOPPING, State.STOPPED})
AT_REST = frozenset({State.PARKED, State.WAITING})
# a hold's stop is made without smoothing
SMOOTHED = ALL - FAULTS - {State.HOLDING}
FOLLOWING = frozenset({State.ENGAGING, State.RUNNING})


class DefectError(RuntimeError):
    """What a defect raises."""


def quiet(seconds: float) -> Fault:
    def fault(rig: Rig) -> None:
        rig.source.quiet = True
        rig.fly(seconds)
        rig.source.quiet = False

    return fault


def bad_samples(rig: Rig) -> None:
    rig.source.bad = 3
    rig.fly(3 * rig.dt)


def jump(rig: Rig) -> None:
    rig.source.jumps = True
    rig.tick()


def late(rig: Rig) -> None:
    if rig.state in AT_REST:
        rig.until(lambda: rig.guard.standing, 10.0)
    rig.tick(lateness=0.025)


class Defect:
    """Cueing, or contacts that smoothing asks: it raises, whatever it is asked."""

    sphere_from_wheels = (ZERO, ZERO, ZERO)

    def step(self, _: object) -> NoReturn:
        raise DefectError("cueing")

    def excess(self, *_: object) -> NoReturn:
        raise DefectError("smoothing")


def broken_cueing(rig: Rig) -> None:
    if rig.platform._cueing is not None:
        once(rig, rig.platform, "_cueing", Defect())
    else:
        rig.tick()


def broken_smoothing(rig: Rig) -> None:
    of = rig.platform._pipeline.smoothing
    once(rig, of, "_kept", KeptTraction(rig.dt, Defect(), of._sphere, of._stage))  # type: ignore[arg-type]


def once(rig: Rig, part: object, name: str, wrong: object) -> None:
    """One tick in which a part has something wrong in it; what it makes of it, it keeps."""
    right = getattr(part, name)
    setattr(part, name, wrong)
    untouched = repr(getattr(part, name))
    rig.tick()
    if repr(getattr(part, name)) == untouched:
        setattr(part, name, right)


def shifted_stage(rig: Rig) -> None:
    """The stage leaps by a centimetre in one tick."""
    rail = rig.platform._pipeline.smoothing._stage.axes[0]
    once(rig, rail, "p", rail.p + 0.01)


def wrong_wheel(name: str, by: float) -> Fault:
    """In one tick angle or speed of a wheel (rad, s) are off by so much."""

    def fault(rig: Rig) -> None:
        sphere = rig.platform._pipeline.smoothing._sphere
        first, second, third = getattr(sphere, name)
        once(rig, sphere, name, (first + by, second, third))

    return fault


# Which states a fault leaves, and for which; it leaves all others as they are.
MATRIX: Mapping[str, tuple[Fault, frozenset[State], State]] = {
    "quiet 50 ms": (quiet(0.05), frozenset(), State.RUNNING),
    "quiet 150 ms": (quiet(0.15), FOLLOWING, State.HOLDING),
    "quiet 1.5 s": (quiet(1.5), FOLLOWING, State.PARKING),
    "three bad samples": (bad_samples, FOLLOWING, State.HOLDING),
    "jump": (jump, FOLLOWING, State.HOLDING),
    "25 ms late": (late, ALL - FAULTS - AT_REST, State.FAULT_STOPPING),
    "cueing raises": (broken_cueing, FOLLOWING, State.FAULT_STOPPING),
    "smoothing raises": (broken_smoothing, SMOOTHED, State.FAULT_STOPPING),
    "stage shifted": (shifted_stage, SMOOTHED, State.FAULT_STOPPING),
    "wheel jerked": (wrong_wheel("_speed", 0.5), SMOOTHED, State.FAULT_STOPPING),
    "wheel shifted": (wrong_wheel("_angle", 0.1), SMOOTHED, State.FAULT_STOPPING),
    "not a number": (wrong_wheel("_angle", nan), SMOOTHED, State.FAULT_STOPPING),
}
LEADS_ON = {
    State.FAULT_STOPPING: {State.STOPPED},
    State.PARKING: {State.PARKED},
    State.WAITING: {State.ENGAGING},
    State.ENGAGING: {State.RUNNING},
}
