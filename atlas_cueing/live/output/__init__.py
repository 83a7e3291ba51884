"""What leaves a live run: set points for the drives, the log, and messages for Foxglove.

`SetPointReceiver` and `StatusSender` are the drives' side; their words come back by `status`.
"""

from .foxglove_server import FoxgloveProcess
from .hello import limits_hash
from .operator_desk import OperatorDesk
from .pose_process import PoseProcess
from .receiver import SetPointReceiver
from .recorder_process import RecorderProcess
from .ring_recorder import Recorded, RingRecorder
from .setpoint import SetPoint
from .setpoint_sender import SetPointSender
from .status_sender import StatusSender

__all__ = [
    "FoxgloveProcess",
    "OperatorDesk",
    "PoseProcess",
    "Recorded",
    "RecorderProcess",
    "RingRecorder",
    "SetPoint",
    "SetPointReceiver",
    "SetPointSender",
    "StatusSender",
    "limits_hash",
]
