"""Standard output and standard error of the command: everything it prints goes through here.

What is printed holds texts of others: names of files, reasons from logs, words of simulators. None
of them reaches the terminal as a command to it. A stream that takes nothing more (a full disk, a
reader that is gone) is no bug of the program and is said in one line, or not at all.
"""

import errno
import io
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import IO, Any, cast

from ..errors import PrintError
from ..printable import printable_lines


class SafeStream(io.TextIOBase):
    """A text stream that passes on what is safe to show.

    It has no `buffer`, so that nothing gets around it.
    """

    def __init__(self, raw: IO[str] | None, name: str, *, must: bool, escaped: bool = True) -> None:
        """Pass on to `raw`, which is None when the process has no such stream.

        Args:
            raw: the stream of the process.
            name: of the stream, for messages.
            must: whether what cannot be written is an error; else it is dropped.
            escaped: whether what is not visible is written out, except line feeds and tabs.
        """
        self._raw, self._name, self._must = raw, name, must
        self._shown: Callable[[str], str] = printable_lines if escaped else str

    @property
    def encoding(self) -> str:  # type: ignore[override]  # typeshed has an attribute
        """The encoding of the stream behind; UTF-8 when it does not say."""
        return getattr(self._raw, "encoding", None) or "utf-8"

    @property
    def errors(self) -> str:  # type: ignore[override]  # typeshed has an attribute
        """What the encoding does not know is written out as well."""
        return "backslashreplace"

    def unescaped(self) -> IO[str]:
        """Return the same stream, which passes on everything."""
        return cast(IO[str], SafeStream(self._raw, self._name, must=self._must, escaped=False))

    def isatty(self) -> bool:
        """Whether a person looks at it."""
        return self._raw is not None and self._raw.isatty()

    def fileno(self) -> int:
        """The file descriptor of the stream behind. Raises OSError when there is none."""
        if self._raw is None:
            raise io.UnsupportedOperation("fileno")
        return self._raw.fileno()

    def writable(self) -> bool:
        """Whether it can be written to: always."""
        return True

    def write(self, text: str) -> int:
        """Write `text`. Raises PrintError, or BrokenPipeError when its reader is gone."""
        if not isinstance(text, str):
            raise TypeError("a text stream takes no bytes")
        encoded = self._shown(text).encode(self.encoding, self.errors)
        if encoded:  # click tries nothing, and even that can fail
            self._try(lambda raw: raw.write(encoded.decode(self.encoding)))
        return len(text)

    def flush(self) -> None:
        """Hand on what is buffered. Raises as `write`."""
        if self._raw is not None:
            self._try(lambda raw: raw.flush())

    def _try(self, deed: Callable[[IO[str]], Any]) -> None:
        try:
            if self._raw is None:
                raise OSError(errno.EBADF, os.strerror(errno.EBADF))
            deed(self._raw)
        except OSError as error:
            _drop_the_rest(self._raw)
            if self._must and isinstance(error, BrokenPipeError):
                raise
            if self._must:
                raise PrintError(f"{self._name}: {error.strerror or error}") from error


def terminal_of(stream: IO[str]) -> IO[str]:
    """Return the stream for a program that draws with the terminal's own commands."""
    return stream.unescaped() if isinstance(stream, SafeStream) else stream


@contextmanager
def safe_streams() -> Iterator[None]:
    """Print through SafeStream while entered."""
    _open_closed_ones()
    out, err = sys.stdout, sys.stderr
    sys.stdout = SafeStream(out, "standard output", must=True)
    sys.stderr = SafeStream(err, "standard error", must=False)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = out, err


def _drop_the_rest(raw: IO[str] | None) -> None:
    """Let what is still buffered go nowhere, or Python would try again at its end, and complain."""
    with suppress(OSError, ValueError):
        if raw is not None:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, raw.fileno())
            os.close(nowhere)


def _open_closed_ones() -> None:
    """Open what a shell has closed (`>&-`), or a log could become what libraries print into."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)  # the lowest number is taken
