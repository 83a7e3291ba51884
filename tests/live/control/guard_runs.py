"""Guards fresh and underway, the commands that keep them so, and commands that are spoilt."""

from dataclasses import fields, replace

from installed import COMPILED

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.guard import Guard

from .guard_states import STAGE, WHEELS, coast, command

DT = 1.0 / 128.0  # exact, so that times are
JERK = (100.0, -200.0, 50.0, 20.0, -10.0, 5.0)
FIELDS = [field.name for field in fields(Command)]


def fresh() -> Guard:
    return Guard(DT, WHEELS, STAGE)


def moving(ticks: int, time: float = 0.0) -> Command:
    """After some ticks of constant jerk on every axis from standstill."""
    return command(time + ticks * DT, [coast((0.0, 0.0, 0.0), j, ticks * DT) for j in JERK])


def underway(ticks: int = 4) -> Guard:
    guard = fresh()
    for n in range(ticks + 1):
        one = moving(n)
        assert guard.check(one) is one
    return guard


def spoilt(one: Command, field: str, place: int, value: float) -> Command:
    """One number of the command replaced by another."""
    return replace(one, **_with(one, field, place, value))


def misshapen(one: Command, field: str, place: int, value: object) -> Command | None:
    """One number of the command replaced by what is none, as far as `made` makes it."""
    return made(one, **_with(one, field, place, value))


def made(one: Command, **wrong: object) -> Command | None:
    """The command with fields of another kind; None where it is compiled, which makes no such."""
    try:
        return replace(one, **wrong)
    except TypeError:
        assert COMPILED
        return None


def _with(one: Command, field: str, place: int, value: object) -> dict[str, object]:
    old = getattr(one, field)
    if field == "time":
        return {field: value}
    return {field: tuple(value if k == place else x for k, x in enumerate(old))}
