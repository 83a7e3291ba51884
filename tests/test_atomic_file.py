import os
from pathlib import Path

import pytest
from live.logs import largest_file

from atlas_cueing.atomic_file import PAGE_BEGINS, Destination, write_page, write_whole


def left(folder: Path) -> dict[str, str]:
    """All files by name."""
    return {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}


def test_it_is_written_and_replaced(tmp_path: Path) -> None:
    for text in ("Größe\n", "", "new"):
        write_whole(tmp_path / "page.html", text)
        assert left(tmp_path) == {"page.html": text}


def test_it_may_be_read_by_whoever_may_read_any_new_file(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("")
    write_whole(tmp_path / "page.html", "new")
    assert (tmp_path / "page.html").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("old", [{}, {"page.html": "old"}])
def test_a_full_disk(tmp_path: Path, old: dict[str, str]) -> None:
    for name, text in old.items():
        (tmp_path / name).write_text(text)
    with largest_file(1000), pytest.raises(OSError, match="File too large"):
        write_whole(tmp_path / "page.html", "x" * 100_000)
    assert left(tmp_path) == old


def test_ctrl_c_in_the_middle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "page.html").write_text("old")

    def interrupted(_from: str, _to: str) -> None:
        assert len(left(tmp_path)) == 2
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole(tmp_path / "page.html", "new")
    assert left(tmp_path) == {"page.html": "old"}


def test_nowhere_to_write(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        write_whole(tmp_path / "no" / "page.html", "new")
    with pytest.raises(OSError, match="File name too long"):
        write_whole(tmp_path / ("x" * 5000), "new")
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError, match="no regular file"):
        write_whole(tmp_path / "folder", "new")
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


def test_what_is_no_text_is_a_question_mark(tmp_path: Path) -> None:
    write_whole(tmp_path / "page.html", "of " + os.fsdecode(b"caf\xe9.mcap"))
    assert left(tmp_path) == {"page.html": "of caf?.mcap"}


def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    (tmp_path / "link").symlink_to("there/page.html")
    for text in ("new", "newer"):
        write_whole(tmp_path / "link", text)
        assert (tmp_path / "link").is_symlink()
        assert left(tmp_path / "there") == {"page.html": text}


def test_links_that_lead_nowhere(tmp_path: Path) -> None:
    links = {"a": "b", "b": "a", "null": os.devnull, "open": "/proc/self/fd/1", "far": "no/page"}
    for link, target in links.items():
        (tmp_path / link).symlink_to(target)
    for link in links:
        with pytest.raises(OSError, match=r"symbolic links|no regular file|open file|No such file"):
            write_whole(tmp_path / link, "new")
    assert all(path.is_symlink() for path in tmp_path.iterdir())


def test_what_appears_meanwhile_stays(tmp_path: Path) -> None:
    destination = Destination(tmp_path / "x")
    (tmp_path / "part").write_text("new")
    (tmp_path / "x").write_text("of another")
    with pytest.raises(FileExistsError, match="another file has taken its name"):
        destination.take(tmp_path / "part")
    assert left(tmp_path) == {"x": "of another", "part": "new"}
    (tmp_path / "x").unlink()
    destination.take(tmp_path / "part")
    assert left(tmp_path) == {"x": "new"}


def test_a_page_begins_as_ours_do(tmp_path: Path) -> None:
    for html in ("<!DOCTYPE html>\n<html></html>", "<html></html>"):
        write_page(tmp_path / "page.html", html)
        assert left(tmp_path)["page.html"].startswith(PAGE_BEGINS)
        assert left(tmp_path)["page.html"].lower().count("doctype") == 1


def test_a_long_name_is_no_hindrance(tmp_path: Path) -> None:
    name = "ü" * 127
    write_whole(tmp_path / name, "new")
    assert left(tmp_path) == {name: "new"}
