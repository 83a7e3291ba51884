"""What others do in the same time: one plan of ruckig, plain MCAP writing and reading."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from mcap.reader import make_reader
from mcap.records import Channel, Schema
from mcap.writer import CompressionType, Writer
from ruckig import ControlInterface, InputParameter, Result, Ruckig, Trajectory

DT = 1.0 / 120.0  # s
_V, _A, _J = 31.0, 60.0, 600.0  # rad/s, rad/s^2, rad/s^3: the wheels of atlas-2.9m


def ruckig_call(axes: int) -> Callable[[], object]:
    """One `calculate` of the velocity interface to a speed that is not reached within a tick.

    Its numbers are set before.
    """
    generator, asked, trajectory = Ruckig(axes, DT), InputParameter(axes), Trajectory(axes)
    asked.control_interface = ControlInterface.Velocity
    asked.current_position = [0.0] * axes
    asked.current_velocity, asked.current_acceleration = [1.0] * axes, [2.0] * axes
    asked.target_velocity, asked.target_acceleration = [-3.0 - k for k in range(axes)], [1.0] * axes
    asked.max_velocity, asked.max_acceleration, asked.max_jerk = (
        [_V] * axes,
        [_A] * axes,
        [_J] * axes,
    )
    if generator.calculate(asked, trajectory) is not Result.Working:
        raise SystemExit("ruckig does not plan what it is timed with")
    return lambda: generator.calculate(asked, trajectory)


class Message(NamedTuple):
    """As it stands in a log."""

    schema: Schema
    channel: Channel
    log_time: int
    data: bytes


def read_plain(log: Path) -> list[Message]:
    """All messages of a log by the mcap library, as bytes, in the order of the file."""
    with log.open("rb") as stream:
        messages = make_reader(stream).iter_messages(log_time_order=False)
        return [
            Message(schema, channel, message.log_time, message.data)
            for schema, channel, message in messages
        ]


def write_plain(messages: Sequence[Message], log: Path, chunk_size: int) -> None:
    """The same messages, made already, by the mcap library's writer with zstd.

    Chunks of `chunk_size` bytes.
    """
    with log.open("wb") as stream:
        writer = Writer(stream, chunk_size=chunk_size, compression=CompressionType.ZSTD)
        writer.start()
        schemas: dict[int, int] = {}
        channels: dict[int, int] = {}
        for schema, channel, time, data in messages:
            if channel.id not in channels:
                if schema.id not in schemas:
                    schemas[schema.id] = writer.register_schema(
                        schema.name, schema.encoding, schema.data
                    )
                channels[channel.id] = writer.register_channel(
                    channel.topic, channel.message_encoding, schemas[schema.id]
                )
            writer.add_message(channels[channel.id], time, data, time)
        writer.finish()
