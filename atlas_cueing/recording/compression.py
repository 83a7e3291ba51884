"""Unpacks chunks within bounds: a file of 33 kB can unpack to a GiB.

MCAP names two compressions, zstd and lz4, and none
(https://mcap.dev/spec/registry#well-known-compression-formats).
"""

import zlib

import lz4.frame
import zstandard
from mcap.records import Chunk

from ..errors import LogError

MAX_CHUNK = 64 * 2**20  # bytes unpacked
_WINDOW = 2**27  # bytes that zstd may look back; what its own decoder allows by default


class CompressionError(LogError):
    """A chunk is packed in a way that the format does not name."""


def unpack(chunk: Chunk) -> bytes:
    """Unpack the records of a chunk; a checksum of 0 means that the chunk has none.

    Raises LogError if they are damaged, too large or packed in an unknown way.
    """
    size = chunk.uncompressed_size
    if chunk.compression not in _UNPACK:
        raise CompressionError(
            f"a chunk has compression {chunk.compression!r}, allowed: 'zstd', 'lz4' or none"
        )
    if size > MAX_CHUNK:
        raise LogError(f"a chunk unpacks to {size} bytes, allowed: at most {MAX_CHUNK}")
    try:
        data = _UNPACK[chunk.compression](chunk.data, size)
    except (zstandard.ZstdError, RuntimeError, EOFError, ValueError) as error:  # lz4: RuntimeError
        raise LogError(f"a chunk cannot be unpacked: {error}") from error
    if len(data) != size:
        raise LogError(f"a chunk unpacks to another size than the {size} bytes it claims")
    check_crc("chunk", chunk.uncompressed_crc, zlib.crc32(data))
    return data


def check_crc(what: str, expected: int, found: int) -> None:
    """Compare the checksums of `what`; an expected 0 means "not available".

    Raises LogError when they differ.
    """
    if expected not in (0, found):
        raise LogError(
            f"the checksum of the {what} is wrong ({found:#010x} instead of {expected:#010x})"
        )


def _zstd(data: bytes, size: int) -> bytes:
    """Unpack at most one byte more than `size`."""
    if zstandard.frame_content_size(data) == size:  # as in our own logs
        # the decompressor trusts the size in the frame: only for frames where it is right
        return zstandard.ZstdDecompressor().decompress(data)
    decompressor = zstandard.ZstdDecompressor(max_window_size=_WINDOW)
    with decompressor.stream_reader(data, read_across_frames=True) as reader:
        return bytes(reader.read(size + 1))


def _lz4(data: bytes, size: int) -> bytes:
    """Unpack at most one byte more than `size`; return nothing when the frame is cut."""
    decompressor = lz4.frame.LZ4FrameDecompressor()
    unpacked: bytes = decompressor.decompress(data, max_length=size + 1)
    return unpacked if decompressor.eof else b""


def _none(data: bytes, _: int) -> bytes:
    return data


_UNPACK = {"zstd": _zstd, "lz4": _lz4, "": _none}
