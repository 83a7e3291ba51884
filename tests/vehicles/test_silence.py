"""What a flight leaves behind outside the process: nothing."""

import os
import subprocess
import sys
from pathlib import Path

from atlas_cueing.vehicles import JsbsimVehicle, ScriptFlight, own_scripts

from .flying import event, write_script

FLY = """
import sys
from pathlib import Path
from atlas_cueing.errors import AtlasError
from atlas_cueing.vehicles import JsbsimVehicle, LimitedDuration, ScriptFlight
for argument in sys.argv[2:]:
    try:
        vehicle = LimitedDuration(JsbsimVehicle(ScriptFlight(Path(argument))), float(sys.argv[1]))
        while vehicle.advance():
            pass
    except AtlasError:
        pass
"""


def fly_elsewhere(
    folder: Path, duration: float, scripts: list[Path]
) -> subprocess.CompletedProcess[bytes]:
    """Fly scripts in a process of its own that works in `folder`.

    Its temporary files lie in `folder`/temporary.
    """
    (folder / "temporary").mkdir()
    command = [sys.executable, "-W", "error", "-c", FLY, str(duration), *map(str, scripts)]
    environment = {**os.environ, "TMPDIR": str(folder / "temporary")}
    return subprocess.run(command, cwd=folder, capture_output=True, env=environment, timeout=300.0)


def left_in(folder: Path) -> list[str]:
    return sorted(
        str(path.relative_to(folder)) for path in folder.rglob("*") if path.name != "temporary"
    )


def test_no_own_script_prints_or_leaves_a_file(tmp_path: Path) -> None:
    done = fly_elsewhere(tmp_path, 1.0, list(own_scripts().values()))
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
    assert left_in(tmp_path) == []


def test_what_would_print_or_write_later_is_silent_too(tmp_path: Path) -> None:
    # notifications, trims in mid-run, a linearisation (which writes 737_lin.sce), outputs switched
    # on and off
    names = [
        "c172_elevator_doublet",
        "737_cruise_steady_turn_linearize",
        "c1723",
        "Test_F450_Launch",
    ]
    done = fly_elsewhere(tmp_path, 22.0, [own_scripts()[name] for name in names])
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
    assert left_in(tmp_path) == []


def test_a_users_script_cannot_write_files_either(tmp_path: Path) -> None:
    work = tmp_path / "work"
    work.mkdir()
    outputs = (
        f'<output name="{tmp_path}/escaped.csv" type="CSV" rate="10"><rates>ON</rates></output>'
        '<output name="here.csv" type="CSV" rate="10"><rates>ON</rates></output>'
        '<output type="TERMINAL" rate="10"><rates>ON</rates></output>'
    )
    events = event("simulation/write-state-file", "1", 0.3) + event(
        "simulation/do_linearization", "0", 0.6
    )
    script = write_script(tmp_path / "s.xml", events, outputs)
    done = fly_elsewhere(work, 2.0, [script])
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
    assert left_in(tmp_path) == ["s.xml", "work"]


def test_errors_that_jsbsim_reports_are_silent_too(tmp_path: Path) -> None:
    # with the stick held back there is nothing to trim, and JSBSim says so at length
    events = event("fcs/elevator-cmd-norm", "-1", 0.1) + event(
        "simulation/do_simple_trim", "1", 0.3
    )
    script = write_script(tmp_path / "s.xml", events)
    done = fly_elsewhere(tmp_path, 2.0, [script])
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


def sockets() -> int:
    """Sockets that this process has open."""
    links = [f"/proc/self/fd/{fd}" for fd in os.listdir("/proc/self/fd")]
    return sum(os.readlink(link).startswith("socket:") for link in links if os.path.islink(link))


def test_no_socket_is_opened(tmp_path: Path) -> None:
    ports = (
        '<output name="127.0.0.1" type="SOCKET" protocol="UDP" port="45997"'
        ' rate="10"><rates>ON</rates></output><output name="127.0.0.1" type="FLIGHTGEAR"'
        ' protocol="UDP" port="45996" rate="10"/><input port="45998"/>'
    )
    before = sockets()
    users = JsbsimVehicle(ScriptFlight(write_script(tmp_path / "s.xml", "", ports)))
    own = JsbsimVehicle(ScriptFlight(own_scripts()["737_cruise"]))  # its model listens on two ports
    assert users.advance()
    assert own.advance()
    assert sockets() == before
