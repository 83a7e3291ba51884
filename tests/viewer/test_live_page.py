"""The live page without a browser: words, buttons and plots follow the ring."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from live.riding import live_tick

from atlas_cueing.scenario import Platform
from atlas_cueing.telemetry import LiveWriter, Ring, RingReader, live_ring
from atlas_cueing.viewer.controls import Controls
from atlas_cueing.viewer.live_page import LivePage

ALLOWED = {"parked": ("engage",), "running": ("hold", "park"), "stopped": {"reset"}}


class Live:
    """A page and the loop's end of its ring."""

    def __init__(self, server: Any, platform: Platform) -> None:
        self.ring: Ring = live_ring(1.0, 300.0)
        self.writer, self._reader = LiveWriter(self.ring), RingReader(self.ring)
        self.pressed: list[str] = []
        self.page = LivePage(server, platform, self.pressed.append, ALLOWED)
        self.controls = self.page._controls

    def look(self) -> None:
        self.page.take(self._reader.newest())
        self.page.refresh()

    @property
    def head(self) -> str:
        return str(self.controls._head.content)

    def enabled(self) -> set[str]:
        return {name for name, button in self.controls._buttons.items() if not button.disabled}


@pytest.fixture
def live(server: Any, platform: Platform) -> Live:
    return Live(server, platform)


def test_before_the_first_tick(live: Live) -> None:
    live.look()
    assert "starting" in live.head
    assert live.enabled() == set()


def test_state_and_buttons_follow(live: Live) -> None:
    live.writer.status(0.0, "parked", "at the start")
    live.look()
    assert "parked" in live.head
    assert "at the start" in live.head
    assert live.enabled() == {"engage"}
    live.writer.status(1.0, "running", "")
    live.look()
    assert live.enabled() == {"hold", "park"}
    assert "at the start" not in live.head


def test_a_press_goes_on_if_the_state_allows_it(live: Live) -> None:
    live.writer.status(0.0, "running", "")
    live.writer.tick(*live_tick(3.2))
    live.look()
    live.controls.click("hold")
    assert live.pressed == ["hold"]
    assert "hold asked at 3.2 s" in live.controls._note.content
    live.controls.click("reset")
    assert live.pressed == ["hold"]
    assert "reset does nothing when running" in live.controls._note.content


def test_figures(live: Live) -> None:
    tick, timing = live_tick(12.34)
    live.writer.tick(tick, replace(timing, lateness=1.5e-3, input_age=0.021, missed=7.0))
    live.look()
    for text in ("12.3 s", ">7<", "1.50 ms", "0.20 ms", "21 ms"):
        assert text in live.controls._figures.content


def test_ticks_tell_the_state_when_its_message_was_lost(live: Live) -> None:
    live.writer.status(0.0, "parked", "")
    for k in range(400):
        live.writer.tick(*live_tick(k / 300.0))  # running; the ring has been overwritten
    live.look()
    assert "running" in live.head
    assert live.enabled() == {"hold", "park"}


def test_the_end_stays(live: Live) -> None:
    live.writer.tick(*live_tick(1.0))
    live.writer.end(1.0, "ok", "duration <reached>")
    live.look()
    live.look()
    assert "ended" in live.head
    assert "ok: duration &lt;reached&gt;" in live.head
    assert live.enabled() == set()


def test_plots_show_what_was_felt_and_the_share_of_the_limits(
    live: Live, platform: Platform
) -> None:
    for k in range(100):
        live.writer.tick(*live_tick(k / 100.0))
    live.look()
    plots = live.page._plots
    tick, timing = live_tick(0.99)
    assert plots._force.data[0][-1] == pytest.approx(timing.elapsed)
    assert [line[-1] for line in plots._force.data[4:]] == pytest.approx(list(tick.vehicle.f_B))
    assert [line[-1] for line in plots._rate.data[4:]] == pytest.approx(
        np.degrees(tick.vehicle.w_NB_B).tolist()
    )
    share = [
        100.0 * w / limit
        for w, limit in zip(tick.wheels.speed, platform.wheel_limits.speed_rad_s, strict=True)
    ]
    assert [line[-1] for line in plots._wheels.data[1:]] == pytest.approx([*share, 100.0, -100.0])
    assert plots._timing is not None
    assert [line[-1] for line in plots._timing.data[1:]] == pytest.approx([0.01, 0.2])


def test_numbers_that_are_none_are_not_drawn_and_do_no_harm(live: Live) -> None:
    tick, timing = live_tick(1.0)
    live.writer.tick(
        replace(tick, motion=replace(tick.motion, q_WS=(float("nan"),) * 4)),
        replace(timing, state=99.0),
    )
    live.look()
    live.writer.tick(*live_tick(2.0))
    live.look()
    assert "2.0 s" in live.controls._figures.content


def test_controls_know_no_state_machine(server: Any) -> None:
    controls = Controls(server.gui, lambda _: None, {"dreaming": ("park",)}, ("park",))
    controls.show_state("dreaming", "")
    assert list(controls._buttons) == ["park"]
    assert not controls._buttons["park"].disabled
    controls.show_state("awake", "")
    assert controls._buttons["park"].disabled
