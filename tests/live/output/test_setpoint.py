"""The set-point packet: byte for byte as in its table, whole or refused, sent without waiting."""

import re
import socket
import struct
import zlib
from collections.abc import Iterator
from dataclasses import replace
from hashlib import blake2s
from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import InputError, SetPointError
from atlas_cueing.live.control.command import Command
from atlas_cueing.live.output import setpoint
from atlas_cueing.live.output.setpoint import SIZE, SetPoint, decode, encode
from atlas_cueing.live.output.setpoint_sender import SetPointSender
from atlas_cueing.signals import LIVE_STATES

from ..commands import REST, any_command, swinging

KEY = bytes(range(16))
OTHER_KEY = bytes(range(1, 17))
_keys = st.sampled_from((b"", KEY, bytes(32)))


@pytest.fixture
def packets() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(5.0)
        yield receiver


class TestThePacket:
    @given(
        st.integers(0, 2**64 - 1),
        st.integers(0, 2**64 - 1),
        st.integers(-(10**15), 10**15),
        st.integers(0, 6),
        any_command,
        _keys,
    )
    def test_what_is_decoded_is_what_was_encoded(
        self,
        session: int,
        sequence: int,
        nanoseconds: int,
        state: int,
        command: Command,
        key: bytes,
    ) -> None:
        packet = encode(session, sequence, command.time, nanoseconds, state, command, key)
        point = decode(packet, key)
        assert point == SetPoint(session, sequence, nanoseconds, LIVE_STATES[state], command)

    def test_every_field_lies_where_the_table_says(self) -> None:
        """Read as a stranger would, from the offsets and types of the documentation alone."""
        rows = re.findall(
            r"^\|\s+(\d+) \| (\w+?)(?:\[(\d+)\])?\s+\| ([^:|]+)",
            setpoint.__doc__ or "",
            re.MULTILINE,
        )
        codes = {"char": "s", "uint8": "B", "uint64": "Q", "int64": "q", "double": "d"}
        command = swinging(0.7)
        packet = encode(11, 12, 0.7, 13_000_000_014, 3, command)
        read, end = {}, 0
        for offset, kind, count, name in rows:
            assert int(offset) == end, "no padding, nothing left out"
            layout = struct.Struct(f"<{count}{codes[kind]}")
            read[name.split(" ")[0] + name.partition(" ")[2][:9]] = layout.unpack_from(packet, end)
            end += layout.size
        assert end == len(packet) == SIZE
        magic, version, kind, state, zero, session, sequence, valid, time, *vectors, check = (
            read.values()
        )
        assert (magic, version, kind, state, zero) == ((b"ATSP",), (2,), (0,), (3,), (0,))
        assert (session, sequence, valid, time) == ((11,), (12,), (13_000_000_014,), (0.7,))
        c = command
        rates = [c.wheel_speed, c.wheel_acceleration]
        assert vectors == [*rates, c.p_WS_W, c.v_WS_W, c.a_WS_W, c.wheel_angle]
        assert bytes(check) == struct.pack("<I12x", zlib.crc32(packet[:184]))

    def test_the_states_of_the_table_are_those_of_the_loop(self) -> None:
        table = " ".join((setpoint.__doc__ or "").replace("|", " ").split())
        row = table.partition("state: ")[2].partition(" 7 uint8")[0]
        assert re.findall(r"(\d) (\w+)", row) == [(str(k), s) for k, s in enumerate(LIVE_STATES)]

    def test_with_a_key_the_check_is_keyed_blake2s(self) -> None:
        packet = encode(1, 2, 0.0, 3, 0, REST, KEY)
        assert packet[5] == 1
        assert packet[184:] == blake2s(packet[:184], key=KEY, digest_size=16).digest()

    @given(_keys, st.integers(0, SIZE - 1), st.integers(1, 255))
    def test_any_changed_byte_is_noticed(self, key: bytes, place: int, change: int) -> None:
        packet = bytearray(encode(1, 2, 0.5, 3, 2, swinging(0.5), key))
        packet[place] ^= change
        with pytest.raises(SetPointError):
            decode(bytes(packet), key)

    @given(st.binary(max_size=2 * SIZE), _keys)
    def test_anything_at_all_is_refused_properly(self, packet: bytes, key: bytes) -> None:
        with pytest.raises(SetPointError):
            decode(packet, key)

    @pytest.mark.parametrize(
        ("packet", "message"),
        [
            (b"", "packet of 0 bytes, allowed: 200"),
            (encode(1, 2, 0.0, 3, 0, REST) + b"x", "packet of 201 bytes, allowed: 200"),
            (
                b"XXXX" + encode(1, 2, 0.0, 3, 0, REST)[4:],
                "packet starts with b'XXXX', allowed: b'ATSP'",
            ),
            (b"ATSP\x01" + encode(1, 2, 0.0, 3, 0, REST)[5:], "packet of version 1, allowed: 2"),
            (
                encode(1, 2, 0.0, 3, 0, REST)[:-1] + b"x",
                "packet 2 has a wrong check: it is damaged, or its sender has another key",
            ),
            (encode(1, 2, 0.0, 3, 8, REST), "packet 2 has state 8, allowed: 0 <= state <= 7"),
            (
                encode(1, 2, nan, 3, 0, REST),
                "packet 2 has nan as number 0, allowed: finite numbers",
            ),
            (
                encode(1, 2, 0.0, 3, 0, replace(REST, a_WS_W=(0.0, 0.0, -inf))),
                "packet 2 has -inf as number 15, allowed: finite numbers",
            ),
            (
                encode(1, 2, 0.0, 3, 0, REST, KEY),
                "packet has check 1, allowed: 0, as the receiver has no key",
            ),
        ],
    )
    def test_the_error_says_what_is_wrong(self, packet: bytes, message: str) -> None:
        with pytest.raises(SetPointError, match=f"^{re.escape(message)}$"):
            decode(packet)

    def test_a_key_cannot_be_avoided(self) -> None:
        """Neither by a packet without one, nor with another one, nor by saying so."""
        plain = encode(1, 2, 0.0, 3, 0, REST)
        with pytest.raises(
            SetPointError, match="packet has check 0, allowed: 1, as the receiver has a key"
        ):
            decode(plain, KEY)
        with pytest.raises(SetPointError, match="wrong check"):
            decode(plain[:5] + b"\x01" + plain[6:], KEY)
        with pytest.raises(SetPointError, match="wrong check"):
            decode(encode(1, 2, 0.0, 3, 0, REST, OTHER_KEY), KEY)


