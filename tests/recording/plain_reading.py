"""A log as anyone sees it, through plain mcap and mcap-protobuf-support.

Our own reader takes no part here.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.reader import NonSeekingReader
from mcap_protobuf.decoder import DecoderFactory

from atlas_cueing.recording import McapRecorder

from .flights import ATTACHMENTS, HEAD, METADATA

EPOCH_NS = 946_684_800 * 10**9  # 2000-01-01T00:00:00Z


def open_recorder(path: Path, **options: Any) -> McapRecorder:
    return McapRecorder(path, head_S=HEAD, metadata=METADATA, attachments=ATTACHMENTS, **options)


def decoded(path: Path) -> Iterator[tuple[str, int, Any]]:
    """Yield topic, log time and decoded message of everything in the log, in the order of the file.

    Every checksum is validated.
    """
    with path.open("rb") as stream:
        reader = NonSeekingReader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for item in reader.iter_decoded_messages(log_time_order=False):
            assert item.message.log_time == item.message.publish_time
            yield item.channel.topic, item.message.log_time, item.decoded_message


def vector(message: Any, name: str, unit: str) -> tuple[float, ...]:
    return tuple(getattr(message, f"{name}{axis}_{unit}") for axis in "xyz")


def quaternion(message: Any, name: str) -> tuple[float, ...]:
    return tuple(getattr(message, f"{name}_{component}") for component in "wxyz")
