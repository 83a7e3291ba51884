"""Native FDM packets: JSBSim's own, and made-up ones against the layout."""

import json
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from math import cos, inf, nan, pi, radians
from pathlib import Path
from random import Random
from typing import IO, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles import Bounds
from atlas_cueing.vehicles.flightgear import PACKET_BYTES, PacketError, decode, normal_gravity

from .packets import LAYOUT, euler_rates, packet

FOOT, EARTH_RATE, G0 = 0.3048, 7.292115e-5, 9.80665
FLOAT = 2.0**-24  # relative rounding of a float


def read(content: bytes, time: float = 1.5) -> VehicleState:
    return decode(content, time, Bounds())


class Sender:
    """JSBSim in a process of its own, a step for a line."""

    def __init__(self, script: str) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.setblocking(False)
        port = self.socket.getsockname()[1]
        command = [
            sys.executable,
            str(Path(__file__).parent / "jsbsim" / "jsbsim_sender.py"),
            script,
            str(port),
        ]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def fly(self, steps: int) -> tuple[bytes, dict[str, Any]]:
        """The packet of the last of so many steps, and what JSBSim says of the same step."""
        into, out = self.process.stdin, self.process.stdout
        assert into is not None
        assert out is not None
        told = self._ask(into, out, steps)
        content = b""
        with suppress(BlockingIOError):
            while True:
                content = self.socket.recv(4096)
        return content, told

    @staticmethod
    def _ask(into: IO[str], out: IO[str], steps: int) -> dict[str, Any]:
        into.write(f"{steps}\n")
        into.flush()
        told: dict[str, Any] = json.loads(out.readline())
        return told

    def close(self) -> None:
        self.process.communicate(timeout=20.0)
        self.socket.close()


@pytest.fixture(params=["T37", "c172_cross_wind", "f16_test"])
def sender(request: pytest.FixtureRequest) -> Iterator[Sender]:
    """A jet that spins, an aircraft that stands, rolls and flies, and a fighter."""
    sending = Sender(request.param)
    yield sending
    sending.close()


def test_jsbsims_own_packets_say_what_its_properties_say(sender: Sender) -> None:
    """From another process, over loopback: attitude to 1e-6 rad, the rest to floats."""
    moved = 0.0
    for steps in [1] * 5 + [40] * 30:
        content, told = sender.fly(steps)
        assert len(content) == PACKET_BYTES
        state = read(content)
        north_from_body = Rotation.from_matrix(np.array(told["body_from_north"])).inv()
        mine = Rotation.from_quat(state.q_NB, scalar_first=True)
        assert (north_from_body.inv() * mine).magnitude() < 1e-6
        coarseness = 1e-6 / cos(told["theta"][0]) ** 2
        assert state.w_NB_B == pytest.approx(told["rates"], rel=coarseness, abs=coarseness)
        distance, latitude, gravitation = told["place"]
        gravity = gravitation - EARTH_RATE**2 * distance * cos(latitude) ** 2
        assert state.f_B == pytest.approx(
            np.array(told["force"]) * G0 / gravity, rel=1e-4, abs=1e-4
        )
        moved = max(moved, mine.magnitude())
    assert moved > 0.05  # it was not the start all the time


@given(st.integers(0, 2**32))
def test_rates_and_attitude_come_back(seed: int) -> None:
    """Any attitude but the vertical, any rate: the packet is made by the inverse formulas."""
    random = Random(seed)
    euler = (random.uniform(-pi, pi), random.uniform(-1.5, 1.5), random.uniform(0.0, 2.0 * pi))
    body = tuple(random.uniform(-5.0, 5.0) for _ in range(3))
    state = read(packet(euler=euler, euler_rates=euler_rates(euler, body), force=(1.0, 2.0, -30.0)))
    rounding = 200.0 * FLOAT / cos(euler[1]) ** 2
    assert state.w_NB_B == pytest.approx(body, abs=rounding)
    turned = Rotation.from_euler("ZYX", euler[::-1])
    assert (turned.inv() * Rotation.from_quat(state.q_NB, scalar_first=True)).magnitude() < 1e-6
    assert state.time == 1.5


@pytest.mark.parametrize("latitude", [-1.2, 0.0, 0.7, 0.5 * pi])
@pytest.mark.parametrize("altitude", [-400.0, 0.0, 3000.0, 12000.0])
def test_a_vehicle_at_rest_shows_standard_gravity_anywhere(
    latitude: float, altitude: float
) -> None:
    """Gravitation (with the Earth's oblateness, J2) and centrifugal force.

    By potential theory and not by the formula.
    """
    a, f, gm, j2 = 6378137.0, 1.0 / 298.257223563, 3.986004418e14, 1.082629821e-3
    e2 = f * (2.0 - f)
    n = a / np.sqrt(1.0 - e2 * np.sin(latitude) ** 2)
    x, z = (n + altitude) * np.cos(latitude), (n * (1.0 - e2) + altitude) * np.sin(latitude)
    r2 = x * x + z * z
    common, oblate = gm / r2**1.5, 1.5 * j2 * a * a / r2
    gx = common * x * (1.0 + oblate * (1.0 - 5.0 * z * z / r2)) - EARTH_RATE**2 * x
    gz = common * z * (1.0 + oblate * (3.0 - 5.0 * z * z / r2))
    gravity = float(np.hypot(gx, gz))
    # what J4 adds at the poles
    assert normal_gravity(latitude, altitude) == pytest.approx(gravity, abs=1.5e-4)
    state = read(packet(position=(0.1, latitude, altitude), force=(0.0, 0.0, -gravity / FOOT)))
    assert state.f_B == pytest.approx((0.0, 0.0, -G0), abs=3e-4)


