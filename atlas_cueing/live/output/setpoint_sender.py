"""The loop's socket to the drives: set points and hellos go out, statuses come in."""

# mypyc: runs every tick

import ipaddress
import secrets
import select
import socket
from collections.abc import Sequence
from time import monotonic_ns

from ...errors import InputError, SetPointError
from ..control.command import Command
from ..control.drive_status import DriveStatus
from . import hello, setpoint, status
from .sealing import check_key

HELLO_NS = 1_000_000_000  # from one hello to the next
_MOST_STATUSES = 16  # that are read at a time


class SetPointSender:
    """Sends set points to one receiver, hears what it says of itself, and never waits for it.

    unsent: packets that the kernel did not take: its buffer was full, or there is no receiver.
    session: random number of this sender.
    refusal: why the last status that came was not taken; empty when it was.
    """

    def __init__(self, host: str, port: int, key: bytes = b"", limits: bytes = b"") -> None:
        """Connect to a numeric IPv4 address; one off this machine needs a shared key.

        Args:
            host: of the receiver.
            port: of the receiver.
            key: shared with the receiver; empty for none.
            limits: hash of the limits that the set points keep (`hello.limits_hash`); empty for a
                receiver that is not asked for its status.

        Raises InputError for an address without its key, one of a group or of all, and a bad port
        or key.
        """
        check_key(key)
        _check_address(host, key)
        self.unsent, self.refusal = 0, ""
        self.session = secrets.randbits(64) | 1  # never 0, which means none
        self._key, self._limits = key, limits
        self._asked: int | None = None  # due time of the set point that came with the last hello
        self._hellos, self._heard = 0, 0
        self._refused = False  # the last packet, by the receiver's machine
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        # asked every tick: an exception for each time that nothing has come costs more
        self._arrivals = select.poll()
        self._arrivals.register(self._socket, select.POLLIN)
        try:
            self._socket.connect((host, port))
        except (OSError, OverflowError) as error:
            self._socket.close()
            raise InputError(f"set points cannot be sent to {host}:{port}: {error}") from error

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        """Send one set point, see `setpoint.encode`; what cannot be sent at once is not sent.

        Once a second a hello goes before it. Return whether the kernel took it.
        """
        if self._limits and (self._asked is None or due - self._asked >= HELLO_NS):
            self._ask(due)
        sent = self._send(
            setpoint.encode(self.session, sequence, time, due, state, command, self._key)
        )
        self.unsent += not sent
        return sent

    def statuses(self) -> Sequence[DriveStatus]:
        """Return what the receiver has told since the last call, without waiting.

        What is damaged, older than what came before, or for another session is left out.
        """
        found: list[DriveStatus] = []
        if not self._arrivals.poll(0):
            return found
        for _ in range(_MOST_STATUSES):
            try:
                packet = self._socket.recv(status.SIZE + 1)
            except BlockingIOError:
                break
            except OSError:  # nobody listened when the last packet came there
                self._refused = True
                continue
            found += self._good(packet)
        return found

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()

    def _good(self, packet: bytes) -> list[DriveStatus]:
        """Return the status in a packet, or nothing."""
        try:
            session, one = status.decode(packet, self._key)
        except SetPointError as error:
            self.refusal = str(error)
            return []
        if session != self.session or one.number <= self._heard:
            return []
        self._heard, self.refusal = one.number, ""
        return [one]

    def _ask(self, due: int) -> None:
        """Send a hello; a lost one is made up for by the next."""
        self._asked = due
        self._hellos += 1
        new = hello.Hello(self.session, self._hellos, monotonic_ns(), self._limits)
        self._send(hello.encode(new, self._key))

    def _send(self, packet: bytes) -> bool:
        """Return whether the kernel took the packet, and the one before it had a receiver."""
        refused, self._refused = self._refused, False
        try:
            self._socket.send(packet)
        except OSError:
            # BlockingIOError: the buffer is full; ConnectionRefusedError: there is no receiver
            return False
        return not refused


def _check_address(host: str, key: bytes) -> None:
    try:
        address = ipaddress.IPv4Address(host)
    except ValueError as error:
        raise InputError(
            f"set-point receiver {host!r}: allowed: a numeric IPv4 address such as 127.0.0.1"
        ) from error
    if address.is_multicast or address.is_unspecified:
        raise InputError(f"set-point receiver {host}: allowed: the address of one machine")
    if not (address.is_loopback or key):
        raise InputError(
            f"set-point receiver {host} is not on this machine: allowed with a shared key only, or"
            " 127.0.0.1"
        )
