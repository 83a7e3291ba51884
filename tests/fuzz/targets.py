"""What strangers hand in, with anything wrong with it.

Each target takes bytes and may refuse them, with an error of ours.
"""

import io
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

import numpy as np
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from atlas_cueing.errors import AtlasError
from atlas_cueing.flight_data import import_flight, known_maps, load_map
from atlas_cueing.live.control.command import Command
from atlas_cueing.live.output import setpoint
from atlas_cueing.recording import read_log
from atlas_cueing.recording.chunk import EncodedChunk
from atlas_cueing.recording.container import Container
from atlas_cueing.recording.salvage import rewrite, salvage
from atlas_cueing.recording.schemas import STATUS, TF, schema_of
from atlas_cueing.recording.wire import flat_template, record_template
from atlas_cueing.rotation import ZERO
from atlas_cueing.scenario import load_platform, load_variants, presets
from atlas_cueing.signals import TOPICS
from atlas_cueing.vehicles import Bounds
from atlas_cueing.vehicles.flightgear import PACKET_BYTES, decode

from .good_content import SCENARIO, good_log, logs_of_others, recordings

Take: TypeAlias = Callable[[bytes, Path], object]

LARGEST_CONTENT = 1 << 20  # bytes that a log may unpack to
_WORDS = (
    b"=",
    b".",
    b"[",
    b"]",
    b"{",
    b"}",
    b'"',
    b"'''",
    b"\n",
    b",",
    b"nan",
    b"-inf",
    b"1e999",
    b"true",
    b"0x" + b"f" * 400,
)
_WORDS += (
    b"1979-05-27",
    b"[[",
    b"\\u0000",
    b"\xff",
    b"vehicle",
    b"sweep",
    b'"*"',
    b"-1",
    b"0",
    b"#",
    b"99999999999999999999",
)
_NUMBERS = (0, 1, 2**7, 2**15, 2**31, 2**63, 2**64 - 1)  # lengths that lie


@dataclass(frozen=True)
class Target:
    """Inputs to make and who takes them; `folder` is one to write to."""

    inputs: st.SearchStrategy[bytes]
    take: Take


@dataclass
class Tally:
    """What came of a number of executions.

    `crashes` has one line for each kind of error that was not ours.
    """

    executions: int = 0
    refused: int = 0
    crashes: dict[str, bytes] = field(default_factory=dict)

    @property
    def peak_mb(self) -> float:
        """Largest resident memory of this process so far, MB.

        Ru_maxrss would begin with that of the parent.
        """
        status = Path("/proc/self/status")
        return (
            int(status.read_text().split("VmHWM:")[1].split()[0]) / 1024.0
            if status.exists()
            else nan
        )


def run(target: Target, number: int, examples: int, tally: Tally) -> None:
    """Give a target so many inputs; the same ones for the same number.

    Crashes are counted, not raised.
    """
    with TemporaryDirectory() as name:

        @seed(number)
        @settings(
            max_examples=examples,
            database=None,
            deadline=None,
            phases=[Phase.generate],
            suppress_health_check=list(HealthCheck),
        )
        @given(target.inputs)
        def one(data: bytes) -> None:
            tally.executions += 1
            try:
                target.take(data, Path(name))
            except AtlasError as refusal:
                assert str(refusal), "a refusal says why"  # noqa: PT017
                tally.refused += 1
            except Exception as error:  # noqa: BLE001 - this is what is looked for
                tally.crashes.setdefault(f"{type(error).__name__}: {error}"[:200], data)

        one()


def spoilt(bases: Sequence[bytes], words: Sequence[bytes]) -> st.SearchStrategy[bytes]:
    """One of the bases with up to eight places overwritten, cut out or filled up.

    What is put there are words, bytes or numbers that lie.
    """
    piece = st.one_of(
        st.sampled_from(words),
        st.binary(max_size=6),
        st.sampled_from(_NUMBERS).map(lambda n: n.to_bytes(8, "little")),
    )
    edit = st.tuples(st.floats(0.0, 1.0), st.integers(0, 12), piece)
    return st.tuples(st.sampled_from(bases), st.lists(edit, max_size=8), st.floats(0.5, 1.3)).map(
        _edited
    )


def _edited(what: tuple[bytes, list[tuple[float, int, bytes]], float]) -> bytes:
    base, edits, kept = what
    data = bytearray(base)
    for place, removed, put in edits:
        start = int(place * len(data))
        data[start : start + removed] = put
    return bytes(data[: int(kept * len(data))])


