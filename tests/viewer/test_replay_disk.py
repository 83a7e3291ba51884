"""A replay on a disk that is full."""

from pathlib import Path

import pytest
from live.logs import largest_file

from atlas_cueing.errors import OutputError
from atlas_cueing.review import RecordedRun
from atlas_cueing.viewer import write_replay


def test_a_full_disk_leaves_the_old_replay(run: RecordedRun, tmp_path: Path) -> None:
    (tmp_path / "old.html").write_text("old")
    for file in ("old.html", "new.html"):
        with (
            largest_file(100_000),
            pytest.raises(OutputError, match=rf"page .*{file}: File too large"),
        ):
            write_replay(run.platform, run.flight, tmp_path / file)
    assert [path.name for path in tmp_path.iterdir()] == ["old.html"]
    assert (tmp_path / "old.html").read_text() == "old"
