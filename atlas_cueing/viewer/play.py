"""Shows a log in the live page's scene, with a play bar."""

import time
from collections.abc import Callable
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from ..evaluation import RunColumns
from ..scenario import Platform
from .forces import largest_g
from .live_plots import Plots, Traces
from .recorded_motion import RecordedMotion
from .scene import KEY, Scene
from .server import check_viser, close_server, open_server, url_of

if TYPE_CHECKING:
    from viser import ViserServer

_REFRESH = 0.04  # s
_PLOT_EVERY = 5  # refreshes
SPAN, STEP = 20.0, 0.05  # s; of the plots, and from point to point
_SPEEDS = ("¼", "½", "1", "2", "4")
_TIMES = dict(zip(_SPEEDS, (0.25, 0.5, 1.0, 2.0, 4.0), strict=True))


class PlayHead:
    """The position of the player between `start` and `end` (s).

    at: present position, s.
    playing: whether it moves; `speed` is in s of the flight a second.
    """

    def __init__(self, start: float, end: float) -> None:
        self.start, self.end, self.at = start, end, start
        self.playing, self.speed = True, 1.0

    def advance(self, elapsed: float) -> None:
        """Go on by `elapsed` s of real time; stop at the end."""
        if self.playing:
            self.at = min(self.end, self.at + self.speed * elapsed)
            self.playing = self.at < self.end

    def toggle(self) -> None:
        """Play or pause; from the end, play again from the start."""
        if not self.playing and self.at >= self.end:
            self.at = self.start
        self.playing = not self.playing

    def run_at(self, speed: float) -> None:
        """Set the speed, in seconds of the flight a second."""
        self.speed = speed

    def seek(self, at: float) -> None:
        """Go to a time (s), unless it is not finite; whether it plays stays as it is."""
        if isfinite(at):
            self.at = min(max(at, self.start), self.end)


class PlayPage:
    """The page of a log: scene, play bar and plots."""

    def __init__(self, server: "ViserServer", platform: Platform, flight: RunColumns) -> None:
        self._flight, self._motion = flight, RecordedMotion(flight, platform)
        self._points = thinned(flight.time)
        self.head = PlayHead(float(flight.time[0]), float(flight.time[-1]))
        self._scene = Scene(server, platform, largest_g(flight.vehicle_f_B, flight.felt_f))
        gui = server.gui
        gui.main_panel.dock_left()
        gui.main_panel.set_width(270)
        self._button = gui.add_button("Pause", hint="Play or pause")
        length = max(self.head.end - self.head.start, STEP)
        self._bar: Any = gui.add_slider(
            "time, s",
            self.head.start,
            self.head.start + length,
            step=STEP,
            initial_value=self.head.start,
        )
        speed: Any = gui.add_button_group("speed", _SPEEDS)
        self._button.on_click(lambda _: self.head.toggle())
        self._bar.on_update(
            lambda event: None if event.client is None else self.head.seek(self._bar.value)
        )
        # any text a client sends
        speed.on_click(lambda _: self.head.run_at(_TIMES.get(speed.value, self.head.speed)))
        gui.add_html(KEY)
        panel = gui.add_panel()
        with panel.add_tab("Last 20 s"):
            self._plots = Plots(gui, platform, timing=False)
        panel.dock_right()
        panel.set_width(430)
        self._refreshes = 0

    def refresh(self, elapsed: float) -> None:
        """Go on by `elapsed` s of real time and draw."""
        before = self.head.at
        self.head.advance(elapsed)
        label = "Pause" if self.head.playing else "Play"
        if self._button.label != label:
            self._button.label = label
        tick = int(np.searchsorted(self._flight.time, self.head.at, side="right")) - 1
        self._scene.show(self._motion.pose(max(tick, 0)))
        if self.head.at != before:
            self._bar.value = self.head.at
        if self._refreshes % _PLOT_EVERY == 0:
            self._plots.show(self._window())
        self._refreshes += 1

    def _window(self) -> Traces:
        """Return the SPAN seconds up to the present position."""
        time = self._flight.time[self._points]
        ticks = self._points[(time > self.head.at - SPAN) & (time <= self.head.at)]
        f = self._flight
        columns = (
            f.time,
            f.vehicle_f_B,
            f.felt_f,
            f.vehicle_w_B,
            f.felt_w,
            f.wheel_speed,
            f.motion_p_W,
        )
        time, pilot_f, felt_f, pilot_w, felt_w, wheel_speed, p_W = (
            column[ticks] for column in columns
        )
        return Traces(time, pilot_f, felt_f, pilot_w, felt_w, wheel_speed, p_W, None)


def thinned(time: np.ndarray) -> np.ndarray:
    """Return the ticks to plot, about STEP apart."""
    count = int((time[-1] - time[0]) / STEP) + 1
    return np.unique(
        np.searchsorted(time, time[0] + STEP * np.arange(count)).clip(0, len(time) - 1)
    )


def play(
    platform: Platform,
    flight: RunColumns,
    report_url: Callable[[str], object],
    *,
    port: int = 0,
    title: str | None = None,
    go_on: Callable[[], bool] = lambda: True,
) -> None:
    """Serve a flight until Ctrl-C.

    Args:
        platform: to draw.
        flight: columns of the log.
        report_url: called with the page's address.
        port: of 127.0.0.1; 0 takes a free one.
        title: of the page.
        go_on: checked between two refreshes; False ends it, too.

    Raises InputError when viser is missing, the port is in use, or there is no motion to show.
    """
    check_viser("live")
    RecordedMotion(flight)
    server = open_server(port, title)
    try:
        page = PlayPage(server, platform, flight)
        report_url(url_of(server))
        last = time.monotonic()
        while go_on():
            now = time.monotonic()
            page.refresh(now - last)
            last = now
            time.sleep(_REFRESH)
    except KeyboardInterrupt:
        pass
    finally:
        close_server(server)
