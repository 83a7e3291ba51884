from pathlib import Path

import pytest

from atlas_cueing.batch.folder_store import LOCK, FolderStore
from atlas_cueing.errors import OutputError


def test_a_folder_is_made_when_needed(tmp_path: Path) -> None:
    results = FolderStore(tmp_path / "new")
    results.check()
    assert results.names() == set()
    assert list(tmp_path.iterdir()) == []
    with results.opened():
        assert results.names() == {LOCK}


def test_one_batch_at_a_time(tmp_path: Path) -> None:
    results = FolderStore(tmp_path)
    with (
        results.opened(),
        pytest.raises(OutputError, match="another batch is at work"),
        results.opened(),
    ):
        pytest.fail("two batches in one folder")
    with results.opened():
        pass


def test_what_can_never_be_a_folder_of_results(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="is no folder"):
        FolderStore(tmp_path / "file").check()
    with pytest.raises(OutputError, match="is no folder"):
        FolderStore(tmp_path / "file" / "deeper").check()
    with pytest.raises(OutputError, match="is missing"):
        FolderStore(tmp_path / "missing" / "deeper").check()
    with pytest.raises(OutputError, match="File name too long"):
        FolderStore(tmp_path / ("x" * 300)).check()


def test_a_folder_that_cannot_be_written_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.access", lambda _path, _mode: False)
    with pytest.raises(OutputError, match="cannot be written to"):
        FolderStore(tmp_path).check()


def test_a_file_is_replaced_as_a_whole(tmp_path: Path) -> None:
    results = FolderStore(tmp_path)
    results.write("a", b"1")
    before = (tmp_path / "a").open("rb")
    results.write("a", b"22")
    with before:
        assert before.read() == b"1"  # who had it open still has it whole
    assert results.read(["a", "b"]) == {"a": b"22"}
    assert results.names() == {"a"}


def test_runs_write_into_the_folder_itself(tmp_path: Path) -> None:
    results = FolderStore(tmp_path / "new")
    assert results.workdir(tmp_path / "scratch") == tmp_path / "new"
    assert results.fetch("a", tmp_path / "scratch") == tmp_path / "new" / "a"


def test_workers_are_told_an_absolute_path_and_people_their_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    results = FolderStore(Path("new"))
    assert (results.place, results.title) == (str(tmp_path / "new"), "new")
    assert (results.where(), results.where("a")) == ("new", "new/a")
    assert FolderStore(Path()).title == tmp_path.name
