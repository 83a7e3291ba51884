"""Two rides that would drive one platform: the second is told, and the first is not disturbed."""

import os
import re
import signal
from pathlib import Path

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.live import pose_lock
from atlas_cueing.live.pose_lock import locked_pose


def child_with(file: Path, end: str) -> tuple[int, int]:
    """A process that has the lock, and keeps it until `end`; its id, and a pipe to it."""
    read, write = os.pipe()
    here, there = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(write)
        with locked_pose(file):
            os.write(there, b"1")
            os.read(read, 1)
            if end == "killed":
                os.kill(os.getpid(), signal.SIGKILL)
        os._exit(0)
    os.close(read)
    assert os.read(here, 1) == b"1"
    for number in (here, there):
        os.close(number)
    return child, write


@pytest.mark.parametrize("end", ["clean", "killed"])
def test_a_second_ride_is_refused_and_told_whose_it_is(
    tmp_path: Path, end: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By another name of the file, too; after the first one's end, however it ended, it may."""
    monkeypatch.setattr(pose_lock, "PATIENCE_S", 0.1)
    (tmp_path / "state").mkdir()
    (tmp_path / "link.json").symlink_to("state/pose.json")
    child, write = child_with(tmp_path / "state" / "pose.json", end)
    told = re.escape(f"another ride has it, that of process {child};")
    for name in ("state/pose.json", "state/../state/pose.json", "link.json"):
        with pytest.raises(InputError, match=told), locked_pose(tmp_path / name):
            pytest.fail("two rides")
    with locked_pose(tmp_path / "state" / "another.json"):
        pass
    os.close(write)
    os.waitpid(child, 0)
    with locked_pose(tmp_path / "link.json"):
        assert (tmp_path / "state" / "pose.json.lock").read_text() == f"{os.getpid()}\n"
    assert not list((tmp_path / "state").iterdir())


def test_a_copy_of_the_descriptor_does_not_keep_it(tmp_path: Path) -> None:
    """As of a helper that hangs when the ride has ended."""
    with locked_pose(tmp_path / "pose.json"):
        read, write = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(write)
            os.read(read, 1)
            os._exit(0)
    with locked_pose(tmp_path / "pose.json"):
        pass
    os.close(write)
    os.waitpid(child, 0)
    os.close(read)


def test_a_refusal_leaves_no_folder(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), locked_pose(tmp_path / "a" / "b" / "pose.json"):
        raise ZeroDivisionError
    assert not list(tmp_path.iterdir())


def test_a_place_that_cannot_be_used(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    message = r"pose .*pose.json: cannot be locked: .*file: File exists"
    with (
        pytest.raises(InputError, match=message),
        locked_pose(tmp_path / "file" / "pose.json"),
    ):
        pytest.fail("no lock")
