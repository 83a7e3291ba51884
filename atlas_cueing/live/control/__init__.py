"""The supervisory controller: from readings of the source to one command a tick."""

from .attitude_correction import AttitudeCorrection
from .command import Command, command_of, standstill
from .controller import LiveController
from .drive_monitor import DriveMonitor
from .drive_status import CabinSensors, DriveFeedback, DriveStatus
from .guard import Guard
from .input_monitor import InputMonitor
from .operator_inputs import OperatorInputs
from .platform_controller import PlatformController
from .run_account import RunOutcome
from .state_machine import Event, State, allowed_buttons, next_state

__all__ = [
    "AttitudeCorrection",
    "CabinSensors",
    "Command",
    "DriveFeedback",
    "DriveMonitor",
    "DriveStatus",
    "Event",
    "Guard",
    "InputMonitor",
    "LiveController",
    "OperatorInputs",
    "PlatformController",
    "RunOutcome",
    "State",
    "allowed_buttons",
    "command_of",
    "next_state",
    "standstill",
]
