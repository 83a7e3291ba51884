"""The reference receiver: what it follows and refuses, when it stops, and its command."""

import json
import socket
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from time import monotonic_ns, sleep

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import InputError
from atlas_cueing.live.control.command import Command, axes_of, command_from
from atlas_cueing.live.control.trajectories import smoothstep
from atlas_cueing.live.output.receiver import SetPointReceiver
from atlas_cueing.live.output.setpoint import SIZE, encode
from atlas_cueing.live.output.setpoint_sender import SetPointSender

from ..commands import REST
from ..control.guard_states import STAGE, WHEELS, limits

SENDER = ("127.0.0.1", 4001)
STEP = 10_000_000  # ns
DUE = 18_000_000  # ns from a packet's sending until it is due
START = 10**12  # ns on the clock when the run began
TURN = 2.0  # s that the motion takes
LEAD = 0.008
TOOL = Path(__file__).parents[3] / "tools" / "receive_setpoints"


def moving(k: int) -> Command:
    """From rest by 6 rad of each wheel and 0.3 m of each axis, at tick k."""
    s, ds, dds = smoothstep(k * STEP * 1e-9 / TURN)
    ways = [6.0, -6.0, 3.0, 0.3, -0.3, 0.2]
    axes = [(way * s, way * ds / TURN, way * dds / TURN**2) for way in ways]
    return command_from(k * STEP * 1e-9, axes)


def packet(k: int, session: int = 7, key: bytes = b"", command: Command | None = None) -> bytes:
    """The one of tick k, sent at START + k STEP."""
    due = START + k * STEP + DUE
    return encode(session, k, k * STEP * 1e-9, due, 2, command or moving(k), key)


def following(ticks: int, key: bytes = b"") -> SetPointReceiver:
    """A receiver that took `ticks` packets, each when it was sent."""
    receiver = SetPointReceiver(WHEELS, STAGE, key)
    for k in range(ticks):
        assert receiver.take(packet(k, key=key), SENDER, START + k * STEP) == ""
    return receiver


def near(command: Command | None, true: Command, tolerance: float) -> bool:
    assert command is not None
    return bool(np.max(np.abs(np.subtract(axes_of(command), axes_of(true)))) <= tolerance)


class TestFollowing:
    def test_there_is_nothing_to_do_before_the_first_packet(self) -> None:
        receiver = SetPointReceiver(WHEELS, STAGE)
        assert receiver.at(START) is None
        assert receiver.report(START).state == "waiting"
        assert (receiver.tripped, receiver.newest) == ("", None)

    def test_at_a_set_points_own_time_it_is_that_set_point(self) -> None:
        receiver = following(9)
        for k in range(9):
            assert near(receiver.at(START + k * STEP + DUE), moving(k), 1e-9)

    def test_between_two_the_jerk_keeps_its_limit_and_all_is_one_motion(self) -> None:
        receiver, h = following(200), 1e-4
        times = range(START + DUE, START + DUE + 198 * STEP, 100_000)
        x = np.array([axes_of(command) for t in times if (command := receiver.at(t))])
        jerk = np.diff(x[:, :, 2], axis=0) / h
        assert np.all(np.abs(jerk) <= np.array([limits(k)[2] for k in range(6)]) * (1.0 + 1e-5))
        for order in (0, 1):
            mean = 0.5 * (x[1:, :, order + 1] + x[:-1, :, order + 1])
            # the trapezoid's own error: jerk h, and h^2 of it
            assert np.max(np.abs(np.diff(x[:, :, order], axis=0) / h - mean)) < 200.0 * h ** (
                2 - order
            )

    @pytest.mark.parametrize("lost", [1, 2, 5])
    def test_lost_packets_are_a_longer_way_to_the_next(self, lost: int) -> None:
        receiver = following(50)
        assert receiver.take(packet(50 + lost), SENDER, START + 50 * STEP) == ""
        assert near(receiver.at(START + (50 + lost) * STEP + DUE), moving(50 + lost), 1e-9)
        assert receiver.report(START + (50 + lost) * STEP + DUE).state == "following"


