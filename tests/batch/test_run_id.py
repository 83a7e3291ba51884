import string
from pathlib import Path

import pytest
from short_scenario import Load

from atlas_cueing.batch import run_id as module
from atlas_cueing.batch.run_id import digest, run_id
from atlas_cueing.scenario import load_scenario


def test_it_reads_well_and_is_a_file_name(load: Load) -> None:
    name, flown, method, code = run_id(load()).split("-")
    assert (name, flown, method) == ("short", "c1722", "hedge")
    assert len(code) == 12
    assert set(code) <= set(string.hexdigits)


def test_whatever_changes_the_log_changes_it(load: Load, monkeypatch: pytest.MonkeyPatch) -> None:
    changes = [
        "duration_s=2",
        "cueing.memory_s=2",
        "platform.wheel_limits.speed_rad_s=20",
        "recording.chunk_ticks=17",
    ]
    ids = [run_id(load()), *(run_id(load(change)) for change in changes)]
    assert len(set(ids)) == len(ids)
    assert run_id(load("cueing.memory_s=5.0")) == ids[0]  # the default, said aloud
    monkeypatch.setattr(module, "_version", lambda _: b"another")
    assert run_id(load()) not in ids


def test_a_users_script_counts_by_its_content(load: Load, tmp_path: Path) -> None:
    (tmp_path / "my flight.xml").write_text("<runscript/>")
    load()
    settings = ["vehicle.script=my flight.xml"]
    first = run_id(load_scenario(tmp_path / "s.toml", settings, trust_models=True))
    assert first.startswith("short-my_flight-hedge-")
    (tmp_path / "my flight.xml").write_text("<runscript />")
    assert run_id(load_scenario(tmp_path / "s.toml", settings, trust_models=True)) != first


def test_names_and_contents_of_files_do_not_run_into_each_other() -> None:
    assert digest({"a": b"bc"}) != digest({"ab": b"c"})
    assert digest({"a": b"1", "b": b""}) != digest({"a": b"", "b": b"1"})
    assert digest({"a": b"1", "b": b"2"}) != digest({"a": b"1b\0\0" + b"2"})
    assert digest({"a": b"1", "b": b"2"}) == digest({"b": b"2", "a": b"1"})


def test_the_longest_name_still_fits_into_a_folder(load: Load) -> None:
    assert len(run_id(load("name=" + "x" * 100)) + ".mcap.part") < 200
