"""The operator's desk: what it tells, what it presses, and that nobody can hold it up."""

import os
import pty
import signal
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from waiting import until

from atlas_cueing.errors import InputError
from atlas_cueing.live.output.operator_desk import Desk, OperatorDesk
from atlas_cueing.telemetry import LiveWriter, OperatorButtons, live_ring
from atlas_cueing.telemetry import command_socket as sockets

from ..riding import live_tick


@pytest.fixture(autouse=True)
def runtime(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    return tmp_path


def desk(told: list[str], pressed: list[str]) -> tuple[LiveWriter, Desk]:
    ring = live_ring(1.0, 300.0)
    return LiveWriter(ring), Desk(ring, pressed.append, report=told.append)


def test_states_are_told_and_commands_are_answered_by_them() -> None:
    told: list[str] = []
    pressed: list[str] = []
    writer, at = desk(told, pressed)
    assert at.answer("hold").startswith("no: hold does nothing when parked")
    writer.status(0.0, "parked", "")
    writer.tick(*live_tick(3.0))  # running
    at.follow()
    assert (at.state, at.time) == ("running", 3.0)
    assert at.answer(" Hold\r") == "ok: hold asked at 3.00 s, running"
    assert at.answer("stop").startswith("ok: stop")
    assert at.answer("reset") == "no: reset does nothing when running"
    assert at.answer("explode") == (
        "no: 'explode', allowed: engage, hold, park, reset, stop, state"
    )
    assert at.answer("state") == "ok: running at 3.00 s"
    writer.status(3.1, "holding", "asked to hold")
    writer.end(4.0, "ok", "")
    at.follow()
    assert at.answer("park") == "no: park does nothing when the run is over"
    assert told == ["   0.00 s  parked", "   3.10 s  holding  asked to hold"]
    assert pressed == ["hold", "stop"]


@contextmanager
def open_desk(**options: object) -> Iterator[tuple[Path, OperatorButtons, LiveWriter, int]]:
    ring, buttons = live_ring(1.0, 300.0), OperatorButtons()
    place, listener = sockets.open_socket(os.getpid())
    process = OperatorDesk(ring, buttons.press, listener, **options)  # type: ignore[arg-type]
    try:
        writer = LiveWriter(ring)
        writer.tick(*live_tick(0.0))
        yield place, buttons, writer, process.pid
    finally:
        process.close()
        place.unlink(missing_ok=True)
    assert not process.alive


def pressed_within(buttons: OperatorButtons) -> tuple[str, ...]:
    found: list[str] = []
    until(lambda: bool(found.extend(buttons.edges()) or found), 30.0)
    return tuple(found)


def test_a_command_by_the_socket_is_pressed_and_answered(runtime: Path) -> None:
    with open_desk(typed=False) as (place, buttons, _, pid):
        assert place == runtime / "atlas_cueing" / f"{os.getpid()}.sock"
        assert place.stat().st_mode & 0o777 == 0o600
        assert place.parent.stat().st_mode & 0o777 == 0o700
        os.kill(pid, signal.SIGINT)  # Ctrl-C and a closed terminal reach the whole group
        os.kill(pid, signal.SIGHUP)
        until(lambda: "running" in sockets.ask(place, "state"))
        assert sockets.ask(sockets.newest(), "park").startswith("ok: park")
        assert pressed_within(buttons) == ("park",)
        with socket.socket(socket.AF_UNIX) as line:  # as nc does: many words, then the end
            line.connect(str(place))
            line.sendall(b"hold\nnonsense\n\nstop")
            line.shutdown(socket.SHUT_WR)
            answers = line.makefile().read().splitlines()
        assert [answer.split(":")[0] for answer in answers] == ["ok", "no", "ok"]
        assert set(pressed_within(buttons)) <= {"hold", "stop"}
    with pytest.raises(InputError, match="no live run"):
        sockets.newest()
    with pytest.raises(InputError, match="no live run answers there"):
        sockets.ask(place, "hold")


def test_hostile_clients_do_not_keep_the_operator_out() -> None:
    with open_desk(typed=False) as (place, _, _, _):
        clients = [socket.socket(socket.AF_UNIX) for _ in range(3)]
        for client in clients:
            client.connect(str(place))
            client.sendall(b"x" * 50_000)  # no line, and it reads nothing
        assert sockets.ask(place, "state").startswith("ok: ")
        clients[0].settimeout(30.0)
        assert clients[0].recv(4) == b"no: ", "what is too long for a line is answered, not kept"
        for client in clients:
            client.close()
        assert sockets.ask(place, "state").startswith("ok: ")


def test_commands_are_typed_and_the_end_of_them_means_nothing(
    capfd: pytest.CaptureFixture[str],
) -> None:
    ours, theirs = pty.openpty()
    before = os.dup(0)
    try:
        os.dup2(theirs, 0)
        with open_desk() as (place, buttons, writer, _):
            writer.status(1.0, "running", "")
            until(lambda: "1.00 s  running" in "".join(capfd.readouterr().err))
            os.write(ours, b"park\n")
            assert pressed_within(buttons) == ("park",)
            os.write(ours, b"\x04")
            assert sockets.ask(place, "state").startswith("ok")
    finally:
        os.dup2(before, 0)
        for number in (before, ours, theirs):
            os.close(number)


def test_a_file_on_stdin_is_left_to_the_next_command(tmp_path: Path) -> None:
    (tmp_path / "list").write_text("stop\n" * 3)
    before, file = os.dup(0), os.open(tmp_path / "list", os.O_RDONLY)
    try:
        os.dup2(file, 0)
        with open_desk() as (place, buttons, _, _):
            until(lambda: "running" in sockets.ask(place, "state"))
            assert buttons.edges() == ()
        assert os.read(0, 4) == b"stop"
    finally:
        os.dup2(before, 0)
        os.close(before)
        os.close(file)


def test_a_folder_that_others_can_write_is_refused(runtime: Path) -> None:
    (runtime / "atlas_cueing").mkdir(mode=0o777)
    (runtime / "atlas_cueing").chmod(0o777)
    with pytest.raises(InputError, match="not the user's alone"):
        sockets.open_socket(1)
    (runtime / "atlas_cueing").rmdir()
    (runtime / "atlas_cueing").symlink_to(runtime)
    with pytest.raises(InputError, match="not the user's alone"):
        sockets.open_socket(1)


def test_without_a_session_the_folder_is_the_users(
    runtime: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("XDG_RUNTIME_DIR")
    monkeypatch.setattr("tempfile.tempdir", str(runtime))
    assert sockets.folder() == runtime / f"atlas_cueing-{os.getuid()}"
    monkeypatch.setattr("tempfile.tempdir", str(runtime / ("x" * 100)))
    with pytest.raises(InputError, match="longer than 107 bytes"):
        sockets.open_socket(1)


def test_the_socket_of_a_killed_run_is_taken_over() -> None:
    place, listener = sockets.open_socket(4711)
    listener.close()
    again, listener = sockets.open_socket(4711)
    assert again == place
    assert sockets.newest() == place
    listener.close()
