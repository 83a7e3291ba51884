"""Without any network interface everything is the same, and no socket is open.

The kernel's own list is empty.
"""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import SCRIPT, Command

ALONE = ["unshare", "--user", "--map-root-user", "--net"]
# The lists are read while the vehicle flies; in a namespace of its own they hold the sockets of
# this process and no other.
FLY = """
import sys
from pathlib import Path
from atlas_cueing.run import fly as run
from atlas_cueing.cli import main
fly, seen = run._fly, []
def flying(*arguments):
    outcome = fly(*arguments)
    seen.append([line for kind in ("tcp", "tcp6", "udp", "udp6", "raw")
                 for line in Path("/proc/self/net", kind).read_text().splitlines()[1:]])
    return outcome
run._fly = flying
script = "vehicle.script=" + sys.argv[2]
status = main(["run", "s.toml", "-o", sys.argv[1], "--trust-models", "--set", script])
lines = Path("/proc/self/net/dev").read_text().splitlines()[2:]
interfaces = [line.split(":")[0].strip() for line in lines]
print(status, interfaces, seen, file=sys.stderr)
"""
USERS = """<runscript>
  <use aircraft="737" initialize="cruise_init"/>
  <output name="127.0.0.1" type="SOCKET" protocol="UDP" port="45997" rate="10">
    <rates>ON</rates>
  </output>
  <input port="45998"/>
  <run start="0.0" end="0.4" dt="0.01"/>
</runscript>
"""


def permitted() -> bool:
    return (
        bool(shutil.which(ALONE[0]))
        and subprocess.run([*ALONE, "true"], capture_output=True, timeout=60.0).returncode == 0
    )


@pytest.mark.skipif(not permitted(), reason="needs unshare and leave to make a network namespace")
@pytest.mark.parametrize(
    "script", ["c1722", "737_cruise", "mine.xml"], ids=["quiet", "listens", "sends and listens"]
)
def test_without_a_network_a_run_is_the_same_byte_for_byte(
    command: Command, tmp_path: Path, script: str
) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT)
    (tmp_path / "mine.xml").write_text(USERS)
    assert (
        command(
            "run",
            "s.toml",
            "-o",
            "open.mcap",
            "--trust-models",
            "--set",
            f"vehicle.script={script}",
        ).status
        == 0
    )
    done = subprocess.run(
        [*ALONE, sys.executable, "-c", FLY, "alone.mcap", script],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300.0,
    )
    assert done.stderr == "0 ['lo'] [[]]\n"
    assert (tmp_path / "alone.mcap").read_bytes() == (tmp_path / "open.mcap").read_bytes()
