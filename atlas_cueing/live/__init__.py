"""The real-time loop: the same pipeline against the clock, from a simulator to the drives.

    input    sources: the state of the vehicle at the time of a tick
    control  state machine, trajectories and guard: one command a tick; knows no sockets
    output   set points to the drives; recorder and Foxglove behind the ring

Data goes one way, input -> control -> output. Nothing behind the ring can hold the loop up; nothing
before the guard can move the platform beyond its limits. `LiveSession` puts it all together.
"""

from .live_options import LiveOptions
from .loop import Drives, Loop, Output
from .open_source import open_source
from .session import LiveSession

__all__ = [
    "Drives",
    "LiveOptions",
    "LiveSession",
    "Loop",
    "Output",
    "open_source",
]
