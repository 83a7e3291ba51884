import os
from pathlib import Path

import pytest

from atlas_cueing.batch import check_output
from atlas_cueing.errors import OutputError


def test_a_new_log_in_a_folder_is_fine(tmp_path: Path) -> None:
    check_output(tmp_path / "new.mcap", force=False)
    assert list(tmp_path.iterdir()) == []


def test_an_existing_log_needs_force(tmp_path: Path) -> None:
    log = tmp_path / "old.mcap"
    log.write_text("kept")
    with pytest.raises(OutputError, match="--force"):
        check_output(log, force=False)
    check_output(log, force=True)
    assert log.read_text() == "kept"


def test_what_is_left_of_another_run_needs_force_where_a_new_one_begins(tmp_path: Path) -> None:
    part = tmp_path / "new.mcap.part"
    part.write_text("kept")
    with pytest.raises(OutputError, match=r"new\.mcap\.part is there.*recover .*new\.mcap\.part -o NAME\.mcap.*--force"):
        check_output(tmp_path / "new.mcap", force=False, fresh=True)
    check_output(tmp_path / "new.mcap", force=True, fresh=True)
    check_output(tmp_path / "new.mcap", force=False)  # as for recover, whose input it may be
    assert part.read_text() == "kept"


@pytest.mark.parametrize("force", [False, True])
def test_what_can_never_be_a_log(tmp_path: Path, force: bool) -> None:
    with pytest.raises(OutputError, match="no regular file"):
        check_output(tmp_path, force=force)
    with pytest.raises(OutputError, match="no regular file"):
        check_output(Path(os.devnull), force=force)
    with pytest.raises(OutputError, match="there is no folder"):
        check_output(tmp_path / "missing" / "log.mcap", force=force)
    with pytest.raises(OutputError, match="File name too long"):
        check_output(tmp_path / ("x" * 300), force=force)


def test_a_folder_that_cannot_be_written_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Asked of the system, as the tests may run as a user who can write anywhere."""
    asked = []
    monkeypatch.setattr(os, "access", lambda path, mode: asked.append((path, mode)))
    with pytest.raises(OutputError, match="cannot be written to"):
        check_output(tmp_path / "log.mcap", force=False)
    assert asked == [(tmp_path, os.W_OK | os.X_OK)]
