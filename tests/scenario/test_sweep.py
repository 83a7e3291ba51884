from pathlib import Path

import pytest

from atlas_cueing.cueing import CAUSAL_METHODS
from atlas_cueing.errors import ScenarioError
from atlas_cueing.scenario import Variant, load_scenario, load_variants, scenario_files
from atlas_cueing.vehicles import own_scripts

from .texts import AIRCRAFT, SCRIPT

SCENARIOS = Path(__file__).parents[2] / "scenarios"
BLEND = SCRIPT + '[cueing]\nmethod = "blend"\n'


def variants(folder: Path, sweep: str, *overrides: str, text: str = BLEND) -> list[Variant]:
    path = folder / "s.toml"
    path.write_text(f"{text}\n[sweep]\n{sweep}")
    return load_variants(path, overrides)


def settings(
    folder: Path, sweep: str, *overrides: str, text: str = BLEND
) -> list[dict[str, object]]:
    return [variant.settings for variant in variants(folder, sweep, *overrides, text=text)]


def mistakes(folder: Path, sweep: str, *overrides: str, text: str = BLEND) -> list[str]:
    with pytest.raises(ScenarioError) as refusal:
        variants(folder, sweep, *overrides, text=text)
    return str(refusal.value).replace(f"{folder}/", "").splitlines()


def test_a_file_without_a_sweep_is_one_run(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT)
    (only,) = load_variants(tmp_path / "s.toml", ["cueing.method=force"])
    assert only.settings == {}
    assert (
        only.scenario.attachments()
        == load_scenario(tmp_path / "s.toml", ["cueing.method=force"]).attachments()
    )


def test_a_grid_has_every_combination_in_the_order_of_the_file(tmp_path: Path) -> None:
    found = variants(
        tmp_path, 'cueing.method = ["force", "blend"]\ncueing.force_gain = [1, 0.5, [1, 0, 1]]'
    )
    assert [tuple(variant.settings.values()) for variant in found] == [
        *(("force", 1), ("force", 0.5), ("force", [1, 0, 1])),
        *(("blend", 1), ("blend", 0.5), ("blend", [1, 0, 1])),
    ]
    assert [variant.scenario.file.cueing.method for variant in found] == ["force"] * 3 + [
        "blend"
    ] * 3
    assert found[5].scenario.file.cueing.force_gain == (1.0, 0.0, 1.0)
    assert set(found[0].settings) == {"cueing.method", "cueing.force_gain"}


def test_a_run_of_a_sweep_is_the_scenario_with_its_settings(tmp_path: Path) -> None:
    """What a sweep resolves to has no trace of it, so that its log alone can be flown again."""
    second = variants(tmp_path, "platform.wheel_limits.speed_rad_s = [31, 20]")[1].scenario
    (tmp_path / "plain.toml").write_text(BLEND)
    assert (
        second.attachments()
        == load_scenario(
            tmp_path / "plain.toml", ["platform.wheel_limits.speed_rad_s=20"]
        ).attachments()
    )
    assert "sweep" not in second.scenario_toml()


def test_items_of_lists_are_swept_by_number(tmp_path: Path) -> None:
    found = variants(tmp_path, "vehicle.input.1.value = [0.25, 0.75]", text=AIRCRAFT)
    assert [variant.scenario.file.vehicle.input[1].value for variant in found] == [0.25, 0.75]
    assert [variant.scenario.file.vehicle.input[0].value for variant in found] == [-0.2, -0.2]


def test_patterns_are_names_known_here_and_now(tmp_path: Path) -> None:
    assert {run["vehicle.script"] for run in settings(tmp_path, 'vehicle.script = "*"')} == set(
        own_scripts()
    )
    assert [
        run["platform.preset"] for run in settings(tmp_path, 'platform.preset = "atlas-?.?m"')
    ] == [
        "atlas-1.5m",
        "atlas-2.9m",
    ]
    assert {run["cueing.method"] for run in settings(tmp_path, 'cueing.method = "*"')} == set(
        CAUSAL_METHODS
    )
    found = settings(tmp_path, 'vehicle.aircraft = "c172*"', text=AIRCRAFT)
    assert {run["vehicle.aircraft"] for run in found} == {"c172p", "c172r", "c172x"}


DRAWS = "draws = 50\nseed = 3\ncueing.align_rate_deg_s = { low = 1.0, high = 9.0 }\n"


