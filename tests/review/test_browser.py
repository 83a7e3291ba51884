"""Both pages in a real browser, opened from disk: nothing is fetched, plots are drawn, the replay plays."""

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from atlas_cueing.review import review
from atlas_cueing.review.page import write_page
from atlas_cueing.review.replay import write_replay

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PATIENCE = 120_000  # ms; software rendering on a busy machine
# No sandbox: a container seldom has one. Rendering in software: there may be no graphics card.
ARGUMENTS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no browser: chromium is missing (Debian: apt-get install chromium)")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium without a window."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="no browser driver: pip install playwright")
    with sync_api.sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS, timeout=PATIENCE)
        yield chromium
        chromium.close()


class Opened:
    """A page opened from disk, with everything it asked for and everything that went wrong in it."""

    def __init__(self, browser: Any, file: Path) -> None:
        self.page = browser.new_page(viewport={"width": 700, "height": 400})
        self.page.set_default_timeout(PATIENCE)
        self.requests: list[str] = []
        self.errors: list[str] = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(file.as_uri())
        self.uri = file.as_uri()

    def check_alone(self) -> None:
        """The page asked for itself only (blobs and data are parts of it), and no script failed."""
        assert self.requests[0] == self.uri
        assert [url for url in self.requests[1:] if not url.startswith(("blob:", "data:"))] == []
        assert self.errors == []


def test_the_plots_are_drawn_and_their_zoom_is_linked(browser: Any, flight: Path, tmp_path: Path) -> None:
    write_page(review(flight), tmp_path / "page.html")
    opened = Opened(browser, tmp_path / "page.html")
    page = opened.page
    page.wait_for_function("document.querySelectorAll('.js-plotly-plot').length == 4")
    page.wait_for_function("document.querySelectorAll('.js-plotly-plot .main-svg').length >= 4")
    assert page.inner_text(".verdict") == "clean"
    lines = page.evaluate("[...document.querySelectorAll('.js-plotly-plot')[0].querySelectorAll('path.js-line')].length")
    assert lines >= 6 * 2 + 1 + 3 * 3 + 2
    length = page.evaluate("document.querySelector('path.js-line').getTotalLength()")
    assert length > 300  # pixels: the first line goes across the page
    assert page.evaluate("document.querySelectorAll('.gl-container canvas').length") >= 2  # the two scenes in space
    page.evaluate("Plotly.relayout(document.querySelectorAll('.js-plotly-plot')[0], {'xaxis.range': [2, 3]})")
    ranges = page.evaluate(
        "(l => [l.xaxis.range, l.xaxis8.range])(document.querySelectorAll('.js-plotly-plot')[0]._fullLayout)"
    )
    assert ranges == [[2, 3], [2, 3]]
    opened.check_alone()


def test_the_replay_plays(browser: Any, flight: Path, tmp_path: Path) -> None:
    write_replay(review(flight), tmp_path / "replay.html")
    opened = Opened(browser, tmp_path / "replay.html")
    page = opened.page
    page.wait_for_selector("canvas")
    clock = page.wait_for_selector("input")
    page.wait_for_function("document.querySelector('input').value != ''", polling=200)
    before = float(clock.input_value())
    page.wait_for_function(f"Number(document.querySelector('input').value) != {before}", polling=200)
    opened.check_alone()
