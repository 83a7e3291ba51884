"""Hands one bad input to the command, in a folder of its own, and judges what comes of it.

Status, message, time, memory.
"""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Timer
from typing import TypeAlias

# What takes more memory than is good for anybody ends here, and not with the machine; files that
# are mapped do not count.
_BOUNDED = "import resource; resource.setrlimit(resource.RLIMIT_DATA, (4 << 30, 4 << 30))"
_MAIN = "import sys; from atlas_cueing.cli import main; sys.exit(main())"
COMMAND = (sys.executable, "-W", "error", "-c", f"{_BOUNDED}; {_MAIN}")
# A process counts the memory of the one it was started by as its own largest: it is started by a
# small one, which tells.
_STARTER = """
import os, sys
child = os.fork()
if child == 0:
    os.execvp(sys.argv[2], sys.argv[2:])
_, ended, usage = os.wait4(child, 0)
with open(sys.argv[1], "w") as told:
    cpu, memory = usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0
    print(os.waitstatus_to_exitcode(ended), cpu, memory, file=told)
"""
PATIENCE = 300.0  # s of wall time, after which a command hangs
BAD_USAGE = 2  # exit status of what was refused, with nothing written
DISK = "disk"  # folder of inputs that need one of their own
_KEPT = "kept"  # what the command left on it
# whose mounts nobody else sees, and which end with the command
_DISKS = ("unshare", "--user", "--map-root-user", "--mount")


@dataclass(frozen=True)
class Pipe:
    """A FIFO that nobody writes to."""


@dataclass(frozen=True)
class Link:
    """A symbolic link."""

    target: str


@dataclass(frozen=True)
class Hole:
    """A sparse file of so many bytes, beginning with `head`: it takes no room on the disk."""

    size: int
    head: bytes = b""


@dataclass(frozen=True)
class Folder:
    """A folder with nothing in it."""


@dataclass(frozen=True)
class Good:
    """A log that has nothing wrong with it."""


@dataclass(frozen=True)
class Same:
    """A hard link to a file that comes before it."""

    file: str


Content: TypeAlias = str | bytes | Pipe | Link | Same | Hole | Folder | Good


@dataclass(frozen=True)
class Limits:
    """Of a command: CPU time above that of its start, s, and memory, MB."""

    seconds: float = 2.0
    megabytes: float = 200.0


FILES, LOGS = Limits(), Limits(5.0, 512.0)


@dataclass(frozen=True)
class BadInput:
    """What is handed in, and the exit status that it ought to have.

    files: by name, in the folder in which the command runs; there is always a scenario `good.toml`,
        too.
    says: part of the message. disk: options of mount for a tmpfs at `disk/`, or nothing.
    """

    name: str
    arguments: tuple[str, ...]
    files: Mapping[str, Content] = field(default_factory=dict)
    status: int = BAD_USAGE
    says: str = ""
    limits: Limits = FILES
    disk: str = ""


@dataclass(frozen=True)
class Ended:
    """What came of it. seconds: of CPU above those of the command's start.

    Written: names that are there now and were not.
    """

    status: int
    seconds: float
    megabytes: float
    message: str
    written: tuple[str, ...]

    @property
    def first(self) -> str:
        """First line of the message."""
        return self.message.partition("\n")[0]


def objections(bad: BadInput, ended: Ended) -> list[str]:
    """What is wrong with how the command ended; nothing if it ended as it ought to."""
    wrong = {
        f"status {ended.status}, not {bad.status}": ended.status != bad.status,
        "traceback": "Traceback" in ended.message or "This is a bug" in ended.message,
        "no message": ended.status != 0 and not ended.first,
        f"does not say {bad.says!r}": bad.says not in ended.message,
        f"{ended.seconds:.1f} s, at most {bad.limits.seconds:g}": (
            ended.seconds > bad.limits.seconds
        ),
        f"{ended.megabytes:.0f} MB, at most {bad.limits.megabytes:g}": (
            ended.megabytes > bad.limits.megabytes
        ),
        f"wrote {', '.join(ended.written)}": bad.status == BAD_USAGE and bool(ended.written),
    }
    return [objection for objection, holds in wrong.items() if holds]


def missing(bad: BadInput) -> str:
    """What this machine lacks for an input; nothing when it can be tried."""
    return "leave to mount a tmpfs (unshare)" if bad.disk and not _can_mount() else ""


