"""The panel of a live page: state, figures of the last tick, and the operator's buttons."""

from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING, Literal

from ..printable import html_text

if TYPE_CHECKING:
    from viser import GuiApi

ENDED = "ended"
_BUTTONS: tuple[tuple[str, Literal["green", "yellow", "orange", "gray"], str], ...] = (
    ("engage", "green", "Take the platform from rest to the vehicle's motion"),
    ("hold", "yellow", "Bring the platform to a standstill where it is"),
    ("park", "orange", "Bring the platform to its rest position"),
    ("reset", "gray", "Leave a fault behind"),
)
_COLOURS = {
    "running": "#00795a",
    "fault_stopping": "#b3261e",
    "stopped": "#b3261e",
    "parked": "#5b6470",
    ENDED: "#5b6470",
}
_OTHER = "#b36b00"  # a state on the way to another
_TABLE = (
    '<table style="width:calc(100% - 28px);margin:6px'
    ' 14px;font-size:14px;font-variant-numeric:tabular-nums">{}</table>'
)
_ROW = (
    '<tr><td style="color:#5b6470;padding-right:14px">{}</td><td'
    ' style="text-align:right">{}</td></tr>'
)


class Controls:
    """The panel: a press is passed on if the state allows it, and confirmed in the panel."""

    def __init__(
        self,
        gui: "GuiApi",
        press: Callable[[str], object],
        allowed: Mapping[str, Collection[str]],
        names: Collection[str],
    ) -> None:
        """Add the panel to a page.

        Args:
            gui: of the page.
            press: called with the name of a button that is pressed.
            allowed: the buttons that have an effect, by the name of the state.
            names: the buttons to show.
        """
        self._press = press
        self._allowed = allowed
        self._state, self._time = "", 0.0
        self._head = gui.add_html("")
        self._buttons = {
            name: gui.add_button(name.capitalize(), color=c, hint=h)
            for name, c, h in _BUTTONS
            if name in names
        }
        for name, button in self._buttons.items():
            button.on_click(self._clicked(name))
        self._note = gui.add_html("")
        self._figures = gui.add_html("")
        self.show_state("starting", "the loop is about to begin")

    def show_state(self, state: str, reason: str) -> None:
        """Show a state and the reason for it; enable the buttons that it allows."""
        self._state = state
        colour = _COLOURS.get(state, _OTHER)
        title = html_text(state.replace("_", " "))
        self._head.content = (
            f'<div style="background:{colour};color:#fff;border-radius:6px;margin:8px'
            ' 10px;padding:10px 14px"><div id="state"'
            f' style="font-size:26px;font-weight:700">{title}</div><div'
            f' id="reason" style="font-size:13px;min-height:1.3em">{html_text(reason)}</div></div>'
        )
        for name, button in self._buttons.items():
            button.disabled = name not in self._allowed.get(state, ())

    def show_figures(
        self, time: float, missed: float, late: float, cost: float, age: float
    ) -> None:
        """Show the figures of a tick.

        Args:
            time: of the platform, s.
            missed: deadlines missed up to now.
            late: from the deadline to the tick's beginning, s.
            cost: of the tick, s.
            age: of the input, s.
        """
        self._time = time
        rows = (
            ("time", f"{time:.1f} s"),
            ("missed deadlines", f"{missed:.0f}"),
            ("late", f"{1e3 * late:.2f} ms"),
            ("cost of a tick", f"{1e3 * cost:.2f} ms"),
            ("age of the input", f"{1e3 * age:.0f} ms"),
        )
        table = "".join(_ROW.format(*row) for row in rows)
        self._figures.content = _TABLE.format(table)

    def _clicked(self, name: str) -> Callable[[object], None]:
        return lambda _: self.click(name)

    def click(self, name: str) -> None:
        """Press a button, or show that the present state does not allow it."""
        if name in self._allowed.get(self._state, ()):
            self._press(name)
            note = f"{name} asked at {self._time:.1f} s"
        else:
            note = f"{name} does nothing when {self._state.replace('_', ' ')}"
        self._note.content = (
            '<div id="note" style="margin:4px'
            f' 14px;font-size:13px;color:#2c3440;min-height:1.4em">{html_text(note)}</div>'
        )
