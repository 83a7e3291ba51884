"""Whom the drives answer, when, and with what."""

from math import inf

import pytest

from atlas_cueing.live.output import hello, status
from atlas_cueing.live.output.hello import Hello, limits_hash
from atlas_cueing.live.output.receiver import SetPointReceiver
from atlas_cueing.live.output.setpoint import encode
from atlas_cueing.live.output.status_sender import StatusSender

from ..commands import REST
from ..control.guard_states import STAGE, WHEELS

LOOP, OTHER = ("127.0.0.1", 4001), ("127.0.0.1", 4002)
MS = 1_000_000  # ns
START = 10**12  # ns
LIMITS = limits_hash(WHEELS, STAGE)
KEY = bytes(range(16))


def drives(key: bytes = b"") -> tuple[SetPointReceiver, StatusSender]:
    receiver = SetPointReceiver(WHEELS, STAGE, key, (0.1, 0.0, 0.0))
    return receiver, StatusSender(receiver, LIMITS, key)


def ask(session: int = 7, number: int = 1, key: bytes = b"") -> bytes:
    return hello.encode(Hello(session, number, START, LIMITS), key)


def test_nobody_is_answered_who_did_not_ask() -> None:
    _, sender = drives()
    assert all(sender.due(START + k * MS) == [] for k in range(100))


def test_fifty_a_second_for_two_and_a_half_seconds() -> None:
    _, sender = drives()
    assert sender.hear(ask(), LOOP, START) == ""
    sent = [k for k in range(4000) if sender.due(START + k * MS)]
    assert sent == list(range(0, 2501, 20))


def test_it_tells_where_it_stands_and_why_it_waits() -> None:
    receiver, sender = drives()
    sender.hear(ask(), LOOP, START)
    wrong = encode(7, 1, 0.0, START + 10 * MS, 0, REST)
    receiver.take(wrong, LOOP, START)
    ((packet, to),) = sender.due(START)
    session, one = status.decode(packet)
    assert (to, session, one.state, one.followed, one.newest) == (LOOP, 7, "waiting", 0, 0)
    assert one.reason == "packet 1 is the first and does not stand where the drives do"
    assert (one.p_WS_W, one.margin, one.limits) == ((0.1, 0.0, 0.0), inf, LIMITS)
    assert (one.good, one.refused) == (0, 1)


def test_a_change_is_told_at_once() -> None:
    receiver, sender = drives()
    receiver.reset()
    sender.hear(ask(), LOOP, START)
    assert status.decode(sender.due(START)[0][0])[1].state == "waiting"
    receiver.take(encode(7, 5, 0.0, START + 11 * MS, 0, REST), LOOP, START + MS)
    ((packet, _),) = sender.due(START + MS)
    _, one = status.decode(packet)
    assert (one.state, one.followed, one.newest, one.number) == ("following", 7, 5, 2)
    assert one.margin == pytest.approx(0.010)
    assert status.decode(sender.due(START + 21 * MS)[0][0])[1].margin == inf, "since the last one"


def test_whoever_waits_is_answered_beside_the_one_that_is_followed() -> None:
    receiver, sender = drives()
    receiver.reset()
    sender.hear(ask(), LOOP, START)
    receiver.take(encode(7, 5, 0.0, START + 11 * MS, 0, REST), LOOP, START)
    sender.hear(ask(session=9), OTHER, START)
    told = {to: status.decode(packet) for packet, to in sender.due(START)}
    assert {to: (session, one.followed) for to, (session, one) in told.items()} == {
        LOOP: (7, 7),
        OTHER: (9, 7),
    }


def test_what_is_heard_again_too_much_or_without_the_key_is_refused() -> None:
    _, sender = drives(KEY)
    assert "has a key" in sender.hear(ask(), LOOP, START)
    assert sender.hear(ask(key=KEY, number=2), LOOP, START) == ""
    assert "hello 2 comes after 2" in sender.hear(ask(key=KEY, number=2), LOOP, START)
    for port in range(3):
        assert sender.hear(ask(key=KEY), ("127.0.0.1", port), START) == ""
    assert "4 loops are answered already" in sender.hear(ask(key=KEY), OTHER, START)
    assert sender.hear(ask(key=KEY), OTHER, START + 3000 * MS) == ""
