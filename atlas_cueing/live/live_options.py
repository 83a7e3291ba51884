"""How a live run is to be flown."""

from dataclasses import dataclass, field
from pathlib import Path

from ..errors import InputError
from .control.drive_monitor import MOST_OFF, TIMEOUT
from .control.pose import Pose
from .loop import LEAD

RATES = (100.0, 1000.0)  # Hz, lowest and highest of the loop
DEFAULT_RATE = 500.0  # Hz
DRIVE_TIMEOUTS = (0.03, 1.0)  # s, shortest and longest silence of the drives
LEADS = (0.002, 0.08)  # s, shortest and longest of the set points


@dataclass(frozen=True, slots=True)
class LiveOptions:
    """How to run.

    rate: of the loop, Hz; a tick takes whole nanoseconds.
    lead: of the set points, s; so much lateness is borne, less a millisecond.
    duration: until the platform parks, s.
    attended: the operator's buttons can be pressed, and the run waits for them.
    engage: engage at the start.
    priority: ask the system for SCHED_FIFO, locked memory and a core of its own.
    announce: let the recorder report changes of state on stderr; the command's desk does it itself.
    pose: where the platform stands; anywhere but at home the run starts stopped.
    pose_file: where the pose is kept; None for nowhere.
    drive_timeout: s that the drives may be silent while the platform moves, if they speak.
    drive_tolerance: rad of a wheel that they may be off the command.
    occupied: somebody may sit in the platform, who is not left alone.
    feedback: what the attitude is corrected by: none, gyro or fix.
    listen: address of this machine that packets come to; None for the scenario's, a loopback.
    """

    rate: float = DEFAULT_RATE
    duration: float = float("inf")
    attended: bool = False
    engage: bool = True
    priority: bool = False
    announce: bool = False
    lead: float = LEAD
    drive_timeout: float = TIMEOUT
    drive_tolerance: float = MOST_OFF[0]
    feedback: str = "none"
    listen: str | None = None
    pose: Pose = field(default_factory=Pose)
    pose_file: Path | None = None
    occupied: bool = True

    def check(self) -> None:
        """Raise InputError for what is not allowed."""
        if not RATES[0] <= self.rate <= RATES[1]:
            raise InputError(
                f"--rate {self.rate:g} Hz, allowed: {RATES[0]:g} <= rate <= {RATES[1]:g}"
            )
        if not LEADS[0] <= self.lead <= LEADS[1]:
            shortest, longest = (1e3 * lead for lead in LEADS)
            raise InputError(
                f"--lead {1e3 * self.lead:g} ms, allowed: {shortest:g} <= lead <= {longest:g}"
            )
        if not DRIVE_TIMEOUTS[0] <= self.drive_timeout <= DRIVE_TIMEOUTS[1]:
            shortest, longest = (1e3 * timeout for timeout in DRIVE_TIMEOUTS)
            raise InputError(
                f"--drive-timeout {1e3 * self.drive_timeout:g} ms, allowed: {shortest:g} <="
                f" timeout <= {longest:g}"
            )
