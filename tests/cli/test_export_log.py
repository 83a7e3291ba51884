"""`atlas-cueing export` as its users see it."""

import json
import sys
from pathlib import Path

import numpy as np
import pandas
import pytest

from atlas_cueing.recording import read_log

from .conftest import Command

ENDINGS = ("csv", "npz", "mat", "parquet")


@pytest.fixture
def log(command: Command, tmp_path: Path) -> Path:
    assert command("run", "s.toml", "--set", "recording.chunk_ticks=16").status == 0
    return tmp_path / "short.mcap"


def test_a_run_as_a_table(command: Command, log: Path) -> None:
    ended = command("export", "short.mcap", "-o", "x.csv", "--topics", "vehicle,felt")
    assert (ended.status, ended.err) == (0, "")
    assert "topics  vehicle, felt" in ended.out
    frame = pandas.read_csv("x.csv", comment="#", engine="python")
    assert np.array_equal(frame["felt.fz_m_s2"], read_log(log).column("/felt", "fz_m_s2"))
    table = json.loads(command("export", "short.mcap", "-o", "x.npz", "--json").out)
    assert table["rows"] == len(frame)
    assert {"name": "motion.px_m", "unit": "m", "frame": "W"} in table["columns"]


@pytest.mark.parametrize("ending", ENDINGS)
def test_force_replaces_only_its_own(command: Command, log: Path, ending: str) -> None:
    words = ("export", log.name, "-o", f"x.{ending}")
    target = log.parent / f"x.{ending}"
    assert command(*words).status == 0
    refused = command(*words)
    assert (refused.status, "exists already" in refused.err) == (2, True)
    assert command(*words, "--force").status == 0
    for foreign in (b"time_s,x\n0,1\n", b"PK\x03\x04" + 60 * b"x", b"MATLAB 5.0 MAT-file by me"):
        target.write_bytes(foreign)
        refused = command(*words, "--force")
        assert (refused.status, target.read_bytes()) == (2, foreign)
        assert "nothing else is replaced" in refused.err


def test_an_input_is_never_replaced(command: Command, log: Path) -> None:
    before = log.read_bytes()
    (log.parent / "x.csv").hardlink_to(log)
    ended = command("export", "short.mcap", "-o", "x.csv", "--force")
    assert (ended.status, "is a file that is read" in ended.err) == (2, True)
    assert log.read_bytes() == before


def test_bad_input_writes_nothing(command: Command, log: Path) -> None:
    cut = log.parent / "cut.mcap"
    cut.write_bytes(log.read_bytes()[:20000])
    for words, told in (
        ((log.name, "-o", "x.xls"), "allowed: a name that ends in .csv, .npz, .mat, .parquet"),
        ((log.name, "-o", "x.csv", "--topics", "lift"), "--topics: /lift: allowed: /vehicle"),
        (("s.toml", "-o", "x.csv"), "is a TOML file, not a log"),
        (("none.mcap", "-o", "x.csv"), "no such file"),
        (("cut.mcap", "-o", "x.csv"), "atlas-cueing recover cut.mcap"),
        ((log.name, "-o", "no/x.csv"), "there is no folder no"),
    ):
        ended = command("export", *words)
        assert (ended.status, ended.out) == (2, ""), words
        assert told in ended.err
    assert {p.name for p in log.parent.iterdir()} == {"s.toml", "short.mcap", "cut.mcap"}


def test_a_missing_pyarrow_names_the_extra(
    command: Command, log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in [m for m in sys.modules if m.split(".")[0] == "pyarrow"]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    ended = command("export", log.name, "-o", "x.parquet")
    assert ended.status == 2
    assert "pip install 'atlas_cueing[parquet]'" in ended.err
    assert not (log.parent / "x.parquet").exists()
