"""Logs cut and damaged on purpose: every complete chunk comes back, and what did not is told."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError, LogError, OutputError
from atlas_cueing.recording import read_log
from atlas_cueing.review import advice, recover_log, review_log

from .conftest import fly

CHUNK = 64  # ticks


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A clean log of twelve chunks, the last one short."""
    return fly(tmp_path_factory.mktemp("chunks"), f"recording.chunk_ticks={CHUNK}")


def chunk_starts(log: Path) -> list[int]:
    """Where each chunk record starts, by the words it holds.

    As the format has it, not as the code does.
    """
    data, starts, place = log.read_bytes(), [], 0
    while (place := data.find(b"\x04\0\0\0zstd", place + 1)) >= 0:
        starts.append(place - 37)
    starts = [start for start in starts if data[start] == 6]
    assert len(starts) == 12
    return starts


def damaged(log: Path, folder: Path, change: Callable[[bytearray], None]) -> Path:
    """A copy with its bytes changed; fails if they were not."""
    data = bytearray(log.read_bytes())
    change(data)
    assert bytes(data) != log.read_bytes()
    (folder / "broken.mcap").write_bytes(data)
    return folder / "broken.mcap"


def flip(place: int) -> Callable[[bytearray], None]:
    def change(data: bytearray) -> None:
        data[place] ^= 0x55

    return change


def check_same(recovered: Path, log: Path, ticks: np.ndarray) -> None:
    """All columns of `recovered` are those of `log` at `ticks`."""
    one, whole = read_log(recovered), read_log(log)
    for topic, table in whole.tables.items():
        assert np.array_equal(one.tables[topic].values, table.values[ticks]), topic
    assert one.attachments == whole.attachments


@pytest.mark.parametrize("into", [1, 100, -1])
def test_a_cut_log(log: Path, tmp_path: Path, into: int) -> None:
    """Cut within the fifth chunk, or a byte before it: four come back."""
    cut = chunk_starts(log)[4] + into
    broken = damaged(log, tmp_path, lambda data: data.__delitem__(slice(cut, None)))
    assert advice(broken).startswith("4 chunks are whole; try: atlas-cueing recover ")
    result = recover_log(broken, tmp_path / "fixed.mcap")
    assert result.ticks == 4 * CHUNK
    assert result.seconds == pytest.approx((4 * CHUNK - 1) / 120.0)
    assert result.lost == (
        f"after {(4 * CHUNK - 1) / 120.0:.6f} s: whatever there was; the log has no end",
    )
    check_same(tmp_path / "fixed.mcap", log, np.arange(4 * CHUNK))
    metadata = read_log(tmp_path / "fixed.mcap").metadata
    assert (metadata["scenario"], metadata["method"], metadata["platform"]) == (
        "roll",
        "blend",
        "atlas-2.9m",
    )
    assert (metadata["result"], metadata["reason"]) == ("recovered", result.lost[0])
    assert [finding.check for finding in review_log(tmp_path / "fixed.mcap").findings] == ["result"]


@pytest.mark.parametrize(
    "place",
    [60, 9 + 3, 3, 0, 37, 9 + 26],
    ids=["data", "time", "length", "opcode", "compression", "crc"],
)
def test_a_damaged_chunk_in_the_middle(log: Path, tmp_path: Path, place: int) -> None:
    """Wherever the third chunk is damaged, the others are recovered."""
    broken = damaged(log, tmp_path, flip(chunk_starts(log)[2] + place))
    with pytest.raises(LogError):
        read_log(broken)
    result = recover_log(broken, tmp_path / "fixed.mcap")
    ticks = np.arange(721)
    if place == 9 + 3:  # the chunk's own note of its first time, which is made anew
        assert result.lost == ()
    else:
        ticks = np.delete(ticks, slice(2 * CHUNK, 3 * CHUNK))
        assert result.lost == (
            f"{(2 * CHUNK - 1) / 120:.6f} to {3 * CHUNK / 120:.6f} s: {CHUNK / 120:.6f} s of ticks",
        )
        assert (
            read_log(tmp_path / "fixed.mcap").metadata["reason"]
            == f"{result.lost[0]}; its result was 'ok'"
        )
    check_same(tmp_path / "fixed.mcap", log, ticks)


def test_the_first_chunk_is_lost(log: Path, tmp_path: Path) -> None:
    result = recover_log(
        damaged(log, tmp_path, flip(chunk_starts(log)[0] + 60)), tmp_path / "fixed.mcap"
    )
    assert result.lost == (f"before {CHUNK / 120:.6f} s: everything",)


