"""The reference receiver: what it follows and refuses, when it stops, and its command."""

import json
import socket
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from time import monotonic, sleep

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import InputError
from atlas_cueing.live.control.command import Command
from atlas_cueing.live.output.receiver import WATCHDOG_S, SetPointReceiver
from atlas_cueing.live.output.setpoint import SIZE, SetPointSender, encode
from atlas_cueing.rotation import Vec3

from ..commands import REST, swinging

SENDER = ("127.0.0.1", 4001)
WHEELS: Vec3 = (60.0, 50.0, 40.0)
STAGE: Vec3 = (6.0, 6.0, 5.0)
LEAD = 0.008
STEP = 0.01
START = 1000.0  # s on the clock when the run began
TOOL = Path(__file__).parents[3] / "tools" / "receive_setpoints"


def packet(k: int, session: int = 7, key: bytes = b"", command: Command | None = None) -> bytes:
    """The one of tick k, at START + k STEP."""
    return encode(
        session, k, k * STEP, START + k * STEP + LEAD, 2, command or swinging(k * STEP), key
    )


def following(ticks: int, key: bytes = b"") -> SetPointReceiver:
    """A receiver that took `ticks` packets, each when it was sent."""
    receiver = SetPointReceiver(WHEELS, STAGE, key)
    for k in range(ticks):
        assert receiver.take(packet(k, key=key), SENDER, START + k * STEP) == ""
    return receiver


class TestFollowing:
    def test_there_is_nothing_to_do_before_the_first_packet(self) -> None:
        receiver = SetPointReceiver(WHEELS, STAGE)
        assert receiver.at(START) is None
        assert receiver.at(START + 100.0) is None
        assert receiver.tripped == ""
        assert receiver.newest is None

    def test_at_a_set_points_own_time_it_is_that_set_point(self) -> None:
        receiver = following(5)
        for k in range(5):
            command = receiver.at(START + k * STEP + LEAD)
            assert close(command, swinging(k * STEP), 1e-9)

    def test_before_the_first_ones_time_it_is_the_first(self) -> None:
        assert close(following(1).at(START), swinging(0.0), 0.0)

    @given(st.floats(0.0, 0.29))
    def test_between_it_is_the_motion_itself(self, t: float) -> None:
        """The error of Hermite's interpolation has a bound.

        h^4 / 384 of the fourth derivative in position and speed, h^2 / 8 of the second in
        acceleration.
        """
        command = following(30).at(START + LEAD + t)
        true = swinging(t)
        assert close(
            replace(command, wheel_acceleration=true.wheel_acceleration, a_WS_W=true.a_WS_W),
            true,
            2.1e-9 * 16 * 5 + 1e-9,
        )
        assert close(command, true, STEP**2 / 8.0 * 40.0 + 1e-9)

    @given(st.floats(0.0, 0.999 * WATCHDOG_S - LEAD))
    def test_after_the_newest_it_keeps_its_speeds(self, t: float) -> None:
        receiver = following(30)
        last = swinging(0.29)
        command = receiver.at(START + 0.29 + LEAD + t)
        assert command is not None
        assert command.wheel_speed == pytest.approx(last.wheel_speed)
        assert command.v_WS_W == pytest.approx(last.v_WS_W)
        assert command.p_WS_W == pytest.approx(
            [p + v * t for p, v in zip(last.p_WS_W, last.v_WS_W, strict=True)]
        )
        assert receiver.tripped == ""

    def test_all_of_a_burst_is_kept(self) -> None:
        """Packets of the next 90 ms at once, as after a hiccup of the network."""
        receiver = SetPointReceiver(WHEELS, STAGE)
        for k in range(9):
            assert receiver.take(packet(k), SENDER, START) == ""
        for k in range(9):
            assert close(receiver.at(START + k * STEP + LEAD), swinging(k * STEP), 1e-9)


