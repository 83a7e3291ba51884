"""The overview of a batch in a browser."""

from itertools import product
from math import nan
from pathlib import Path

import pytest
from viewer.browsing import Opened, launched, needs_browser

from .overviews import ANGLE, FAILED, METRIC, ROW, Row, page

LONG = "a_rather_long_name_of_a_script_that_somebody_chose"
KEYS = tuple(f"cueing.some_longer_parameter_{i}_deg_s" for i in range(6))
METRICS = (
    METRIC,
    ANGLE,
    "rate_rms_rad_s",
    "wheels_limited_share",
    "stage_limited_share",
    "attitude_rms_rad",
)
FALLING = ["103.0", "100.125", "13.0", "10.125", "5.5", "2.625"]


def wide_page() -> str:
    """Six swept parameters, long names, a metric that is none, and a run that failed."""
    rows: list[Row] = [
        {
            **ROW,
            "scenario": LONG,
            "vehicle": LONG + str(a),
            **dict.fromkeys(KEYS, a + b),
            **dict.fromkeys(METRICS, 10.0 * a + b),
        }
        for a, b in product((0.25, 1.0, 10.0), (0.125, 3.0))
    ]
    rows += [{**ROW, METRIC: nan, "violations": 3}, {**FAILED, "reason": LONG * 9}]
    return page(*rows, settings=KEYS, metrics=METRICS)


@needs_browser
def test_it_fits_the_window_and_a_click_sorts(tmp_path: Path) -> None:
    """What is empty stays last, and the other table is left alone."""
    (tmp_path / "page.html").write_text(wide_page())
    with launched() as browser:
        opened = Opened(browser, (tmp_path / "page.html").as_uri())
        opened.page.set_viewport_size({"width": 1200, "height": 500})
        assert opened.page.evaluate("document.documentElement.scrollWidth") <= 1200
        column = (
            "[...document.querySelectorAll('table')[0].tBodies[0].rows].map(r =>"
            f" r.cells[{2 + len(KEYS)}].dataset.v)"
        )
        head = opened.page.locator(f"th[title^={METRIC}]")
        assert head.get_attribute("aria-sort") == "ascending"
        head.click()
        assert opened.page.evaluate(column) == [*FALLING, ""]
        head.press("Enter")
        assert opened.page.evaluate(column) == [*reversed(FALLING), ""]
        opened.page.evaluate("window.scrollTo(0, 300)")
        assert opened.page.evaluate(
            "document.querySelector('th').getBoundingClientRect().top"
        ) == pytest.approx(0.0, abs=1.0)
        assert opened.page.locator("td.reason").inner_text() == LONG * 9
        opened.check_alone()
