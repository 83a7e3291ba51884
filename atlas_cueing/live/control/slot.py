"""The slot of real time that one tick belongs to."""

# mypyc: runs every tick

from collections.abc import Callable

RESERVE = 0.001  # s that guard, encoding and transport of a set point may take (assumed)

_REMEDY = "what helps: --priority, a longer --lead, a lower --rate, fewer programs beside it"


class Slot:
    """One period of the loop.

    Whoever follows set points needs this slot's when the one before it is due. So the slot is lost
    as soon as less than RESERVE is left until then.

    now: returns the time of the loop's clock, s.
    time: of the platform, s.
    due: when the drives shall have this slot's set point, ns of the clock.
    """

    def __init__(self, now: Callable[[], float], time: float, needed: float, due: int = 0) -> None:
        """Begin with its set point not yet sent.

        Args:
            now: returns the time of the loop's clock, s.
            time: of the platform, s.
            needed: when the set point has to be with the drives, s of the clock.
            due: when the drives shall have it, ns of the clock.
        """
        self.now, self._latest = now, needed - RESERVE
        self.time, self.due = time, due

    def late(self) -> float:
        """Return by how much it is too late now for the set point of this slot, s.

        A number above zero means that the slot is lost.
        """
        return self.now() - self._latest


def lateness_text(late: float, drives: bool) -> str:
    """Return in words what a slot that is lost by `late` (s) means, with or without drives."""
    lost = "a set point came {:.1f} ms too late for the drives"
    if not drives:
        lost = "a tick came {:.1f} ms too late for its slot"
    return f"{lost.format(1e3 * late)}; {_REMEDY}"