def test_draws_lie_in_their_range_and_come_again(tmp_path: Path) -> None:
    drawn = [run["cueing.align_rate_deg_s"] for run in settings(tmp_path, DRAWS)]
    assert len(set(drawn)) == 50
    assert all(isinstance(rate, float) and 1.0 <= rate <= 9.0 for rate in drawn)
    assert min(map(float, map(str, drawn))) < 2.0 < 8.0 < max(map(float, map(str, drawn)))
    assert [run["cueing.align_rate_deg_s"] for run in settings(tmp_path, DRAWS)] == drawn
    assert [
        run["cueing.align_rate_deg_s"]
        for run in settings(tmp_path, DRAWS.replace("seed = 3", "seed = 4"))
    ] != drawn
    assert [
        run["cueing.align_rate_deg_s"] for run in settings(tmp_path, DRAWS, "sweep.draws=7")
    ] == drawn[:7]


def test_every_point_of_the_grid_gets_the_same_draws_and_other_ranges_change_nothing(
    tmp_path: Path,
) -> None:
    alone = [run["cueing.align_rate_deg_s"] for run in settings(tmp_path, DRAWS)]
    more = (
        'cueing.method = ["blend", "force"]\ncueing.align_time_s = { low = 0.1, high = 10.0, log ='
        " true }\n"
    )
    both = settings(tmp_path, more + DRAWS)
    assert len(both) == 100
    for method, half in (("blend", both[:50]), ("force", both[50:])):
        assert [run["cueing.align_rate_deg_s"] for run in half] == alone
        assert {run["cueing.method"] for run in half} == {method}
    times = [float(str(run["cueing.align_time_s"])) for run in both[:50]]
    assert all(0.1 <= time <= 10.0 for time in times)
    assert 10 < sum(time < 1.0 for time in times) < 40  # half of them below the geometric middle


def test_two_ranges_are_drawn_independently(tmp_path: Path) -> None:
    both = settings(tmp_path, DRAWS + "cueing.align_time_s = { low = 1.0, high = 9.0 }")
    assert all(run["cueing.align_rate_deg_s"] != run["cueing.align_time_s"] for run in both)


def test_set_takes_a_key_out_of_the_sweep(tmp_path: Path) -> None:
    sweep = 'vehicle.script = "*"\ncueing.method = ["blend", "attitude"]'
    found = variants(tmp_path, sweep, "vehicle.script=ball")
    assert [variant.settings for variant in found] == [
        {"cueing.method": "blend"},
        {"cueing.method": "attitude"},
    ]
    assert {variant.scenario.file.vehicle.script for variant in found} == {"ball"}
    assert len(settings(tmp_path, sweep, "vehicle.script=ball", "cueing.method=force")) == 1
    assert settings(tmp_path, sweep, "vehicle.script=ball", 'sweep.cueing.method=["force"]') == [
        {"cueing.method": "force"}
    ]


@pytest.mark.parametrize(
    ("sweep", "said"),
    [
        ("", "s.toml: sweep: nothing to sweep; allowed: a list of values"),
        ("cueing.force_gain = 3", "s.toml: sweep.cueing.force_gain = 3: allowed: a list of values"),
        (
            "cueing.force_gain = []",
            "s.toml: sweep.cueing.force_gain = []: allowed: a list of values",
        ),
        ('vehicle.script = "z*"', "s.toml: sweep.vehicle.script = 'z*': no such name; allowed: "),
        (
            'vehicle.script = "c172"',
            "s.toml: sweep.vehicle.script = 'c172': no such name; did you mean 'c17",
        ),
        ('name = "*"', "s.toml: sweep.name = '*': allowed: a list of values"),
        (
            "draws = 0\nduration_s = { low = 1, high = 2 }",
            "s.toml: sweep.draws = 0: allowed: a whole number, 1 <= value <= 10000",
        ),
        ("seed = 0.5\nduration_s = [1, 2]", "s.toml: sweep.seed = 0.5: allowed: a whole number"),
        ("draws = 3\nduration_s = [1, 2]", "s.toml: sweep: ranges and draws go together"),
        ("duration_s = { low = 1, high = 2 }", "s.toml: sweep: ranges and draws go together"),
        (
            "draws = 3\nduration_s = { low = 2, high = 1 }",
            "s.toml: sweep.duration_s: allowed: { low = a number",
        ),
        (
            "draws = 3\nduration_s = { low = 0, high = 1, log = true }",
            "s.toml: sweep.duration_s: allowed: { low = a number",
        ),
        (
            "draws = 3\nduration_s = { low = 0 }",
            "s.toml: sweep.duration_s: allowed: { low = a number",
        ),
        (
            "draws = 3\nduration_s = { low = 0, high = inf }",
            "s.toml: sweep.duration_s: allowed: { low = a number",
        ),
        (
            "draws = 3\nduration_s = { low = 0, high = 1, step = 2 }",
            "s.toml: sweep.duration_s: allowed: { low = a number",
        ),
        (
            "draws = 10000\nduration_s = { low = 1, high = 2 }\nname = ['a', 'b']",
            "s.toml: sweep: 20000 runs, allowed: ",
        ),
        (
            "duration_s = [0.1, -1]",
            "s.toml: sweep.duration_s = -1: allowed: a number, 0 < value <= 86400",
        ),
        (
            "cueing.rotation_gain = [[1, 1, -1]]",
            "s.toml: sweep.cueing.rotation_gain.2 = -1: allowed: a number",
        ),
        (
            "platform.wheel_limits.speed_rad_s = [1, 0]",
            "s.toml: sweep.platform.wheel_limits.speed_rad_s = 0: allowed: a number",
        ),
        (
            "cueing.align_rte_deg_s = [1]",
            "s.toml: sweep.cueing.align_rte_deg_s = 1: unknown key; did you mean 'align_rate_",
        ),
    ],
)
def test_a_mistake_says_where_and_what_is_allowed(tmp_path: Path, sweep: str, said: str) -> None:
    lines = mistakes(tmp_path, sweep)
    assert lines[0].startswith(said), lines


