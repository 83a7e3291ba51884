"""The live run in Foxglove: its WebSocket server, in a process of its own.

Its messages are those of the log. As of 0.30 foxglove-sdk opens no other port than the one it is
given, but lets in web pages of any origin. So it stands behind an `OriginGate`, at a random address
of 127.0.0.0/8. Its queue for each client is bounded and drops the oldest; no service, parameter,
asset or publishing by clients is offered.
"""

import asyncio
import secrets
import socket
from importlib.util import find_spec
from ipaddress import IPv4Address
from typing import TYPE_CHECKING

import numpy as np

from ...errors import MissingExtraError
from ...recording.chunk import ELAPSED, ChunkEncoder, with_attitude, with_felt
from ...recording.schemas import STATUS as STATUS_TOPIC
from ...recording.schemas import TF, message_class, schema_of
from ...recording.wire import live_log_times
from ...rotation import Vec3
from ...signals import CORRECTION, ESTIMATE, LIVE_ROW, LIVE_TOPICS, StateChange
from ...telemetry import Ring, RingReader
from ...telemetry.child_process import ChildProcess, Left
from ...telemetry.messages import END, STATUS, TICK, status
from ...telemetry.origin_gate import OriginGate, listen

if TYPE_CHECKING:
    from foxglove import Channel, Context

RATE_HZ = 60.0  # of the newest tick: as often as a screen draws
REPEAT_S = 1.0  # s after which the state is sent again, for clients that came later
CLOSING_S = 1.0  # s that clients may take for the last messages
BACKLOG = 256  # messages kept for a client that does not read: half a second of all topics
# Foxglove in a browser; its desktop program (assumed)
ORIGINS = ("https://app.foxglove.dev", "file://")
_NAME = "atlas_cueing"


class FoxgloveProcess:
    """Serves a live run to Foxglove on this machine, until END is in the ring or the loop ends."""

    def __init__(
        self, ring: Ring, port: int, head_S: Vec3, started_ns: int, *, attitude: bool = False
    ) -> None:
        """Fork the server.

        Args:
            ring: written by this process only.
            port: of 127.0.0.1; 0 takes a free one.
            head_S: position of the rider's head for /felt, m, frame S.
            started_ns: start of the run, ns since 1970, as McapRecorder has it.
            attitude: that of the run is corrected.

        Raises MissingExtraError when foxglove-sdk is not installed, InputError when the port is not
        available.
        """
        if find_spec("foxglove") is None:
            raise MissingExtraError("--foxglove", "foxglove-sdk", "foxglove")
        with listen("127.0.0.1", port) as listener:
            self.port: int = listener.getsockname()[1]
            feed = Feed(ring, head_S, started_ns, attitude)
            self._process = ChildProcess(lambda left: asyncio.run(_serve(feed, listener, left)))

    @property
    def pid(self) -> int:
        """Process id of the server."""
        return self._process.pid

    @property
    def url(self) -> str:
        """Address to open in Foxglove."""
        return f"ws://127.0.0.1:{self.port}"

    @property
    def alive(self) -> bool:
        """Whether it serves."""
        return self._process.alive

    @property
    def answers(self) -> bool:
        """Whether it serves, and does not hang (`ChildProcess.answers`)."""
        return self._process.answers

    def close(self, timeout: float = 2.0) -> bool:
        """End the server, by force after `timeout` s; return whether it had served until now.

        A second call is harmless.
        """
        return self._process.finish(timeout).status == 0


class Feed:
    """Encodes messages for viewers from a ring: the newest tick and all changes of state."""

    def __init__(self, ring: Ring, head_S: Vec3, started_ns: int, attitude: bool = False) -> None:
        """Read `ring` from its next message on; see FoxgloveProcess for the arguments."""
        topics = (*LIVE_TOPICS, CORRECTION, ESTIMATE) if attitude else LIVE_TOPICS
        self.topics = (*(topic.name for topic in topics), TF, STATUS_TOPIC)
        self.over = False
        self._reader = RingReader(ring)
        self._head_S = head_S
        self._encoder = ChunkEncoder({name: k for k, name in enumerate(self.topics)}, topics)
        self._attitude = attitude
        self._status_class = message_class(*schema_of(STATUS_TOPIC))
        self._started = self._latest = started_ns
        self._state: StateChange | None = None
        self._state_sent = 0.0  # s, monotonic

    def new(self, now: float) -> list[tuple[str, int, bytes]]:
        """Return topic, log time (ns) and content of the messages to send at `now`.

        `now` is in s and monotonic.
        """
        tick, states = b"", []
        for kind, data in self._reader.newest():
            if kind == TICK:
                tick = data
            elif kind == STATUS:
                states.append(status(data))
            self.over = self.over or kind == END
        messages = self._ticks(tick) if tick else []
        if not states and self._state and now >= self._state_sent + REPEAT_S:
            states = [self._state]
        if states:
            self._state, self._state_sent = states[-1], now
        return messages + [self._status(state) for state in states]

    def _ticks(self, tick: bytes) -> list[tuple[str, int, bytes]]:
        row = np.frombuffer(tick)[None]
        rows, own = row[:, :LIVE_ROW], row[:, LIVE_ROW:]
        times = live_log_times(rows[:, ELAPSED], self._started)
        self._latest = int(times[0])
        ticks = with_felt(rows, self._head_S)
        ticks = with_attitude(ticks, own) if self._attitude else ticks
        chunk = self._encoder.encode(ticks, times, ())
        return [(self.topics[k], at, content) for k, at, content in chunk.messages()]

    def _status(self, new: StateChange) -> tuple[str, int, bytes]:
        message = self._status_class(time_s=new.time, state=new.state, reason=new.reason)
        return STATUS_TOPIC, self._latest, message.SerializeToString()


async def _serve(feed: Feed, listener: socket.socket, left: Left) -> bytes:
    """Serve until the run is over."""
    import foxglove

    foxglove.set_log_level("CRITICAL")  # a client that vanishes is no error of the server
    context = foxglove.Context()
    host = str(IPv4Address("127.0.0.0") + 1 + secrets.randbelow(2**24 - 2))
    server = foxglove.start_server(
        name=_NAME,
        host=host,
        port=0,
        capabilities=[],
        context=context,
        message_backlog_size=BACKLOG,
    )
    channels = {topic: _channel(topic, context) for topic in feed.topics}
    gate = OriginGate((host, server.port), ORIGINS)
    door = await gate.open(listener)
    clock = asyncio.get_running_loop().time
    while True:
        last = left()
        for topic, log_time, content in feed.new(clock()):
            channels[topic].log(content, log_time=log_time)
        await asyncio.sleep(1.0 / RATE_HZ)
        if feed.over or last:
            break
    door.close()
    server.stop()
    await gate.finish(CLOSING_S)  # or the last state would not reach a client on a busy machine
    return b""


def _channel(topic: str, context: "Context") -> "Channel":
    from foxglove import Channel, Schema

    name, schema = schema_of(topic)
    return Channel(
        topic,
        schema=Schema(name=name, encoding="protobuf", data=schema),
        message_encoding="protobuf",
        context=context,
    )
