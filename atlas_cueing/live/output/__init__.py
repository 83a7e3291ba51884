"""What leaves a live run: set points for the drives, the log, and messages for Foxglove.

`SetPointReceiver` is the drives' side of the set points.
"""

from .foxglove_server import FoxgloveProcess
from .operator_desk import OperatorDesk
from .receiver import SetPointReceiver
from .recorder_process import RecorderProcess
from .ring_recorder import Recorded, RingRecorder
from .setpoint import SetPoint, SetPointSender

__all__ = [
    "FoxgloveProcess",
    "OperatorDesk",
    "Recorded",
    "RecorderProcess",
    "RingRecorder",
    "SetPoint",
    "SetPointReceiver",
    "SetPointSender",
]
