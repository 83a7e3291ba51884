"""What `export` writes, read back by readers of others: every double to the last bit."""

import csv
import re
from pathlib import Path

import numpy as np
import pandas
import pyarrow.parquet
import pytest
import scipy.io

from atlas_cueing.errors import InputError, LogError
from atlas_cueing.export import LogTable, log_table, write_export
from atlas_cueing.recording import Log, TopicColumns
from atlas_cueing.rotations import Array
from atlas_cueing.signals import TOPICS, StateChange

COUNT = 40
WILD = (0.1, 1.0 / 3.0, -0.0, 5e-324, 1.7976931348623157e308, -2.2250738585072014e-308, 1e22, np.pi)


def log_of(**lost: int) -> Log:
    """A log of all topics of a run with wild numbers; `lost` are last ticks of a topic."""
    generator = np.random.default_rng(7)
    tables = {}
    for topic in TOPICS:
        values = generator.normal(size=(COUNT, len(topic.fields))) * 1e-3
        values[3, 1:9] = WILD[: len(topic.fields) - 1]
        values[:, 0] = np.arange(COUNT) * 0.1
        kept = COUNT - lost.get(topic.name.strip("/"), 0)
        tables[topic.name] = TopicColumns(topic.fields, values[:kept])
    statuses = (StateChange(0.0, "engaging", ""), StateChange(1.05, "running", 'a "start", yes'))
    return Log(Path("x.mcap"), tables, {"scenario": "wild"}, {}, statuses)


def same_bits(found: Array, expected: Array) -> bool:
    """Whether doubles are the same to the last bit, the sign of 0 too; any NaN is one."""
    found, expected = np.asarray(found, np.float64), np.asarray(expected, np.float64)
    nan = np.isnan(expected)
    return bool(
        np.array_equal(np.isnan(found), nan) and found[~nan].tobytes() == expected[~nan].tobytes()
    )


def expected_columns(log: Log, table: LogTable) -> dict[str, Array]:
    """Columns by name, from the log itself; what is lost at the end is NaN."""
    found = {"time_s": log.column("/motion", "time_s")}
    for name, each in log.tables.items():
        for field in each.fields[1:]:
            values = np.full(COUNT, np.nan)
            values[: len(each.values)] = log.column(name, field)
            found[f"{name[1:]}.{field}"] = values
    assert list(found) == ["time_s", *(column.name for column in table.columns)]
    return found


@pytest.fixture(params=[{}, {"felt": 5}], ids=["whole", "cut"])
def log(request: pytest.FixtureRequest) -> Log:
    return log_of(**request.param)