class TestRefusing:
    def test_a_packet_sent_again_or_out_of_order(self) -> None:
        receiver, now = following(3), START + 3 * STEP
        for k in (2, 0):
            told = f"packet {k} comes after 2: out of order or sent again"
            assert receiver.take(packet(k), SENDER, now) == told
        assert receiver.take(packet(4), SENDER, now) == ""
        assert "comes after 4" in receiver.take(packet(3), SENDER, now)
        assert (receiver.good, receiver.refused) == (4, 3)

    def test_another_sender_or_session_than_the_first_good_one(self) -> None:
        receiver, other = following(1), ("127.0.0.1", 9)
        assert "from another sender, 127.0.0.1:9," in receiver.take(packet(1), other, START)
        assert "from another sender" in receiver.take(packet(1, session=8), SENDER, START)
        assert receiver.take(packet(1), SENDER, START) == ""

    def test_a_time_that_cannot_be(self) -> None:
        receiver = SetPointReceiver(WHEELS, STAGE)
        told = "packet 0 is due 0.218 s ahead, allowed: 0.1 s"
        assert receiver.take(packet(0), SENDER, START - 200_000_000) == told
        assert receiver.take(packet(0), SENDER, START) == ""
        same = encode(7, 1, 0.0, START + DUE, 2, REST)
        assert receiver.take(same, SENDER, START) == "packet 1 is not due later than the one before"

    def test_a_first_one_that_moves_or_is_elsewhere(self) -> None:
        receiver = SetPointReceiver(WHEELS, STAGE)
        for wrong in (moving(20), replace(REST, p_WS_W=(0.0, 1e-3, 0.0))):
            told = receiver.take(packet(20, command=wrong), SENDER, START + 20 * STEP)
            assert told == "packet 20 is the first and does not stand where the drives do"
        receiver.reset((0.0, 1e-3, 0.0))
        assert receiver.take(packet(20, command=wrong), SENDER, START + 20 * STEP) == ""

    @pytest.mark.parametrize("field", ["p_WS_W", "wheel_angle", "wheel_speed", "v_WS_W"])
    @pytest.mark.parametrize("by", [5.0, 0.01])
    def test_a_jump(self, field: str, by: float) -> None:
        receiver, good = following(60), moving(60)
        x, y, z = getattr(good, field)
        jumped = packet(60, command=replace(good, **{field: (x, y + by * 10.0, z)}))
        assert "packet 60 cannot be reached: " in receiver.take(jumped, SENDER, START + 60 * STEP)
        assert receiver.take(packet(60), SENDER, START + 60 * STEP) == ""

    def test_a_key_cannot_be_avoided(self) -> None:
        receiver, now = following(3, bytes(16)), START + 3 * STEP
        assert "as the receiver has a key" in receiver.take(packet(3), SENDER, now)
        assert "wrong check" in receiver.take(packet(3, key=bytes(range(16))), SENDER, now)
        with pytest.raises(InputError, match="shared key of 3 bytes"):
            SetPointReceiver(WHEELS, STAGE, b"abc")

    @given(st.lists(st.binary(max_size=SIZE + 8), max_size=20))
    def test_rubbish_changes_nothing(self, rubbish: list[bytes]) -> None:
        receiver, calm = following(60), following(60)
        now = START + 60 * STEP
        assert all(receiver.take(data, SENDER, now) for data in rubbish)
        assert receiver.at(now + STEP) == calm.at(now + STEP)


