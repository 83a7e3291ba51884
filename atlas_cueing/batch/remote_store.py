"""Results at a URL, by fsspec (extra `cluster`) and its driver for that kind of URL.

Say s3fs for `s3://bucket/folder`.
"""

import secrets
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import cached_property
from pathlib import Path
from typing import Any

from ..errors import PIP, InputError, MissingExtraError, OutputError
from .isolation import in_child

# s of wall time for what one run leaves (assumed); a GB takes an hour at 2.3 Mbit/s
UPLOAD_LIMIT = 3600.0
_PROBE = ".atlas_cueing"  # written and removed again before anything flies
_TOKEN = 4  # bytes; what is being uploaded is told apart by them
_MAGIC = "*?[]"  # drivers would look for other files with them
_LOCAL = ("file", "local")
_NOT_ABSOLUTE = "a local URL has three slashes and an absolute path: file:///folder"
_OF_ONE_PROCESS = "memory"


class RemoteStore:
    """`Results` at a URL.

    Runs write on the machine where they fly; what is finished is uploaded by another name, then
    moved.

    Two batches at work in one place do not see each other: they would fly some runs twice and do no
    other harm. fsspec is imported when something is first asked of the place, as drivers start
    threads and a worker must not have any.
    """

    def __init__(self, url: str) -> None:
        kind, _, rest = url.partition("://")
        self._url = f"{kind}://{rest.rstrip('/')}"
        if found := _flaw(kind, rest.rstrip("/")):
            raise InputError(f"-o {self.where()}: {found}")

    @property
    def place(self) -> str:
        """The URL that was asked for."""
        return self._url

    @property
    def title(self) -> str:
        """The last part of the URL."""
        return self.where().rsplit("/", 1)[-1]

    def where(self, name: str = "") -> str:
        """URL without user and password."""
        kind, _, rest = self._url.partition("://")
        host, slash, path = rest.partition("/")
        return f"{kind}://{host.rsplit('@', 1)[-1]}{slash}{path}{'/' if name else ''}{name}"

    def check(self) -> None:
        """Raise InputError when fsspec, its driver or the host is missing, or a file is in the way.

        Makes nothing.
        """
        if _OF_ONE_PROCESS in self._fs.protocol:
            raise InputError(
                f"-o {self.where()}: no other process sees it, and every run is in one; write to a"
                " folder"
            )
        with self._telling():
            try:
                found = self._fs.info(self._root)
            except FileNotFoundError:
                return
        if found["type"] != "directory":
            raise OutputError(f"{self.where()}: is no folder")

    @contextmanager
    def opened(self) -> Iterator[None]:
        """Make the folder and prove that a file can be written, moved and removed there.

        Nobody else is kept out.
        """
        with self._telling():
            if not self._fs.exists(self._root):
                self._fs.mkdir(self._root, create_parents=False)
        self.write(_PROBE, b"\n")
        with self._telling():
            self._fs.rm_file(self._at(_PROBE))
        yield

    @contextmanager
    def claimed(self, run: str) -> Iterator[None]:  # noqa: ARG002 - no run is held
        """Keep no other batch out.

        Two workers at the same run upload the same bytes, each under a name of its own.
        """
        yield

    def has(self, name: str) -> bool:
        """Whether a file is there."""
        with self._telling():
            return bool(self._fs.exists(self._at(name)))

    def names(self) -> set[str]:
        """The files there; none while there is no folder."""
        with self._telling():
            self._fs.invalidate_cache()
            try:
                return {path.rsplit("/", 1)[-1] for path in self._fs.ls(self._root, detail=False)}
            except FileNotFoundError:
                return set()

    def read(self, names: Iterable[str]) -> dict[str, bytes]:
        """Contents of files by name, fetched side by side where the driver can.

        One that is not there is left out.
        """
        wanted = [self._at(name) for name in names]
        if not wanted:
            return {}
        with self._telling():
            got = self._fs.cat(wanted, on_error="return")
            for found in got.values():
                if isinstance(found, Exception) and not isinstance(found, FileNotFoundError):
                    raise found
        return {
            path.rsplit("/", 1)[-1]: found
            for path, found in got.items()
            if isinstance(found, bytes)
        }

    def write(self, name: str, content: bytes) -> None:
        """Write a file under another name, then move it; what was there goes first."""
        with self._telling(), self._moved(name) as part:
            self._fs.pipe_file(part, content)

    def workdir(self, scratch: Path) -> Path:
        """A folder of this machine."""
        return scratch

    def deliver(self, workdir: Path, names: Iterable[str]) -> None:
        """Upload files from the workdir, by a child that may hang and may have threads.

        Raises EOFError as `in_child` does.
        """
        ended = in_child(lambda: self._upload(workdir, names), UPLOAD_LIMIT)
        if ended.late:
            raise OutputError(f"{self.where()}: upload not over after {UPLOAD_LIMIT:g} s")
        if ended.status != 0:
            raise OutputError(f"{self.where()}: upload {ended.how()}")
        if ended.answer:
            raise OutputError(ended.answer.decode())

    def fetch(self, name: str, scratch: Path) -> Path:
        """The file, downloaded into `scratch`."""
        with self._telling():
            self._fs.get_file(self._at(name), str(scratch / name))
        return scratch / name

    def _upload(self, workdir: Path, names: Iterable[str]) -> bytes:
        """Upload, in the child, and tell what went wrong."""
        try:
            for name in names:
                with self._telling(), self._moved(name) as part:
                    self._fs.put_file(str(workdir / name), part)
        except OutputError as error:
            return str(error).encode()
        return b""

    @contextmanager
    def _moved(self, name: str) -> Iterator[str]:
        """Give a name to write to; what is there in the end is moved to `name`.

        What was written in vain is removed.
        """
        # so that nobody else writes into the same file
        part = self._at(f"{name}.{secrets.token_hex(_TOKEN)}.upload")
        try:
            yield part
            if self._fs.exists(self._at(name)):  # not every driver moves over what is there
                self._fs.rm_file(self._at(name))
            self._fs.mv(part, self._at(name))
        except BaseException:
            with suppress(Exception):  # the first error tells more
                self._fs.rm_file(part)
            raise

    def _at(self, name: str) -> str:
        return f"{self._root}/{name}"

    @contextmanager
    def _telling(self) -> Iterator[None]:
        """What goes wrong in a driver, in words."""
        try:
            yield
        except InputError:
            raise
        except Exception as error:  # every driver has errors of its own
            raise OutputError(f"{self.where()}: {type(error).__name__}: {error}") from error

    @property
    def _fs(self) -> Any:
        return self._driver[0]

    @property
    def _root(self) -> str:
        """The folder as the driver names it."""
        return self._driver[1]

    @cached_property
    def _driver(self) -> tuple[Any, str]:
        try:
            from fsspec.core import url_to_fs
        except ImportError as error:
            raise MissingExtraError(f"-o {self.where()}: a URL", "fsspec", "cluster") from error
        try:
            fs, root = url_to_fs(self._url)
        except ImportError as error:
            raise InputError(
                f"-o {self.where()}: its driver is missing: {error} ({PIP} install ...)"
            ) from error
        except Exception as error:  # a kind of URL that nobody knows, a host that does not answer
            raise InputError(f"-o {self.where()}: {error}") from error
        return fs, root


def _flaw(kind: str, rest: str) -> str:
    """What is wrong with a URL on its face; empty when nothing is."""
    if "::" in kind + rest:
        return "chained URLs are not written to"
    if any(sign in rest for sign in _MAGIC):
        return f"has one of {_MAGIC}, which drivers take for a pattern"
    if not kind or not rest:
        return "is no URL of a folder, as s3://bucket/folder or file:///folder is"
    return _NOT_ABSOLUTE if kind in _LOCAL and not rest.startswith("/") else ""
