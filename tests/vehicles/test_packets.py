"""Our own packet: against struct, hmac and zlib by its table, and against its C header."""

import hmac
import re
import shutil
import struct
import subprocess
import zlib
from dataclasses import replace
from hashlib import sha256
from math import cos, nan, pi, sin
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.rotation import IDENTITY, ZERO, geodesic, norm
from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles import Bounds, PacketError, packets
from atlas_cueing.vehicles.packets import Stream, decode, encode

KEY = b"sixteen bytes of"
REST = VehicleState(1.5, IDENTITY, ZERO, (0.0, 0.0, -9.80665))
HALF = VehicleState(2.0, (cos(0.3), sin(0.3), 0.0, 0.0), (0.1, -0.2, 0.3), (1.0, -2.0, -9.0))
HEADER = Path(packets.__file__).with_name("atlas_packet.h")
needs_cc = pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler: cc is missing")


def written(
    *,
    kind: int = 0,
    euler: int = 0,
    attitude: tuple[float, ...] = IDENTITY,
    time: float = 1.5,
    rate: tuple[float, ...] = ZERO,
    force: tuple[float, ...] = (0.0, 0.0, -9.8),
    key: bytes = b"",
    magic: bytes = b"ATVP",
    version: int = 1,
    sequence: int = 7,
) -> bytes:
    """A packet by the table of the specification."""
    content = struct.pack(
        "<4sBBBBQQ11d",
        *(magic, version, kind, euler, 0, 5, sequence, time),
        *(*attitude, *rate, *force),
    )
    if key:
        return content + hmac.new(key, content, sha256).digest()[:16]
    return content + struct.pack("<I12x", zlib.crc32(content))


def test_the_table_is_the_layout() -> None:
    rows = re.findall(r"^\| +(\d+) \| (\w+)(?:\[(\d+)\])? ", packets.__doc__ or "", re.MULTILINE)
    sizes = {"char": 1, "uint8": 1, "uint64": 8, "double": 8}
    offset = 0
    for at, kind, count in rows:
        assert int(at) == offset
        offset += sizes[kind] * int(count or 1)
    assert offset == packets.PACKET_BYTES == 128


@pytest.mark.parametrize("key", [b"", KEY])
def test_what_is_encoded_is_what_the_table_says(key: bytes) -> None:
    expected = written(
        kind=int(bool(key)),
        attitude=HALF.q_NB,
        time=HALF.time,
        rate=HALF.w_NB_B,
        force=HALF.f_B,
        key=key,
    )
    assert encode(5, 7, HALF, key) == expected
    found = decode(expected, Bounds(), key)
    assert (found.session, found.sequence) == (5, 7)
    assert found.state.w_NB_B == HALF.w_NB_B
    assert found.state.f_B == HALF.f_B
    assert geodesic(found.state.q_NB, HALF.q_NB) < 1e-12


def test_euler_angles() -> None:
    roll = decode(written(euler=1, attitude=(0.6, 0.0, 0.0, nan)), Bounds()).state.q_NB
    assert roll == pytest.approx(HALF.q_NB)
    heading = decode(written(euler=1, attitude=(0.0, 0.0, pi / 2, 0.0)), Bounds()).state.q_NB
    assert heading == pytest.approx((cos(pi / 4), 0.0, 0.0, sin(pi / 4)))


@pytest.mark.parametrize(
    ("packet", "why"),
    [
        (b"", "starts with"),
        (written(magic=b"ATSP"), "starts with b'ATSP', allowed: b'ATVP'"),
        (written(version=2), "version 2 of our own packet, allowed: 1"),
        (written()[:-1], "127 bytes, allowed: 128"),
        (written() + b"x", "129 bytes"),
        (written()[:-1] + b"x", "wrong check"),
        (written(kind=1, key=KEY), "check 1, allowed: 0, as the receiver has no key"),
        (written(attitude=(1.0, 0.1, 0.0, 0.0)), "quaternion of length 1.00499"),
        (written(attitude=(nan, 0.0, 0.0, 0.0)), "quaternion of length nan"),
        (written(euler=2), "attitude of kind 2"),
        (written(euler=1, attitude=(0.0, 1.6, 0.0, 0.0)), "no triple of Euler angles"),
        (written(time=nan), "time nan s"),
        (written(rate=(0.0, nan, 0.0)), "body rate nan"),
        (written(force=(0.0, 0.0, -1e4)), "specific force 1e\\+04"),
    ],
)
def test_each_refusal_says_why(packet: bytes, why: str) -> None:
    with pytest.raises(PacketError, match=why):
        decode(packet, Bounds())


