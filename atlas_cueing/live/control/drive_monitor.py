"""Watches the drives of a live run: whether they do what they are told, and may be set in motion.

What the drives tell is held against the commands of the same time. While the platform moves, a word
that says otherwise, or no word, is a fault; at rest it is a reason not to set out.
"""

# mypyc: runs every tick

from collections import deque
from math import degrees, inf, isfinite, radians

from ...rotation import Vec3
from .attitude_correction import AttitudeCorrection
from .command import Command, is_still
from .drive_status import DriveFeedback, DriveStatus

TIMEOUT = 0.05  # s without a status while it moves, by default
MOST_OFF = (radians(0.1), 1e-3)  # rad of a wheel and m of the stage between drives and command
LEAST_MARGIN = 0.002  # s that set points have to come early before it sets out
PATIENCE = 1.0  # s that a trouble at rest has to last before it is told
_MOST_AHEAD = 0.02  # s that the drives' clock may be ahead (assumed)
_MARGIN_TIME = 0.25  # s; the least margin of so long counts
_KEPT = 1024  # commands, newest due times first to come: a second at 1 kHz


class DriveMonitor:
    """Turns what the drives tell into faults, and into reasons to stay at rest.

    trouble: why the platform may not set out now; empty when it may.
    heard: number of statuses up to now.
    least_margin: of all set points that were taken, s; infinite before the first.
    wheel_difference, stage_difference: largest between drives and command up to now, rad and m.
    """

    def __init__(
        self,
        feedback: DriveFeedback,
        limits: bytes,
        timeout: float = TIMEOUT,
        attitude: AttitudeCorrection | None = None,
        most_off: float = MOST_OFF[0],
    ) -> None:
        """Begin with no status heard.

        Args:
            feedback: where statuses come from.
            limits: hash of the limits that the drives have to keep.
            timeout: s without a status while the platform moves.
            attitude: hears what the cabin's sensors tell, where it is corrected.
            most_off: rad of a wheel that the drives may be off the command.
        """
        self._attitude, self._most_off = attitude, most_off
        self._feedback, self._limits, self._timeout = feedback, limits, timeout
        self._commands: deque[tuple[int, Command]] = deque(maxlen=_KEPT)
        self._margins: deque[tuple[float, float]] = deque()
        self._status: DriveStatus | None = None
        self._came = self._since = -inf  # the newest status, this kind of trouble, s
        self._off = self._clock = self._kind = self._told = ""
        self._ever_moved = False
        self._moving = False  # by the commands, and not yet at rest by the drives' words
        self._at_rest: int | None = None  # when the first command at rest is due, ns
        self._notes: list[str] = []
        self.trouble = "nothing has been heard of the drives yet"
        self.heard = 0
        self.least_margin = inf
        self.wheel_difference = self.stage_difference = 0.0

    @property
    def finding(self) -> str:
        """Why the drives have never moved, if they should have; empty when they have."""
        return "" if self._ever_moved else self.trouble

    @property
    def settled(self) -> bool:
        """Whether the drives have told that they came to rest where they should."""
        return not self._moving

    def watch(self, now: float, tracking: bool) -> str:
        """Read what has come; return why the platform has to stop, or ''.

        Args:
            now: s of the loop's clock.
            tracking: the platform follows the cue, and may move with the next command.
        """
        for status in self._feedback.statuses():
            self._take(status, now)
        while self._margins and now - self._margins[0][0] > _MARGIN_TIME:
            self._margins.popleft()
        kind, text = self._disagreement(now)
        fault = text if tracking or not self.settled else ""
        if not kind:
            kind, text = self._unready()
        self.trouble = text
        self._tell(now, kind, text)
        return fault

    def commanded(self, due: int, command: Command) -> None:
        """Note the command that the drives shall have at `due` (ns)."""
        self._commands.append((due, command))
        if moves(command):
            self._moving = self._ever_moved = True
            self._at_rest = None
        elif self._at_rest is None:
            self._at_rest = due

    def figures(self) -> dict[str, float]:
        """Return what the drives told, by name, the unit in the name."""
        figures: dict[str, float] = {
            "statuses": self.heard,
            "wheel_difference_deg": degrees(self.wheel_difference),
            "stage_difference_mm": 1e3 * self.stage_difference,
        }
        if self.least_margin < inf:
            figures["least_margin_ms"] = 1e3 * self.least_margin
        return figures | (self._attitude.figures() if self._attitude else {})

    def notes(self) -> list[str]:
        """Return what the user should be told since the last call."""
        notes, self._notes = self._notes, []
        return notes

    def _take(self, status: DriveStatus, now: float) -> None:
        self._clock = self._clock_trouble(status, now)
        self._status, self._came = status, now
        if self._attitude:
            self._attitude.hear(status)
        self.heard += 1
        self.least_margin = min(self.least_margin, status.margin)
        self._margins.append((now, status.margin))
        self._off = ""
        if status.followed != self._feedback.session:
            return
        self._compare(status)
        following = status.state == "following" and not self._off
        if following and self._at_rest is not None and status.time >= self._at_rest:
            self._moving = False

    def _compare(self, status: DriveStatus) -> None:
        """Hold the positions against the command of the same time, if there is one."""
        commands = self._commands
        while len(commands) > 1 and commands[1][0] <= status.time:
            commands.popleft()
        if len(commands) < 2 or commands[0][0] > status.time:
            return  # before the first or after the newest: the loop is late itself
        angle, place = _between(commands[0], commands[1], status.time)
        wheels, stage = _largest(angle, status.wheel_angle), _largest(place, status.p_WS_W)
        self.wheel_difference = max(self.wheel_difference, wheels)
        self.stage_difference = max(self.stage_difference, stage)
        if not (wheels <= self._most_off and stage <= MOST_OFF[1]):
            self._off = (
                f"the drives are {degrees(wheels):.2f} deg of a wheel and {1e3 * stage:.2f} mm off"
                f" the command, allowed: {degrees(self._most_off):g} deg and 1 mm"
            )

    def _clock_trouble(self, status: DriveStatus, now: float) -> str:
        """Describe a time that cannot be that of a status that has come now; empty otherwise."""
        age, before = now - 1e-9 * status.time, self._status
        if before is not None and status.time <= before.time:
            return "time stands still or runs back in the drives' statuses; their clock is wrong"
        if -_MOST_AHEAD <= age <= self._timeout:
            return ""
        return (
            f"a status of the drives is {1e3 * age:.0f} ms old, allowed: {-1e3 * _MOST_AHEAD:.0f}"
            f" to {1e3 * self._timeout:.0f} ms; keep both clocks together (as by PTP)"
        )

    def _disagreement(self, now: float) -> tuple[str, str]:
        """Return kind and description of what is a fault while the platform moves."""
        status = self._status
        if status is None:
            return "nobody", (
                "set points go to nobody: no status of the drives has come; start the receiver, or"
                " say --no-drive-status for one that tells nothing"
            )
        if now - self._came > self._timeout:
            refusal = f"; refused: {self._feedback.refusal}" if self._feedback.refusal else ""
            return "silent", (
                f"the drives were silent for {1e3 * (now - self._came):.0f} ms,"
                f" allowed: {1e3 * self._timeout:.0f} ms{refusal}"
            )
        if status.state == "waiting":
            reason = f": {status.reason}" if status.reason else ""
            return "waiting", f"the drives wait for a first set point{reason}"
        if status.followed != self._feedback.session:
            return "stranger", (
                "the drives follow the set points of another run; wait until that has ended parked,"
                " or reset them"
            )
        if status.state == "latched":
            return "latched", f"the drives have latched: {status.reason}; reset them"
        if self._clock or self._off:
            return ("clock", self._clock) if self._clock else ("off", self._off)
        fault = self._attitude.fault if self._attitude else ""
        return ("sensors", fault) if fault else ("", "")

    def _unready(self) -> tuple[str, str]:
        """Return kind and description of what only keeps the platform from setting out."""
        status = self._status
        if status is None:
            return "", ""
        if status.limits != self._limits:
            return "limits", (
                f"the drives keep other limits (hash {status.limits.hex()[:8]}) than the platform"
                f" ({self._limits.hex()[:8]}); give both the same platform file"
            )
        if status.state == "stopping":
            return "stopping", f"the drives stop by themselves: {status.reason}; reset them"
        if self._attitude and (trouble := self._attitude.trouble):
            return "sensors", trouble
        margin = inf
        for _, each in self._margins:
            margin = min(margin, each)
        if margin < LEAST_MARGIN:
            return "margin", (
                f"set points come {1e3 * margin:.1f} ms before they are due, allowed: at least"
                f" {1e3 * LEAST_MARGIN:.0f} ms; what helps: --lead, the same clock on both machines"
            )
        return "", ""

    def _tell(self, now: float, kind: str, text: str) -> None:
        """Note a trouble that lasts, once, and its end."""
        if kind != self._kind:
            self._kind, self._since = kind, now
        if kind == self._told or (kind and now - self._since < PATIENCE):
            return
        self._notes.append(text or "the drives are ready")
        self._told = kind


