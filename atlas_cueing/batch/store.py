"""Where results go: a folder of this machine, or an fsspec URL."""

from collections.abc import Iterable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Protocol

from ..errors import OutputError
from ..run.output import PAGE, TABLE
from .folder_store import FolderStore
from .remote_store import RemoteStore

SUMMARY, INDEX = "summary.csv", "index.html"  # the table and the page of all runs


class ResultStore(Protocol):
    """Files by name, each complete or not there at all.

    A run writes into a `workdir` on the machine where it flies, and what it leaves there is
    delivered. Everything but `workdir` raises OSError or OutputError when the place fails.
    """

    @property
    def place(self) -> str:
        """Address of the place, valid from any working directory.

        For a shared place it is valid on any machine as well.
        """
        ...

    @property
    def title(self) -> str:
        """A name for people."""
        ...

    def where(self, name: str = "") -> str:
        """The place, or a file in it, as a person would ask for it; without passwords."""
        ...

    def check(self) -> None:
        """Raise InputError when results can never go there. Makes nothing."""
        ...

    def opened(self) -> AbstractContextManager[None]:
        """Make the place and hold it while entered.

        Raises OutputError when it cannot be written to.
        """
        ...

    def claimed(self, run: str) -> AbstractContextManager[None]:
        """Keep other workers from a run while entered, where there are locks.

        Raises EOFError as `in_child` does.
        """
        ...

    def has(self, name: str) -> bool:
        """Whether a file is there."""
        ...

    def names(self) -> set[str]:
        """The files that are there."""
        ...

    def read(self, names: Iterable[str]) -> dict[str, bytes]:
        """Contents of files by name; one that is not there is left out."""
        ...

    def write(self, name: str, content: bytes) -> None:
        """Write a file, or replace it."""
        ...

    def workdir(self, scratch: Path) -> Path:
        """The folder that a run writes into: `scratch`, unless it may write here at once."""
        ...

    def deliver(self, workdir: Path, names: Iterable[str]) -> None:
        """Bring files from the workdir, one after the other."""
        ...

    def fetch(self, name: str, scratch: Path) -> Path:
        """A file of this machine with the content of `name`.

        In `scratch` unless there is one already.
        """
        ...


def check_results(results: ResultStore) -> None:
    """Refuse a place whose table or page would be replaced, and is not of an earlier batch.

    Raises OutputError for that, and InputError when results can never go there. Makes nothing.
    """
    results.check()
    there = results.names()
    for name, kind in ((SUMMARY, TABLE), (INDEX, PAGE)):
        content = results.read([name]).get(name, b"") if results.has(name) else None
        if name in there and (content is None or not kind.may_replace(content)):
            raise OutputError(
                f"{results.where(name)}: is no {kind.name} of a batch, and would be replaced; "
                "choose another folder, or give it another name"
            )


def open_store(place: str) -> ResultStore:
    """The results at a URL, or in a folder. Raises InputError for a URL that cannot be one."""
    return RemoteStore(place) if "://" in place else FolderStore(Path(place))
