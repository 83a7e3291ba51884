"""A run on a platform with masses: /loads in its log, remarks or violations of its result."""

from pathlib import Path

import numpy as np
import pytest
from short_scenario import Load

from atlas_cueing.errors import InputError
from atlas_cueing.evaluation import RunColumns
from atlas_cueing.loads import platform_loads
from atlas_cueing.recording import read_log
from atlas_cueing.review import review_log
from atlas_cueing.run import evaluate_log, run_scenario
from atlas_cueing.scenario import load_scenario, presets

ROLLS = Path(__file__).parents[2] / "scenarios" / "f16_rolls.toml"
SLIPPING = ("cueing.method=force", "duration_s=6.5")
FINDING = 'platform.traction.report="finding"'


def kinematic_platform(folder: Path) -> str:
    """A file of atlas-2.9m without masses, as an override."""
    text = presets()["atlas-2.9m"].read_text().split("[[part]]")[0]
    lines = [line for line in text.splitlines() if not line.startswith(("inertia", "friction"))]
    (folder / "bare.toml").write_text("\n".join(lines))
    return "bare.toml"


def test_the_log_holds_what_the_motion_needs(load: Load, tmp_path: Path) -> None:
    scenario = load()
    log = read_log(run_scenario(scenario, tmp_path / "log.mcap").log)
    flight = RunColumns.of(log)
    loads = platform_loads(
        scenario.platform,
        q_WS=flight.motion_q_WS,
        w_WS_W=flight.motion_w_W,
        alpha_WS_W=flight.motion_alpha_W,
        a_WS_W=flight.motion_a_W,
    )
    for name, expected in (
        ("f", loads.drive),
        ("n", loads.normal),
        ("t", loads.torque),
        ("p", loads.power),
    ):
        np.testing.assert_allclose(log.vector("/loads", name), expected, rtol=1e-9, atol=1e-9)
    np.testing.assert_array_equal(log.column("/loads", "time_s"), flight.time)
    use = np.column_stack([log.column("/loads", f"use{k}") for k in (1, 2, 3)])
    np.testing.assert_allclose(use, loads.traction_use, rtol=1e-9, atol=1e-12)


def test_masses_change_no_other_topic(load: Load, tmp_path: Path) -> None:
    heavy = run_scenario(load(), tmp_path / "heavy.mcap")
    name = kinematic_platform(tmp_path)
    text = (tmp_path / "s.toml").read_text().replace('preset = "atlas-2.9m"', f'file = "{name}"')
    (tmp_path / "bare_s.toml").write_text(text)
    bare = run_scenario(load_scenario(tmp_path / "bare_s.toml"), tmp_path / "bare.mcap")
    with_loads, without = read_log(heavy.log), read_log(bare.log)
    assert set(with_loads.tables) - set(without.tables) == {"/loads"}
    for topic, table in without.tables.items():
        np.testing.assert_array_equal(with_loads.tables[topic].values, table.values)
    assert b"part" not in without.attachments["platform.toml"]
    assert not any("traction" in name or "torque" in name for name in bare.evaluation.metrics)
    others = {k: v for k, v in heavy.evaluation.metrics.items() if k in bare.evaluation.metrics}
    assert others == bare.evaluation.metrics
    assert bare.evaluation.remarks == ()


@pytest.mark.parametrize("report", ["remark", "finding"])
def test_slip_is_a_remark_or_a_violation(tmp_path: Path, report: str) -> None:
    scenario = load_scenario(ROLLS, [*SLIPPING, f"platform.traction.report={report}"])
    result = run_scenario(scenario, tmp_path / "log.mcap")
    found, review = result.evaluation, review_log(tmp_path / "log.mcap")
    lines = found.violations if report == "finding" else found.remarks
    assert any("a wheel slips on" in line for line in lines)
    assert (found.remarks, found.violations)[report == "remark"] == ()
    assert result.clean is review.clean is (report == "remark")
    assert found.metrics["traction_slip_share"] > 0.05
    assert any(": slip: " in note for note in review.notes) is (report == "remark")
    assert {finding.check for finding in review.findings} <= {"slip", "lift-off"}
    assert evaluate_log(tmp_path / "log.mcap", scenario.platform) == found
    assert review.metrics == found.metrics


def test_traction_is_kept_where_the_platform_says_so(tmp_path: Path) -> None:
    """The same flight that slips without; review finds it by its own arithmetic."""
    scenario = load_scenario(ROLLS, [*SLIPPING, "platform.traction.keep=true"])
    result = run_scenario(scenario, tmp_path / "log.mcap")
    review = review_log(tmp_path / "log.mcap")
    assert result.clean
    assert review.clean
    (line,) = result.evaluation.remarks
    assert line.startswith("traction kept: 0.7")
    assert any(note.startswith("traction kept: 0.7") for note in review.notes)
    assert result.evaluation.metrics["traction_use_max"] <= 1.0 / 1.25
    assert result.evaluation.metrics["lift_off_share"] == 0.0


def test_a_motion_that_was_to_keep_traction_and_did_not_is_found(tmp_path: Path) -> None:
    """A log that slips, judged as if its platform kept traction."""
    scenario = load_scenario(ROLLS, [*SLIPPING])
    run_scenario(scenario, tmp_path / "log.mcap")
    kept = load_scenario(ROLLS, [*SLIPPING, "platform.traction.keep=true"])
    found = evaluate_log(tmp_path / "log.mcap", kept.platform)
    assert any("a wheel slips on" in line for line in found.violations)


def test_a_first_pose_that_is_not_safe_at_rest_writes_nothing(tmp_path: Path) -> None:
    """The cabin, of 220 kg, hangs 1.2 m off the centre."""
    text = presets()["atlas-2.9m"].read_text()
    (tmp_path / "p.toml").write_text(
        text.replace("[0.0, 0.0, -0.1]", "[1.2, 0.0, -0.1]").replace(
            "margin = 1.25", "keep = true\nmargin = 1.25"
        )
    )
    flight = ROLLS.read_text().replace('preset = "atlas-2.9m"', 'file = "p.toml"')
    (tmp_path / "s.toml").write_text(flight)
    with pytest.raises(InputError, match=r"wheel\.\d: drive force .* N, allowed: at most"):
        run_scenario(load_scenario(tmp_path / "s.toml", ["duration_s=1"]), tmp_path / "log.mcap")
    assert not list(tmp_path.glob("log.mcap*"))


def test_without_the_key_it_is_in_no_log(load: Load, tmp_path: Path) -> None:
    log = run_scenario(load(), tmp_path / "log.mcap").log
    assert b"keep" not in read_log(log).attachments["platform.toml"]


def test_a_weak_motor_is_a_violation(tmp_path: Path) -> None:
    scenario = load_scenario(ROLLS, [*SLIPPING, "platform.drive.torque_n_m=100"])
    result = run_scenario(scenario, tmp_path / "log.mcap")
    (line,) = result.evaluation.violations
    assert line.startswith("wheel_torque_max_n_m = ")
    assert {finding.check for finding in review_log(tmp_path / "log.mcap").findings} == {"limit"}


def test_recording_in_chunks_of_any_length_is_the_same(load: Load, tmp_path: Path) -> None:
    logs = []
    for ticks in (7, 512):
        path = tmp_path / f"{ticks}.mcap"
        run_scenario(load(f"recording.chunk_ticks={ticks}"), path)
        logs.append(read_log(path).tables["/loads"].values)
    np.testing.assert_allclose(*logs, rtol=1e-12, atol=1e-12)