class TestRefusing:
    def test_a_packet_sent_again_or_out_of_order(self) -> None:
        receiver = following(3)
        now = START + 3 * STEP
        assert (
            receiver.take(packet(2), SENDER, now)
            == "packet 2 comes after 2: out of order or sent again"
        )
        assert (
            receiver.take(packet(0), SENDER, now)
            == "packet 0 comes after 2: out of order or sent again"
        )
        assert receiver.take(packet(4), SENDER, now) == ""
        assert "comes after 4" in receiver.take(packet(3), SENDER, now)
        assert (receiver.good, receiver.refused) == (4, 3)

    def test_another_sender_or_session_than_the_first_good_one(self) -> None:
        receiver = SetPointReceiver(WHEELS, STAGE)
        assert "packet of 3 bytes" in receiver.take(b"bad", ("127.0.0.1", 9), START)
        assert receiver.take(packet(0), SENDER, START) == ""
        assert "from another sender, 127.0.0.1:9," in receiver.take(
            packet(1), ("127.0.0.1", 9), START
        )
        assert "from another sender" in receiver.take(packet(1, session=8), SENDER, START)
        assert receiver.take(packet(1), SENDER, START) == ""

    def test_a_time_that_cannot_be(self) -> None:
        receiver = SetPointReceiver(WHEELS, STAGE)
        assert "valid from 0.208 s ahead, allowed: 0.1 s" in receiver.take(
            packet(0), SENDER, START - 0.2
        )
        assert "valid from 0.192 s ago, allowed: 0.1 s" in receiver.take(
            packet(0), SENDER, START + 0.2
        )
        assert receiver.take(packet(1), SENDER, START) == ""
        same = encode(7, 2, 0.0, START + STEP + LEAD, 2, REST)
        assert (
            receiver.take(same, SENDER, START)
            == "packet 2 is not valid from later than the one before"
        )

    def test_a_forged_packet_changes_nothing(self) -> None:
        key = bytes(16)
        receiver = following(3, key)
        before = receiver.at(START + 2 * STEP)
        assert "as the receiver has a key" in receiver.take(packet(3), SENDER, START + 2 * STEP)
        assert "wrong check" in receiver.take(
            packet(3, key=bytes(range(16))), SENDER, START + 2 * STEP
        )
        assert receiver.at(START + 2 * STEP) == before

    def test_a_key_of_a_wrong_size(self) -> None:
        with pytest.raises(InputError, match="shared key of 3 bytes"):
            SetPointReceiver(WHEELS, STAGE, b"abc")

    @given(st.lists(st.binary(max_size=SIZE + 8), max_size=20))
    def test_rubbish_neither_trips_nor_feeds_the_watchdog(self, rubbish: list[bytes]) -> None:
        receiver = following(3)
        for data in rubbish:
            assert receiver.take(data, SENDER, START + 2 * STEP + 0.09)
        receiver.at(START + 2 * STEP + 0.099)
        assert receiver.tripped == ""
        receiver.at(START + 2 * STEP + 0.11)
        assert receiver.tripped == "no good set point for 0.110 s, allowed: 0.1 s"


