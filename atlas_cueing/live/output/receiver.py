"""The drive controller's side of the set points: a reference receiver with a watchdog.

The watchdog stops the platform when the set points cease. Time is the sender's CLOCK_MONOTONIC in
s. A receiver on another machine adds the difference of the clocks, which it has to keep itself (as
with PTP); a difference of more than AHEAD_S is refused packet by packet.
"""

from collections import deque
from math import copysign, inf

from ...errors import SetPointError
from ...rotation import Vec3
from ..control.command import Command
from .setpoint import Address, SetPoint, check_key, decode

WATCHDOG_S = 0.1  # s without a good packet, or past the newest set point's valid-from, that trip
AHEAD_S = 0.1  # s that a valid-from may lie in the future; more is a clock that is not the sender's
_KEPT = 256  # set points: more than AHEAD_S of them at 1 kHz


class SetPointReceiver:
    """Follows the set points of one sender, and stops by itself when they cease.

    Between two set points it interpolates (cubic in position and in speed, linear in acceleration).
    After the newest one it keeps the speeds; a watchdog later it trips: every wheel and stage axis
    slows down at its largest acceleration to zero, and nothing is followed any more until `reset`.
    The ramp has corners, so the jerk at its ends is the drive's to limit; and until the watchdog
    trips the stage goes on by up to speed * WATCHDOG_S, which the drives' own end stops have to
    allow for.

    good, refused: number of packets taken and not taken since the start.
    """

    def __init__(
        self, wheel_acceleration: Vec3, stage_acceleration: Vec3, key: bytes = b""
    ) -> None:
        """Wait for the first set point.

        Args:
            wheel_acceleration: of the stop ramp of each wheel, rad/s^2.
            stage_acceleration: of the stop ramp of each axis of W, m/s^2.
            key: shared with the sender; empty for none.

        Raises InputError for a bad key.
        """
        check_key(key)
        self._wheel_acceleration = wheel_acceleration
        self._stage_acceleration = stage_acceleration
        self._key = key
        self.good = self.refused = 0
        self.reset()

    def reset(self) -> None:
        """Forget the sender and why it tripped; the platform has to stand."""
        self._points: deque[SetPoint] = deque(maxlen=_KEPT)
        self._sender: Address | None = None
        self._received = inf  # time of the last good packet
        self._stop: Command | None = None  # where the stop ramp begins
        self._reason = ""

    @property
    def tripped(self) -> str:
        """Why it stops or has stopped; empty while it follows."""
        return self._reason

    @property
    def newest(self) -> SetPoint | None:
        """The last good set point; None before the first."""
        return self._points[-1] if self._points else None

    def take(self, packet: bytes, sender: Address, now: float) -> str:
        """Take a packet of `sender` that came at `now` (s); return why it was refused, or ''."""
        self._watch(now)
        try:
            point = decode(packet, self._key)
        except SetPointError as error:
            reason = str(error)
        else:
            reason = self._refusal(point, sender, now)
        if reason:
            self.refused += 1
            return reason
        self.good += 1
        self._sender, self._received = sender, now
        self._points.append(point)
        return ""

    def at(self, now: float) -> Command | None:
        """Return the motion of the drives at `now` (s), which does not decrease.

        It is None before the first good packet: stand still.
        """
        self._watch(now)
        if self._stop is not None:
            return self._ramp(self._stop, now - self._stop.time)
        return self._follow(now)

    def _follow(self, now: float) -> Command | None:
        """Interpolate, or go on from the newest set point."""
        points = self._points
        while len(points) > 1 and points[1].valid_from <= now:
            points.popleft()
        if not points or now <= points[0].valid_from:
            return _timed(points[0], points[0].valid_from) if points else None
        if len(points) == 1:
            return _coast(points[0], now)
        return _between(points[0], points[1], now)

    def _watch(self, now: float) -> None:
        """Trip if the set points have ceased."""
        if self._reason or not self._points:
            return
        newest = self._points[-1].valid_from
        if now - self._received > WATCHDOG_S:
            self._reason = (
                f"no good set point for {now - self._received:.3f} s, allowed: {WATCHDOG_S} s"
            )
        elif now - newest > WATCHDOG_S:
            self._reason = f"set points late by {now - newest:.3f} s, allowed: {WATCHDOG_S} s"
        if self._reason:
            self._stop = self._follow(now)

    def _refusal(self, point: SetPoint, sender: Address, now: float) -> str:
        """Describe why an intact packet is not followed; empty when it is."""
        last = self.newest
        if self._reason:
            return f"stopped: {self._reason}; reset first"
        if point.valid_from > now + AHEAD_S:
            return (
                f"packet {point.sequence} is valid from {point.valid_from - now:.3f} s ahead,"
                f" allowed: {AHEAD_S} s"
            )
        if point.valid_from < now - WATCHDOG_S:
            return (
                f"packet {point.sequence} was valid from {now - point.valid_from:.3f} s ago,"
                f" allowed: {WATCHDOG_S} s"
            )
        if last is None:
            return ""
        if sender != self._sender or point.session != last.session:
            return (
                f"packet {point.sequence} is from another sender, {sender[0]}:{sender[1]}, or"
                " session than the first one"
            )
        if point.sequence <= last.sequence:
            return (
                f"packet {point.sequence} comes after {last.sequence}: out of order or sent again"
            )
        if point.valid_from <= last.valid_from:
            return f"packet {point.sequence} is not valid from later than the one before"
        return ""

    def _ramp(self, start: Command, t: float) -> Command:
        """Return the command t s into the stop."""
        wheels = [
            _brake(0.0, v, a, t)
            for v, a in zip(start.wheel_speed, self._wheel_acceleration, strict=True)
        ]
        rails = [
            _brake(p, v, a, t)
            for p, v, a in zip(start.p_WS_W, start.v_WS_W, self._stage_acceleration, strict=True)
        ]
        (_, w1, b1), (_, w2, b2), (_, w3, b3), (px, vx, ax), (py, vy, ay), (pz, vz, az) = (
            wheels + rails
        )
        return Command(
            start.time + t, (w1, w2, w3), (b1, b2, b3), (px, py, pz), (vx, vy, vz), (ax, ay, az)
        )