def test_a_sweep_that_is_no_table(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(f"sweep = 3\n{SCRIPT}")
    with pytest.raises(ScenarioError, match=r"s\.toml: sweep = 3: allowed: a table"):
        load_variants(tmp_path / "s.toml")
    (tmp_path / "s.toml").write_text(SCRIPT)
    with pytest.raises(ScenarioError, match=r"--set: sweep: nothing to sweep"):
        load_variants(tmp_path / "s.toml", ["sweep.seed=1"])


def test_a_mistake_of_the_file_is_said_once_and_not_for_every_run(tmp_path: Path) -> None:
    lines = mistakes(
        tmp_path, 'cueing.method = "*"\nduration_s = [1, 2]', text=SCRIPT.replace("name", "nam")
    )
    assert [line.split(": ")[1] for line in lines] == ["nam = 'short'", "name"]


def test_runs_that_differ_in_their_platform_have_one_scenario(tmp_path: Path) -> None:
    """Which is checked once, and not for every run."""
    runs = variants(
        tmp_path, "draws = 3\nplatform.wheel_limits.speed_rad_s = { low = 10.0, high = 20.0 }"
    )
    assert len({id(run.scenario.file) for run in runs}) == 1
    assert len({run.scenario.platform.wheel_limits.speed_rad_s for run in runs}) == 3
    runs = variants(
        tmp_path, 'cueing.method = ["blend", "force"]\nplatform.wheel_limits.speed_rad_s = [10, 20]'
    )
    assert [run.scenario.file.cueing.method for run in runs] == ["blend", "blend", "force", "force"]


def test_values_that_are_equal_and_not_the_same_are_told_apart(tmp_path: Path) -> None:
    (line,) = mistakes(tmp_path, "cueing.align_rate_deg_s = [1, 1.0, true]")
    assert "s.toml: sweep.cueing.align_rate_deg_s = true: allowed: a number" in line


def test_a_thousand_wrong_runs_are_cut_short(tmp_path: Path) -> None:
    values = ", ".join(str(-i - 1) for i in range(1000))
    assert len(mistakes(tmp_path, f"duration_s = [{values}]")) == 50


def test_run_refuses_a_sweep(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(f"{SCRIPT}\n[sweep]\nduration_s = [1, 2]")
    with pytest.raises(
        ScenarioError, match=r"s\.toml: sweep: a sweep stands for many runs; .* atlas-cueing batch"
    ):
        load_scenario(tmp_path / "s.toml")


def test_scenario_files_of_a_folder(tmp_path: Path) -> None:
    for name in ("b.toml", "a.toml"):
        (tmp_path / name).write_text(SCRIPT)
    (tmp_path / "platform.toml").write_text('name = "p"\n[sphere]\nradius_m = 1.0')
    (tmp_path / "broken.toml").write_text("[")
    (tmp_path / "notes.txt").write_text("")
    assert [path.name for path in scenario_files(tmp_path)] == ["a.toml", "b.toml", "broken.toml"]
    (tmp_path / "empty").mkdir()
    with pytest.raises(ScenarioError, match="no scenario files"):
        scenario_files(tmp_path / "empty")


@pytest.mark.parametrize("path", scenario_files(SCENARIOS), ids=lambda path: path.stem)
def test_every_bundled_scenario_loads(path: Path) -> None:
    found = load_variants(path)
    assert found
    assert all(variant.scenario.name == path.stem for variant in found)


def test_the_collection_is_everything_that_jsbsim_ships() -> None:
    found = load_variants(SCENARIOS / "jsbsim_collection.toml")
    assert len(found) == 2 * len(own_scripts()) > 100
    assert {variant.scenario.file.cueing.method for variant in found} == {"blend", "attitude"}