class TestTheWatchdog:
    def test_it_trips_after_a_tenth_of_a_second_and_not_before(self) -> None:
        receiver = following(30)
        last = START + 29 * STEP
        receiver.at(last + 0.0999)
        assert receiver.tripped == ""
        receiver.at(last + 0.1001)
        assert receiver.tripped.startswith("no good set point for 0.100 s")

    def test_a_packet_that_comes_too_late_does_not_undo_it(self) -> None:
        """Nobody asked between: the packet itself finds the watchdog expired."""
        receiver = following(3)
        late = START + 2 * STEP + 0.15
        assert (
            receiver.take(packet(17), SENDER, late)
            == "stopped: no good set point for 0.150 s, allowed: 0.1 s; reset first"
        )

    def test_packets_that_all_come_late_trip_it_too(self) -> None:
        receiver = SetPointReceiver(WHEELS, STAGE)
        for k in range(20):
            delay = 0.009 * k
            receiver.take(packet(k), SENDER, START + k * STEP + LEAD + delay)
        assert receiver.tripped.startswith("set points late by 0.1")

    @pytest.mark.parametrize("seed", range(3))
    def test_the_stop_keeps_to_the_accelerations_and_ends_at_rest(self, seed: int) -> None:
        receiver = following(30 + seed)
        start = START + (29 + seed) * STEP + WATCHDOG_S + 1e-6
        first = receiver.at(start)
        assert first is not None
        before, dt = first, 1e-3
        for k in range(1, 400):
            now = receiver.at(start + k * dt)
            assert now is not None
            for v0, v, most in zip(before.wheel_speed, now.wheel_speed, WHEELS, strict=True):
                assert abs(v - v0) <= most * dt * (1 + 1e-6)
                assert abs(v) <= abs(v0)
            for p0, v0, p, v, most in zip(
                before.p_WS_W, before.v_WS_W, now.p_WS_W, now.v_WS_W, STAGE, strict=True
            ):
                assert abs(v - v0) <= most * dt * (1 + 1e-6)
                assert abs(v) <= abs(v0)
                assert p - p0 == pytest.approx(0.5 * (v0 + v) * dt, abs=most * dt * dt)
            before = now
        assert (
            before.wheel_speed
            == before.v_WS_W
            == before.wheel_acceleration
            == before.a_WS_W
            == (0.0, 0.0, 0.0)
        )
        expected = [
            p + v * abs(v) / (2 * a)
            for p, v, a in zip(first.p_WS_W, first.v_WS_W, STAGE, strict=True)
        ]
        assert before.p_WS_W == pytest.approx(expected, abs=1e-9)

    def test_it_is_latched_until_reset(self) -> None:
        receiver = following(3)
        receiver.at(START + 1.0)
        reason = receiver.tripped
        assert "reset first" in receiver.take(packet(100), SENDER, START + 1.0)
        receiver.at(START + 1.1)
        assert receiver.tripped == reason
        receiver.reset()
        assert receiver.tripped == ""
        assert receiver.at(START + 1.1) is None
        assert receiver.take(packet(111, session=9), ("127.0.0.1", 5), START + 1.11) == ""


class TestTheCommand:
    def test_it_tells_rate_lateness_and_the_trip_at_the_end(self) -> None:
        # a tenth of a second is sent, and up to three on a busy machine
        done = received(20, "--duration", "3.0")
        report = json.loads(done.stdout)
        assert done.returncode == 1, "the sender stops before the receiver does"
        assert "allowed: 0.1 s" in report["tripped"]
        assert report["good"] > 0
        assert report["rate_hz"] == round(report["good"] / 3.0, 2)
        assert (
            -1e3 * LEAD
            < report["lateness_p0_ms"]
            <= report["lateness_p50_ms"]
            <= report["lateness_p100_ms"]
        )

    def test_nothing_received_is_no_success(self) -> None:
        done = subprocess.run(
            [sys.executable, TOOL, "--port", "0", "--duration", "0.05"],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert done.returncode == 1
        assert "good               0" in done.stdout

    def test_an_empty_key_file_is_no_key(self, tmp_path: Path) -> None:
        """Or packets of anybody would be taken by somebody who asked for a key."""
        file = tmp_path / "key"
        file.write_bytes(b"\n")
        command = [sys.executable, TOOL, "--key-file", file]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        assert (done.returncode, done.stdout) == (2, "")
        assert done.stderr == f"error: {file}: holds no key\n"

    def test_bad_usage(self) -> None:
        done = subprocess.run(
            [sys.executable, TOOL, "--port", "70000"],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert (done.returncode, done.stdout) == (2, "")
        assert done.stderr.startswith("error: UDP 127.0.0.1:70000: cannot listen there")


def received(count: int, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The command, and `count` packets sent to it at about 200 Hz once it listens."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, TOOL, "--port", str(port), "--json", *arguments]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        sender, k, taken = SetPointSender("127.0.0.1", port), 0, 0
        while taken < count and k < 12_000:
            before = sender.unsent
            sender.send(k, k * 0.005, monotonic() + LEAD, 2, swinging(k * 0.005))
            sleep(0.005)
            # every other one is not taken while nobody listens
            k, taken = k + 1, taken + 1 if sender.unsent == before else 0
        sender.close()
        out, error = process.communicate(timeout=60.0)
    return subprocess.CompletedProcess(command, process.returncode, out, error)


def close(command: Command | None, true: Command, tolerance: float) -> bool:
    assert command is not None
    pairs = zip(numbers(command), numbers(true), strict=True)
    return all(abs(a - b) <= tolerance for a, b in pairs)


def numbers(c: Command) -> tuple[float, ...]:
    return (*c.wheel_speed, *c.wheel_acceleration, *c.p_WS_W, *c.v_WS_W, *c.a_WS_W)
