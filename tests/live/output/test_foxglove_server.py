"""Foxglove's server behind the loop, seen by a plain WebSocket client."""

import base64
import json
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from struct import unpack_from
from time import monotonic
from typing import Any

import pytest
from recording.flights import HEAD
from waiting import until
from websockets.exceptions import InvalidStatus
from websockets.sync.client import ClientConnection, connect

from atlas_cueing.errors import InputError
from atlas_cueing.live.output.foxglove_server import RATE_HZ, FoxgloveProcess
from atlas_cueing.recording.schemas import message_class
from atlas_cueing.signals import LIVE_TOPICS, live_row
from atlas_cueing.telemetry import LiveWriter, Ring, live_ring

from ..riding import STARTED_NS, child, live_tick, write_ticks

PROTOCOL = "foxglove.sdk.v1"
PATIENCE = 60.0  # s, for what takes milliseconds on a machine that has time
TOPICS = [*(topic.name for topic in LIVE_TOPICS), "/tf", "/status"]


@pytest.fixture
def ring() -> Ring:
    return live_ring(2.0, 500.0)


@pytest.fixture
def server(ring: Ring) -> Iterator[FoxgloveProcess]:
    process = FoxgloveProcess(ring, 0, HEAD, STARTED_NS)
    yield process
    process.close()
    assert not process.alive


class Viewer:
    """Does as Foxglove: subscribes to all topics and decodes messages by the server's schemas."""

    def __init__(self, url: str) -> None:
        self.socket: ClientConnection = connect(
            url, subprotocols=[PROTOCOL], proxy=None, max_size=None, open_timeout=PATIENCE
        )
        self.info = json.loads(self.socket.recv(timeout=PATIENCE))
        self.channels: dict[int, dict[str, Any]] = {}
        while len(self.channels) < len(TOPICS):
            self.channels |= {
                c["id"]: c for c in json.loads(self.socket.recv(timeout=PATIENCE))["channels"]
            }
        ids = [{"id": 100 + k, "channelId": k} for k in self.channels]
        self.socket.send(json.dumps({"op": "subscribe", "subscriptions": ids}))
        self.classes = {
            k: message_class(c["schemaName"], base64.b64decode(c["schema"]))
            for k, c in self.channels.items()
        }

    def next(self) -> tuple[str, int, bytes]:
        """Topic, log time and content of the next message."""
        data = self.socket.recv(timeout=PATIENCE)
        assert isinstance(data, bytes)
        assert data[0] == 1
        number, log_time = unpack_from("<IQ", data, 1)
        return self.channels[number - 100]["topic"], log_time, data[13:]

    def decoded(self, topic: str, content: bytes) -> Any:
        number = next(k for k, c in self.channels.items() if c["topic"] == topic)
        return self.classes[number].FromString(content)

    def shown(self, writer: LiveWriter, time: float) -> dict[str, tuple[int, bytes]]:
        """Return the next message of each topic but /status when this tick is written.

        It is written again and again until the subscription has arrived.
        """
        found: dict[str, tuple[int, bytes]] = {}
        for step in range(1000):
            writer.tick(*live_tick(time + step))
            while len(found) < len(TOPICS) - 1:
                try:
                    data = self.socket.recv(timeout=0.1)
                except TimeoutError:
                    break
                assert isinstance(data, bytes)
                number, log_time = unpack_from("<IQ", data, 1)
                found[self.channels[number - 100]["topic"]] = (log_time, data[13:])
            else:
                return found
        raise AssertionError("nothing is shown")


def test_a_viewer_reads_what_the_loop_wrote(ring: Ring, server: FoxgloveProcess) -> None:
    viewer = Viewer(server.url)
    assert viewer.info["name"] == "atlas_cueing"
    assert viewer.info["capabilities"] == []
    assert sorted(c["topic"] for c in viewer.channels.values()) == sorted(TOPICS)
    shown = viewer.shown(LiveWriter(ring), 0.5)
    elapsed = {at - STARTED_NS for at, _ in shown.values()}
    assert len(elapsed) == 1
    tick, timing = live_tick(elapsed.pop() / 1e9 - 0.25)
    row = iter(live_row(tick, timing))
    for topic in LIVE_TOPICS[:-1]:
        message = viewer.decoded(topic.name, shown[topic.name][1])
        assert [getattr(message, field) for field in topic.fields] == [
            next(row) for _ in topic.fields
        ]
    stage, cabin = viewer.decoded("/tf", shown["/tf"][1]).transforms
    assert (stage.translation.x, stage.translation.y, stage.translation.z) == tick.motion.p_WS_W
    assert (
        cabin.rotation.w,
        cabin.rotation.x,
        cabin.rotation.y,
        cabin.rotation.z,
    ) == tick.motion.q_WS
    viewer.socket.close()


def test_a_late_viewer_hears_the_state(ring: Ring, server: FoxgloveProcess) -> None:
    LiveWriter(ring).status(3.0, "holding", "no input")
    viewer = Viewer(server.url)
    topic, _, content = viewer.next()
    state = viewer.decoded(topic, content)
    assert (topic, state.time_s, state.state, state.reason) == (
        "/status",
        3.0,
        "holding",
        "no input",
    )
    viewer.socket.close()


