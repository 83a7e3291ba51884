"""Which job a worker gets: one of the flight that it has, and no other worker's where possible."""

from collections.abc import Iterator

from atlas_cueing.batch.job import Job, RunLimits
from atlas_cueing.batch.job_queue import AHEAD, JobQueue


def jobs(flights: str) -> Iterator[Job]:
    """A job of each flight in a row, named by flight and place."""
    for place, flight in enumerate(flights):
        yield Job(f"{flight.strip()}{place}", "", {}, RunLimits(), flight=flight.strip())


def ids(queue: JobQueue, *asked: tuple[str, str]) -> list[str]:
    """What workers get that have a flight while others have theirs."""
    found = [queue.next(flight, set(others)) for flight, others in asked]
    return [job.id if job else "-" for job in found]


def test_a_worker_stays_with_its_flight_and_leaves_others_theirs() -> None:
    queue = JobQueue(jobs("aabbcc"))
    asked = ("", ""), ("", "a"), ("a", "b"), ("b", "a"), ("a", "b"), ("b", "ac"), ("c", "b")
    assert ids(queue, *asked) == ["a0", "b2", "a1", "b3", "c4", "c5", "-"]


def test_jobs_of_no_flight_come_in_their_order() -> None:
    assert ids(JobQueue(jobs("   a")), ("", ""), ("", ""), ("", "a"), ("", "")) == [
        "0",
        "1",
        "2",
        "a3",
    ]


def test_only_a_bounded_number_is_taken_beforehand() -> None:
    taken = []

    def counted() -> Iterator[Job]:
        for job in jobs("a" * 1000 + "b"):
            taken.append(job)
            yield job

    queue = JobQueue(counted())
    assert taken == []
    assert ids(queue, ("", ""), ("", "a")) == ["a0", "a1"]
    assert len(taken) == AHEAD + 1
    assert len(ids(queue, *[("a", "")] * 999)) == 999
    assert ids(queue, ("a", "")) == ["-"]
