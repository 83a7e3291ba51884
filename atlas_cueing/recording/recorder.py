"""Records ticks in an MCAP log, byte for byte the same for the same run."""

from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from struct import Struct

import numpy as np

from ..errors import OutputError
from ..printable import utf8
from ..rotation import Vec3
from ..rotations import Array
from ..signals import (
    ALL_TOPICS,
    ATTITUDE_ROW,
    CORRECTION,
    ESTIMATE,
    LIVE_ROW,
    LIVE_TOPICS,
    LOADS,
    ROW,
    TOPICS,
    LoadColumns,
    Tick,
    Topic,
    tick_row,
)
from .chunk import ELAPSED, ChunkEncoder, Extra, with_attitude, with_felt, with_loads
from .container import Container
from .part_file import PartFile
from .schemas import STATUS, STATUS_SCHEMA, TF, message_class, schema_of, status_schema
from .wire import EPOCH_NS, LATEST_S, Times, live_log_times, log_times, record_template

RUN_METADATA = "atlas.run"
MAX_CHUNK_TICKS = 16384  # 16 MB of messages: well inside what the reader will unpack
_NAMES = (*(topic.name for topic in ALL_TOPICS), STATUS, TF)
_BEFORE_START = -1.0  # s; no tick yet
_pack = Struct(f"{ROW}d").pack


