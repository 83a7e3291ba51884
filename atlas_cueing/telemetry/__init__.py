"""What a live run shares with other processes of this machine.

A ring of ticks and changes of state, the operator's buttons, child processes that follow the run,
and a gate that keeps web pages of other hosts away from its servers.
"""

from .child_process import ChildProcess, Left, ProcessExit
from .helper_watch import HelperWatch, Loss
from .messages import LiveWriter, live_ring
from .operator_buttons import BUTTONS, OperatorButtons
from .origin_gate import OriginGate, listen
from .ring import Ring, RingReader

__all__ = [
    "BUTTONS",
    "ChildProcess",
    "HelperWatch",
    "Left",
    "LiveWriter",
    "Loss",
    "OperatorButtons",
    "OriginGate",
    "ProcessExit",
    "Ring",
    "RingReader",
    "listen",
    "live_ring",
]
