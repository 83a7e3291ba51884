"""`atlas-cueing review` as its users see it."""

import json
import re
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import pytest
import zstandard

from atlas_cueing.recording.container import Container
from atlas_cueing.recording.schemas import schema_of
from atlas_cueing.recording.wire import flat_template
from atlas_cueing.signals import TOPICS
from atlas_cueing.viewer.play import PlayPage

from .conftest import Command


@pytest.fixture
def log(command: Command, tmp_path: Path) -> Path:
    """A short clean log."""
    assert command("run", "s.toml").status == 0
    return tmp_path / "short.mcap"


def test_a_review_for_people(command: Command, log: Path) -> None:
    ended = command("review", log.name)
    assert (ended.status, ended.err) == (0, "")
    lines = ended.out.splitlines()
    assert re.fullmatch(r"verdict +clean", lines[0])
    assert re.fullmatch(r"result +ok", lines[1])
    assert re.fullmatch(r"scenario +short, hedge on atlas-2.9m", lines[3])
    assert any(re.fullmatch(r"force rms m/s2 +\d+\.\d{3}", line) for line in lines)
    assert "finding" not in ended.out


def test_a_review_for_programs(command: Command, log: Path) -> None:
    run = json.loads(command("run", "s.toml", "--force", "--json").out)
    ended = command("review", log.name, "--json")
    assert (ended.status, ended.err) == (0, "")
    table = json.loads(ended.out)
    same = ("result", "reason", "log", "ticks", "duration_s", "violations")
    assert {key: table[key] for key in same} == {key: run[key] for key in same}
    assert table["metrics"].items() <= run["metrics"].items()
    assert table["verdict"] == "clean"


def test_findings(command: Command) -> None:
    assert (
        command(
            "run", "s.toml", "--set", "vehicle.script=cannonball", "--set", "duration_s=600"
        ).status
        == 1
    )
    ended = command("review", "short.mcap")
    assert ended.status == 1
    assert re.search(r"^verdict +\d+ findings?$", ended.out, re.MULTILINE)
    assert re.search(
        r"^finding +atlas.run: result: result = 'vehicle_failed', allowed: 'ok'; ",
        ended.out,
        re.MULTILINE,
    )
    assert len(json.loads(command("review", "short.mcap", "--json").out)["findings"]) >= 1


def test_a_damaged_log_names_the_remedy(command: Command, log: Path) -> None:
    log.write_bytes(log.read_bytes()[:-5])
    ended = command("review", log.name)
    assert (ended.status, ended.out) == (1, "")
    todo = "1 chunk is whole; try: atlas-cueing recover short.mcap -o short_recovered.mcap"
    assert ended.err == f"error: short.mcap: the file does not end after its footer; {todo}\n"
    assert command("recover", "short.mcap", "-o", "short_recovered.mcap").status == 0
    ended = command("review", log.name, "--json")
    assert (ended.status, json.loads(ended.out)["verdict"]) == (1, "unreadable")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["missing.mcap"], "no such file"),
        (["."], "is a folder; name one of the logs in it"),
        (
            ["short.mcap", "--html", "no/such/page.html"],
            "page no/such/page.html: there is no folder no/such",
        ),
        (["short.mcap", "--html", "s.toml"], "page s.toml: exists already"),
        (["short.mcap", "--replay", "."], "no regular file"),
    ],
)
@pytest.mark.usefixtures("log")
def test_bad_usage(command: Command, arguments: list[str], message: str) -> None:
    ended = command("review", *arguments)
    assert (ended.status, ended.out) == (2, "")
    assert message in ended.err
    assert len(ended.err.splitlines()) == 1


