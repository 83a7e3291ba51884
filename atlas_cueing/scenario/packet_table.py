"""The `[vehicle]` table of a simulator that sends our own packets."""

from pathlib import Path
from typing import Annotated, Literal

from ..printable import is_name
from ..vehicles import PacketFlight
from .packet_port import PacketPort
from .source_table import SourceTable
from .tables import says, text

_LONGEST_PATH = 4096  # characters


class PacketTable(PacketPort, SourceTable):
    """`[vehicle]` of our own packets: where they come in, and the file of a shared key, if any.

    The key lies in a file of its own, at a path from the scenario's folder: a scenario goes into
    every log.
    """

    source: Annotated[Literal["packets"], says("takes packets of your own simulator, live")] = (
        "packets"
    )
    key_file: Annotated[
        Annotated[
            str, text("path of a file with a key", lambda p: is_name(p) and len(p) <= _LONGEST_PATH)
        ]
        | None,
        says("file with the key that packets of other machines are checked by"),
    ] = None

    def flight(self, folder: Path) -> PacketFlight:
        """Return where to listen."""
        default = PacketFlight()
        return PacketFlight(
            self.host or default.host,
            self.port or default.port,
            self.rate_hz or default.rate_hz,
            self.hold_after_s or default.hold_after,
            folder / self.key_file if self.key_file else None,
        )
