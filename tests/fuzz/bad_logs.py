"""Bad logs, and whatever else has the name of one."""

import struct
import zlib
from collections.abc import Callable

from .bad_files import NO_FILES
from .trying import LOGS, BadInput, Good, Hole

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
