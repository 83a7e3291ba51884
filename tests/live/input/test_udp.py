"""Datagrams over loopback."""

import socket
from collections.abc import Iterator
from time import sleep

import pytest
from waiting import until

from atlas_cueing.errors import InputError
from atlas_cueing.live.input.udp import BUFFER, LARGEST, Datagram, UdpReceiver


@pytest.fixture
def receiver() -> Iterator[UdpReceiver]:
    made = UdpReceiver("127.0.0.1", 0)
    yield made
    made.close()


@pytest.fixture
def sender() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as made:
        made.bind(("127.0.0.1", 0))
        yield made


def all_of(receiver: UdpReceiver) -> list[Datagram]:
    found = []
    while (datagram := receiver.receive()) is not None:
        found.append(datagram)
    return found


def test_it_never_waits(receiver: UdpReceiver) -> None:
    assert receiver.receive() is None


def test_datagrams_come_in_order_with_their_sender(
    receiver: UdpReceiver, sender: socket.socket
) -> None:
    for content in (b"one", b"", b"three"):
        sender.sendto(content, receiver.address)
    found = all_of(receiver)
    assert [datagram.content for datagram in found] == [b"one", b"", b"three"]
    assert {datagram.sender for datagram in found} == {sender.getsockname()}


def test_the_kernel_tells_how_long_ago_it_came(
    receiver: UdpReceiver, sender: socket.socket
) -> None:
    """Whenever it is read: the first of two is older by what was waited between them.

    Once the kernel does: where nobody else has asked for it, it begins some time later. And once
        nobody comes between the
    two readings: a busy machine may.
    """

    def apart() -> float:
        sender.sendto(b"early", receiver.address)
        sleep(0.05)  # a real clock is what is tested
        sender.sendto(b"late", receiver.address)
        early, late = all_of(receiver)
        assert late.ago >= 0.0
        return early.ago - late.ago

    until(lambda: apart() >= 0.045)


def test_a_long_datagram_is_cut_and_keeps_its_neighbours(
    receiver: UdpReceiver, sender: socket.socket
) -> None:
    for content in (b"a", bytes(60_000), b"b"):
        sender.sendto(content, receiver.address)
    assert [len(datagram.content) for datagram in all_of(receiver)] == [1, LARGEST, 1]


def test_a_flood_is_not_kept(receiver: UdpReceiver, sender: socket.socket) -> None:
    """The kernel holds a few hundred packets at most, so what is read is never long past."""
    for _ in range(5000):
        sender.sendto(bytes(408), receiver.address)
    assert 10 < len(all_of(receiver)) <= 4 * BUFFER // 408


def test_pinned_to_one_sender_the_others_are_not_even_received(
    receiver: UdpReceiver, sender: socket.socket
) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
        stranger.sendto(b"before", receiver.address)
        receiver.pin(sender.getsockname())
        for _ in range(100):
            stranger.sendto(b"after", receiver.address)
        sender.sendto(b"known", receiver.address)
        assert [datagram.content for datagram in all_of(receiver)] == [b"before", b"known"]
        sender.sendto(b"on", receiver.address)
        assert [datagram.content for datagram in all_of(receiver)] == [b"on"]


def test_a_port_that_is_taken_is_bad_input(receiver: UdpReceiver) -> None:
    host, port = receiver.address
    with pytest.raises(
        InputError, match=f"UDP {host}:{port}: cannot listen there: Address already in use"
    ):
        UdpReceiver(host, port)


def test_after_a_release_all_are_heard_again_at_the_same_port() -> None:
    receiver = UdpReceiver("127.0.0.1", 0)
    place = receiver.address
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other,
    ):
        for each in (one, other):
            each.bind(("127.0.0.1", 0))
        receiver.pin(one.getsockname())
        other.sendto(b"stranger", place)
        one.sendto(b"pinned", place)
        first = receiver.receive()
        assert first is not None
        assert first.content == b"pinned"
        receiver.release()
        assert receiver.address == place
        other.sendto(b"welcome", place)
        second = receiver.receive()
        assert second is not None
        assert (second.content, second.sender) == (b"welcome", other.getsockname())
    receiver.close()
