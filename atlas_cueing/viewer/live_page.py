"""The page of a live run, in a process of its own: no browser can disturb the loop's process."""

from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING

from ..scenario import Platform
from ..signals import LIVE_STATES
from ..telemetry.messages import END, STATUS, TICK, numbers, status
from ..telemetry.operator_buttons import BUTTONS
from .controls import ENDED, Controls
from .history import History
from .live_plots import Plots
from .scene import KEY, Scene

if TYPE_CHECKING:
    from viser import ViserServer

_PLOT_EVERY = 5  # refreshes


class LivePage:
    """The page of a live run: scene, state, buttons and plots."""

    def __init__(
        self,
        server: "ViserServer",
        platform: Platform,
        press: Callable[[str], object],
        allowed: Mapping[str, Collection[str]],
    ) -> None:
        self._scene = Scene(server, platform)
        self._controls = Controls(server.gui, press, allowed, BUTTONS)
        server.gui.add_html(KEY)
        server.gui.main_panel.dock_left()
        server.gui.main_panel.set_width(270)
        panel = server.gui.add_panel()
        with panel.add_tab("Last 20 s"):
            self._plots = Plots(server.gui, platform, timing=True)
        panel.dock_right()
        panel.set_width(430)
        self._history = History(platform.head_S)
        self._state, self._reason, self._refreshes = "", "", 0

    def take(self, messages: Iterable[tuple[int, bytes]]) -> None:
        """Keep ring messages (kind, content); nothing is drawn yet but a change of state."""
        rows, shown = [], (self._state, self._reason)
        for kind, data in messages:
            if kind == TICK:
                rows.append(numbers(data))
            elif kind == STATUS:
                self._state, self._reason = status(data).state, status(data).reason
            elif kind == END:
                end = status(data)
                self._state = ENDED
                self._reason = f"{end.state}: {end.reason}" if end.reason else end.state
        self._history.add(rows)
        if rows and self._state != ENDED:
            self._follow_ticks()
        if (self._state, self._reason) != shown:
            self._controls.show_state(self._state, self._reason)

    def refresh(self) -> None:
        """Draw the last tick, and the plots every few times."""
        if self._history.empty:
            return
        pose = self._history.pose()
        if pose.finite:
            self._scene.show(pose)
        late, cost, age, missed, _ = self._history.timing
        self._controls.show_figures(self._history.time, missed, late, cost, age)
        if self._refreshes % _PLOT_EVERY == 0:
            self._plots.show(self._history.traces())
        self._refreshes += 1

    def _follow_ticks(self) -> None:
        """Take the state from the ticks when the message of a change has been lost."""
        place = self._history.timing[-1]
        if 0 <= place < len(LIVE_STATES) and LIVE_STATES[place] != self._state:
            self._state, self._reason = LIVE_STATES[place], ""
