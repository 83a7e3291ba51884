"""Our own packets fly a live run: from a program in C, and from another address."""

import shutil
import socket
import subprocess
from pathlib import Path
from time import monotonic, sleep

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.live.open_source import open_source
from atlas_cueing.live.session import LiveOptions, LiveSession
from atlas_cueing.recording import read_log
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.scenario import Scenario, load_scenario
from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles import PacketFlight, packets
from atlas_cueing.vehicles.packets import encode

KEY = "a key of 25 bytes, shared"
SCENARIO = """
name = "ours"
[vehicle]
source = "packets"
port = {port}
{more}
[platform]
preset = "atlas-2.9m"
[cueing]
method = "classical"
"""
SENDER = r"""
#define _POSIX_C_SOURCE 200809L
#include <arpa/inet.h>
#include <math.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <time.h>
#include "atlas_packet.h"
int main(int argc, char **argv) {
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)atoi(argv[1]))};
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    int out = socket(AF_INET, SOCK_DGRAM, 0);
    atlas_packet packet = {.session = (uint64_t)time(NULL), .attitude = {1.0, 0.0, 0.0, 0.0}};
    uint8_t bytes[ATLAS_PACKET_BYTES];
    for (int k = 0; k < 2000; k++) {
        double t = 0.01 * k, roll = 0.2 * sin(t);
        packet.sequence++;
        packet.time = t;
        packet.attitude[0] = cos(0.5 * roll);
        packet.attitude[1] = sin(0.5 * roll);
        packet.rate[0] = 0.2 * cos(t);
        packet.force[2] = -9.80665;
        atlas_packet_write(bytes, &packet, (uint8_t *)argv[2], argc > 2 ? strlen(argv[2]) : 0);
        sendto(out, bytes, sizeof bytes, 0, (struct sockaddr *)&to, sizeof to);
        nanosleep(&(struct timespec){0, 10000000}, NULL);
    }
    return 0;
}
"""


def free_port(host: str = "127.0.0.1") -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind((host, 0))
        return int(free.getsockname()[1])


def scenario(folder: Path, port: int, more: str = "") -> Scenario:
    (folder / "key").write_text(KEY + "\n")
    (folder / "s.toml").write_text(SCENARIO.format(port=port, more=more))
    return load_scenario(folder / "s.toml")


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler: cc is missing")
@pytest.mark.parametrize("key", ["", KEY])
def test_a_c_program_built_from_the_header_alone_is_flown(tmp_path: Path, key: str) -> None:
    shutil.copy(Path(packets.__file__).with_name("atlas_packet.h"), tmp_path)
    (tmp_path / "send.c").write_text(SENDER)
    subprocess.run(["cc", "-std=c99", "send.c", "-lm", "-o", "send"], cwd=tmp_path, check=True)
    port = free_port()
    flown = scenario(tmp_path, port, 'rate_hz = 100\nkey_file = "key"' if key else "rate_hz = 100")
    session = LiveSession(flown, tmp_path / "l.mcap", LiveOptions(rate=100.0, duration=2.0))
    sender = subprocess.Popen([tmp_path / "send", str(port), *([key] if key else [])])
    try:
        result = session.run()
    finally:
        sender.kill()
        sender.wait()
    assert result.result in ("ok", "fault")  # a busy machine makes a fault of any run
    rolls = read_log(tmp_path / "l.mcap").vector("/vehicle", "w")[:, 0]
    assert 0.05 < abs(rolls).max() < 0.25
    if result.result == "ok":
        assert result.live is not None
        assert result.live.dropped == 0


def test_a_stranger_without_the_key_is_refused_and_told(tmp_path: Path) -> None:
    port = free_port()
    source = open_source(scenario(tmp_path, port, 'key_file = "key"'))
    state = VehicleState(0.0, IDENTITY, ZERO, (0.0, 0.0, -9.80665))
    begun = monotonic()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for key in (b"", b"another key, 16 bytes", KEY.encode()):
            sender.sendto(encode(1, 1, state, key), ("127.0.0.1", port))
            sleep(0.001)
            reading = source.read(monotonic() - begun, advance=True)
            assert (reading.vehicle is not None) == (key == KEY.encode())
            assert ("check" in reading.remark) == (key != KEY.encode())
    source.close()


@pytest.mark.parametrize(
    ("content", "why"),
    [(None, "No such file"), ("short", "key of 5 bytes, allowed: 16"), ("k" * 65, "key of 65")],
)
def test_a_key_that_will_not_do(tmp_path: Path, content: str | None, why: str) -> None:
    flown = scenario(tmp_path, free_port(), 'key_file = "other"')
    if content is not None:
        (tmp_path / "other").write_text(content)
    with pytest.raises(InputError, match=rf"vehicle\.key_file = .*{why}"):
        open_source(flown)


def test_a_key_does_not_go_into_the_log(tmp_path: Path) -> None:
    flown = scenario(tmp_path, 5502, 'key_file = "key"')
    assert flown.live_flight == PacketFlight(key_file=tmp_path / "key")
    assert not any(KEY.encode() in content for content in flown.attachments().values())
    assert b"key_file" in flown.attachments()["scenario.toml"]


@pytest.mark.parametrize("listen", [None, "127.0.0.2", "0.0.0.0"])  # noqa: S104
def test_packets_come_to_the_address_that_is_listened_at(
    tmp_path: Path, listen: str | None
) -> None:
    flown = scenario(tmp_path, free_port())
    state = VehicleState(0.0, IDENTITY, ZERO, (0.0, 0.0, -9.80665))
    heard, everywhere = set(), {"127.0.0.1", "127.0.0.2", "127.0.0.3"}
    for host in everywhere:
        source = open_source(flown, listen)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.sendto(encode(1, 1, state), (host, flown.live_flight.port))
            sleep(0.001)
            heard |= {host} if source.read(1.0, advance=True).vehicle else set()
        source.close()
    assert heard == {None: {"127.0.0.1"}, "127.0.0.2": {"127.0.0.2"}}.get(listen, everywhere)


@pytest.mark.parametrize("listen", ["localhost", "", "::1", "224.0.0.1", "1.2.3"])
def test_addresses_that_are_none(tmp_path: Path, listen: str) -> None:
    with pytest.raises(InputError, match=r"--listen .*: allowed: "):
        open_source(scenario(tmp_path, 5502), listen)


def test_listening_is_for_packets(tmp_path: Path) -> None:
    text = SCENARIO.replace('source = "packets"\nport = {port}\n{more}', 'script = "c1723"')
    (tmp_path / "s.toml").write_text(text)
    with pytest.raises(InputError, match="--listen is for packets: source = 'flightgear'"):
        open_source(load_scenario(tmp_path / "s.toml"), "0.0.0.0")  # noqa: S104
