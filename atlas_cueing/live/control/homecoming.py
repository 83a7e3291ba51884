"""What becomes of a run with drives that has stopped and that nobody attends.

A program that ended would leave its rider where the platform stopped, perhaps upside down. So after
lateness, and nothing else, the platform goes slowly home as soon as the loop has been punctual for
a while. After any other fault it stands where it is, with set points, until the run is asked to end
once more.
"""

# mypyc: runs every tick

from typing import Final

HOME_AFTER: Final = 5.0  # s of punctual slots (assumed)


class Homecoming:
    """Decides when a stopped run goes home, and when it may end.

    homeward: the platform is on its way home, or goes there next; no flight comes after it.
    """

    def __init__(self, applies: bool, stopped: bool) -> None:
        """Begin with no way home known to be needed.

        Args:
            applies: there are drives, and nobody attends the run.
            stopped: the run starts stopped.
        """
        self._applies, self.homeward = applies, stopped
        self._late_only = False
        self._punctual_since: float | None = None  # s
        self._requests = self._requests_before = 0  # to end, that do not count any more

    @property
    def advice(self) -> str:
        """What to tell the user of a run that has stopped; empty for one that ends."""
        if not self._applies:
            return ""
        remedy = f"after {HOME_AFTER:g} punctual s" if self._late_only else "no more"
        return f"set points go on; it moves {remedy}; Ctrl-C or SIGTERM ends the run"

    def note_fault(self, requests: int) -> None:
        """Note a fault, which is none of lateness until `note_lateness` says so.

        requests: to end, up to now, which do not end the run once it has stopped.
        """
        self._late_only = False
        self._requests_before = requests

    def note_lateness(self) -> None:
        """Note that lateness was the reason of the fault."""
        self._late_only = True

    def note_stop(self) -> None:
        """Note that the platform has stopped.

        Two requests have asked for this stop, and the second is all that is needed.
        """
        self._punctual_since = None
        self._requests = self._requests_before - (self._requests_before > 1)

    def waits(self, requests: int) -> bool:
        """Whether an operator's reset is waited for: nobody has asked to end since the fault."""
        return requests < 2 and requests <= self._requests_before

    def stays(self, requests: int) -> bool:
        """Whether a stopped run goes on, asked to end so often up to now."""
        return self._applies and requests <= self._requests

    def sets_out(self, time: float, good: bool) -> bool:
        """Return whether a stopped platform goes home now.

        Args:
            time: of the platform, s.
            good: the slot is punctual, and the drives are ready.
        """
        if not (self._applies and self._late_only and good):
            self._punctual_since = None
            return False
        if self._punctual_since is None:
            self._punctual_since = time
        self.homeward |= time - self._punctual_since >= HOME_AFTER
        return time - self._punctual_since >= HOME_AFTER
