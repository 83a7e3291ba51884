"""The key of a sender of set points, the helpers of a ride, and the lock of its pose."""

import os
import signal
import tracemalloc
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
from waiting import until

from atlas_cueing.cli.live_extras import DriveLink, Pages, followers, standing
from atlas_cueing.cli.live_extras import drives as drives_of
from atlas_cueing.errors import InputError
from atlas_cueing.live import pose_lock
from atlas_cueing.live.input.shared_key import LARGEST_KEY
from atlas_cueing.scenario import load_scenario
from atlas_cueing.telemetry import HelperWatch, OperatorButtons, Ring, child_process, live_ring

HERE = "127.0.0.1:5600"
SCENARIO = Path(__file__).parents[2] / "scenarios/signal_sway.toml"


def drives(address: str, key: Path) -> AbstractContextManager[Any]:
    return drives_of(DriveLink(address, key), load_scenario(SCENARIO))


def test_a_file_of_the_largest_size_will_do(tmp_path: Path) -> None:
    """What is around the key does not count."""
    (tmp_path / "key").write_bytes(b"k" * 32 + b"\n" * (LARGEST_KEY - 32))
    with drives(HERE, tmp_path / "key") as (senders, _):
        assert len(senders) == 1


@pytest.mark.parametrize("size", [LARGEST_KEY + 1, 256 * 2**20])
def test_a_key_that_is_too_large_is_not_read(size: int, tmp_path: Path) -> None:
    with (tmp_path / "key").open("wb") as file:
        file.truncate(size)
    tracemalloc.start()
    try:
        with (
            pytest.raises(InputError, match=r"--key .*key: too large, allowed: size <= 4096 bytes"),
            drives(HERE, tmp_path / "key"),
        ):
            pytest.fail("nobody is to be driven")
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()


def test_a_key_that_never_ends(tmp_path: Path) -> None:
    """Whoever writes it into the pipe is cut off: of 64 MB, only what a pipe holds was taken."""
    os.mkfifo(tmp_path / "key")
    written = []

    def write() -> None:
        with (tmp_path / "key").open("wb", buffering=0) as pipe:
            try:
                written.extend(pipe.write(bytes(65536)) for _ in range(1024))
            except BrokenPipeError:
                written.append(0)

    writer = Thread(target=write, daemon=True)
    writer.start()
    with pytest.raises(InputError, match="too large"), drives(HERE, tmp_path / "key"):
        pytest.fail("nobody is to be driven")
    writer.join(timeout=60.0)
    assert written[-1] == 0
    assert sum(written) < 2**20


@pytest.mark.parametrize(("content", "message"), [(b"", "holds no key"), (b" \n", "holds no key")])
def test_no_key(content: bytes, message: str, tmp_path: Path) -> None:
    (tmp_path / "key").write_bytes(content)
    with pytest.raises(InputError, match=message), drives(HERE, tmp_path / "key"):
        pytest.fail("nobody is to be driven")


@dataclass
class Session:
    """What the helpers need of one."""

    ring: Ring = field(default_factory=lambda: live_ring(1.0, 100.0))
    buttons: OperatorButtons = field(default_factory=OperatorButtons)
    helpers: HelperWatch = field(default_factory=HelperWatch)
    started_ns: int = 0
    corrects: bool = False

    def lost(self, found: list[tuple[str, bool]]) -> bool:
        found += self.helpers.losses()
        return bool(found)


def children() -> set[int]:
    """Process ids of what this process has forked."""
    task = Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children")
    return {int(pid) for pid in task.read_text().split()}


@pytest.mark.parametrize(
    ("pages", "text", "parks"),
    [
        (Pages(view=0), "the view has died, or answers no more", True),
        (Pages(foxglove=0), "the server for Foxglove has died, or answers no more", False),
        (Pages(), "the operator's desk has died, or answers no more", False),
    ],
)
@pytest.mark.parametrize("number", [signal.SIGSTOP, signal.SIGKILL])
def test_a_helper_that_hangs_is_told_as_a_dead_one(
    pages: Pages,
    text: str,
    parks: bool,
    number: signal.Signals,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setattr(child_process, "HANGS_S", 2.0)
    session, before, found = Session(), children(), []  # type: ignore[var-annotated]
    with followers(session, load_scenario(SCENARIO), pages, tell=False) as lines:  # type: ignore[arg-type]
        assert len(lines) == 1 + (pages != Pages())
        newest = max(children() - before)
        os.kill(newest, number)
        until(lambda: session.lost(found))
        os.kill(newest, signal.SIGCONT)
    assert [(told.startswith(text), asked) for told, asked in found] == [(True, parks)]


def test_a_pose_that_another_ride_has(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pose_lock, "PATIENCE_S", 0.1)
    link = DriveLink(HERE, pose=tmp_path / "pose.json", stated="home")
    scenario = load_scenario(SCENARIO)
    with (
        standing(link, scenario),
        pytest.raises(InputError, match="another ride has it"),
        standing(link, scenario),
    ):
        pytest.fail("two rides")
    with standing(link, scenario) as (pose, file):
        assert (pose.is_home, file) == (True, link.pose)
