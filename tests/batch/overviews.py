"""Pages of made-up batches."""

from collections.abc import Mapping

from atlas_cueing.batch.overview import overview

METRIC, ANGLE = "force_rms_m_s2", "direction_rms_rad"

SAME = {"scenario": "short", "vehicle": "c1722", "method": "blend", "platform": "atlas-2.9m"}

ROW = {
    **SAME,
    "run": "short-c1722-blend-0123456789ab",
    "result": "ok",
    "log": "a.mcap",
    METRIC: 1.25,
    ANGLE: 0.5,
}

FAILED = {**SAME, "run": "b-2", "log": "", "result": "vehicle_failed", "reason": "it <fell>"}

Row = Mapping[str, object]


def page(
    *rows: Row,
    settings: tuple[str, ...] = (),
    files: tuple[str, ...] = (),
    metrics: tuple[str, ...] = (METRIC,),
) -> str:
    return overview(rows, settings, metrics, "mine & yours", files)