def _crafted(what: tuple[bytes, bytes, bytes]) -> bytes:
    """A log with good checksums around a description and messages that may be anything."""
    flat, status, messages = what
    stream = io.BytesIO()
    container = Container(stream.write)
    container.add_channel("/felt", "atlas.Felt", flat)
    container.add_channel(STATUS, "atlas.Status", status)
    container.add_channel(TF, *schema_of(TF))
    container.add_metadata("atlas.run", {})
    container.add_chunk(EncodedChunk(messages, {1: np.zeros((1, 2), dtype=np.uint64)}))
    container.finish()
    return stream.getvalue()


_FELT, _STATUS = schema_of("/felt")[1], schema_of(STATUS)[1]
_MESSAGES = (
    flat_template(1, len(TOPICS[-1].fields)).tobytes() * 2
    + record_template(2, b"\x12\x02ok")
    + record_template(3, b"")
)
_LOGS = st.one_of(
    spoilt([good_log()], (b"\x89MCAP0\r\n", b"zstd", b"\x05", b"\x06")),
    spoilt(logs_of_others(), (b"lz4", b"\x03", b"\x04", b"\x05", b"\x06", b"json", b"protobuf")),
    st.tuples(
        spoilt([_FELT], (b"time_s", b"\x01")),
        spoilt([_STATUS], (b"time_s", b"\x09", b"\x01")),
        spoilt([_MESSAGES], (b"\x05",)),
    ).map(_crafted),
    st.tuples(
        st.just(_FELT), st.just(_STATUS), spoilt([_MESSAGES], (b"\x05", b"\x09", b"\x11"))
    ).map(_crafted),
)
_POINT = setpoint.encode(1, 2, 3.0, 4, 2, Command(3.0, ZERO, ZERO, ZERO, ZERO, ZERO, ZERO))


def _with_check(packet: bytes) -> bytes:
    """A set point whose check is right, whatever is in it."""
    content = packet[: setpoint.SIZE - 16].ljust(setpoint.SIZE - 16, b"\0")
    return content + zlib.crc32(content).to_bytes(16, "little")


def _file(data: bytes, folder: Path, name: str) -> Path:
    (folder / name).write_bytes(data)
    return folder / name


def _recover(data: bytes, folder: Path) -> None:
    rewrite(salvage(_file(data, folder, "x.mcap"), LARGEST_CONTENT), folder / "y.mcap", {})


def _importing(map_name: str, ending: str) -> Take:
    def take(data: bytes, folder: Path) -> object:
        return import_flight(_file(data, folder, f"x.{ending}"), load_map(map_name), split=True)

    return take


_RECORDED = recordings()
_CELLS = (b",", b";", b"\n", b"\r", b'"', b"nan", b"1e999", b"-1", b"0,5", b"\xff", b"#", b" ")
_FRAMES = (b"\xa3\x95", b"FMT", b"IMU", b"D", b"F", b"\xff\xff", b"\0\0", b"\x89MCAP0\r\n")
_PACKETS = spoilt(
    [bytes([0, 0, 0, 24]) + bytes(PACKET_BYTES - 4)],
    (b"\x7f\xc0\0\0", b"\x7f\xf0\0\0", b"\xff" * 8, b"\0\0\0\x18"),
)
_POINTS = spoilt([_POINT], (b"ATSP", b"\0\0\0\0\0\0\xf8\x7f", b"\xff"))

TARGETS: dict[str, Target] = {
    "scenario": Target(
        spoilt([SCENARIO], _WORDS), lambda data, at: load_variants(_file(data, at, "s.toml"))
    ),
    "platform": Target(
        spoilt([path.read_bytes() for path in presets().values()], _WORDS),
        lambda data, at: load_platform(str(_file(data, at, "p.toml"))).geometry(),
    ),
    "reader": Target(_LOGS, lambda data, at: read_log(_file(data, at, "x.mcap"), LARGEST_CONTENT)),
    "salvage": Target(_LOGS, _recover),
    "map": Target(
        spoilt([path.read_bytes() for path in known_maps().values()], _WORDS),
        lambda data, at: load_map(str(_file(data, at, "m.toml"))),
    ),
    "csv": Target(spoilt([_RECORDED["csv"]], _CELLS), _importing("csv", "csv")),
    "ulog": Target(spoilt([_RECORDED["px4"]], _FRAMES), _importing("px4", "ulg")),
    "dataflash": Target(spoilt([_RECORDED["ardupilot"]], _FRAMES), _importing("ardupilot", "bin")),
    "ros": Target(spoilt([_RECORDED["ros-imu"]], _FRAMES), _importing("ros-imu", "mcap")),
    "flightgear": Target(_PACKETS, lambda data, _: decode(data, 0.0, Bounds())),
    "setpoint": Target(
        st.one_of(_POINTS, _POINTS.map(_with_check)), lambda data, _: setpoint.decode(data)
    ),
}
