from pathlib import Path

import pytest

from atlas_cueing.batch.folder_store import FolderStore
from atlas_cueing.batch.remote_store import RemoteStore
from atlas_cueing.batch.store import ResultStore, open_store


def test_a_url_is_one_and_anything_else_a_folder() -> None:
    assert isinstance(open_store("file:///a"), RemoteStore)
    assert isinstance(open_store("s3://bucket/a"), RemoteStore)
    assert isinstance(open_store("a"), FolderStore)
    assert isinstance(open_store("/a:b//c"), FolderStore)


@pytest.mark.parametrize("kind", ["", "file://"])
def test_both_kinds_do_the_same(tmp_path: Path, kind: str) -> None:
    """The same course of events, whatever the place.

    Nothing made by looking, then files whole, then found from its `place`.
    """
    results: ResultStore = open_store(f"{kind}{tmp_path}/new")
    results.check()
    assert results.names() == set()
    assert results.read(["a"]) == {}
    assert not (tmp_path / "new").exists()
    with results.opened():
        results.write("a", b"1")
        results.write("a", b"2")
        workdir = results.workdir(tmp_path)
        (workdir / "left").write_bytes(b"3")
    again = open_store(results.place)
    assert again.read(["a"]) == {"a": b"2"}
    assert again.names() >= {"a"}
    assert not any(name.endswith((".part", ".upload")) for name in again.names())
    assert again.fetch("a", tmp_path).read_bytes() == b"2"
    assert (again.title, again.where("a")) == ("new", f"{kind}{tmp_path}/new/a")
