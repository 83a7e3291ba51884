import os
from pathlib import Path

import pytest

from atlas_cueing.atomic_file import write_page
from atlas_cueing.errors import OutputError
from atlas_cueing.run import PAGE, check_output
from atlas_cueing.run.output import LOG, Kind

MCAP = b"\x89MCAP0\r\n and so on"


def test_a_new_log_in_a_folder_is_fine(tmp_path: Path) -> None:
    check_output(tmp_path / "new.mcap", force=False)
    assert list(tmp_path.iterdir()) == []


def test_an_existing_log_needs_force(tmp_path: Path) -> None:
    log = tmp_path / "old.mcap"
    log.write_bytes(MCAP)
    with pytest.raises(OutputError, match="--force"):
        check_output(log, force=False)
    check_output(log, force=True)
    assert log.read_bytes() == MCAP


def test_what_is_left_of_another_run_needs_force_where_a_new_one_begins(tmp_path: Path) -> None:
    part = tmp_path / "new.mcap.part"
    part.write_bytes(MCAP)
    with pytest.raises(
        OutputError,
        match=r"new\.mcap\.part is there.*recover .*new\.mcap\.part -o NAME\.mcap.*--force",
    ):
        check_output(tmp_path / "new.mcap", force=False, fresh=True)
    check_output(tmp_path / "new.mcap", force=True, fresh=True)
    check_output(tmp_path / "new.mcap", force=False)  # as for recover, whose input it may be
    assert part.read_bytes() == MCAP


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


def test_a_folder_that_cannot_be_written_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Asked of the system, as the tests may run as a user who can write anywhere."""
    asked = []
    monkeypatch.setattr(os, "access", lambda path, mode: asked.append((path, mode)))
    with pytest.raises(OutputError, match="cannot be written to"):
        check_output(tmp_path / "log.mcap", force=False)
    assert asked == [(tmp_path, os.W_OK | os.X_OK)]


@pytest.mark.parametrize("kind", [LOG, PAGE], ids=lambda kind: kind.name)
@pytest.mark.parametrize("old", ["log", "page", "empty", "text", "page of another"])
def test_force_replaces_only_what_is_empty_or_of_the_kind(
    tmp_path: Path, kind: Kind, old: str
) -> None:
    write_page(tmp_path / "page", "<!DOCTYPE html><html></html>")
    (tmp_path / "log").write_bytes(MCAP)
    (tmp_path / "empty").touch()
    (tmp_path / "text").write_text("time_s,wx")
    (tmp_path / "page of another").write_text("<!doctype html><html>")
    if old in (kind.name, "empty"):
        assert check_output(tmp_path / old, kind, force=True) == tmp_path / old
    else:
        with pytest.raises(OutputError, match=f"^{kind.name} .*is no {kind.name} of atlas-cueing"):
            check_output(tmp_path / old, kind, force=True)


def test_a_link_leads_to_the_real_file(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    (tmp_path / "far").symlink_to("near")
    (tmp_path / "near").symlink_to("there/../there/log.mcap")
    assert check_output(tmp_path / "far", force=False) == tmp_path / "there/../there/log.mcap"
    (tmp_path / "there" / "log.mcap").write_bytes(MCAP)
    with pytest.raises(OutputError, match="far: exists already"):
        check_output(tmp_path / "far", force=False)
    (tmp_path / "there" / "log.mcap").rename(tmp_path / "there" / "log.mcap.part")
    with pytest.raises(OutputError, match=r"log\.mcap\.part is there"):
        check_output(tmp_path / "far", force=False, fresh=True)


@pytest.mark.parametrize("name", ["input", "./input", "link", "hard"])
def test_no_input_is_an_output(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.chdir(tmp_path)
    Path("input").write_bytes(MCAP)
    Path("link").symlink_to(tmp_path / "input")
    Path("hard").hardlink_to("input")
    for inputs in (["input"], ["other", "link"], ["hard"]):
        with pytest.raises(OutputError, match="is a file that is read"):
            check_output(Path(name), inputs=map(Path, inputs), force=True)


def test_an_input_may_not_become_the_part(tmp_path: Path) -> None:
    part = tmp_path / "log.mcap.part"
    part.write_bytes(MCAP)
    with pytest.raises(OutputError, match=r"log\.mcap\.part is a file that is read"):
        check_output(tmp_path / "log.mcap", inputs=[part], force=True, fresh=True)


def test_no_file_is_written_twice(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to("new")
    with pytest.raises(OutputError, match="is written twice"):
        check_output(tmp_path / "link", PAGE, outputs=[tmp_path / "new"], force=True)


def test_in_a_folder_like_tmp_everybody_replaces_only_what_is_theirs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Asked of the system, as above."""
    (tmp_path / "log.mcap").write_bytes(MCAP)
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    check_output(tmp_path / "log.mcap", force=True)
    tmp_path.chmod(0o1777)
    with pytest.raises(OutputError, match="belongs to another user"):
        check_output(tmp_path / "log.mcap", force=True)
