from pathlib import Path

import pytest

from atlas_cueing.batch.folder import LOCK, check_folder, locked
from atlas_cueing.errors import OutputError


def test_a_folder_is_made_when_needed(tmp_path: Path) -> None:
    check_folder(tmp_path / "new")
    assert list(tmp_path.iterdir()) == []
    with locked(tmp_path / "new"):
        assert (tmp_path / "new" / LOCK).exists()


def test_one_batch_at_a_time(tmp_path: Path) -> None:
    with locked(tmp_path), pytest.raises(OutputError, match="another batch is at work"), locked(tmp_path):
        pytest.fail("two batches in one folder")
    with locked(tmp_path):
        pass


def test_what_can_never_be_a_folder_of_results(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="is no folder"):
        check_folder(tmp_path / "file")
    with pytest.raises(OutputError, match="is no folder"):
        check_folder(tmp_path / "file" / "deeper")
    with pytest.raises(OutputError, match="is missing"):
        check_folder(tmp_path / "missing" / "deeper")
    with pytest.raises(OutputError, match="File name too long"):
        check_folder(tmp_path / ("x" * 300))


def test_a_folder_that_cannot_be_written_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.access", lambda _path, _mode: False)
    with pytest.raises(OutputError, match="cannot be written to"):
        check_folder(tmp_path)
