"""Everything that can go wrong in a live run, to be done to a rig, with the state that follows."""

from collections.abc import Callable, Mapping
from math import nan

from atlas_cueing.live.control.state_machine import State
from atlas_cueing.signals import Motion

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


def broken_cueing(rig: Rig) -> None:
    once(rig, rig.platform._cueing)


def broken_smoothing(rig: Rig) -> None:
    once(rig, rig.platform._pipeline.smoothing)


def once(rig: Rig, part: object) -> None:
    """One tick with a part that raises."""

    def step(_: object) -> None:
        raise DefectError(type(part).__name__)

    if part is not None:
        part.step = step  # type: ignore[attr-defined]
    rig.tick()
    if part is not None:
        del part.step  # type: ignore[attr-defined]


def illegal(corrupt: Callable[[Motion], Motion]) -> Fault:
    """One motion that smoothing should never give."""

    def fault(rig: Rig) -> None:
        smoothing = rig.platform._pipeline.smoothing
        step = smoothing.step
        smoothing.step = lambda cue: corrupt(step(cue))  # type: ignore[method-assign]
        rig.tick()
        del smoothing.step  # type: ignore[method-assign]

    return fault


def shifted(m: Motion) -> Motion:
    x, y, z = m.p_WS_W
    return Motion(
        m.time, m.q_WS, m.w_WS_W, m.alpha_WS_W, (x + 0.01, y, z), m.v_WS_W, m.a_WS_W, m.limited
    )


def illegal_wheels(angle: float, speed: float) -> Fault:
    """One motion of the wheels that smoothing should never give, off by so much."""

    def fault(rig: Rig) -> None:
        smoothing = rig.platform._pipeline.smoothing
        (q, *others), (w, *more), acceleration = smoothing.wheel_motion()
        wrong = (q + angle, *others), (w + speed, *more), acceleration
        smoothing.wheel_motion = lambda: wrong  # type: ignore[method-assign]
        rig.tick()
        del smoothing.wheel_motion  # type: ignore[method-assign]

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
    "stage shifted": (illegal(shifted), SMOOTHED, State.FAULT_STOPPING),
    "wheel jerked": (illegal_wheels(0.0, 0.5), SMOOTHED, State.FAULT_STOPPING),
    "wheel shifted": (illegal_wheels(0.1, 0.0), SMOOTHED, State.FAULT_STOPPING),
    "not a number": (illegal_wheels(0.0, nan), SMOOTHED, State.FAULT_STOPPING),
}
LEADS_ON = {
    State.FAULT_STOPPING: {State.STOPPED},
    State.PARKING: {State.PARKED},
    State.WAITING: {State.ENGAGING},
    State.ENGAGING: {State.RUNNING},
}