def _brake(p: float, v: float, most: float, t: float) -> Vec3:
    """Return position, speed and acceleration t s into a stop at constant deceleration."""
    end = abs(v) / most
    a = -copysign(most, v) if t < end else 0.0
    t = min(t, end)
    return (
        p + v * t - 0.5 * copysign(most, v) * t * t,
        v - copysign(most, v) * t if t < end else 0.0,
        a,
    )


def _timed(point: SetPoint, time: float) -> Command:
    c = point.command
    return Command(time, c.wheel_speed, c.wheel_acceleration, c.p_WS_W, c.v_WS_W, c.a_WS_W)


def _coast(point: SetPoint, now: float) -> Command:
    """Return the command at `now` after the newest set point, at its speeds."""
    c, t = point.command, now - point.valid_from
    (px, py, pz), (vx, vy, vz) = c.p_WS_W, c.v_WS_W
    still = (0.0, 0.0, 0.0)
    return Command(
        now, c.wheel_speed, still, (px + t * vx, py + t * vy, pz + t * vz), c.v_WS_W, still
    )


def _between(one: SetPoint, two: SetPoint, now: float) -> Command:
    h = two.valid_from - one.valid_from
    s, a, b = (now - one.valid_from) / h, one.command, two.command
    return Command(
        now,
        _cubic(a.wheel_speed, a.wheel_acceleration, b.wheel_speed, b.wheel_acceleration, h, s),
        _linear(a.wheel_acceleration, b.wheel_acceleration, s),
        _cubic(a.p_WS_W, a.v_WS_W, b.p_WS_W, b.v_WS_W, h, s),
        _cubic(a.v_WS_W, a.a_WS_W, b.v_WS_W, b.a_WS_W, h, s),
        _linear(a.a_WS_W, b.a_WS_W, s),
    )


def _cubic(x0: Vec3, d0: Vec3, x1: Vec3, d1: Vec3, h: float, s: float) -> Vec3:
    """Interpolate (Hermite) between values x and derivatives d at both ends of h s, at share s."""
    r = 1.0 - s
    u0, w0, u1, w1 = (1.0 + 2.0 * s) * r * r, h * s * r * r, (1.0 + 2.0 * r) * s * s, -h * r * s * s
    x, y, z = (u0 * p + w0 * v + u1 * q + w1 * w for p, v, q, w in zip(x0, d0, x1, d1, strict=True))
    return x, y, z


def _linear(x0: Vec3, x1: Vec3, s: float) -> Vec3:
    x, y, z = ((1.0 - s) * p + s * q for p, q in zip(x0, x1, strict=True))
    return x, y, z
