"""The viewer's process: it starts, never holds the writer up, and ends with its parent."""

import os
import signal
import sys
from pathlib import Path
from urllib.request import urlopen

import pytest
from live.riding import child, live_tick
from waiting import until

from atlas_cueing.errors import InputError
from atlas_cueing.scenario import Platform
from atlas_cueing.telemetry import LiveWriter, live_ring
from atlas_cueing.telemetry.operator_buttons import OperatorButtons
from atlas_cueing.viewer import ViewerProcess


def serves(url: str) -> bool:
    with urlopen(url, timeout=30.0) as page:  # noqa: S310 - our own
        return bool(page.status == 200)


def state_of(pid: int) -> str:
    """As the kernel has it; empty when the process is gone."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return ""


def test_a_stopped_view_does_not_hold_the_writer_up(
    platform: Platform, capfd: pytest.CaptureFixture[str]
) -> None:
    ring, buttons = live_ring(1.0, 300.0), OperatorButtons()
    writer = LiveWriter(ring)
    with ViewerProcess(ring, platform, buttons.press, {}) as viewer:
        assert viewer.pid
        writer.tick(*live_tick(0.0))
        assert serves(viewer.url)
        os.kill(viewer.pid, signal.SIGSTOP)
        until(lambda: state_of(viewer.pid) == "T")
        for k in range(3 * ring.slots):
            writer.tick(*live_tick(k / 300.0))
        assert ring.written == 3 * ring.slots + 1
        os.kill(viewer.pid, signal.SIGINT)  # Ctrl-C reaches the whole group
        os.kill(viewer.pid, signal.SIGCONT)
        assert serves(viewer.url)
        writer.end(1.0, "ok", "")
        assert viewer.alive
    assert not viewer.alive
    assert capfd.readouterr() == ("", "")


def test_a_stopped_view_can_be_closed(platform: Platform) -> None:
    viewer = ViewerProcess(live_ring(1.0, 300.0), platform, OperatorButtons().press, {})
    assert viewer.pid
    os.kill(viewer.pid, signal.SIGSTOP)
    viewer.close()
    assert not viewer.alive


def test_a_port_in_use(platform: Platform) -> None:
    with ViewerProcess(live_ring(1.0, 300.0), platform, OperatorButtons().press, {}) as viewer:
        port = int(viewer.url.rsplit(":", 1)[1].split("/")[0])
        with pytest.raises(InputError, match=f"the view could not be started: port {port}: in use"):
            ViewerProcess(live_ring(1.0, 300.0), platform, OperatorButtons().press, {}, port=port)


def test_without_viser(platform: Platform, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(InputError, match=r"pip install 'atlas_cueing\[live\]'"):
        ViewerProcess(live_ring(1.0, 300.0), platform, OperatorButtons().press, {})


def test_it_ends_when_its_parent_is_gone(platform: Platform) -> None:
    here, there = os.pipe()

    def start_and_vanish() -> None:
        viewer = ViewerProcess(live_ring(1.0, 300.0), platform, OperatorButtons().press, {})
        os.write(there, f"{viewer.pid} ".encode())
        os._exit(0)

    with child(start_and_vanish):
        pid = int(os.read(here, 20))
    until(lambda: state_of(pid) in ("", "Z"))
    os.close(here)
    os.close(there)