def test_ticks_are_thinned_to_what_a_screen_draws(ring: Ring, server: FoxgloveProcess) -> None:
    viewer = Viewer(server.url)
    writer = LiveWriter(ring)
    viewer.shown(writer, 0.5)
    start = monotonic()
    write_ticks(writer, 500.0, 250)
    seconds = monotonic() - start
    writer.end(1.0, "ok", "")
    shown = [topic for topic, _, _ in rest(viewer)]
    assert 2 <= shown.count("/timing") <= (seconds + 0.5) * RATE_HZ


def test_web_pages_of_strangers_are_kept_out(server: FoxgloveProcess) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        connect(server.url, subprotocols=[PROTOCOL], origin="https://evil.example", proxy=None)
    with connect(
        server.url, subprotocols=[PROTOCOL], origin="https://app.foxglove.dev", proxy=None
    ) as page:
        assert json.loads(page.recv(timeout=PATIENCE))["op"] == "serverInfo"


def test_a_client_that_does_not_read_and_one_that_vanishes_hold_up_nobody(
    ring: Ring, server: FoxgloveProcess
) -> None:
    deaf, gone, viewer = Viewer(server.url), Viewer(server.url), Viewer(server.url)
    deaf.socket.recv_messages.pause()
    gone.socket.socket.close()
    writer, before = LiveWriter(ring), ring.written
    for k in range(20_000):
        writer.tick(*live_tick(k * 0.002))
    assert ring.written == before + 20_000
    assert viewer.shown(writer, 100.0)
    assert server.alive
    for each in (deaf, viewer):
        each.socket.socket.close()


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_no_socket_but_on_loopback(ring: Ring, server: FoxgloveProcess) -> None:
    viewer = Viewer(server.url)
    viewer.shown(LiveWriter(ring), 0.5)
    found = sockets(server.pid)
    listening = [address for table, address, _, state in found if table == "tcp" and state == "0A"]
    assert len(listening) == 2
    assert all(table == "tcp" and local.startswith("127.") for table, local, _, _ in found)
    assert all(remote.startswith("127.") for _, _, remote, state in found if state != "0A")
    viewer.socket.close()


def test_it_ends_with_the_run(ring: Ring, server: FoxgloveProcess) -> None:
    viewer = Viewer(server.url)
    writer = LiveWriter(ring)
    viewer.shown(writer, 0.5)
    writer.status(1.0, "stopped", "over")
    writer.end(1.0, "ok", "over")
    until(lambda: not server.alive)
    assert server.close()
    results = [
        viewer.decoded(topic, content).reason
        for topic, _, content in rest(viewer)
        if topic == "/status"
    ]
    assert results == ["over"]


def test_it_goes_when_the_loop_is_killed(ring: Ring) -> None:
    reading, writing = os.pipe()

    def run() -> None:
        process = FoxgloveProcess(ring, 0, HEAD, STARTED_NS)
        os.write(writing, f"{process.pid} {process.port}".encode())
        signal.pause()
        process.close()

    with child(run) as loop:
        pid, port = map(int, os.read(reading, 100).split())
        connect(f"ws://127.0.0.1:{port}", subprotocols=[PROTOCOL], proxy=None).close()
        os.kill(loop, signal.SIGKILL)
    os.close(reading)
    os.close(writing)
    until(lambda: not running(pid))


def test_a_port_that_is_taken_is_told_before_anything_starts(
    ring: Ring, server: FoxgloveProcess
) -> None:
    with pytest.raises(InputError, match=f"TCP 127.0.0.1:{server.port}: cannot listen there"):
        FoxgloveProcess(ring, server.port, HEAD, STARTED_NS)


def test_what_to_install_is_told(ring: Ring, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("atlas_cueing.live.output.foxglove_server.find_spec", lambda _: None)
    with pytest.raises(InputError, match=r"pip install 'atlas_cueing\[foxglove\]'"):
        FoxgloveProcess(ring, 0, HEAD, STARTED_NS)


def rest(viewer: Viewer) -> Iterator[tuple[str, int, bytes]]:
    """All that comes until the server hangs up."""
    from websockets.exceptions import ConnectionClosed

    try:
        while True:
            data = viewer.socket.recv(timeout=PATIENCE)
            if isinstance(data, bytes) and data[0] == 1:
                number, log_time = unpack_from("<IQ", data, 1)
                yield viewer.channels[number - 100]["topic"], log_time, data[13:]
    except ConnectionClosed:
        return


def running(pid: int) -> bool:
    """Whether it is there and no zombie (whose parent is whoever adopts orphans here)."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def sockets(pid: int) -> list[tuple[str, str, str, str]]:
    """Table, local address, remote address and state of each internet socket of a process."""
    links = [os.readlink(f"/proc/{pid}/fd/{fd}") for fd in os.listdir(f"/proc/{pid}/fd")]
    mine = {link[8:-1] for link in links if link.startswith("socket:")}
    found = []
    for table in ("tcp", "tcp6", "udp", "udp6", "raw", "raw6", "packet"):
        path = Path(f"/proc/{pid}/net/{table}")
        for line in path.read_text().splitlines()[1:] if path.exists() else ():
            words = line.split()
            if len(words) > 9 and words[9] in mine:
                found.append((table, *(address(word) for word in words[1:3]), words[3]))
    return found


def address(word: str) -> str:
    """As /proc writes it, the first four bytes from the right."""
    digits = word.partition(":")[0]
    return ".".join(str(int(digits[k : k + 2], 16)) for k in (6, 4, 2, 0))