@cache
def _can_mount() -> bool:
    mount = [*_DISKS, "mount", "-t", "tmpfs", "none", "/mnt"]
    return (
        bool(shutil.which(_DISKS[0]))
        and subprocess.run(mount, capture_output=True, timeout=PATIENCE).returncode == 0
    )


def attempt(bad: BadInput, scenario: str, log: bytes) -> Ended:
    """Hand it to the command. scenario, log: a good one of each."""
    with TemporaryDirectory(prefix="bad_input_") as name:
        folder = Path(name)
        prepare(bad, folder, scenario, log)
        before = _names(folder)
        status, seconds, megabytes, message = _run(_words(bad), folder)
        return Ended(
            status,
            seconds - _start_up(bad.arguments[:1]),
            megabytes,
            message,
            tuple(sorted(_names(folder) - before - {DISK, _KEPT})),
        )


def prepare(bad: BadInput, folder: Path, scenario: str, log: bytes) -> None:
    """Put its files into the folder in which the command is to run."""
    (folder / "good.toml").write_text(scenario)
    for file, content in bad.files.items():
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        _make(folder / file, content, log)


def good_log(scenario: str) -> bytes:
    """The log of a scenario that has nothing wrong with it."""
    with TemporaryDirectory() as name:
        (Path(name) / "good.toml").write_text(scenario)
        status, _, _, message = _run([*COMMAND, "run", "good.toml", "-o", "good.mcap"], Path(name))
        if status:
            raise RuntimeError(f"the good scenario is not good: {message}")
        return (Path(name) / "good.mcap").read_bytes()


def _names(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def _make(path: Path, content: Content, log: bytes) -> None:
    match content:
        case Pipe():
            os.mkfifo(path)
        case Link():
            path.symlink_to(content.target)
        case Same():
            path.hardlink_to(path.with_name(content.file))
        case Folder():
            path.mkdir()
        case Hole():
            with path.open("wb") as file:
                file.write(content.head)
                file.truncate(content.size)
        case Good():
            path.write_bytes(log)
        case str():
            path.write_text(content)
        case bytes():
            path.write_bytes(content)


def _words(bad: BadInput) -> list[str]:
    """What to run.

    On a disk of its own, what the command wrote there is copied beside it at the end, under another
    name.
    """
    command = [*COMMAND, *bad.arguments]
    if not bad.disk:
        return command
    script = (
        f'mkdir -p {DISK} && mount -t tmpfs -o "$0" none {DISK} && "$@"; status=$?; cp -r {DISK}'
        f" {_KEPT}; exit $status"
    )
    return [*_DISKS, "sh", "-c", script, bad.disk, *command]


@cache
def _start_up(command: tuple[str, ...]) -> float:
    """CPU time that a command takes to find that its file is not there, s; the least of three."""
    nothing = [
        *COMMAND,
        *command,
        "none",
        *(["-o", "x"] if command[0] in ("batch", "recue", "recover") else []),
    ]
    with TemporaryDirectory() as folder:
        return min(_run(nothing, Path(folder))[1] for _ in range(3))


def _run(words: Sequence[str], folder: Path) -> tuple[int, float, float, str]:
    """Exit status (negative: a signal), CPU time in s, largest resident memory in MB, stderr."""
    with TemporaryDirectory(prefix="bad_input_") as name, (Path(name) / "err").open("w+b") as err:
        told = Path(name) / "told"
        starter = [sys.executable, "-I", "-S", "-c", _STARTER, str(told), *words]
        quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": err}
        with subprocess.Popen(starter, cwd=folder, process_group=0, **quiet) as process:  # type: ignore[call-overload]
            alarm = Timer(PATIENCE, os.killpg, (process.pid, signal.SIGKILL))
            alarm.start()
            killed = process.wait()
            alarm.cancel()
        err.seek(0)
        message = err.read().decode(errors="replace")
        status, seconds, megabytes = (
            told.read_text().split() if told.exists() else (killed, 0.0, 0.0)
        )
    return int(status), float(seconds), float(megabytes), message


def counted(all_ended: Iterable[Ended]) -> str:
    """`57 x 2, 12 x 1`: how many ended with each status."""
    statuses = [ended.status for ended in all_ended]
    return ", ".join(
        f"{statuses.count(status)} x {status}" for status in sorted(set(statuses), reverse=True)
    )
