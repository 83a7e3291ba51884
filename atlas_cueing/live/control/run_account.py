"""What is told of a live run: its changes of state while it happens, and how it went."""

# mypyc: runs every tick

from dataclasses import dataclass

from .state_machine import State


@dataclass(frozen=True, slots=True)
class RunOutcome:
    """How a run went.

    result: ok, vehicle_failed, input_lost, viewer_died, fault or stopped: the first thing that went
        wrong.
    reason: what went wrong, in words; empty for ok.
    faults: number of faults.
    dropped: number of samples that the source refused.
    """

    result: str = "ok"
    reason: str = ""
    faults: int = 0
    dropped: int = 0


class RunAccount:
    """Keeps what has happened in a run.

    faults: number of faults up to now.
    """

    def __init__(self, state: State) -> None:
        """Begin in this state."""
        self._changes: list[tuple[State, str]] = [(state, "")]
        self._failures: list[tuple[str, str]] = []  # result and reason, in order
        self.faults = 0

    @property
    def failed(self) -> bool:
        """Whether anything has gone wrong."""
        return bool(self._failures)

    def tell(self, state: State, text: str) -> None:
        """Note a new state and its reason, or something that is to be told in this state."""
        self._changes.append((state, text))

    def take_changes(self) -> list[tuple[State, str]]:
        """Return the changes of state since the last call, each with its reason."""
        changes, self._changes = self._changes, []
        return changes

    def fail(self, result: str, reason: str) -> None:
        """Note what went wrong; the first counts."""
        self._failures.append((result, reason))

    def outcome(self, dropped: int, absence: str) -> RunOutcome:
        """Return how the run has gone up to now.

        Args:
            dropped: number of samples that the source refused.
            absence: why it had no input, if it asked for some; empty if it had.
        """
        first = self._failures[0] if self._failures else ("ok", "")
        result, reason = ("input_lost", absence) if first[0] == "ok" and absence else first
        return RunOutcome(result, reason, self.faults, dropped)


def described(error: BaseException) -> str:
    """Return the error in words; one that cannot tell them is named."""
    try:
        return f"{type(error).__name__}: {error}"
    except BaseException:  # noqa: BLE001
        return type(error).__name__
