"""Pages in a real browser, with everything they ask for and everything that goes wrong in them."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

CHROMIUM = (
    shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
)
PATIENCE = 120_000  # ms; software rendering on a busy machine
# No sandbox: a container seldom has one. Rendering in software: there may be no graphics card.
ARGUMENTS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]

needs_browser = pytest.mark.skipif(
    CHROMIUM is None, reason="no browser: chromium is missing (Debian: apt-get install chromium)"
)


@contextmanager
def launched() -> Iterator[Any]:
    """Chromium without a window."""
    sync_api = pytest.importorskip(
        "playwright.sync_api", reason="no browser driver: pip install playwright"
    )
    with sync_api.sync_playwright() as playwright:
        chromium = playwright.chromium.launch(
            executable_path=CHROMIUM, args=ARGUMENTS, timeout=PATIENCE
        )
        yield chromium
        chromium.close()


class Opened:
    """A page, from disk or from the loopback."""

    def __init__(self, browser: Any, uri: str) -> None:
        self.page = browser.new_page(viewport={"width": 700, "height": 400})
        self.page.set_default_timeout(PATIENCE)
        self.uri = uri
        self.requests: list[str] = []
        self.errors: list[str] = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("websocket", lambda socket: self.requests.append(socket.url))
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(uri)

    def check_alone(self) -> None:
        """The page asked for itself only (blobs and data are parts of it), and no script failed."""
        ours = ("blob:", "data:", self.uri, self.uri.replace("http:", "ws:"))
        assert self.requests[0].rstrip("/") == self.uri.rstrip("/")
        assert [url for url in self.requests if not url.startswith(ours)] == []
        assert self.errors == []

    def check_drawn(self) -> None:
        """The scene has many colours, some of the sphere's sky and earth.

        Polled, for drawing in software takes its time.
        """
        self.page.wait_for_function(_DRAWN, polling=500)


# The canvas is read back through a copy in two dimensions; a WebGL canvas is blank but in the turn
# that drew it.
_DRAWN = """() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(() => {
    const colours = new Set();
    for (const scene of document.querySelectorAll('canvas')) {
        if (scene.width < 200) continue;
        const copy = document.createElement('canvas');
        [copy.width, copy.height] = [120, 80];
        const pencil = copy.getContext('2d');
        pencil.drawImage(scene, 0, 0, 120, 80);
        const pixels = pencil.getImageData(0, 0, 120, 80).data;
        for (let k = 0; k < pixels.length; k += 4)
            colours.add((pixels[k] >> 4) * 256 + (pixels[k + 1] >> 4) * 16 + (pixels[k + 2] >> 4));
    }
    resolve(colours.size > 40);
})))"""
