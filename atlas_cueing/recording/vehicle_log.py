"""A log of a flight that nobody has cued yet: `/vehicle`, files and metadata."""

from collections.abc import Mapping
from pathlib import Path

from ..rotations import Array
from ..signals import TOPICS
from .container import Container
from .log import Log, TopicColumns
from .log_writer import write_log
from .wire import log_times


def write_vehicle_log(
    rows: Array, metadata: Mapping[str, str], attachments: Mapping[str, bytes]
) -> bytes:
    """Return a finished MCAP log with the states of a vehicle.

    Args:
        rows: (n, fields of `/vehicle`): time s from 0 on, q_NB, body rates rad/s, specific force
            m/s^2; FRD.
        metadata: the record `atlas.run`.
        attachments: TOML files by name.
    """
    written = bytearray()
    vehicle = TOPICS[0]
    table = TopicColumns(vehicle.fields, rows, log_times(rows[:, 0]))
    log = Log(Path(), {vehicle.name: table}, {}, attachments, ())
    write_log(Container(written.extend), log, metadata)
    return bytes(written)
