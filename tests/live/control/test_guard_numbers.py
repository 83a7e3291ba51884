"""Bad numbers: commands that are not finite or too short, and limits that make no sense."""

from dataclasses import replace
from math import inf, nan, nextafter, ulp

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.signals import StageLimits, WheelLimits

from .guard_runs import DT, FIELDS, fresh, made, misshapen, moving, spoilt, underway
from .guard_states import AXES, STAGE, STANDING, WHEELS


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("value", [nan, inf, -inf, 1e308, -1e308])
def test_what_is_no_number_stops_it(field: str, value: float) -> None:
    for place in range(1 if field == "time" else 3):
        guard = underway()
        given = guard.check(spoilt(moving(5), field, place, value))
        assert given == underway().stop(5 * DT)
        assert guard.stopping


@pytest.mark.parametrize("field", FIELDS[1:])
def test_what_is_no_command_stops_it(field: str) -> None:
    """Numbers of the wrong kind, one too few, one too many: or there is no such command."""
    fit = getattr(moving(5), field)
    for wrong in ((), fit[:2], (*fit, 0.0), None, (None, *fit[1:]), (*fit[:2], "0.0")):
        if one := made(moving(5), **{field: wrong}):
            guard = underway()
            assert guard.check(one) == underway().stop(5 * DT)
            assert guard.reason.startswith("no command at all: ")
            assert guard.reason.endswith(f", at {5 * DT} s")


@pytest.mark.parametrize("together", [FIELDS[1:3], FIELDS[3:]])
@pytest.mark.parametrize("numbers", [2, 4])
def test_as_many_numbers_as_wheels_and_axes(together: list[str], numbers: int) -> None:
    """Also when speed and acceleration agree in having too few or too many."""
    guard, fit = underway(), moving(5)
    wrong: dict[str, object] = {field: (*getattr(fit, field), 0.0)[:numbers] for field in together}
    if one := made(fit, **wrong):
        assert guard.check(one) == underway().stop(5 * DT)
        assert guard.reason.startswith("no command at all: ")


@pytest.mark.parametrize("numbers", [2, 4])
def test_a_start_has_three_positions(numbers: int) -> None:
    wrong: dict[str, object] = {"p_WS_W": (0.0,) * numbers}
    with pytest.raises((TypeError, ValueError), match=r"zip|tuple\["):
        fresh().start(replace(STANDING, **wrong))


def test_a_number_that_overflows_stops_it() -> None:
    guard = underway()
    if one := misshapen(moving(5), "wheel_speed", 0, 10**400):
        assert guard.check(one) == underway().stop(5 * DT)


def test_what_was_put_out_has_room_for_nothing_else() -> None:
    """That it stays as it is, `Final` says: to the type checker, and at run time when compiled."""
    assert not hasattr(STANDING, "__dict__")


def test_lists_of_numbers_are_as_good_as_tuples() -> None:
    lists: dict[str, object] = {field: list(getattr(moving(5), field)) for field in FIELDS[1:]}
    guard, same = underway(), made(moving(5), **lists)
    if same is None:
        return
    assert guard.check(same) is same
    assert not guard.standing
    assert guard.stop(6 * DT) == underway(5).stop(6 * DT)


@pytest.mark.parametrize("bad", [0.0, -1.0, inf, nan])
@pytest.mark.parametrize("place", range(3))
def test_limits_that_make_no_sense_are_refused(bad: float, place: int) -> None:
    with pytest.raises(InputError, match=r"wheel 1 tick .*, allowed: 0 < value < inf"):
        Guard(bad, WHEELS, STAGE)
    for quantity in ("speed", "acceleration", "jerk"):
        wheels: dict[str, object] = {quantity: spread(getattr(WHEELS, quantity), place, bad)}
        with pytest.raises(
            InputError, match=f"{AXES[place]} {quantity} {bad:g}, allowed: 0 < value < inf"
        ):
            Guard(DT, replace(WHEELS, **wheels), STAGE)
        stage: dict[str, object] = {quantity: spread(getattr(STAGE, quantity), place, bad)}
        with pytest.raises(
            InputError, match=f"{AXES[3 + place]} {quantity} {bad:g}, allowed: 0 < value < inf"
        ):
            Guard(DT, WHEELS, replace(STAGE, **stage))


@pytest.mark.parametrize("place", range(3))
def test_a_travel_without_room_between_two_ticks_is_refused(place: int) -> None:
    unused = STAGE.acceleration[place] * DT * DT / 8.0
    for bad in (0.0, -1.0, nan, inf, unused):
        with pytest.raises(
            InputError,
            match=f"{AXES[3 + place]} travel {bad:g} m, allowed: {unused:.3g} < value < inf",
        ):
            Guard(DT, WHEELS, replace(STAGE, travel=spread(STAGE.travel, place, bad)))
    Guard(DT, WHEELS, replace(STAGE, travel=spread(STAGE.travel, place, nextafter(unused, inf))))


@pytest.mark.parametrize("name", ["speed", "acceleration", "jerk", "travel"])
def test_three_limits_each_are_needed(name: str) -> None:
    four: dict[str, object] = {name: (1.0,) * 4}
    refused = pytest.raises((TypeError, ValueError), match=r"zip|tuple\[")
    with refused:
        Guard(DT, WHEELS, replace(STAGE, **four))
    if name != "travel":
        with refused:
            Guard(DT, replace(WHEELS, **four), STAGE)


def spread(three: tuple[float, ...], place: int, value: float) -> tuple[float, ...]:
    return tuple(value if k == place else x for k, x in enumerate(three))


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("inside", [True, False])
def test_positions_may_be_rounded(sign: float, inside: bool) -> None:
    """On a million metres of rail one step of a double is a tenth of a nanometre.

    That is far more than this jerk moves in a tick.
    """
    travel, jerk = 1e6, 1e-6
    guard = Guard(
        DT,
        WheelLimits(*((1.0,) * 3,) * 3),
        StageLimits((travel,) * 3, *((1.0,) * 3,) * 2, (jerk,) * 3),
    )
    step = 4.0 * ulp(travel) * (1.0 - 1e-6 if inside else 1.0 + 1e-3)
    moved = replace(STANDING, time=DT, p_WS_W=(sign * step, 0.0, 0.0))
    assert (guard.check(moved) is moved) == inside, guard.reason
