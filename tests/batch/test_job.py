from pathlib import Path

from atlas_cueing.batch.job import Job, RunLimits

from .sweeping import order, planned


def test_an_order_survives_its_line(tmp_path: Path) -> None:
    sent = order(planned(tmp_path)[0], tmp_path, RunLimits(12.5, 3.0))
    line = sent.to_line()
    assert line.count(b"\n") == 1
    assert line.endswith(b"\n")
    assert Job.from_line(line) == sent


def test_bytes_of_any_kind_go_along(tmp_path: Path) -> None:
    sent = Job("r", str(tmp_path), {"x.xml": bytes(range(256)).decode("latin-1")}, RunLimits())
    assert Job.from_line(sent.to_line()).files["x.xml"].encode("latin-1") == bytes(range(256))
