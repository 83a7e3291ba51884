"""Bad logs, and what else can be wrong with a command: its options, its outputs, the disk."""

import struct
import zlib
from collections.abc import Callable

from .bad_files import NO_FILES, SCENARIO
from .trying import DISK, FILES, LOGS, BadInput, Content, Folder, Good, Hole, Link, Pipe, Same

_MAGIC = b"\x89MCAP0\r\n"
_GIB = 2**30
_BLOCK, _REPEATED = 1 << 17, 1  # bytes that a block of zstd has at most; its kind
_HEADER = struct.pack("<BQII", 1, 8, 0, 0)  # with an empty profile and library


def _chunk(claimed: int, packed: bytes, crc: int = 0) -> bytes:
    """A record of a chunk, compressed by zstd, that says it unpacks to so many bytes."""
    body = struct.pack("<QQQII4sQ", 0, 0, claimed, crc, 4, b"zstd", len(packed)) + packed
    return struct.pack("<BQ", 6, len(body)) + body


def _packed(size: int) -> bytes:
    """So many zeros in 32 bytes for each MB.

    A frame of zstd (RFC 8878, 3.1.1) whose blocks are all one byte repeated.
    """
    # of that size, with a window of 8 MB
    head = b"\x28\xb5\x2f\xfd\xc0\x68" + size.to_bytes(8, "little")
    middle, last = (
        (_BLOCK << 3 | _REPEATED << 1 | last).to_bytes(3, "little") + b"\0" for last in (0, 1)
    )
    return head + middle * (size // _BLOCK - 1) + last


def damaged(log: bytes) -> dict[str, bytes]:
    """Everything that may be wrong with a log, made from a good one."""

    def flipped(place: int) -> bytes:
        return log[:place] + bytes([log[place] ^ 4]) + log[place + 1 :]

    return {
        "empty": b"",
        "text": b"hello" * 100,
        "cut": log[: len(log) // 2],
        "one bit": flipped(len(log) // 2),
        "one bit of an attachment": flipped(log.index(b"radius_m")),
        "more behind its end": log + b"x",
        "record of 1 TB": log[:8] + struct.pack("<BQ", 1, 2**40),
        "record of 2^64 - 1 bytes": log[:8] + struct.pack("<BQ", 5, 2**64 - 1),
        "bomb of 2 GB": _MAGIC + _HEADER + _chunk(2 * _GIB, _packed(2 * _GIB)),
        "bomb that claims to be small": _MAGIC + _HEADER + _chunk(100, _packed(_GIB)),
        "chunk that claims 2^63 bytes": _MAGIC + _HEADER + _chunk(2**63, _packed(1 << 20)),
        "million empty records": _MAGIC + _HEADER + struct.pack("<BQ", 0x80, 0) * 1_000_000,
        "another format's checksum": (
            _MAGIC + _HEADER + _chunk(1 << 20, _packed(1 << 20), zlib.crc32(b"x"))
        ),
    }


READERS: dict[str, Callable[[str], tuple[str, ...]]] = {
    "review": lambda log: ("review", log),
    "compare": lambda log: ("compare", "good.mcap", log),
    "recue": lambda log: ("recue", log, "-o", "new.mcap"),
    "recover": lambda log: ("recover", log, "-o", "new.mcap"),
    "export": lambda log: ("export", log, "-o", "new.csv"),
}
_INPUT = ("recue", "export")  # to whom a log is input: a bad one is refused, as bad usage is


def _refusal(command: str) -> int:
    """Exit status of a command for a log that is damaged."""
    return 2 if command in _INPUT else 1


def bad_logs(log: bytes) -> list[BadInput]:
    """Every command that reads a log with each of them.

    `recover` takes those of which something is whole.
    """
    whole = {"more behind its end", "one bit of an attachment"}
    return [
        BadInput(
            f"{command}: {name}",
            words("bad.mcap"),
            {"bad.mcap": content, "good.mcap": Good()},
            0 if command == "recover" and name in whole else _refusal(command),
            limits=LOGS,
        )
        for command, words in READERS.items()
        for name, content in damaged(log).items()
    ]


NOT_THERE = [
    BadInput(
        f"{command}: {name}",
        words(path),
        {**files, "good.mcap": Good()},
        _refusal(command) if "GB" in name else 2,
        limits=LOGS,
    )
    for command, words in READERS.items()
    for name, (path, files) in {**NO_FILES, "none": ("none", {})}.items()
] + [
    BadInput(
        f"{command}: 10 GB behind a header",
        words("bad.mcap"),
        {"bad.mcap": Hole(10 * _GIB, _MAGIC + _HEADER), "good.mcap": Good()},
        _refusal(command),
        limits=LOGS,
    )
    for command, words in READERS.items()
]
_GOOD: dict[str, Content] = {"good.mcap": Good()}
_OUTPUTS = {
    "run": ("run", "good.toml", "-o"),
    "live": ("live", "good.toml", "--duration", "0.1", "-o"),
    "recue": ("recue", "good.mcap", "-o"),
    "recover": ("recover", "good.mcap", "-o"),
    "review --html": ("review", "good.mcap", "--html"),
    "review --replay": ("review", "good.mcap", "--replay"),
    "compare --html": ("compare", "good.mcap", "good.mcap", "--html"),
}
_PLACES: dict[str, tuple[str, dict[str, Content], str]] = {
    "exists": ("old", {"old": "precious"}, "exists already"),
    "in no folder": ("no/new", {}, "there is no folder"),
    "a folder": ("old", {"old": Folder()}, "no regular file"),
    "a FIFO": ("old", {"old": Pipe()}, "no regular file"),
    "a name of 5 kB": ("x" * 5000, {}, "File name too long"),
}
_FORCED: dict[str, tuple[str, dict[str, Content], str]] = {
    "a file of another kind": ("old", {"old": "precious"}, "nothing else is replaced"),
    "a link to one": ("new", {"new": Link("old"), "old": "precious"}, "nothing else is replaced"),
    "links in a circle": (
        "a",
        {"a": Link("b"), "b": Link("a")},
        "Too many levels of symbolic links",
    ),
    "a link to a device": ("new", {"new": Link("/dev/null")}, "no regular file"),
    "a link to an open file": (
        "new",
        {"new": Link("/proc/self/fd/2")},
        "an open file of a process",
    ),
    "a FIFO": ("old", {"old": Pipe()}, "no regular file"),
    "a link into no folder": ("new", {"new": Link("no/new")}, "there is no folder"),
}


def _onto(file: str) -> dict[str, tuple[str, dict[str, Content]]]:
    return {
        "itself": (file, {}),
        "by a link": ("link", {"link": Link(f"./{file}")}),
        "by a hard link": ("hard", {"hard": Same(file)}),
    }


_RUN = ("run", "good.toml")
OUTPUTS = (
    [
        BadInput(
            f"{command} to what {name}" if name == "exists" else f"{command} to {name}",
            (*words, path),
            {**_GOOD, **files},
            says=says,
            limits=LOGS,
        )
        for command, words in _OUTPUTS.items()
        for name, (path, files, says) in _PLACES.items()
    ]
    + [
        BadInput(
            f"{command} --force to {name}",
            (*words, path, "--force"),
            {**_GOOD, **files},
            says=says,
            limits=LOGS,
        )
        for command, words in _OUTPUTS.items()
        for name, (path, files, says) in _FORCED.items()
    ]
    + [
        BadInput(
            f"{command} --force onto its input {name}",
            (*words, path, "--force"),
            {**_GOOD, **files},
            says="is read",
            limits=LOGS,
        )
        for command, words in _OUTPUTS.items()
        for name, (path, files) in _onto(words[1]).items()
    ]
    + [
        BadInput(
            "review: two pages in one file",
            ("review", "good.mcap", "--html", "new", "--replay", "link"),
            {**_GOOD, "link": Link("new")},
            says="is written twice",
        ),
        BadInput(
            "run --force over a .part that is a link",
            (*_RUN, "--force"),
            {"s.mcap.part": Link("old"), "old": "precious"},
            says="no regular",
        ),
        BadInput(
            "run --force over a .part that is a FIFO",
            (*_RUN, "--force"),
            {"s.mcap.part": Pipe()},
            says="no regular",
        ),
        BadInput(
            "run --force over a .part of another kind",
            (*_RUN, "--force"),
            {"s.mcap.part": "precious"},
            says="no log",
        ),
        BadInput(
            "batch over a page of another",
            ("batch", "good.toml", "-o", "."),
            {"index.html": "<html>"},
            says="index.html",
        ),
        BadInput(
            "batch over a table of another",
            ("batch", "good.toml", "-o", "."),
            {"summary.csv": "a,b"},
            says="summary.csv",
        ),
        BadInput(
            "batch over a FIFO",
            ("batch", "good.toml", "-o", "."),
            {"summary.csv": Pipe()},
            says="summary.csv",
        ),
        BadInput(
            "run to /dev/null",
            ("run", "good.toml", "-o", "/dev/null", "--force"),
            says="no regular file",
        ),
        BadInput(
            "run beside what a killed run left",
            ("run", "good.toml"),
            {"s.mcap.part": "precious"},
            says="recover",
        ),
        BadInput("batch into a file", ("batch", "good.toml", "-o", "good.toml"), says="no folder"),
    ]
)
DISKS = [
    BadInput(
        "run to a full disk",
        ("run", "good.toml", "-o", f"{DISK}/new"),
        {},
        1,
        "No space left",
        FILES,
        "size=16k",
    ),
    *[
        BadInput(
            f"{command} to a full disk",
            (*words, f"{DISK}/new"),
            _GOOD,
            2,
            "No space left",
            LOGS,
            "size=16k",
        )
        for command, words in _OUTPUTS.items()
        if command not in ("run", "live")
    ],
    *[
        BadInput(
            f"{command} to a read-only disk",
            (*words, f"{DISK}/new"),
            _GOOD,
            2,
            "cannot be written to",
            LOGS,
            "ro",
        )
        for command, words in _OUTPUTS.items()
    ],
]
OPTIONS = [
    BadInput("no such command", ("fly",)),
    BadInput("no such option", ("run", "--nope")),
    BadInput("no argument", ("run",)),
    BadInput("batch --jobs 0", ("batch", "good.toml", "-o", "new", "--jobs", "0")),
    BadInput("batch --time-limit nan", ("batch", "good.toml", "-o", "new", "--time-limit", "nan")),
    BadInput(
        "batch --memory-limit -1", ("batch", "good.toml", "-o", "new", "--memory-limit", "-1")
    ),
    BadInput("batch --sort nothing", ("batch", "good.toml", "-o", "new", "--sort", "beauty")),
    BadInput(
        "batch --cluster nowhere", ("batch", "good.toml", "-o", "new", "--cluster", "nowhere")
    ),
    BadInput(
        "batch of an empty folder",
        ("batch", "empty", "-o", "new"),
        {"empty": Folder()},
        says="no scenario files",
    ),
    BadInput("live --rate 1e9", ("live", "good.toml", "--rate", "1e9"), says="--rate"),
    BadInput("live --rate nan", ("live", "good.toml", "--rate", "nan"), says="--rate"),
    BadInput("live --duration nan", ("live", "good.toml", "--duration", "nan"), says="duration"),
    BadInput("live --wait without --view", ("live", "good.toml", "--wait"), says="--view"),
    BadInput("live --port 65536", ("live", "good.toml", "--view", "--port", "65536")),
    BadInput("live --foxglove -1", ("live", "good.toml", "--foxglove", "-1")),
    BadInput("live --setpoints x:y", ("live", "good.toml", "--setpoints", "x:y"), says="HOST:PORT"),
    BadInput(
        "live --setpoints to all",
        ("live", "good.toml", "--setpoints", "0.0.0.0:5600"),
        says="one machine",
    ),
    BadInput(
        "live --setpoints beyond the loopback",
        ("live", "good.toml", "--setpoints", "192.0.2.1:5600"),
        says="key",
    ),
    BadInput(
        "live --setpoints by name", ("live", "good.toml", "--setpoints", "example.invalid:5600")
    ),
    BadInput("live --key alone", ("live", "good.toml", "--key", "good.toml"), says="--setpoints"),
    *[
        BadInput(
            f"live --key: {name}",
            ("live", "good.toml", "--setpoints", "127.0.0.1:5600", "--key", path),
            files,
            says="--key",
        )
        for name, (path, files) in {**NO_FILES, "empty": ("it", {"it": ""})}.items()
        if name != "FIFO"  # perhaps a password manager writes to it
    ],
    BadInput(
        "a source that flies only live",
        ("run", "bad.toml"),
        {"bad.toml": SCENARIO.replace('script = "c1722"', 'source = "flightgear"')},
    ),
]
