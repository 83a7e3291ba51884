"""Receives datagrams at a port, without waiting."""

import ctypes
import socket
from contextlib import suppress
from struct import Struct
from time import time_ns
from typing import NamedTuple, Protocol, TypeAlias

from ...errors import InputError

Address: TypeAlias = tuple[str, int]

LARGEST = 2048  # bytes read of a datagram; a longer one is cut, and is no packet of a simulator
# bytes the kernel keeps unread: some 50 packets, so that a flood does not bring old ones (assumed)
BUFFER = 64 * 1024

_SO_TIMESTAMPNS = 35  # Linux, asm-generic/socket.h; Python has no name for it
_TIMESPEC = Struct("@ll")
_SOCKADDR_SIZE = 16  # bytes of a struct sockaddr; a family of zero is AF_UNSPEC
_ANCILLARY = socket.CMSG_SPACE(_TIMESPEC.size)


class Datagram(NamedTuple):
    """A datagram: its content, who sent it, and how long ago it arrived (s)."""

    content: bytes
    sender: Address
    ago: float


class Receiver(Protocol):
    """Where datagrams come from."""

    def receive(self) -> Datagram | None:
        """Return the oldest datagram not yet received; None when there is none."""

    def pin(self, sender: Address) -> None:
        """From now on take datagrams of this sender only."""

    def release(self) -> None:
        """Take datagrams of any sender again."""

    def close(self) -> None:
        """Close the port."""


class UdpReceiver:
    """A bound UDP socket (implements Receiver).

    The kernel notes when a datagram arrives, however late it is read. After `pin` the kernel itself
    throws away what others send, so that it can neither be received nor fill the buffer.
    """

    def __init__(self, host: str, port: int) -> None:
        """Bind to `host` and `port`; 0 takes a free one.

        Raises InputError when the port is not available.
        """
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.setblocking(False)
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
            self._socket.setsockopt(socket.SOL_SOCKET, _SO_TIMESTAMPNS, 1)
            self._socket.bind((host, port))
        except OSError as error:
            self._socket.close()
            raise InputError(
                f"UDP {host}:{port}: cannot listen there: {error.strerror}; another program may"
                " have it"
            ) from error

    @property
    def address(self) -> Address:
        """Address that it listens at."""
        host, port = self._socket.getsockname()
        return host, port

    def receive(self) -> Datagram | None:
        """Return the oldest datagram, see Receiver; a socket error counts as no datagram."""
        try:
            content, ancillary, _, sender = self._socket.recvmsg(LARGEST, _ANCILLARY)
        except OSError:  # BlockingIOError: nothing there
            return None
        return Datagram(content, sender, _ago(ancillary))

    def pin(self, sender: Address) -> None:
        """Take datagrams of this sender only; what others sent before may still be received."""
        with suppress(OSError):
            self._socket.connect(sender)

    def release(self) -> None:
        """Take datagrams of any sender again; the port stays its own."""
        # AF_UNSPEC dissolves the connection of a datagram socket (connect(2)); Python cannot say it
        place, nowhere = self.address, bytes(_SOCKADDR_SIZE)
        ctypes.CDLL(None).connect(self._socket.fileno(), nowhere, len(nowhere))
        if self.address != place:  # a port that the system chose is given up with the connection
            with suppress(OSError):
                self._socket.bind(place)

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()


def _ago(ancillary: list[tuple[int, int, bytes]]) -> float:
    """Return the seconds since the kernel's time stamp.

    They are 0 without one, and when the system's clock was put back since.
    """
    for level, kind, stamp in ancillary:
        if level == socket.SOL_SOCKET and kind == _SO_TIMESTAMPNS and len(stamp) == _TIMESPEC.size:
            seconds, nanoseconds = _TIMESPEC.unpack(stamp)
            ago: int = time_ns() - 1_000_000_000 * seconds - nanoseconds
            return max(0.0, 1e-9 * ago)
    return 0.0