def test_gravity_is_one_of_the_published_values() -> None:
    """TR8350.2, in m/s^2.

    9.7803253359 at the equator, 9.8321849378 at the poles, 9.7976432222 on average.
    """
    assert normal_gravity(0.0, 0.0) == pytest.approx(9.7803253359, abs=1e-10)
    assert normal_gravity(0.5 * pi, 0.0) == pytest.approx(9.8321849378, abs=1e-9)
    sines = (np.arange(2000) + 0.5) / 1000.0 - 1.0
    area = (1.0 - 0.00669437999 * sines**2) ** -2.0  # of the ellipsoid between two latitudes
    mean = np.average([normal_gravity(np.arcsin(s), 0.0) for s in sines], weights=area)
    assert mean == pytest.approx(9.7976432222, abs=1e-6)
    assert 0.0 < normal_gravity(0.3, 3.6e7) < 0.3  # no series that turns upwards


@pytest.mark.parametrize("name", ["euler", "euler_rates", "force", "position"])
@pytest.mark.parametrize("bad", [nan, inf, -inf, 1e30])
@pytest.mark.parametrize("index", [0, 1, 2])
def test_what_is_not_finite_or_absurd_is_refused(name: str, bad: float, index: int) -> None:
    usual = {
        "euler": [0.1, 0.2, 0.3],
        "euler_rates": [0.1, 0.1, 0.1],
        "force": [0.0, 0.0, -32.0],
        "position": [0.1, 0.2, 300.0],
    }
    read(packet(**{name: usual[name]}))
    if (name, index, bad) == ("position", 0, 1e30):
        return  # any longitude will do, since nothing depends on it
    usual[name][index] = bad
    with pytest.raises(PacketError):
        read(packet(**{name: usual[name]}))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (packet(euler=(0.0, 1.58, 0.0)), "pitch 1.58"),
        (packet(euler=(7.0, 0.0, 0.0)), "roll 7"),
        (packet(euler_rates=(60.0, 0.0, 0.0)), "body rate 60 rad/s, allowed: 0 <= rate <= 50"),
        (packet(force=(0.0, 0.0, -2000.0)), "specific force 609.8 m/s\\^2, allowed"),
        (packet(height=-50.0), "height above ground -50 m"),
        (packet(height=nan), "height above ground nan m"),
        (packet(position=(0.0, 0.0, -6.3e6)), "nowhere"),
        (packet(version=25), r"version 25 of the native FDM packet \(\d+ bytes\), allowed: 24"),
        (packet(version=25) + bytes(552 - 408), "version 25 .* \\(552 bytes\\)"),
        (packet(version=0), "version 0"),
        (packet(version=24 << 24), "swapped bytes: version 24"),  # the other byte order
        (packet()[:-1], "407 bytes, allowed: 408"),
        (packet() + b"\0", "409 bytes, allowed: 408"),
        (b"", "0 bytes, allowed: 408"),
        (b"\0\0", "2 bytes"),
        (packet()[:4], "4 bytes"),
    ],
)
def test_each_refusal_says_why(content: bytes, message: str) -> None:
    with pytest.raises(PacketError, match=message):
        read(content)


@given(st.binary(max_size=600))
def test_nonsense_is_refused(content: bytes) -> None:
    with pytest.raises(PacketError):
        read(content)


@given(st.binary(min_size=404, max_size=404))
def test_nonsense_of_the_right_kind_is_refused_or_believable(content: bytes) -> None:
    """Whatever comes out is inside the bounds."""
    try:
        state = read(b"\0\0\0\x18" + content)
    except PacketError:
        return
    assert Bounds().objection(state, 0.0) == ""
    assert sum(c * c for c in state.q_NB) == pytest.approx(1.0)


def test_what_is_not_read_does_not_matter() -> None:
    assert LAYOUT.count("f") == 9
    assert read(packet(other=nan)) == read(packet(other=3.0))


def test_heading_may_be_of_either_sign() -> None:
    one, other = (read(packet(euler=(0.1, 0.2, radians(psi)))) for psi in (-90.0, 270.0))
    assert abs(sum(a * b for a, b in zip(one.q_NB, other.q_NB, strict=True))) == pytest.approx(1.0)