def test_a_whole_log_is_copied(log: Path, tmp_path: Path) -> None:
    result = recover_log(log, tmp_path / "fixed.mcap")
    assert (result.lost, result.ticks) == ((), 721)
    assert (tmp_path / "fixed.mcap").read_bytes() == log.read_bytes()
    assert result.to_json() == {
        "log": str(tmp_path / "fixed.mcap"),
        "ticks": 721,
        "recovered_s": result.seconds,
        "lost": [],
    }


def test_a_damaged_end(log: Path, tmp_path: Path) -> None:
    """The summary is made anew; all ticks are there."""
    place = len(log.read_bytes()) - 30
    result = recover_log(damaged(log, tmp_path, flip(place)), tmp_path / "fixed.mcap")
    assert result.ticks == 721
    check_same(tmp_path / "fixed.mcap", log, np.arange(721))


def test_a_damaged_scenario_is_not_passed_on(log: Path, tmp_path: Path) -> None:
    """Attachments are checksummed: a changed limit would judge the log by another platform."""
    place = log.read_bytes().index(b"radius_m")
    result = recover_log(damaged(log, tmp_path, flip(place)), tmp_path / "fixed.mcap")
    assert result.ticks == 721
    assert "platform.toml" not in read_log(tmp_path / "fixed.mcap").attachments
    assert result.lost == ("no ticks; the damage is outside the complete chunks",)
    with pytest.raises(LogError, match=r"does not hold platform\.toml"):
        review_log(tmp_path / "fixed.mcap")


def test_a_lost_description(log: Path, tmp_path: Path) -> None:
    """Cut before the summary, and damaged in the only description left of a channel."""
    place, cut = log.read_bytes().index(b"/motion"), chunk_starts(log)[5]

    def change(data: bytearray) -> None:
        del data[cut:]
        data[place - 15 : place] = bytes(15)

    with pytest.raises(LogError, match="description of channel"):
        recover_log(damaged(log, tmp_path, change), tmp_path / "fixed.mcap")


def test_many_random_hits(log: Path, tmp_path: Path) -> None:
    """Whatever is hit, what comes back is true, and the advice never fails."""
    rng, whole = np.random.default_rng(5), read_log(log).tables["/motion"].values
    recovered = 0
    for _ in range(40):
        places = rng.integers(0, log.stat().st_size, 3)

        def change(data: bytearray, places: np.ndarray = places) -> None:
            for place in places:
                data[place] ^= int(rng.integers(1, 256))

        broken = damaged(log, tmp_path, change)
        advice(broken)
        try:
            recover_log(broken, tmp_path / "fixed.mcap")
        except LogError:
            continue
        recovered += 1
        values = read_log(tmp_path / "fixed.mcap").tables["/motion"].values
        ticks = np.rint(values[:, 0] * 120).astype(int)
        assert np.array_equal(values, whole[ticks])
    assert recovered > 30


def test_nothing_to_recover(tmp_path: Path) -> None:
    for content in (b"", b"\x89MCAP0\r\n", b"no log at all " * 100):
        (tmp_path / "nothing.mcap").write_bytes(content)
        with pytest.raises(LogError, match="nothing to recover"):
            recover_log(tmp_path / "nothing.mcap", tmp_path / "fixed.mcap")
        assert advice(tmp_path / "nothing.mcap") == ""
    assert not (tmp_path / "fixed.mcap").exists()
    with pytest.raises(InputError, match="no such file"):
        recover_log(tmp_path / "missing.mcap", tmp_path / "fixed.mcap")
    assert advice(tmp_path / "missing.mcap") == ""


def test_nowhere_to_write(log: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="No such file or directory"):
        recover_log(log, tmp_path / "no" / "fixed.mcap")


def test_the_part_of_a_killed_run_can_be_recovered_under_its_own_name(
    log: Path, tmp_path: Path
) -> None:
    """The temporary file that recover writes must not be the log it reads."""
    part = tmp_path / "flight.mcap.part"
    part.write_bytes(log.read_bytes()[: chunk_starts(log)[7]])
    before = part.read_bytes()
    recover_log(part, tmp_path / "flight.mcap")
    assert part.read_bytes() == before
    assert len(read_log(tmp_path / "flight.mcap").column("/motion", "time_s")) == 7 * CHUNK
    assert sorted(path.name for path in tmp_path.iterdir()) == ["flight.mcap", "flight.mcap.part"]