def moves(command: Command) -> bool:
    """Return whether a command is not at rest."""
    return not is_still(command)


def _between(one: tuple[int, Command], other: tuple[int, Command], time: int) -> tuple[Vec3, Vec3]:
    """Return wheel angles and stage position at `time` (ns) between two commands.

    By the cubic that meets position and speed of both; in a slot of h, a motion of jerk J leaves it
    by less than J h^3 / 24.
    """
    h = 1e-9 * (other[0] - one[0])
    u = 1e-9 * (time - one[0]) / h
    a, b = one[1], other[1]
    return (
        _cubic(h, u, a.wheel_angle, a.wheel_speed, b.wheel_angle, b.wheel_speed),
        _cubic(h, u, a.p_WS_W, a.v_WS_W, b.p_WS_W, b.v_WS_W),
    )


def _cubic(h: float, u: float, p0: Vec3, v0: Vec3, p1: Vec3, v1: Vec3) -> Vec3:
    s, r = u * u * (3.0 - 2.0 * u), 1.0 - u
    x, y, z = (
        a + s * (b - a) + h * u * r * (r * va - u * vb)
        for a, va, b, vb in zip(p0, v0, p1, v1, strict=True)
    )
    return (x, y, z)


def _largest(one: Vec3, other: Vec3) -> float:
    """Return the largest difference of two vectors; infinite where there is none."""
    x, y, z = (abs(a - b) for a, b in zip(one, other, strict=True))
    return max(x, y, z) if isfinite(x + y + z) else inf
