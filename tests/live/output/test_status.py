"""Status and hello: byte for byte as in their tables, whole or refused; the hash of limits."""

import re
import struct
import zlib
from dataclasses import replace
from hashlib import blake2s
from math import inf, nan
from types import ModuleType

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import SetPointError
from atlas_cueing.live.control.drive_status import DRIVE_STATES, CabinSensors, DriveStatus
from atlas_cueing.live.output import hello, status
from atlas_cueing.live.output.hello import Hello, limits_hash

from ..control.guard_states import STAGE, WHEELS

KEY = bytes(range(16))
SENSED = CabinSensors((0.5, -0.5, 0.5, 0.5), 12_000_000_014, (0.6, 0.0, -0.8, 0.0))
ONE = DriveStatus(
    *(5, "stopping", "no successor", 13_000_000_014, 7, 12, 0.004, bytes(range(16))),
    *((1.0, -2.0, 3e9), (0.1, 0.2, -0.3), 99, 4, SENSED),
)
ASKED = Hello(7, 3, 13_000_000_014, bytes(range(16)))
PACKETS = {
    "status": (status, status.encode(8, ONE)),
    "hello": (hello, hello.encode(ASKED)),
}


def read(module: ModuleType, packet: bytes) -> list[tuple[object, ...]]:
    """As a stranger would, from the offsets and types of the documentation alone."""
    rows = re.findall(
        r"^\|\s+(\d+) \| (\w+?)(?:\[(\d+)\])?\s+\| ", module.__doc__ or "", re.MULTILINE
    )
    codes = {"char": "s", "uint8": "B", "uint16": "H", "uint64": "Q", "int64": "q", "double": "d"}
    fields, end = [], 0
    for offset, kind, count in rows:
        assert int(offset) == end, "no padding, nothing left out"
        layout = struct.Struct(f"<{count}{codes[kind]}")
        fields.append(layout.unpack_from(packet, end))
        end += layout.size
    assert end == len(packet) == module.SIZE
    assert f"datagram of {end} bytes" in (module.__doc__ or "")
    return fields


def test_a_status_lies_where_the_table_says() -> None:
    magic, version, kind, state, sensors, session, number, time, followed, newest, *rest = read(
        *PACKETS["status"]
    )
    assert (magic, version, kind, state, sensors) == ((b"ATSS",), (2,), (0,), (2,), (2,))
    assert (session, number, time) == ((8,), (5,), (13_000_000_014,))
    assert (followed, newest) == ((7,), (12,))
    margin, limits, angle, place, good, refused, turned, seen, fix, reason, check = rest
    assert (turned, seen, fix) == (SENSED.turned, (SENSED.seen,), SENSED.fix_WS)
    assert (margin, angle, place) == ((0.004,), ONE.wheel_angle, ONE.p_WS_W)
    assert bytes(limits) == ONE.limits  # type: ignore[arg-type]
    assert (good, refused, reason[0].rstrip(b"\0")) == ((99,), (4,), b"no successor")  # type: ignore[attr-defined]
    assert bytes(check) == struct.pack("<I12x", zlib.crc32(PACKETS["status"][1][:296]))  # type: ignore[arg-type]


def test_a_hello_lies_where_the_table_says() -> None:
    fields = read(*PACKETS["hello"])
    assert fields[:3] == [(b"ATSH",), (1,), (0,)]
    assert fields[4:7] == [(7,), (3,), (13_000_000_014,)]
    assert bytes(fields[7]) == ASKED.limits  # type: ignore[arg-type]
    assert fields[8:10] == [(0.0,) * 3] * 2


def test_the_states_of_the_table_are_those_of_the_monitor() -> None:
    table = " ".join((status.__doc__ or "").replace("|", " ").split())
    row = table.partition("state: ")[2].partition(" 7 uint8")[0]
    assert re.findall(r"(\d) (\w+)", row) == [(str(k), s) for k, s in enumerate(DRIVE_STATES)]


@given(
    st.integers(0, 2**64 - 1),
    st.sampled_from(DRIVE_STATES),
    st.text(max_size=100).map(lambda text: text.rstrip("\0")),
    st.floats(allow_nan=False),
    st.sampled_from((b"", KEY)),
)
def test_what_is_decoded_is_what_was_encoded(
    session: int, state: str, reason: str, margin: float, key: bytes
) -> None:
    one = replace(ONE, state=state, reason=reason, margin=margin)
    told = status.decode(status.encode(session, one, key), key)
    cut = reason.encode()[: status.REASON_SIZE].decode(errors="replace")
    assert told == (session, replace(one, reason=cut))
    asked = replace(ASKED, session=session)
    assert hello.decode(hello.encode(asked, key), key) == asked


@pytest.mark.parametrize("name", PACKETS)
@given(st.data())
def test_any_changed_byte_and_any_rubbish_is_refused(name: str, data: st.DataObject) -> None:
    module, packet = PACKETS[name]
    broken = bytearray(packet)
    broken[data.draw(st.integers(0, len(packet) - 1))] ^= data.draw(st.integers(1, 255))
    rubbish = data.draw(st.binary(max_size=300))
    for wrong in (bytes(broken), rubbish, packet + b"x", packet[:-1]):
        with pytest.raises(SetPointError):
            module.decode(wrong)
    with pytest.raises(SetPointError, match="as the receiver has a key"):
        module.decode(packet, KEY)


@pytest.mark.parametrize("sensors", [None, CabinSensors(SENSED.turned), SENSED])
def test_sensors_come_as_they_were_sent(sensors: CabinSensors | None) -> None:
    assert status.decode(status.encode(8, replace(ONE, sensors=sensors)))[1].sensors == sensors


def test_orientations_that_cannot_be() -> None:
    for wrong in ((0.0, 0.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.0), (inf, 0.0, 0.0, 0.0)):
        for sensors in (replace(SENSED, turned=wrong), replace(SENSED, fix_WS=wrong)):
            with pytest.raises(SetPointError, match="quaternion of norm"):
                status.decode(status.encode(8, replace(ONE, sensors=sensors)))
    content = bytearray(PACKETS["status"][1][:296])
    content[7] = 3
    packet = bytes(content) + struct.pack("<I12x", zlib.crc32(bytes(content)))
    with pytest.raises(SetPointError, match="status 5 has sensors 3"):
        status.decode(packet)


def test_numbers_and_corrections_that_cannot_be() -> None:
    for wrong in (replace(ONE, margin=nan), replace(ONE, p_WS_W=(0.0, inf, 0.0))):
        with pytest.raises(SetPointError, match="status 5 has a number that is not finite"):
            status.decode(status.encode(8, wrong))
    content = bytearray(PACKETS["hello"][1][:96])
    content[48:56] = struct.pack("<d", 0.1)
    packet = bytes(content) + struct.pack("<I12x", zlib.crc32(bytes(content)))
    with pytest.raises(SetPointError, match="packet 3 has a correction"):
        hello.decode(packet)


def test_the_hash_is_that_of_the_limits_in_order_and_of_each_of_them() -> None:
    numbers = [31, 20, 25, 60, 80, 50, 600, 700, 450, 1, 0.8, 0.6, 1.5, 1.2, 0.9]
    numbers += [6, 5, 3, 60, 40, 45]
    told = blake2s(struct.pack("<21d", *numbers), digest_size=16).digest()
    assert limits_hash(WHEELS, STAGE) == told
    for name in ("travel", "speed", "acceleration", "jerk"):
        x, y, z = getattr(STAGE, name)
        assert limits_hash(WHEELS, replace(STAGE, **{name: (x, y, z * 1.001)})) != told
