"""Results at a URL: file:// as workers see it, and fsspec's file system in memory."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fsspec.implementations.memory import MemoryFileSystem

from atlas_cueing.batch import fly_batch, fly_here, missing
from atlas_cueing.batch import pool as workers
from atlas_cueing.batch import remote_store as remote
from atlas_cueing.batch.folder_store import FolderStore
from atlas_cueing.batch.isolation import ChildExit
from atlas_cueing.batch.job_result import JobResult, keep, kept
from atlas_cueing.batch.remote_store import RemoteStore
from atlas_cueing.batch.worker_main import _deliver
from atlas_cueing.errors import InputError, OutputError

from .sweeping import LIMITS, job_of, planned, sabotage
from .test_fly_batch import hashes

WHERE = "memory://results"


@pytest.fixture
def results() -> Iterator[RemoteStore]:
    """An empty place in memory."""
    MemoryFileSystem.store.clear()
    MemoryFileSystem.pseudo_dirs[:] = [""]
    yield RemoteStore(WHERE)
    MemoryFileSystem.store.clear()
    MemoryFileSystem.pseudo_dirs[:] = [""]


def test_a_file_written_is_there_whole_and_alone(results: RemoteStore) -> None:
    assert results.names() == set()
    results.write("a", b"1")
    results.write("b", b"2")
    results.write("a", b"33")
    assert results.names() == {"a", "b"}
    assert results.read(["b", "a", "c"]) == {"a": b"33", "b": b"2"}
    assert results.read(["c"]) == {}
    assert results.read([]) == {}


def test_opening_proves_that_files_can_be_written_and_leaves_none(results: RemoteStore) -> None:
    with results.opened():
        assert results.names() == set()
        assert MemoryFileSystem().isdir("/results")


class Deaf(MemoryFileSystem):  # type: ignore[misc]
    """Takes no files, or breaks off when they are moved."""

    cachable = False

    def pipe_file(self, *_: Any, **__: Any) -> None:
        raise PermissionError("denied")

    def cp_file(self, *_: Any, **__: Any) -> None:
        raise ConnectionError("cut")


def deaf(results: RemoteStore) -> RemoteStore:
    results.__dict__["_driver"] = (Deaf(), "/results")
    return results


def test_a_place_that_takes_no_files_is_found_out_when_it_is_opened(results: RemoteStore) -> None:
    with (
        pytest.raises(OutputError, match=r"memory://results: PermissionError: denied"),
        deaf(results).opened(),
    ):
        pytest.fail("it can be written to")


def test_what_breaks_off_is_never_taken_for_a_finished_log(
    results: RemoteStore, tmp_path: Path
) -> None:
    (tmp_path / "r.mcap").write_bytes(b"log")
    keep(JobResult("ok", log=Path("r.mcap"), id="r"), tmp_path)
    told = deaf(results)._upload(tmp_path, ["r.mcap", "r.json"])
    assert told == b"memory://results: ConnectionError: cut"
    assert results.names() == set()
    assert kept(["r"], results) == {}


def test_while_it_is_uploaded_it_has_another_name(
    results: RemoteStore, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also of every upload another one, so that two never write into the same file."""
    seen: list[str] = []
    move = MemoryFileSystem.mv
    monkeypatch.setattr(MemoryFileSystem, "mv", lambda fs, a, b: (seen.append(a), move(fs, a, b)))
    (tmp_path / "r.mcap").write_bytes(b"log")
    for _ in range(2):
        assert results._upload(tmp_path, ["r.mcap"]) == b""
    assert len(set(seen)) == 2
    assert all(name.startswith("/results/r.mcap.") and name.endswith(".upload") for name in seen)
    assert results.read(results.names()) == {"r.mcap": b"log"}


def test_a_record_there_without_its_log_is_flown_again(
    results: RemoteStore, tmp_path: Path
) -> None:
    result = JobResult("ok", log=Path("r.mcap"), id="r")
    keep(result, tmp_path)
    results.write("r.json", (tmp_path / "r.json").read_bytes())
    assert kept(["r"], results) == {}
    results.write("r.mcap", b"log")
    assert kept(["r", "s"], results) == {"r": result}


