from pathlib import Path

import pytest

from atlas_cueing.batch.folder_store import FolderResults
from atlas_cueing.batch.remote_store import RemoteResults
from atlas_cueing.batch.store import Results, results_at


def test_a_url_is_one_and_anything_else_a_folder() -> None:
    assert isinstance(results_at("file:///a"), RemoteResults)
    assert isinstance(results_at("s3://bucket/a"), RemoteResults)
    assert isinstance(results_at("a"), FolderResults)
    assert isinstance(results_at("/a:b//c"), FolderResults)


@pytest.mark.parametrize("kind", ["", "file://"])
def test_both_kinds_do_the_same(tmp_path: Path, kind: str) -> None:
    """The same course of events, whatever the place: nothing made by looking, then files whole, then found from its `place`."""
    results: Results = results_at(f"{kind}{tmp_path}/new")
    results.check()
    assert results.names() == set()
    assert results.read(["a"]) == {}
    assert not (tmp_path / "new").exists()
    with results.opened():
        results.write("a", b"1")
        results.write("a", b"2")
        desk = results.desk(tmp_path)
        (desk / "left").write_bytes(b"3")
    again = results_at(results.place)
    assert again.read(["a"]) == {"a": b"2"}
    assert again.names() >= {"a"}
    assert not any(name.endswith((".part", ".upload")) for name in again.names())
    assert again.fetch("a", tmp_path).read_bytes() == b"2"
    assert (again.title, again.where("a")) == ("new", f"{kind}{tmp_path}/new/a")
