"""What the packets between loop and drives have in common: head, number, and check.

Each begins with a magic of four bytes, a version (uint8) and the kind of its check (uint8), and
ends with 16 bytes of check over all that comes before. Kind 0 is the CRC-32 of zlib, PNG and
Ethernet as a uint32, then 12 zeros: it finds damage, not forgery, and is for loopback. Kind 1 is
BLAKE2s (RFC 7693) with a shared key of 16 to 32 bytes, a digest of 16 bytes, no salt and no
personalisation. Who has a key takes nothing but kind 1.
"""

# mypyc: runs every tick

import hmac
import zlib
from dataclasses import dataclass
from hashlib import blake2s
from struct import Struct
from typing import Any, TypeAlias

from ...errors import InputError, SetPointError

Address: TypeAlias = tuple[str, int]
"""Host and port of a sender."""

CRC32, BLAKE2S = 0, 1
SHORTEST_KEY = 16  # bytes
LONGEST_KEY = blake2s.MAX_KEY_SIZE
_CHECK = 16  # bytes


@dataclass(frozen=True, slots=True)
class Layout:
    """How a packet is laid out.

    magic, version: its first five bytes.
    content: all fields before the check, the first three are magic, version and kind of check.
    number: place of the packet's number among them.
    """

    magic: bytes
    version: int
    content: Struct
    number: int

    @property
    def size(self) -> int:
        """Size of the packet, bytes."""
        return self.content.size + _CHECK


def seal(layout: Layout, key: bytes, *fields: Any) -> bytes:
    """Return the packet of these fields, those after the kind of check."""
    kind = BLAKE2S if key else CRC32
    content = layout.content.pack(layout.magic, layout.version, kind, *fields)
    return content + _check(content, key)


def unseal(layout: Layout, packet: bytes, key: bytes) -> tuple[Any, ...]:
    """Return the fields of a packet, those after the kind of check.

    Raises SetPointError for a wrong size, magic, version, kind or check.
    """
    if len(packet) != layout.size:
        raise SetPointError(f"packet of {len(packet)} bytes, allowed: {layout.size}")
    content = packet[: layout.content.size]
    fields = layout.content.unpack(content)
    magic, version, kind = fields[:3]
    if magic != layout.magic:
        raise SetPointError(f"packet starts with {magic!r}, allowed: {layout.magic!r}")
    if version != layout.version:
        raise SetPointError(f"packet of version {version}, allowed: {layout.version}")
    wanted = BLAKE2S if key else CRC32
    if kind != wanted:
        raise SetPointError(
            f"packet has check {kind}, allowed: {wanted}, as the receiver has"
            f" {'a' if key else 'no'} key"
        )
    if not hmac.compare_digest(packet[layout.content.size :], _check(content, key)):
        raise SetPointError(
            f"packet {fields[layout.number]} has a wrong check: it is damaged, or its sender has"
            " another key"
        )
    return fields[3:]


def check_key(key: bytes) -> None:
    """Raise InputError for a key that is too short or too long; an empty one means none."""
    if key and not SHORTEST_KEY <= len(key) <= LONGEST_KEY:
        raise InputError(
            f"shared key of {len(key)} bytes, allowed: {SHORTEST_KEY} <= bytes <= {LONGEST_KEY}"
        )


def _check(content: bytes, key: bytes) -> bytes:
    if key:
        return blake2s(content, digest_size=_CHECK, key=key).digest()
    return zlib.crc32(content).to_bytes(_CHECK, "little")
