"""The jobs that are left, handed out so that a worker stays with the flight it has."""

from collections import deque
from collections.abc import Collection, Iterable

from .job import Job

AHEAD = 64  # jobs looked through; more cost memory, some 10 kB each


class JobQueue:
    """Jobs in their order, but for those of a flight that a worker has flown already."""

    def __init__(self, jobs: Iterable[Job]) -> None:
        """Take jobs from `jobs` as they are needed, AHEAD of them beforehand."""
        self._more = iter(jobs)
        self._seen: deque[Job] = deque()

    def __bool__(self) -> bool:
        """Whether there are jobs left."""
        self._look_ahead()
        return bool(self._seen)

    def next(self, flight: str, others: Collection[str] = ()) -> Job | None:
        """Give the next job for a worker that last flew `flight`; None when there are no more.

        It is one of the same flight, else one of a flight that no worker is at, else the first.

        others: flights of the other workers.
        """
        self._look_ahead()
        if not self._seen:
            return None
        fit = (each for each in self._seen if each.flight == flight and flight)
        free = (each for each in self._seen if each.flight not in others)
        chosen = next(fit, None) or next(free, None) or self._seen[0]
        self._seen.remove(chosen)
        return chosen

    def _look_ahead(self) -> None:
        while len(self._seen) < AHEAD and (job := next(self._more, None)):
            self._seen.append(job)
