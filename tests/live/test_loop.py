"""The schedule against a clock under control.

Absolute, missed slots made up, everything in order.
"""

from collections.abc import Callable

import pytest

from atlas_cueing.live.control.state_machine import State
from atlas_cueing.live.loop import LEAD

from .rig import Rig
from .rig_parts import Watched

DT = 0.01


def run(delays: dict[int, float], ticks: int = 60, costs: dict[int, float] | None = None) -> Rig:
    """Run a loop of some ticks.

    The wait before tick k (from 1) takes delays[k] s too long, and tick k takes costs[k] s.
    """
    rig = Rig(DT, duration=1e9)
    costs = costs or {}
    wait = rig.clock.sleep_until
    begun = [0]

    def sleep_until(time: float) -> None:
        begun[0] += 1
        rig.clock.delay = delays.get(begun[0], 0.0)
        wait(time)

    def costly() -> None:
        rig.clock.time += costs.get(begun[0], 0.0)
        if begun[0] == ticks:
            rig.wanted.signals = 1

    rig.clock.sleep_until = sleep_until  # type: ignore[method-assign]
    rig.loop._controller = Watched(rig.controller, costly)  # type: ignore[assignment]
    rig.loop.run()
    return rig


def test_a_punctual_run() -> None:
    rig = run({})
    timings = rig.tape.timings
    assert [t.elapsed for t in timings] == pytest.approx([k * DT for k in range(60)], abs=1e-9)
    assert [t.time for t in timings] == [(k + 1) * DT for k in range(60)]
    assert {(t.missed, t.cost) for t in timings} == {(0, 0.0)}
    assert max(abs(t.lateness) for t in timings) < 1e-9
    assert rig.loop.ticks == 60
    assert rig.loop.time == 60 * DT


def test_the_schedule_is_absolute() -> None:
    """Half a period late, ten times: no deadline moves, and the late ticks are recorded as late."""
    rig = run(dict.fromkeys(range(10, 20), 0.005))
    timings = rig.tape.timings
    assert [t.elapsed for t in timings] == pytest.approx([k * DT for k in range(60)], abs=1e-9)
    assert [round(t.lateness, 9) for t in timings] == [
        0.005 if 10 <= k < 20 else 0.0 for k in range(1, 61)
    ]
    assert rig.loop.timing.missed == 0
    assert rig.loop.timing.lateness.maximum == pytest.approx(0.005)


def test_missed_slots_are_made_up_in_order() -> None:
    """1.5 periods late at one tick: the next one begins at once, and all have their own time."""
    rig = run({20: 0.015})
    timings = rig.tape.timings
    assert [t.lateness for t in timings[18:22]] == pytest.approx([0.0, 0.015, 0.005, 0.0], abs=1e-9)
    assert [t.missed for t in timings] == [0] * 19 + [1] * 41
    assert [t.elapsed for t in timings] == pytest.approx([k * DT for k in range(60)], abs=1e-9)
    assert [t.time for t in timings] == [(k + 1) * DT for k in range(60)]
    assert rig.controller.outcome.faults == 0


def test_what_a_tick_costs_makes_the_next_ones_late() -> None:
    rig = run({}, costs={20: 0.025})
    timings = rig.tape.timings
    assert timings[19].cost == pytest.approx(0.025)
    assert rig.loop.timing.cost.maximum == pytest.approx(0.025)
    assert timings[20].lateness == pytest.approx(0.015)
    assert [t.missed for t in timings][19:23] == [0, 1, 1, 1]
    assert timings[-1].elapsed == pytest.approx(59 * DT, abs=1e-9)


def test_lost_slots_while_parked_are_no_fault() -> None:
    rig = run({20: 0.3})
    assert rig.loop.timing.longest_row in (29, 30)
    assert rig.controller.outcome.faults == 0
    assert len(rig.tape.commands) == 60
    assert len({command.p_WS_W + command.wheel_angle for command in rig.tape.commands}) == 1


def test_states_are_reported_before_their_first_tick() -> None:
    rig = Rig(DT)
    rig.controller.engage()
    events: dict[int, Callable[[], None]] = {
        200: lambda: setattr(rig.source, "quiet", True),
        240: lambda: setattr(rig.source, "quiet", False),
        700: lambda: setattr(rig.wanted, "signals", 1),
    }
    wait = rig.clock.sleep_until

    def sleep_until(time: float) -> None:
        events.get(len(rig.tape.ticks), lambda: None)()
        wait(time)

    rig.clock.sleep_until = sleep_until  # type: ignore[method-assign]
    rig.loop.run()
    changes = [(time, state) for time, state, _ in rig.tape.statuses]
    assert [state for _, state in changes][:6] == [
        "parked",
        "engaging",
        "holding",
        "engaging",
        "running",
        "parking",
    ]
    assert changes[-1][1] == "parked"
    names = [state.value for state in State]
    current, ticks = "", iter(rig.tape.timings)
    for what in rig.tape.order:
        if what != "tick":
            current = what
            continue
        timing = next(ticks)
        assert names[int(timing.state)] == current
        assert not [
            t
            for t, state in changes
            if t > timing.time and state == current and changes.index((t, state)) == 0
        ]


def test_drives_hear_every_tick_ahead_of_time() -> None:
    rig = run({20: 0.015})
    timings = rig.tape.timings
    assert [sequence for sequence, *_ in rig.tape.sent] == list(range(1, 61))
    for k, ((_, time, due, state), timing) in enumerate(zip(rig.tape.sent, timings, strict=True)):
        assert time == timing.time
        assert due == round(1e9 * (rig.start - DT)) + (k + 2) * 10_000_000 + round(1e9 * LEAD)
        assert state == timing.state
    assert [command.time for command in rig.tape.commands] == [timing.time for timing in timings]


def test_the_age_of_the_input_is_recorded_and_none_is_minus_one() -> None:
    rig = Rig(DT)
    rig.source.quiet = True
    events = {5: False, 9: True}
    wait = rig.clock.sleep_until

    def sleep_until(time: float) -> None:
        rig.source.quiet = events.get(len(rig.tape.ticks), rig.source.quiet)
        rig.wanted.signals = int(len(rig.tape.ticks) > 12)
        wait(time)

    rig.clock.sleep_until = sleep_until  # type: ignore[method-assign]
    rig.loop.run()
    ages = [timing.input_age for timing in rig.tape.timings]
    assert ages[:10] == pytest.approx([-1.0] * 5 + [0.0] * 4 + [DT])


def test_the_next_tick_is_prepared_when_all_of_this_one_has_gone_out() -> None:
    rig = Rig(DT)
    prepared: list[tuple[float, int, int]] = []

    def ahead(time: float) -> None:
        prepared.append((time, len(rig.tape.commands), len(rig.tape.ticks)))

    rig.loop._controller = Watched(rig.controller, ahead=ahead)  # type: ignore[assignment]
    wait = rig.clock.sleep_until

    def sleep_until(time: float) -> None:
        rig.wanted.signals = int(len(rig.tape.ticks) > 12)
        wait(time)

    rig.clock.sleep_until = sleep_until  # type: ignore[method-assign]
    rig.loop.run()
    assert prepared == [((k + 1) * DT, k, k) for k in range(1, len(rig.tape.ticks) + 1)]


def test_the_vehicle_is_prepared_only_while_it_flies() -> None:
    rig = Rig(DT)
    rig.controller.prepare(1.0)
    rig.bring_to(State.RUNNING)
    rig.controller.prepare(2.0)
    rig.press("hold")
    rig.tick()
    rig.controller.prepare(3.0)
    assert rig.source.prepared == [2.0]