class TestTheStop:
    def test_it_begins_at_once_and_is_the_guards(self) -> None:
        receiver, due = following(100), START + 99 * STEP + DUE
        receiver.at(due)
        assert receiver.tripped == ""
        receiver.at(due + 1)
        assert receiver.tripped == "no successor of set point 99 when that was due"
        assert receiver.report(due + 1).state == "stopping"
        ended = receiver.at(due + 10**9)
        assert ended is not None
        assert not any(v or a for _, v, a in axes_of(ended))

    def test_a_set_point_on_it_is_followed_however_late_and_leads_on(self) -> None:
        receiver, due = following(100), START + 99 * STEP + DUE
        twin = following(100)
        for k in range(100, 155):
            on_it = twin.at(due + (k - 99) * STEP)
            told = receiver.take(packet(k, command=on_it), SENDER, due + 500_000_000 + k)
            assert told == "", (k, told)
        assert receiver.report(due + 10**9).state == "following"

    @pytest.mark.parametrize("late_ms", [1, 3, 5])
    def test_one_that_can_still_be_reached_is_rejoined(self, late_ms: int) -> None:
        receiver = following(100)
        now = START + 99 * STEP + DUE + late_ms * 10**6
        assert receiver.take(packet(104), SENDER, now) == ""
        assert receiver.report(START + 104 * STEP + DUE).state == "following"
        assert near(receiver.at(START + 104 * STEP + DUE), moving(104), 1e-9)

    def test_after_20_ms_it_latches_until_reset(self) -> None:
        receiver = following(100)
        now = START + 99 * STEP + DUE + 21_000_000
        assert "is not on its way to rest" in receiver.take(packet(104), SENDER, now)
        assert "reset first" in receiver.take(packet(105), SENDER, now)
        assert receiver.report(now).state == "latched"
        receiver.reset()
        assert (receiver.tripped, receiver.at(now)) == ("", None)
        assert receiver.take(packet(0, session=9), ("127.0.0.1", 5), now) == ""

    def test_one_that_stands_needs_no_successor(self) -> None:
        receiver = following(1)
        receiver.at(START + 10**10)
        assert receiver.tripped == ""
        late = encode(7, 2, 0.0, START + 10**9, 0, REST)
        assert receiver.take(late, SENDER, START + 10**10) == ""

    def test_the_least_margin_is_reported(self) -> None:
        receiver = following(3)
        assert receiver.report(START + 3 * STEP).margin == pytest.approx(0.018)
        receiver.take(packet(3), SENDER, START + 3 * STEP + 5_000_000)
        assert receiver.report(START + 4 * STEP).margin == pytest.approx(0.013)


class TestLostPackets:
    """As many in a row as README says, for a transport of a millisecond; and not one more."""

    @pytest.mark.parametrize(
        ("rate", "lead_ms", "lost"),
        [
            *((100, 8, 0), (250, 8, 1), (500, 8, 3), (1000, 8, 7)),
            *((100, 22, 2), (250, 22, 5), (500, 22, 10), (1000, 22, 21)),
            *((100, 80, 7), (250, 80, 19), (500, 80, 39), (1000, 80, 79)),
        ],
    )
    def test_so_many_are_survived(self, rate: int, lead_ms: int, lost: int) -> None:
        assert self.stops(rate, lead_ms, lost) is False
        assert self.stops(rate, lead_ms, lost + 1) is True

    def stops(self, rate: int, lead_ms: int, lost: int) -> bool:
        """Whether the drives begin to stop by themselves when so many in a row do not come."""
        receiver, slot, gap = SetPointReceiver(WHEELS, STAGE), 10**9 // rate, rate // 2
        for k in [*range(gap), gap + lost]:
            sent = START + k * slot
            arrived, due = sent + 1_000_000, sent + slot + lead_ms * 1_000_000
            receiver.at(arrived - 1)
            if receiver.state[0] == "stopping":
                return True
            at = moving(k * slot / STEP)  # type: ignore[arg-type]
            refused = receiver.take(encode(7, k, 1e-9 * k * slot, due, 2, at), SENDER, arrived)
            assert refused == "", (k, refused)
        return False


class TestTheCommand:
    def test_it_tells_rate_and_lateness(self) -> None:
        # a tenth of a second is sent, and up to three on a busy machine
        done = received(20, "--duration", "3.0")
        report = json.loads(done.stdout)
        assert done.returncode == 0, report
        assert report["tripped"] == ""
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
            sender.send(k, k * 0.005, monotonic_ns() + round(1e9 * LEAD), 0, REST)
            sleep(0.005)
            # every other one is not taken while nobody listens
            k, taken = k + 1, taken + 1 if sender.unsent == before else 0
        sender.close()
        out, error = process.communicate(timeout=60.0)
    return subprocess.CompletedProcess(command, process.returncode, out, error)
