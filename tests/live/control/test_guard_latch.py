"""When the guard opens, latches and opens again, and what times it takes."""

import re
from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal
from math import inf, nan, nextafter, ulp

import pytest
from installed import COMPILED

from atlas_cueing.errors import InputError
from atlas_cueing.live.control.guard import Guard

from .guard_runs import DT, fresh, misshapen, moving, underway
from .guard_states import AXES, ROUNDING, STAGE, STANDING, WHEELS, alone, guard_at, states


def test_a_new_guard_stands_open_in_the_centre() -> None:
    guard = fresh()
    assert (guard.reason, guard.stopping, guard.standing) == ("", False, True)
    assert guard.check(STANDING) is STANDING


@pytest.mark.parametrize("axis", range(6))
def test_any_motion_of_any_axis_is_no_standstill(axis: int) -> None:
    for state in ((0.0, 1e-9, 0.0), (0.0, 0.0, -1e-9)):
        assert not guard_at(DT, alone(axis, state, 0.0)).standing
    assert guard_at(DT, alone(axis, (0.5, 0.0, 0.0), 0.0)).standing


def test_it_lets_motion_through_and_is_not_standing() -> None:
    guard = underway()
    assert not guard.standing
    assert not guard.stopping


def test_the_first_refusal_latches_with_its_reason() -> None:
    guard = underway()
    wrong = replace(moving(5), p_WS_W=(0.3, 0.0, 0.0))
    given = [guard.check(wrong)]
    reason = guard.reason
    wanted = (
        rf"stage x position by the speed 0\.3, allowed: \S+ <= value <= [-.e0-9]+, at {5 * DT} s"
    )
    assert re.fullmatch(wanted, reason), reason
    given += [guard.check(replace(moving(n), p_WS_W=(0.9, 0.0, 0.0))) for n in range(6, 10)]
    given += [guard.stop(10 * DT)]
    assert (guard.reason, guard.stopping) == (reason, True)
    braked = underway()
    assert [braked.stop(n * DT) for n in range(5, 11)] == given, (
        "the same stop, whatever it is asked"
    )
    assert braked.reason == f"no command at {5 * DT} s"
    assert [one.time for one in given] == [n * DT for n in range(5, 11)]


def test_fit_commands_do_not_open_it_again() -> None:
    guard = underway()
    guard.stop(5 * DT)
    for n in range(6, 500):
        guard.stop(n * DT)
    assert guard.standing
    held = guard._last
    for n in range(1, 5):
        fit = replace(held, time=held.time + n * DT)
        assert guard.check(fit) == fit
        assert guard.stopping
    assert (
        guard.check(replace(fit, time=fit.time + DT, p_WS_W=(0.0, 0.0, 0.0))).p_WS_W == held.p_WS_W
    )


def test_a_standing_start_opens_it_again_anywhere_at_any_time() -> None:
    guard = underway()
    guard.stop(5 * DT)
    place = replace(STANDING, time=-7.0, p_WS_W=(-0.9, 0.7, -0.5))
    guard.start(place)
    assert (guard.reason, guard.stopping, guard.standing) == ("", False, True)
    following = replace(place, time=-7.0 + DT)
    assert guard.check(following) is following
    guard.check(replace(following, time=-7.0 + 2.0 * DT, wheel_speed=(9.0, 0.0, 0.0)))
    assert guard.stopping
    second = guard.stop(-7.0 + 3.0 * DT)
    assert second == replace(place, time=-7.0 + 3.0 * DT), "the new stop, from its beginning"


@pytest.mark.parametrize("axis", range(6))
@pytest.mark.parametrize("rate", [1e-12, -1e-12, nan])
def test_a_start_in_motion_is_refused(axis: int, rate: float) -> None:
    guard = fresh()
    for state in ((0.0, rate, 0.0), (0.0, 0.0, rate)):
        with pytest.raises(
            InputError, match=r"standstill inside the travel: a rate .*, allowed: 0 <= value <= 0$"
        ):
            guard.start(alone(axis, state, 0.0))


@pytest.mark.parametrize("axis", [3, 4, 5])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_start_outside_the_travel_is_refused(axis: int, sign: float) -> None:
    end = ROUNDING * STAGE.travel[axis - 3] - STAGE.acceleration[axis - 3] * DT * DT / 8.0
    fresh().start(alone(axis, (sign * end, 0.0, 0.0), 0.0))
    with pytest.raises(InputError, match=f"{AXES[axis]} position"):
        fresh().start(alone(axis, (sign * (end + 1e-12), 0.0, 0.0), 0.0))


