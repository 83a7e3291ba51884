"""The 3D replay as a file; `test_browser` opens it."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError, OutputError
from atlas_cueing.review import review
from atlas_cueing.review.replay import MOST_FRAMES, RATE_HZ, frames, write_replay

from .corrupting import corrupted


def test_a_replay(flight: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    write_replay(review(flight), tmp_path / "replay.html")
    page = (tmp_path / "replay.html").read_text()
    assert capfd.readouterr() == ("", "")
    assert "__VISER_EMBED_DATA__" in page
    assert not re.search(r"<(script|link)[^>]*(src|href)=[\"']?http", page)
    assert len(page) < 4e6


@pytest.mark.parametrize(("duration", "rate"), [(1.0, 120.0), (6.0, 1000.0), (0.05, 100.0), (0.0, 1.0)])
def test_frames_span_the_flight(duration: float, rate: float) -> None:
    time = np.arange(int(duration * rate) + 1) / rate
    shown, pause = frames(time)
    assert (shown[0], shown[-1]) == (0, len(time) - 1)
    assert pause * (len(shown) - 1) == pytest.approx(time[-1])
    assert pause <= 1.5 / RATE_HZ + 1e-9
    assert np.abs(time[shown] - pause * np.arange(len(shown))).max() <= 1.0 / rate + 1e-9


def test_a_long_flight_has_no_more_frames() -> None:
    shown, pause = frames(np.arange(600_001) / 1000.0)
    assert len(shown) == MOST_FRAMES + 1
    assert pause == pytest.approx(600.0 / MOST_FRAMES)


def test_nothing_to_show(flight: Path, tmp_path: Path) -> None:
    empty = corrupted(flight, tmp_path / "empty.mcap", lambda c: c.update({n: v[:0] for n, v in c.items()}))
    nan = corrupted(flight, tmp_path / "nan.mcap", lambda c: c["/motion q_ws_w"].__setitem__(5, np.nan))
    for log in (empty, nan):
        with pytest.raises(InputError, match="no motion to show"):
            write_replay(review(log), tmp_path / "replay.html")


def test_nowhere_to_write(flight: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="No such file or directory"):
        write_replay(review(flight), tmp_path / "no" / "replay.html")


def test_without_viser_it_says_what_to_install(flight: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(InputError, match=r"pip install 'atlas_cueing\[report\]'"):
        write_replay(review(flight), tmp_path / "replay.html")
