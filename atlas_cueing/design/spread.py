"""Work of a design on all cores, or on a dask cluster; what is done is kept and not done again."""

import json
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from hashlib import sha256
from typing import Any, TypeVar

from ..batch import ResultStore
from ..batch.cluster import dask_client

S = TypeVar("S")
T = TypeVar("T")
Submit = Callable[..., Any]
Results = Iterator[tuple[int, Any]]
_PART = "part-"  # names of the files with what is done


@contextmanager
def spread(jobs: int, cluster: str | None) -> Iterator["Crew"]:
    """Yield a crew of `jobs` processes, or of the workers of a cluster (an address, or `local`).

    With one job the work is done here. Raises InputError when a cluster cannot be reached.
    """
    if cluster is not None:
        with dask_client(cluster, jobs) as client:
            yield Crew(client.submit, share=client.scatter, shares=2 * _threads(client))
    elif jobs == 1:
        yield Crew(None)
    else:
        from concurrent.futures import ProcessPoolExecutor
        from multiprocessing import get_context

        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        pool = ProcessPoolExecutor(jobs, get_context("spawn"))
        _start_without_interrupts(pool, jobs)
        try:
            yield Crew(pool.submit, shares=2 * jobs)
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


class Crew:
    """Whoever does the work: `submit` gives a future, None does it here."""

    def __init__(
        self, submit: Submit | None, share: Callable[[Any], Any] | None = None, shares: int = 1
    ) -> None:
        self._submit = submit
        self._share = share or (lambda shared: shared)
        self._shares = shares

    def each(
        self, work: Callable[[S, T], Any], shared: S, items: Sequence[T], *, heavy: bool = False
    ) -> Results:
        """Yield number and result of each item, in some order.

        heavy: whether `shared` is so large that a worker should get many items with it at once.
        """
        if self._submit is None:
            for k, item in enumerate(items):
                yield k, work(shared, item)
            return
        known = self._share(shared)
        count = min(self._shares, len(items)) if heavy else len(items)
        lots = [range(k, len(items), count) for k in range(count)]
        futures = [(lot, self._submit(_lot, work, known, [items[k] for k in lot])) for lot in lots]
        try:
            for lot, future in futures:
                yield from zip(lot, future.result(), strict=True)
        finally:
            for _, future in futures:
                future.cancel()


class Kept:
    """Results of pieces of work in a folder: a file for each, by what it depends on."""

    def __init__(self, store: ResultStore) -> None:
        self._store = store
        self._there = store.names()

    def each(
        self,
        crew: Crew,
        work: Callable[[S, T], Any],
        shared: S,
        items: Sequence[T],
        stamp: str,
        done: Callable[[], None],
        *,
        heavy: bool = False,
    ) -> list[Any]:
        """Results of all items, in their order; those that are kept are not worked out again.

        stamp: of all that the results depend on beside the item; done: called after each. Results
        have to be such that JSON gives them back.
        """
        names = [_name(stamp, work.__name__, item) for item in items]
        found = {k: table for k, name in enumerate(names) if (table := self._read(name))}
        for _ in found:
            done()
        missing = [k for k in range(len(items)) if k not in found]
        for number, result in crew.each(work, shared, [items[k] for k in missing], heavy=heavy):
            k = missing[number]
            self._store.write(names[k], json.dumps({"result": result}).encode())
            found[k] = {"result": result}
            done()
        return [table["result"] for table in map(found.__getitem__, range(len(items)))]

    def _read(self, name: str) -> dict[str, Any] | None:
        if name not in self._there:
            return None
        try:
            table = json.loads(self._store.read([name]).get(name, b""))
        except (ValueError, RecursionError):
            return None
        return table if isinstance(table, dict) and "result" in table else None


def stamp_of(*parts: Any) -> str:
    """A stamp of whatever has a definite repr or bytes."""
    digest = sha256()
    for part in parts:
        digest.update(part if isinstance(part, bytes) else repr(part).encode())
        digest.update(b"\0")
    return digest.hexdigest()


def _start_without_interrupts(pool: Executor, jobs: int) -> None:
    """Start the processes such that Ctrl-C is for the driver alone, also while they import."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # new processes inherit it
    for _ in range(jobs):
        pool.submit(int)  # starts one, as none has had the time to end
    signal.signal(signal.SIGINT, before)


def _name(stamp: str, work: str, item: Any) -> str:
    return f"{_PART}{stamp_of(stamp, work, item)[:20]}.json"


def _lot(work: Callable[[S, T], Any], shared: S, items: list[T]) -> list[Any]:
    return [work(shared, item) for item in items]


def _threads(client: Any) -> int:
    return max(sum(map(int, client.nthreads().values())), 1)
