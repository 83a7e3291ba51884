"""The page of plots in a real browser, opened from disk: nothing is fetched, plots are drawn."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from viewer.browsing import Opened, launched, needs_browser

from atlas_cueing.review import review_log
from atlas_cueing.review.report import write_page

pytestmark = needs_browser


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium without a window."""
    with launched() as chromium:
        yield chromium


def test_the_plots_are_drawn_and_their_zoom_is_linked(
    browser: Any, flight: Path, tmp_path: Path
) -> None:
    write_page(review_log(flight), tmp_path / "page.html")
    opened = Opened(browser, (tmp_path / "page.html").as_uri())
    page = opened.page
    page.wait_for_function("document.querySelectorAll('.js-plotly-plot').length == 6")
    page.wait_for_function("document.querySelectorAll('.js-plotly-plot .main-svg').length >= 6")
    assert page.inner_text(".verdict") == "clean"
    lines = page.evaluate(
        "[...document.querySelectorAll('.js-plotly-plot')[0].querySelectorAll('path.js-line')].length"
    )
    assert lines >= 6 * 2 + 1 + 3 * 3 + 2
    length = page.evaluate("document.querySelector('path.js-line').getTotalLength()")
    assert length > 300  # pixels: the first line goes across the page
    # the two scenes in space
    assert page.evaluate("document.querySelectorAll('.gl-container canvas').length") >= 2
    page.evaluate(
        "Plotly.relayout(document.querySelectorAll('.js-plotly-plot')[0], {'xaxis.range': [2, 3]})"
    )
    ranges = page.evaluate(
        "(l => [l.xaxis.range,"
        " l.xaxis8.range])(document.querySelectorAll('.js-plotly-plot')[0]._fullLayout)"
    )
    assert ranges == [[2, 3], [2, 3]]
    opened.check_alone()