class McapRecorder:
    """A Sink that writes an MCAP log.

    It is written as `path`.part, chunk by chunk, and takes its name when it is complete; a recorder
    that is dropped leaves the .part with all chunks up to then. Whether an existing log may be
    replaced is for the caller to decide; what appears there in the meantime stays. A link is
    followed: the log is written where it points. Bytes of names that are not UTF-8 become question
    marks in the log.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        head_S: Vec3,
        metadata: Mapping[str, str],
        attachments: Mapping[str, bytes],
        chunk_ticks: int = 512,
        skip_topics: Collection[str] = (),
        started_ns: int | None = None,
        observer: Callable[[Array], None] | None = None,
        loads: LoadColumns | None = None,
        attitude: bool = False,
    ) -> None:
        """Open the log.

        Args:
            path: where the complete log will be.
            head_S: the rider's head from the sphere centre, m, frame S; /felt is computed there.
            metadata: the record `atlas.run`, to which result and reason are added at the end.
            attachments: TOML files by name.
            chunk_ticks: ticks a chunk; what a killed process loses at most.
            skip_topics: topics left out.
            started_ns: makes it a live log: wall clock when the loop started, ns since 1970; log
                time is this plus the real time elapsed. Without it log time is simulated time from
                2000-01-01 on.
            observer: called with the numbers of each chunk that was written, (n, fields of TOPICS,
                or of LIVE_TOPICS for a live log), also those of topics left out; if it raises,
                `append` and `flush` do, and it is not called again. The fields of /loads follow
                where the log has it.
            loads: makes the numbers of /loads, which is left out without it.
            attitude: ATTITUDE_ROW numbers follow in each row of a live log, for /correction and
                /estimate.

        Raises OutputError when the file cannot be written, a topic is unknown, or a chunk is too
        large or empty.
        """
        _check_options(chunk_ticks, skip_topics)
        self._path = Path(path)
        self._head_S = head_S
        self._metadata = dict(metadata)
        self._rows = bytearray()
        self._started = started_ns
        self._observer = observer
        self._loads = loads
        self._attitude = attitude
        self._topics = _topics(live=started_ns is not None, loads=bool(loads), attitude=attitude)
        self._row = ROW if started_ns is None else LIVE_ROW
        self._row += ATTITUDE_ROW if attitude else 0
        self._full = chunk_ticks * self._row * 8  # bytes of rows that make a chunk
        self._statuses: list[tuple[float, bytes]] = []
        self._latest = _BEFORE_START  # s; time of the last tick written
        self._latest_log_time = started_ns or EPOCH_NS
        self._failure = ""
        try:
            self._file = PartFile(self._path)
            self._start(attachments, skip_topics)
        except OSError as error:
            raise self._fail(error) from error

    @property
    def part(self) -> Path:
        """Path of the log until it is complete, beside the real file."""
        return self._file.path

    def append(self, tick: Tick) -> None:
        """Keep one tick. Raises OutputError when this or any earlier chunk could not be written."""
        self._rows += _pack(*tick_row(tick))
        if len(self._rows) >= self._full:
            self.flush()

    def append_live(self, row: bytes) -> None:
        """Keep one tick of a live log: its row as it lies in memory.

        Raises as `append`.
        """
        self._rows += row
        if len(self._rows) >= self._full:
            self.flush()

    def status(self, time: float, state: str, reason: str) -> None:
        """Keep a change of state at `time` (s); it stands after the ticks up to that time."""
        self._refuse_after_failure()
        self._check_time(STATUS, np.array([time]), _BEFORE_START)
        change = self._status_class(time_s=time, state=utf8(state), reason=utf8(reason))
        self._statuses.append((time, change.SerializeToString()))

    def sync(self) -> None:
        """Let the disk take what was written up to now, against a power cut; raise as `append`."""
        self._refuse_after_failure()
        try:
            self._file.sync()
        except OSError as error:
            raise self._fail(error) from error

    def close(self, result: str, reason: str) -> None:
        """Write what is left, add result and reason to the metadata, and give the log its name.

        Raises OutputError when anything could not be written; the log then stays a .part.
        """
        self.flush()
        try:
            pairs = {**self._metadata, "result": result, "reason": reason}
            metadata = {utf8(key): utf8(value) for key, value in pairs.items()}
            self._container.add_metadata(RUN_METADATA, metadata)
            self._container.finish()
            self._file.complete()
            self._stop("the recorder is closed")
        except OSError as error:
            raise self._fail(error) from error

    def abandon(self) -> None:
        """Close the file as it is: an unfinished log stays a .part with its complete chunks.

        It is harmless after `close`.
        """
        self._stop("the recorder is closed")
        self._file.release()

    def _start(self, attachments: Mapping[str, bytes], skip: Collection[str]) -> None:
        """Write what comes before the first tick."""
        self._container = Container(self._file.write)
        names = [
            name
            for name in (*(topic.name for topic in self._topics), STATUS, TF)
            if name not in skip
        ]
        self._channels = {
            name: self._container.add_channel(name, *schema_of(name)) for name in names
        }
        for name, data in attachments.items():
            self._container.add_attachment(name, "application/toml", data)
        self._status_class = message_class(STATUS_SCHEMA, status_schema())
        self._encoder = ChunkEncoder(self._channels, self._topics)

    def flush(self) -> None:
        """Write the ticks and states kept so far as one chunk. Raises as `append`."""
        self._refuse_after_failure()
        rows, self._rows = np.frombuffer(self._rows).reshape(-1, self._row), bytearray()
        self._check_time("tick", rows[:, 0], self._latest)
        times = self._log_times(rows)
        self._latest = float(rows[-1, 0]) if len(rows) else self._latest
        self._latest_log_time = int(times[-1]) if len(rows) else self._latest_log_time
        own = rows[:, :-ATTITUDE_ROW] if self._attitude else rows
        ticks = with_felt(own, self._head_S)
        ticks = with_loads(ticks, self._loads) if self._loads else ticks
        ticks = with_attitude(ticks, rows[:, -ATTITUDE_ROW:]) if self._attitude else ticks
        chunk = self._encoder.encode(ticks, times, self._status_records(ticks[:, 0], times))
        self._statuses = []
        try:
            if chunk.data:
                self._container.add_chunk(chunk)
        except OSError as error:
            raise self._fail(error) from error
        self._observe(ticks)

    def _observe(self, ticks: Array) -> None:
        """Call the observer, which is forgotten when it raises: the log can still be finished."""
        observer, self._observer = self._observer, None
        if observer:
            observer(ticks)
        self._observer = observer

    def _log_times(self, rows: Array) -> Times:
        """Return the log time (ns) of each tick."""
        if self._started is None:
            return log_times(rows[:, 0])
        self._check_time("elapsed", rows[:, ELAPSED], _BEFORE_START)
        return live_log_times(rows[:, ELAPSED], self._started)

    def _status_records(self, ticks: Array, times: Times) -> list[Extra]:
        """Return the changes of state of this chunk, each after the ticks up to its time.

        In a live log each has the log time of the last of them.
        """
        if STATUS not in self._channels:
            return []
        channel, records = self._channels[STATUS], []
        for time, body in self._statuses:
            after = int(np.searchsorted(ticks, time, side="right"))
            log_time = int(log_times(np.array([time]))[0])
            if self._started is not None:
                log_time = int(times[after - 1]) if after else self._latest_log_time
            records.append(
                Extra(after, channel, log_time, record_template(channel, body, log_time))
            )
        return records

    def _check_time(self, what: str, times: Array, later_than: float) -> None:
        """Refuse times that a log cannot hold, and ticks that are not in order.

        A NaN would become a date.
        """
        good = (times >= 0.0) & (times <= LATEST_S)
        good[1:] &= times[1:] > times[:-1]
        good[:1] &= times[:1] > later_than
        if not good.all():
            wrong = int(np.argmin(good))
            before = [later_than, *times][wrong]
            order = f", after {before:.9g}" if before >= 0.0 else ""
            self._stop(
                f"{what} at time_s = {times[wrong]:.9g}, allowed: 0 <= time_s <="
                f" {LATEST_S:.0e}{order}"
            )
            self._refuse_after_failure()

    def _fail(self, error: OSError) -> OutputError:
        """Latch the first error: after a full disk later writes may succeed and leave a hole."""
        self._stop(error.strerror or str(error))
        return OutputError(self._failure)

    def _stop(self, reason: str) -> None:
        self._failure = self._failure or f"cannot write log {self._path}: {reason}"
        self._full = 0  # so that the next `append` flushes, and finds the failure

    def _refuse_after_failure(self) -> None:
        if self._failure:
            self._rows.clear()
            raise OutputError(self._failure)


def _topics(*, live: bool, loads: bool, attitude: bool) -> tuple[Topic, ...]:
    """Return the topics of a log, in the order of their numbers."""
    return (
        *(LIVE_TOPICS if live else TOPICS),
        *((LOADS,) if loads else ()),
        *((CORRECTION, ESTIMATE) if attitude else ()),
    )


def _check_options(chunk_ticks: int, skip_topics: Collection[str]) -> None:
    if not 1 <= chunk_ticks <= MAX_CHUNK_TICKS:
        raise OutputError(
            f"chunk_ticks = {chunk_ticks}, allowed: 1 <= chunk_ticks <= {MAX_CHUNK_TICKS}"
        )
    for name in skip_topics:
        if name not in _NAMES:
            raise OutputError(
                f"skip_topics: {name!r} is no topic of the log; topics: {', '.join(_NAMES)}"
            )
    if all(topic.name in skip_topics for topic in TOPICS):
        raise OutputError("skip_topics leaves nothing to record")