@pytest.mark.parametrize(
    "packet",
    [written(), written(kind=1, key=b"another key, 16 bytes"), encode(5, 7, REST, KEY)[:-1] + b"x"],
)
def test_a_receiver_with_a_key_refuses_all_but_its_own(packet: bytes) -> None:
    with pytest.raises(PacketError, match="check"):
        decode(packet, Bounds(), KEY)


@given(
    st.binary(max_size=140)
    | st.binary(min_size=112, max_size=112).map(
        lambda body: (
            (content := b"ATVP\x01\x00" + body[6:]) + struct.pack("<I12x", zlib.crc32(content))
        )
    )
)
def test_nothing_but_a_believable_state_comes_of_any_bytes(packet: bytes) -> None:
    try:
        state = decode(packet, Bounds()).state
    except PacketError:
        return
    assert norm(state.w_NB_B) <= 50.0
    assert abs(sum(x * x for x in state.q_NB) - 1.0) < 1e-9


def refusal(stream: Stream, packet: bytes, arrival: float) -> str:
    try:
        stream.decode(packet, arrival)
    except PacketError as error:
        return str(error)
    return ""


def test_a_session_goes_on_in_order_and_gives_way_only_when_it_is_silent() -> None:
    stream = Stream(Bounds())
    for sequence, why in ((3, ""), (4, ""), (4, "sequence 4 after 4"), (2, "sequence 2"), (9, "")):
        assert refusal(stream, encode(1, sequence, REST), 1.0).startswith(why)
        assert bool(why) == bool(refusal(stream, encode(1, sequence, REST), 1.0)) or not why
    assert "while another one sends" in refusal(stream, encode(2, 1, REST), 1.2)
    assert refusal(stream, encode(2, 1, REST), 1.4) == ""
    assert "is over" in refusal(stream, encode(1, 99, REST), 9.0)
    assert refusal(stream, encode(2, 2, REST), 9.0) == ""


def test_a_simulation_that_stands_still_has_no_rates() -> None:
    stream = Stream(Bounds())
    first, sent = stream.decode(encode(1, 1, HALF), 10.0)
    assert (first.time, first.w_NB_B, sent) == (10.0, HALF.w_NB_B, HALF.time)
    assert stream.decode(encode(1, 2, HALF), 10.1)[0].w_NB_B == ZERO
    assert stream.decode(encode(1, 3, replace(HALF, time=2.1)), 10.2)[0].w_NB_B == HALF.w_NB_B


PROGRAM = r"""
#include <stdio.h>
#include <stdlib.h>
#include "atlas_packet.h"
int main(int argc, char **argv) {
    uint8_t bytes[ATLAS_PACKET_BYTES];
    atlas_packet packet = {5, 7, 2.0, atoi(argv[1]), {0}, {0.1, -0.2, 0.3}, {1.0, -2.0, -9.0}};
    for (int k = 0; k < 4; k++) packet.attitude[k] = strtod(argv[2 + k], NULL);
    const char *key = argc > 6 ? argv[6] : "";
    if (!atlas_packet_write(bytes, &packet, (const uint8_t *)key, strlen(key))) return 3;
    fwrite(bytes, 1, sizeof bytes, stdout);
    return 0;
}
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A C program that has nothing but the header."""
    folder = tmp_path_factory.mktemp("c")
    shutil.copy(HEADER, folder)
    (folder / "write.c").write_text(PROGRAM)
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O1"]
    subprocess.run(["cc", *strict, "write.c", "-o", "write"], cwd=folder, check=True)
    return folder / "write"


@needs_cc
@pytest.mark.parametrize("key", ["", KEY.decode(), "k" * 63, "k" * 64])
def test_c_and_python_write_the_same_bytes(program: Path, key: str) -> None:
    q = [repr(x) for x in HALF.q_NB]
    ran = subprocess.run([program, "0", *q, *([key] if key else [])], capture_output=True)
    assert ran.stdout == encode(5, 7, HALF, key.encode())


@needs_cc
def test_c_writes_euler_angles_and_no_packet_for_a_bad_key(program: Path) -> None:
    angles = ["0.6", "0", "0", "0"]
    packet = subprocess.run([program, "1", *angles], capture_output=True).stdout
    assert decode(packet, Bounds()).state.q_NB == pytest.approx(HALF.q_NB)
    for key in ("short", "k" * 65):
        assert subprocess.run([program, "1", *angles, key], capture_output=True).returncode == 3