def test_a_view_is_served_until_ctrl_c(
    command: Command, log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = []

    def interrupted(_: PlayPage, elapsed: float) -> None:
        shown.append(elapsed)
        raise KeyboardInterrupt

    monkeypatch.setattr(PlayPage, "refresh", interrupted)
    ended = command("review", log.name, "--view", "--port", "0")
    assert ended.status == 0
    assert re.fullmatch(r"view: http://127\.0\.0\.1:\d+ \(end with Ctrl-C\)\n", ended.err)
    assert re.match(r"verdict +clean", ended.out)
    assert len(shown) == 1


MAGIC = b"\x89MCAP0\r\n"


def record(opcode: int, body: bytes) -> bytes:
    return struct.pack("<BQ", opcode, len(body)) + body


def chunk(packed: bytes, size: int, crc: int) -> bytes:
    head = struct.pack("<QQQI", 0, 0, size, crc)
    return record(
        6, head + struct.pack("<I", 4) + b"zstd" + struct.pack("<Q", len(packed)) + packed
    )


def foreign() -> bytes:
    """A finished MCAP of somebody else."""
    header = record(1, struct.pack("<I", 4) + b"ros2" + struct.pack("<I", 3) + b"bag")
    return (
        MAGIC
        + header
        + record(15, struct.pack("<I", 0))
        + record(2, struct.pack("<QQI", 0, 0, 0))
        + MAGIC
    )


def bomb(chunks: int) -> bytes:
    """Chunks of 64 MiB of zero bytes each, packed to a few kB."""
    data = bytes(64 << 20)
    packed = zstandard.ZstdCompressor().compress(data)
    return MAGIC + record(1, bytes(8)) + chunk(packed, len(data), zlib.crc32(data)) * chunks


def messages(chunks: int) -> bytes:
    """One valid message repeated: a gigabyte of columns from a few 100 kB."""
    written = bytearray()
    container = Container(written.extend)
    channel = container.add_channel("/motion", *schema_of("/motion"))
    data = flat_template(channel, len(TOPICS[2].fields)).tobytes()
    data *= (48 << 20) // len(data)
    packed = zstandard.ZstdCompressor().compress(data)
    return bytes(written) + chunk(packed, len(data), zlib.crc32(data)) * chunks


def small_records(chunks: int) -> bytes:
    """Chunks of the smallest records there are."""
    data = record(99, b"") * ((16 << 20) // 9)
    packed = zstandard.ZstdCompressor().compress(data)
    return MAGIC + record(1, bytes(8)) + chunk(packed, len(data), zlib.crc32(data)) * chunks


HOSTILE = {
    "foreign": foreign,
    "bomb": lambda: bomb(16),
    "bomb of messages": lambda: messages(24),
    "small records": lambda: small_records(64),
    "lying size": lambda: MAGIC + chunk(zstandard.compress(bytes(1000)), 1 << 40, 0),
    "lying length": lambda: MAGIC + struct.pack("<BQ", 6, (1 << 63) - 1) + b"x" * 100,
    "lying string": lambda: MAGIC + record(1, struct.pack("<I", 0xFFFFFFFF) + b"x" * 100),
    "garbage": lambda: MAGIC + bytes(range(1, 256)) * 40_000,
    "zeros": lambda: MAGIC + bytes(5_000_000),
    "chunk words": lambda: MAGIC + b"\x06" * 37 + b"\x04\0\0\0zstd" * 500_000,
    "empty": lambda: b"",
    "text": lambda: b"time_s,wx\n0,0\n" * 1000,
    "PNG": lambda: b"\x89PNG\r\n\x1a\n" + bytes(1000),
    "schema of rubbish": lambda: (
        MAGIC
        + record(
            3, struct.pack("<HI", 1, 1) + b"a" + struct.pack("<I", 8) + b"protobuf" + b"\xff" * 9
        )
    ),
}


PROGRAM = """
import contextlib, io, json, resource, sys, time
from pathlib import Path
from atlas_cueing.cli import main
resource.setrlimit(resource.RLIMIT_CPU, (100, 100))  # to end a hang, not to measure
told, proc = {}, Path("/proc/self/status")
for path in sorted(Path().glob("*.mcap")):
    out, err, begun = io.StringIO(), io.StringIO(), time.process_time()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = main(["review", path.name])
    # ru_maxrss begins with the parent's
    peak = int(proc.read_text().split("VmHWM:")[1].split()[0]) if proc.exists() else 0
    told[path.stem] = [status, out.getvalue(), err.getvalue(), time.process_time() - begun, peak]
print(json.dumps(told))
"""


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[int, str, str, float, int]]:
    """What review says of each hostile file, with s of CPU and the peak of memory so far in kB.

    In a process of its own.
    """
    folder = tmp_path_factory.mktemp("hostile")
    for name, make in HOSTILE.items():
        (folder / f"{name}.mcap").write_bytes(make())
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
        check=True,
    )
    table: dict[str, tuple[int, str, str, float, int]] = json.loads(run.stdout)
    return table


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_ends_in_one_line(
    told: dict[str, tuple[int, str, str, float, int]], name: str
) -> None:
    status, out, err, _, peak = told[name]
    assert (status, out) == (1, "")
    assert len(err.splitlines()) == 1
    assert err.startswith(f"error: {name}.mcap: ")
    assert "unexpected" not in err
    assert peak < 512 * 1024