class TestTheSender:
    @pytest.mark.parametrize("key", [b"", KEY])
    def test_what_is_sent_arrives(self, packets: socket.socket, key: bytes) -> None:
        sender = SetPointSender(*packets.getsockname(), key=key)
        for k in range(5):
            sender.send(k, 0.1 * k, 50 + k, 2, swinging(0.1 * k))
        points = [decode(packets.recv(2048), key) for _ in range(5)]
        sender.close()
        assert [p.sequence for p in points] == [0, 1, 2, 3, 4]
        assert [p.command for p in points] == [swinging(0.1 * k) for k in range(5)]
        assert len({p.session for p in points}) == 1
        assert sender.unsent == 0

    def test_two_senders_have_two_sessions(self, packets: socket.socket) -> None:
        sessions = set()
        for _ in range(2):
            sender = SetPointSender(*packets.getsockname())
            sender.send(0, 0.0, 0, 0, REST)
            sessions.add(decode(packets.recv(2048)).session)
            sender.close()
        assert len(sessions) == 2

    def test_nobody_listening_is_counted_and_the_next_one_is_heard(
        self, packets: socket.socket
    ) -> None:
        address = packets.getsockname()
        packets.close()
        sender = SetPointSender(*address)
        for k in range(20):
            sender.send(k, 0.0, 0, 0, REST)
        assert 5 <= sender.unsent < 20
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as again:
            again.bind(address)
            again.settimeout(5.0)
            for k in (20, 21):
                sender.send(k, 0.0, 0, 0, REST)
            assert decode(again.recv(2048)).sequence in (20, 21)
        sender.close()

    def test_a_full_buffer_is_counted(self, packets: socket.socket) -> None:
        sender = SetPointSender(*packets.getsockname())
        assert not sender._socket.getblocking()
        full = Full()
        sender._socket.close()
        sender._socket = full  # type: ignore[assignment]  # the kernel's loopback drops at the receiver, never at the sender
        sender.send(0, 0.0, 0, 0, REST)
        assert sender.unsent == 1

    def test_a_receiver_that_does_not_read_blocks_nobody(self, packets: socket.socket) -> None:
        sender = SetPointSender(*packets.getsockname())
        for k in range(5000):
            sender.send(k, 0.0, 0, 0, REST)
        sender.close()

    @pytest.mark.parametrize("host", ["192.0.2.1", "10.1.2.3"])
    def test_another_machine_needs_a_key(self, host: str) -> None:
        message = (
            f"set-point receiver {host} is not on this machine: allowed with a shared key only, or"
            " 127.0.0.1"
        )
        with pytest.raises(InputError, match=f"^{re.escape(message)}$"):
            SetPointSender(host, 5600)

    @pytest.mark.parametrize(
        "host",
        ["239.1.2.3", "224.0.0.1", "0.0.0.0", "255.255.255.255", "drive", "localhost", "::1", ""],  # noqa: S104
    )
    def test_groups_and_names_are_refused_even_with_a_key(self, host: str) -> None:
        with pytest.raises(InputError, match=r"set-point receiver|cannot be sent"):
            SetPointSender(host, 5600, KEY)

    @pytest.mark.parametrize("port", [-1, 65536])
    def test_a_port_that_is_none(self, port: int) -> None:
        with pytest.raises(InputError, match=f"set points cannot be sent to 127.0.0.1:{port}"):
            SetPointSender("127.0.0.1", port)

    @pytest.mark.parametrize("size", [1, 15, 33])
    def test_a_key_of_a_wrong_size_is_refused_and_not_shown(self, size: int) -> None:
        with pytest.raises(
            InputError, match=f"^shared key of {size} bytes, allowed: 16 <= bytes <= 32$"
        ):
            SetPointSender("127.0.0.1", 5600, b"s" * size)


class Full:
    """A socket with a full buffer."""

    def send(self, _: bytes) -> int:
        raise BlockingIOError