@pytest.mark.parametrize("time", [nan, inf, nextafter(1e10, inf), nextafter(-1e10, -inf)])
def test_a_start_at_no_time_is_refused(time: float) -> None:
    guard = fresh()
    with pytest.raises(
        InputError,
        match=(
            r"^start from a standstill inside the travel: time \S+, allowed: -10000000000 <= value"
            r" <= 10000000000$"
        ),
    ):
        guard.start(replace(STANDING, time=time))
    assert guard.check(replace(STANDING, time=time)) == replace(STANDING, time=DT)
    assert guard.reason.startswith("time ")


@pytest.mark.parametrize("time", [1e10, -1e10, 0.0, 1.7e9])
def test_the_first_command_may_have_any_time(time: float) -> None:
    guard, first = fresh(), replace(STANDING, time=time)
    assert guard.check(first) is first
    guard.start(first)
    assert guard.stop(time) == replace(first, time=time + DT)


@pytest.mark.parametrize(
    ("late", "fit"),
    [
        (lambda _: 0.0, False),
        (lambda _: -1.0, False),
        (lambda _: 0.5 * DT, False),
        (lambda _: DT, True),
        (lambda _: nextafter(DT * (1.0 - 1e-6), 0.0), False),
        (lambda _: DT * (1.0 - 1e-6), True),
        (lambda _: 3.0 * DT, True),
        (lambda _: DT + 0.1, True),
        (lambda _: nextafter(DT + 0.1, inf), False),
    ],
)
def test_a_late_command_is_fit_and_an_early_one_is_not(
    late: Callable[[float], float], fit: bool
) -> None:
    guard = fresh()
    guard.start(STANDING)
    one = replace(moving(1), time=late(0.0))
    given = guard.check(one)
    assert (given is one) == fit, guard.reason
    if not fit:
        assert given == replace(STANDING, time=DT), "a time that cannot be is not put out"
        assert guard.reason.startswith("time ")


@pytest.mark.parametrize(("ulps", "fit"), [(0, True), (-2, True), (-3, False), (-4, False)])
def test_a_time_may_be_early_by_its_rounding(ulps: int, fit: bool) -> None:
    """A clock of 2^30 s, 1 January 2004, has steps of 0.24 us.

    That is 30 times what a tick of 8 ms may be early otherwise.
    """
    start = 2.0**30
    guard = fresh()
    guard.start(replace(STANDING, time=start))
    one = moving(1, start)
    one = replace(one, time=one.time + ulps * ulp(start))
    assert (guard.check(one) is one) == fit


@pytest.mark.parametrize("time", [None, "now", Decimal("0.04"), 5 * DT + 0j])
def test_a_time_of_another_kind_stops_it(time: object) -> None:
    """Also one that compares with numbers but does not add to them; and nothing is kept of it.

    A compiled command has none but numbers, and makes one of a decimal.
    """
    guard = underway()
    one, next_one = (misshapen(moving(k), "time", 0, time) for k in (5, 6))
    if one is None or next_one is None or (COMPILED and type(one.time) is float):
        return
    assert guard.check(one) == underway().stop(5 * DT)
    assert guard.reason.startswith("no command at all: ")
    assert guard.reason.endswith(f", at {time} s")
    assert guard.check(next_one).time == 6 * DT


def test_a_time_may_be_a_whole_number() -> None:
    guard = Guard(1.0, WHEELS, STAGE)
    assert [guard.stop(time).time for time in (5, 6, 7)] == [5, 6, 7]


@pytest.mark.parametrize("time", [None, "", nan, inf, -5.0, 4 * DT, 4 * DT + 0.2, 1e300])
def test_the_stop_keeps_time_when_it_is_given_none(time: float) -> None:
    guard = underway()
    assert [guard.stop(time).time for _ in range(3)] == pytest.approx(
        [5 * DT, 6 * DT, 7 * DT], abs=1e-12
    )


@pytest.mark.parametrize("time", [DT * (1.0 - 1e-6), DT + 0.1])
def test_the_stop_takes_any_time_that_a_command_may_have(time: float) -> None:
    guard = fresh()
    guard.start(STANDING)
    assert guard.stop(time).time == time


def test_a_late_tick_of_the_stop_is_its_next_one() -> None:
    late, prompt = underway(), underway()
    for n in range(5, 9):
        assert states(late.stop(2 * n * DT)) == states(prompt.stop(n * DT))
        assert late._last.time == 2 * n * DT
