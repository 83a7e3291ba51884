import sys
from math import inf
from pathlib import Path

import pytest

from atlas_cueing.batch.plan import plan
from atlas_cueing.errors import InputError

from .sweeping import SWEEP, planned

planning = sys.modules[plan.__module__]  # its name is the function's, too


def test_sweeps_files_and_folders(tmp_path: Path) -> None:
    folder = tmp_path / "in"
    folder.mkdir()
    runs = planned(folder)
    (folder / "one.toml").write_text(SWEEP.split("[sweep]")[0].replace('"short"', '"one"'))
    assert [run.scenario.file.cueing.method for run in runs] == [
        "blend",
        "attitude",
        "force",
        "classical",
    ]
    found = plan([folder])
    assert [run.source.name for run in found] == ["one.toml", *["sweep.toml"] * 4]
    assert [run.settings for run in found[:2]] == [{}, {"cueing.method": "blend"}]
    assert [run.id for run in plan([folder / "sweep.toml", folder])] == [
        run.id for run in [*runs, found[0]]
    ]


def test_the_same_run_is_planned_once(tmp_path: Path) -> None:
    assert len(planned(tmp_path, 'sweep.cueing.method=["blend", "force", "blend"]')) == 2
    assert len(planned(tmp_path, "cueing.method=blend")) == 1


def test_mistakes_of_all_files_together_before_anything(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(SWEEP.replace("0.25", "-1"))
    (tmp_path / "b.toml").write_text(SWEEP.replace("c1722", "none"))
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError) as refusal:
        plan([tmp_path / "a.toml", tmp_path / "b.toml", tmp_path / "empty", tmp_path / "gone.toml"])
    lines = [
        line.removeprefix(f"{tmp_path}/").split(" = ")[0]
        for line in str(refusal.value).splitlines()
    ]
    assert lines[:2] == ["a.toml: duration_s", "b.toml: vehicle.script"]
    assert [line.split(": ")[0] for line in lines[2:]] == ["empty", "gone.toml"]


def test_a_platform_that_cannot_be_driven_is_refused_before_anything(tmp_path: Path) -> None:
    same = "\n".join(
        f"platform.wheel.{i}.contact = [[1, 0, 0]]\nplatform.wheel.{i}.drive = [[0, 1, 0]]"
        for i in (0, 1)
    )
    text = SWEEP + same
    with pytest.raises(
        InputError, match=r"sweep\.toml: --set: wheel: platform .* kinematic slip condition"
    ):
        planned(tmp_path, text=text)


def test_what_spoils_many_runs_is_told_without_checking_them_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checked = []
    build = planning.build_pipeline
    monkeypatch.setattr(planning, "MOST_REFUSED", 3)
    monkeypatch.setattr(
        planning,
        "build_pipeline",
        lambda scenario, step: (checked.append(step), build(scenario, step)),
    )
    same = "\n".join(
        f"platform.wheel.{i}.contact = [[1, 0, 0]]\nplatform.wheel.{i}.drive = [[0, 1, 0]]"
        for i in (0, 1)
    )
    many = "\ndraws = 20\nplatform.sphere.radius_m = { low = 1, high = 2 }\n"
    with pytest.raises(InputError, match="kinematic slip condition"):
        planned(tmp_path, text=SWEEP + same + many)
    assert len(checked) == 3


def test_who_asks_for_many_runs_is_told_before_they_are_checked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[tuple[str, int]] = []
    (tmp_path / "sweep.toml").write_text(SWEEP)
    monkeypatch.setattr(
        planning, "run_id", lambda _: pytest.fail("checked before") if not told else "id"
    )
    monkeypatch.setattr(planning, "MANY", 4)
    plan([tmp_path], checking=lambda file, runs: told.append((file.name, runs)))
    assert told == [("sweep.toml", 4)]
    monkeypatch.setattr(planning, "MANY", 5)
    plan([tmp_path], checking=lambda *_: pytest.fail("these are few"))


def test_a_name_too_long_for_the_disk(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="File name too long"):
        plan([tmp_path / ("x" * 5000)])


def test_how_long_it_may_take(tmp_path: Path) -> None:
    """c1722 states 200 s at 120 Hz; the limits are the script's end and the scenario's."""
    short, *_ = planned(tmp_path)
    assert (short.duration, short.step) == (0.25, pytest.approx(1 / 120, rel=1e-3))
    script, *_ = planned(tmp_path, "duration_s=86400")
    assert script.duration == pytest.approx(200.0)
    assert script.ticks == pytest.approx(200.0 * 120.0, rel=1e-3)
    faster, *_ = planned(tmp_path, "vehicle.rate_hz=1000")
    assert faster.step == 0.001
    unknown, *_ = planned(
        tmp_path, "vehicle.script=unitconversions", text=SWEEP.replace("duration_s = 0.25", "")
    )
    assert (unknown.duration, unknown.ticks) == (None, inf)


def test_a_script_that_states_nonsense_is_planned_and_fails_later(tmp_path: Path) -> None:
    (tmp_path / "odd.xml").write_text('<runscript><run start="x" end="1e" dt="-3"/></runscript>')
    planned(tmp_path)
    odd, *_ = plan([tmp_path / "sweep.toml"], ["vehicle.script=odd.xml"], trust_models=True)
    assert (odd.duration, odd.step) == (0.25, pytest.approx(1 / 120))