def test_the_record_is_uploaded_last(
    results: RemoteStore, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    uploaded: list[str] = []
    monkeypatch.setattr(results, "deliver", lambda _, names: uploaded.extend(names))
    _deliver(JobResult("ok", log=Path("r.mcap"), id="r"), tmp_path, results)
    _deliver(JobResult("vehicle_failed", id="s"), tmp_path, results)
    assert uploaded == ["r.mcap", "r.json", "s.json"]


@pytest.mark.parametrize(
    ("ended", "message"),
    [
        (ChildExit(b"", -9, "", late=True), "upload not over after 3600 s"),
        (ChildExit(b"", -11, "", late=False), "upload ended by SIGSEGV"),
        (ChildExit(b"s3://a: denied", 0, "", late=False), "s3://a: denied"),
    ],
)
def test_an_upload_that_fails_says_how(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ended: ChildExit, message: str
) -> None:
    monkeypatch.setattr(remote, "in_child", lambda _work, _limit: ended)
    with pytest.raises(OutputError, match=message):
        RemoteStore(WHERE).deliver(tmp_path, ["r.mcap"])


def test_a_run_that_cannot_be_uploaded_is_flown_again(tmp_path: Path) -> None:
    run = planned(tmp_path)[0]
    (result,) = fly_here([job_of(run, f"file://{tmp_path}/not_made")], 1)
    assert (result.result, result.final) == ("recording_failed", False)
    assert f"file://{tmp_path}/not_made: FileNotFoundError" in result.reason


def test_a_file_comes_back_for_its_review(results: RemoteStore, tmp_path: Path) -> None:
    results.write("r.mcap", b"log")
    assert results.fetch("r.mcap", tmp_path).read_bytes() == b"log"
    assert results.workdir(tmp_path) == tmp_path
    with pytest.raises(OutputError, match="FileNotFoundError"):
        results.fetch("s.mcap", tmp_path)


def test_a_host_that_fails_is_told(results: RemoteStore, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ConnectionError("no route")

    for name in ("info", "ls", "cat_file"):
        monkeypatch.setattr(MemoryFileSystem, name, fail)
    monkeypatch.setattr(remote, "_OF_ONE_PROCESS", "none")
    for ask in (results.check, results.names, lambda: results.read(["a"])):
        with pytest.raises(OutputError, match=r"memory://results: ConnectionError: no route"):
            ask()


@pytest.mark.parametrize(
    ("url", "message"),
    [
        ("nonsense://place", "Protocol not known: nonsense"),
        ("://place", "is no URL of a folder"),
        ("s3://", "is no URL of a folder"),
        ("file:///", "is no URL of a folder"),
        ("file://place", "has three slashes"),
        ("simplecache::file:///a", "chained URLs"),
        ("file:///a*", "take for a pattern"),
        ("memory://place", "no other process sees it"),
    ],
)
def test_what_is_no_place_for_results(url: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        RemoteStore(url).check()


def test_a_file_in_the_way(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="is no folder"):
        RemoteStore(f"file://{tmp_path}/file").check()
    RemoteStore(f"file://{tmp_path}/new").check()
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    with (
        pytest.raises(OutputError, match=r"FileNotFoundError.*no/such"),
        RemoteStore(f"file://{tmp_path}/no/such").opened(),
    ):
        pytest.fail("it was made with all above it")


def test_without_fsspec_or_its_driver(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "s3fs", None)
    with pytest.raises(InputError, match=r"-o s3://bucket/a: its driver is missing: Install s3fs"):
        RemoteStore("s3://bucket/a").check()
    monkeypatch.setitem(sys.modules, "fsspec.core", None)
    with pytest.raises(
        InputError,
        match=r"-o s3://bucket/a: a URL needs fsspec; .* install 'atlas_cueing\[cluster\]'",
    ):
        RemoteStore("s3://bucket/a").check()


def test_a_password_is_for_the_driver_only() -> None:
    results = RemoteStore("ftp://me:secret@host/folder/")
    assert results.place == "ftp://me:secret@host/folder"
    assert (results.where(), results.where("a"), results.title) == (
        "ftp://host/folder",
        "ftp://host/folder/a",
        "folder",
    )


def test_workers_upload_the_same_bytes_and_leave_nothing_behind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "scratch").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "scratch"))
    runs = planned(tmp_path)
    there = RemoteStore(f"file://{tmp_path}/there")
    outcomes = fly_batch(runs, there, lambda orders, stop: fly_here(orders, 2, stop), LIMITS)
    assert all(outcome.result and outcome.result.clean for outcome in outcomes)
    fly_batch(
        runs, FolderStore(tmp_path / "here"), lambda orders, stop: fly_here(orders, 2, stop), LIMITS
    )
    assert hashes(tmp_path / "there") == hashes(tmp_path / "here")
    assert there.names() == {f"{run.id}{ending}" for run in runs for ending in (".mcap", ".json")}
    assert not list((tmp_path / "scratch").iterdir())
    assert missing(runs, there) == []
    (tmp_path / "there" / f"{runs[1].id}.mcap").unlink()
    assert missing(runs, there) == [runs[1]]


def test_what_a_killed_run_recorded_is_uploaded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    deed = (
        "import tempfile; (Path(tempfile.gettempdir()) / 'mine').touch(); (workdir /"
        " f'{job.id}.mcap.part').touch(); os.abort()"
    )
    sabotage(monkeypatch, deed)
    (tmp_path / "scratch").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "scratch"))
    runs = planned(tmp_path, 'sweep.cueing.method=["attitude"]')
    there = RemoteStore(f"file://{tmp_path}/there")
    (outcome,) = fly_batch(runs, there, lambda orders, stop: fly_here(orders, 1, stop), LIMITS)
    assert outcome.result
    assert (outcome.result.result, outcome.result.log) == (
        "crashed",
        Path(f"{runs[0].id}.mcap.part"),
    )
    assert there.names() == {f"{runs[0].id}.mcap.part", f"{runs[0].id}.json"}
    assert not list((tmp_path / "scratch").iterdir())


def test_a_worker_never_has_a_driver_of_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Drivers start threads, and it forks."""
    seen = (
        f"os.register_at_fork(before=lambda: 'fsspec' in sys.modules and open('{tmp_path}/seen',"
        " 'w'))"
    )
    main = "from atlas_cueing.batch import worker_main as worker"
    code = f"import os, sys; {main}; {seen}; worker.main()"
    monkeypatch.setattr(workers, "_COMMAND", (sys.executable, "-c", code))
    outcomes = fly_batch(
        planned(tmp_path),
        RemoteStore(f"file://{tmp_path}/there"),
        lambda orders, stop: fly_here(orders, 1, stop),
        LIMITS,
    )
    assert [outcome.result and outcome.result.result for outcome in outcomes] == ["ok"] * 4
    assert not (tmp_path / "seen").exists()
