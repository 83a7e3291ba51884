"""The sender of FlightGear packets that stands for a simulator elsewhere."""

import socket
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from atlas_cueing.vehicles import Bounds
from atlas_cueing.vehicles.flightgear import decode

TOOL = Path(__file__).parents[1] / "tools" / "send_flightgear"


def command(*arguments: str) -> list[str]:
    return [sys.executable, str(TOOL), *arguments]


def told(arguments: Sequence[str], folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command(*arguments), cwd=folder, capture_output=True, text=True, timeout=60, check=False
    )


def test_a_script_is_sent_at_the_rate_asked_for(tmp_path: Path) -> None:
    """Two seconds at ten times real time.

    Nothing is left in the folder, although the aircraft has an output of its own.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as port:
        port.bind(("127.0.0.1", 0))
        port.settimeout(60.0)
        arguments = (
            "c1723",
            "--port",
            str(port.getsockname()[1]),
            "--duration",
            "2",
            "--speed",
            "10",
            "--rate",
            "30",
        )
        with subprocess.Popen(
            command(*arguments), cwd=tmp_path, stdout=subprocess.PIPE, text=True
        ) as sending:
            states = [decode(port.recv(2048), 0.0, Bounds()) for _ in range(60)]
            out, _ = sending.communicate(timeout=60.0)
    assert sending.returncode == 0
    assert out == "2.000 s flown\n"
    assert all(state.f_B[2] < -5.0 for state in states)
    assert len({state.q_NB for state in states}) > 50
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["c1724x"], "no script 'c1724x' in JSBSim; did you mean 'c1724'?"),
        (["c1723", "--port", "0"], "allowed: 0 < port < 65536"),
        (["c1723", "--duration", "nan"], "0 < duration <= 3600"),
        (["c1723", "--speed", "0"], "allowed: 0.01 <= speed <= 100"),
    ],
)
def test_what_cannot_be_sent_is_refused(arguments: list[str], message: str, tmp_path: Path) -> None:
    refused = told(arguments, tmp_path)
    assert refused.returncode == 2
    assert message in refused.stderr
    assert "Traceback" not in refused.stderr
