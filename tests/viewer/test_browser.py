"""The three views in a real browser: nothing is fetched, the scene is drawn, controls work."""

import os
import signal
from pathlib import Path
from threading import Event, Thread
from typing import Any

from live.riding import live_tick
from waiting import until

from atlas_cueing.review import RecordedRun
from atlas_cueing.scenario import Platform
from atlas_cueing.telemetry import LiveWriter, live_ring
from atlas_cueing.telemetry.operator_buttons import OperatorButtons
from atlas_cueing.viewer import ViewerProcess, play, write_replay

from .browsing import PATIENCE, Opened, needs_browser

pytestmark = needs_browser
ALLOWED = {"running": ("hold", "park")}


def test_a_live_run(browser: Any, platform: Platform) -> None:
    ring, buttons = live_ring(2.0, 200.0), OperatorButtons()
    writer = LiveWriter(ring)
    with ViewerProcess(ring, platform, buttons.press, ALLOWED, title="tumble") as viewer:
        writer.status(0.0, "running", "engaged")
        for k in range(200):
            writer.tick(*live_tick(k / 200.0))
        opened = Opened(browser, viewer.url)
        page = opened.page
        page.wait_for_function("document.querySelector('#state')?.textContent == 'running'")
        page.wait_for_selector(".uplot canvas")
        opened.check_drawn()
        assert page.get_by_role("button", name="Engage").is_disabled()
        page.get_by_role("button", name="Hold").click()
        pressed: list[str] = []
        until(lambda: pressed.extend(buttons.edges()) or bool(pressed), 0.001 * PATIENCE)
        assert pressed == ["hold"]
        page.wait_for_function(
            "document.querySelector('#note')?.textContent == 'hold asked at 1.0 s'"
        )
        os.kill(viewer.pid or 0, signal.SIGSTOP)
        for k in range(2 * ring.slots):
            writer.tick(*live_tick(2.0 + k / 200.0))
        writer.status(9.0, "holding", "asked")
        os.kill(viewer.pid or 0, signal.SIGCONT)
        writer.end(9.0, "ok", "parked")
        page.wait_for_function("document.querySelector('#state')?.textContent == 'ended'")
        assert page.inner_text("#reason") == "ok: parked"
        opened.check_alone()
        page.close()


def test_a_replay_plays(browser: Any, run: RecordedRun, tmp_path: Path) -> None:
    write_replay(run.platform, run.flight, tmp_path / "replay.html")
    opened = Opened(browser, (tmp_path / "replay.html").as_uri())
    page = opened.page
    page.wait_for_selector("canvas")
    clock = page.wait_for_selector("input")
    page.wait_for_function("document.querySelector('input').value != ''", polling=200)
    before = float(clock.input_value())
    page.wait_for_function(
        f"Number(document.querySelector('input').value) != {before}", polling=200
    )
    opened.check_drawn()
    opened.check_alone()
    page.close()


def test_a_log_is_played(browser: Any, run: RecordedRun) -> None:
    urls: list[str] = []
    enough = Event()
    player = Thread(
        target=play,
        args=(run.platform, run.flight, urls.append),
        kwargs={"go_on": lambda: not enough.is_set()},
    )
    player.start()
    try:
        until(lambda: bool(urls), 60.0)
        opened = Opened(browser, urls[0])
        page = opened.page
        page.get_by_role("button", name="Play").or_(
            page.get_by_role("button", name="Pause")
        ).wait_for()
        page.get_by_role("button", name="Play").click()  # by now it has come to its end
        page.get_by_role("button", name="Pause").wait_for()
        opened.check_drawn()
        opened.check_alone()
        page.close()
    finally:
        enough.set()
        player.join()
