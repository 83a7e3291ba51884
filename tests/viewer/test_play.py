"""The play bar of a log."""

from math import inf, nan
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import InputError
from atlas_cueing.review import RecordedRun
from atlas_cueing.viewer.play import SPAN, STEP, PlayHead, PlayPage, play, thinned


def test_it_plays_to_the_end_and_again() -> None:
    head = PlayHead(2.0, 5.0)
    head.advance(1.0)
    assert (head.at, head.playing) == (3.0, True)
    head.run_at(2.0)
    head.advance(0.5)
    assert head.at == 4.0
    head.advance(10.0)
    assert (head.at, head.playing) == (5.0, False)
    head.toggle()
    assert (head.at, head.playing) == (2.0, True)


def test_a_pause_keeps_its_place() -> None:
    head = PlayHead(0.0, 9.0)
    head.seek(4.0)
    head.toggle()
    head.advance(3.0)
    assert (head.at, head.playing) == (4.0, False)
    head.toggle()
    head.advance(0.5)
    assert head.at == 4.5


@given(
    st.lists(
        st.one_of(st.floats(0.0, 3.0), st.sampled_from(["toggle"]), st.floats(-9.0, -0.1)),
        max_size=30,
    )
)
def test_it_never_leaves_the_flight(acts: list[Any]) -> None:
    head = PlayHead(1.0, 6.0)
    for act in acts:
        if act == "toggle":
            head.toggle()
        elif act < 0.0:
            head.seek(-2.0 * act - 3.0)
        else:
            head.advance(act)
        assert 1.0 <= head.at <= 6.0


@pytest.mark.parametrize("at", [nan, inf, -inf])
def test_it_does_not_go_to_what_is_no_time(at: float) -> None:
    head = PlayHead(1.0, 6.0)
    head.seek(3.0)
    head.seek(at)
    head.advance(0.5)
    assert (head.at, head.playing) == (3.5, True)


def sent(server: Any, label: str, value: Any) -> None:
    """Set a value as a client of viser can: of the right type, and otherwise any."""
    (handle,) = (
        h
        for h in server.gui._gui_input_handle_from_uuid.values()
        if getattr(h._impl.props, "label", "") == label
    )
    handle._impl.value = type(handle._impl.value)(value)
    assert handle._impl.update_cb
    for called in handle._impl.update_cb:
        called(SimpleNamespace(client=object(), target=handle))


def test_a_client_is_not_trusted(server: Any, run: RecordedRun) -> None:
    """What the page sends comes from its own buttons and bar, unless somebody else sends it."""
    page = PlayPage(server, run.platform, run.flight)
    sent(server, "speed", "2")
    sent(server, "time, s", 3.0)
    assert (page.head.speed, page.head.at) == (2.0, 3.0)
    for value in ("3", "", "nan", "¼" * 1000):
        sent(server, "speed", value)
    for value in (nan, inf, -inf):
        sent(server, "time, s", value)
    assert (page.head.speed, page.head.at) == (2.0, 3.0)
    sent(server, "speed", "¼")
    sent(server, "time, s", 1e300)
    page.refresh(0.0)
    assert (page.head.speed, page.head.at) == (0.25, page.head.end)


def test_thinned_ticks_are_a_step_apart() -> None:
    time = 3.0 + np.arange(7001) / 1000.0
    shown = thinned(time)
    assert shown[0] == 0
    assert np.diff(time[shown]) == pytest.approx(STEP, abs=2e-3)
    assert time[-1] - time[shown[-1]] <= STEP


def test_the_page_follows_the_play_head(server: Any, run: RecordedRun) -> None:
    page = PlayPage(server, run.platform, run.flight)
    page.refresh(0.0)
    page.head.seek(4.0)
    page._refreshes = 0
    page.refresh(0.25)
    tick = int(np.searchsorted(run.flight.time, 4.25, side="right")) - 1
    cabin = server.scene.get_handle_by_name("/bridge/carriage/telescope/top/cabin")
    assert tuple(cabin.wxyz) == pytest.approx(tuple(run.flight.motion_q_WS[tick]))
    assert page._bar.value == pytest.approx(4.25)
    window = page._window()
    assert window.time[-1] <= 4.25 < window.time[-1] + 2 * STEP
    assert window.time[0] > 4.25 - SPAN
    assert page._plots._wheels.data[1][-1] == pytest.approx(
        100.0
        * run.flight.wheel_speed[np.searchsorted(run.flight.time, window.time[-1]), 0]
        / page._plots._speed[0]
    )
    assert page._button.label == "Pause"
    page.refresh(100.0)
    assert page._button.label == "Play"


def test_it_is_served_until_somebody_says_no(
    run: RecordedRun, capfd: pytest.CaptureFixture[str]
) -> None:
    urls: list[str] = []
    answers = iter([True, True, False])
    play(run.platform, run.flight, urls.append, go_on=lambda: next(answers))
    assert len(urls) == 1
    assert urls[0].startswith("http://127.0.0.1:")
    assert capfd.readouterr() == ("", "")


def test_ctrl_c_ends_it_quietly(run: RecordedRun) -> None:
    def interrupt() -> bool:
        raise KeyboardInterrupt

    play(run.platform, run.flight, lambda _: None, go_on=interrupt)


def test_nothing_to_play(run: RecordedRun) -> None:
    from dataclasses import replace

    with pytest.raises(InputError, match="no motion to show"):
        play(run.platform, replace(run.flight, time=run.flight.time[:0]), lambda _: None)