def test_csv(tmp_path: Path, log: Log) -> None:
    table = log_table(log)
    write_export(table, tmp_path / "x.csv")
    with (tmp_path / "x.csv").open(encoding="utf-8", newline="") as file:
        lines = [line for line in file if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    frame = pandas.read_csv(tmp_path / "x.csv", comment="#", engine="python")
    for name, values in expected_columns(log, table).items():
        cells = [float(row[name]) if row[name] else np.nan for row in rows]
        assert same_bits(np.array(cells), values), name
        assert same_bits(frame[name].to_numpy(), values), name
    assert [row["status.state"] for row in rows] == ["engaging"] * 11 + ["running"] * 29


def test_units_and_frames_in_csv(tmp_path: Path) -> None:
    write_export(log_table(log_of()), tmp_path / "x.csv")
    told = {
        m[1]: (m[2], m[3])
        for line in (tmp_path / "x.csv").read_text().splitlines()
        if (m := re.fullmatch(r"# (\S+), (\S+),(?: (.*))?", line))
    }
    assert told["time_s"] == ("s", None)
    assert told["vehicle.q_nb_w"] == ("1", "B to N")
    assert told["vehicle.fz_m_s2"] == ("m/s^2", "B")
    assert told["motion.alphax_rad_s2"] == ("rad/s^2", "W")
    assert told["motion.q_ws_z"] == ("1", "S to W")
    assert told["motion.wheels_limited"] == ("1", None)
    assert told["wheels.w1_rad_s"] == ("rad/s", None)
    assert told["felt.wy_rad_s"] == ("rad/s", "S (FRD)")
    assert told["felt.direction_error_rad"] == ("rad", None)


def test_npz(tmp_path: Path, log: Log) -> None:
    table = log_table(log)
    write_export(table, tmp_path / "x.npz")
    with np.load(tmp_path / "x.npz", allow_pickle=False) as found:
        columns = expected_columns(log, table)
        for name, values in columns.items():
            assert same_bits(found[name], values), name
        assert found["names"].tolist() == list(columns)
        units = dict(zip(found["names"].tolist(), found["units"].tolist(), strict=True))
        frames = dict(zip(found["names"].tolist(), found["frames"].tolist(), strict=True))
        assert (units["cue.ax_m_s2"], frames["cue.ax_m_s2"]) == ("m/s^2", "W")
        assert found["status.time_s"].tolist() == [0.0, 1.05]
        assert found["status.reason"].tolist() == ["", 'a "start", yes']


def test_mat(tmp_path: Path, log: Log) -> None:
    table = log_table(log)
    write_export(table, tmp_path / "x.mat")
    found = scipy.io.loadmat(tmp_path / "x.mat", simplify_cells=True)
    for name, values in expected_columns(log, table).items():
        topic, _, field = name.rpartition(".")
        assert same_bits(found[topic][field] if topic else found[field], values), name
    assert found["units"]["motion"]["px_m"] == "m"
    assert found["units"]["time_s"] == "s"
    assert found["frames"]["vehicle"]["wx_rad_s"] == "B"
    assert found["status"]["state"].tolist() == ["engaging", "running"]
    flat = scipy.io.loadmat(tmp_path / "x.mat")
    assert flat["time_s"].shape == flat["felt"][0, 0]["fx_m_s2"].shape == (COUNT, 1), "columns"


def test_parquet(tmp_path: Path, log: Log) -> None:
    table = log_table(log)
    write_export(table, tmp_path / "x.parquet")
    found = pyarrow.parquet.read_table(tmp_path / "x.parquet")
    for name, values in expected_columns(log, table).items():
        assert same_bits(found[name].to_numpy(), values), name
    told = found.schema.field("vehicle.wx_rad_s").metadata
    assert (told[b"unit"], told[b"frame"]) == (b"rad/s", b"B")
    assert found.schema.metadata[b"atlas_cueing.scenario"] == b"wild"
    assert found["status.state"].to_pylist()[10:12] == ["engaging", "running"]


@pytest.mark.parametrize("ending", ["csv", "npz", "mat", "parquet"])
def test_the_same_log_gives_the_same_bytes(tmp_path: Path, ending: str) -> None:
    files = [tmp_path / f"{k}.{ending}" for k in range(2)]
    for file in files:
        write_export(log_table(log_of()), file)
    assert files[0].read_bytes() == files[1].read_bytes()


def test_topics_are_chosen() -> None:
    assert log_table(log_of(), ["felt", "/vehicle"]).topics == ("vehicle", "felt")
    assert not log_table(log_of(), ["felt"]).statuses
    for topics, told in (
        (["lift"], r"--topics: /lift: allowed: /vehicle, /cue, /motion, /wheels, /felt, /status"),
        (["tf"], "/tf: shows the pose of /motion"),
        (["status"], "/status has no numbers, allowed: one of"),
    ):
        with pytest.raises(InputError, match=told):
            log_table(log_of(), topics)


def test_topics_of_unlike_times_stand_on_all_of_them() -> None:
    log = log_of()
    tables = dict(log.tables)
    tables["/felt"] = TopicColumns(TOPICS[4].fields, tables["/felt"].values[::2] + 0.05)
    mixed = Log(log.path, tables, {}, {}, ())
    table = log_table(mixed, ["vehicle", "felt"])
    assert len(table.time) == COUNT + COUNT // 2
    felt = next(c for c in table.columns if c.name == "felt.fx_m_s2")
    assert np.isnan(felt.values[0])
    assert felt.values[1] == mixed.column("/felt", "fx_m_s2")[0]
    still = TopicColumns(TOPICS[4].fields, np.zeros((3, len(TOPICS[4].fields))))
    with pytest.raises(LogError, match="/felt: time_s = 0 after 0, allowed: times that go on"):
        log_table(Log(log.path, {"/felt": still}, {}, {}, ()))


def test_a_name_of_another_ending_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"ends in \.csv, \.npz, \.mat, \.parquet"):
        write_export(log_table(log_of()), tmp_path / "x.xlsx")
    assert not list(tmp_path.iterdir())
