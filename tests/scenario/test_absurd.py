"""Files that are large in the wrong place: few and short messages.

No work grows with the mistakes.
"""

from pathlib import Path

import pytest

from atlas_cueing.errors import Mistake, ScenarioError
from atlas_cueing.scenario import load_scenario, load_variants, presets, reading, sweep
from atlas_cueing.scenario.mistakes import MOST_SHOWN, shown
from atlas_cueing.scenario.reading import LARGEST_FILE, LONGEST_KEY, MOST_KEYS, parse_toml
from atlas_cueing.scenario.sweep import MAX_RUNS

from .texts import SCRIPT

FLOWN = """
name = "s"
duration_s = 1
[platform]
preset = "atlas-2.9m"
[vehicle]
aircraft = "c172x"
initial = { altitude_m = 1000, airspeed_m_s = 50 }
"""
AIRCRAFT = SCRIPT.replace('script = "c1722"', 'aircraft = "f16"\ninput = [{}]')


def mistakes(path: Path, text: str, load: object = load_scenario) -> tuple[Mistake, ...]:
    """Of a file that is small enough to be looked at, and its message, too."""
    path.write_text(text)
    assert path.stat().st_size <= LARGEST_FILE, "refused for its size: nothing else is tested"
    with pytest.raises(ScenarioError) as refusal:
        load(path)  # type: ignore[operator]
    assert len(str(refusal.value)) < 40_000
    return refusal.value.mistakes


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "s.toml"


def test_of_thousands_of_mistakes_some_are_shown_and_the_rest_counted(file: Path) -> None:
    found = mistakes(file, "".join(f"k{i} = 1\n" for i in range(5000)) + SCRIPT)
    assert len(found) == MOST_SHOWN + 1
    assert [mistake.key for mistake in found[:3]] == ["k0", "k1", "k2"]
    assert str(found[-1]) == f"{file}: file: and 4900 more mistakes"


def test_as_many_as_are_shown_are_not_counted(file: Path) -> None:
    found = mistakes(file, "".join(f"k{i} = 1\n" for i in range(MOST_SHOWN)) + SCRIPT)
    assert len(found) == MOST_SHOWN
    assert all("unknown key" in mistake.allowed for mistake in found)


def test_broken_rules_are_counted_too(file: Path) -> None:
    signal = '[[vehicle.signal]]\naxis = "force_x"\nshape = "sine"\nduration_s = 1\n'
    text = (
        'name = "s"\n[platform]\npreset = "atlas-2.9m"\n[vehicle]\nsource = "signal"\n'
        + signal * 200
    )
    assert str(mistakes(file, text)[-1]).endswith("file: and 300 more mistakes")


def test_more_keys_than_any_scenario_has(file: Path) -> None:
    (found,) = mistakes(file, "".join(f"k{i}=1\n" for i in range(MOST_KEYS + 1)))
    assert str(found) == f"{file}: file: {MOST_KEYS + 1} keys, allowed: keys <= {MOST_KEYS}"
    nested = "a = [" + "{b = [{c = 1}]}," * (MOST_KEYS // 2) + "]"
    with pytest.raises(ScenarioError, match=f"{MOST_KEYS + 1} keys"):
        parse_toml(nested, "f.toml")
    assert len(parse_toml("".join(f"k{i}=1\n" for i in range(MOST_KEYS)), "f.toml")) == MOST_KEYS


@pytest.mark.parametrize(
    "name", ["k" * 200_000, '"' + "é" * (LONGEST_KEY + 1) + '"', "a.b." + "c" * (LONGEST_KEY + 1)]
)
def test_a_key_that_would_fill_the_screen(name: str) -> None:
    with pytest.raises(
        ScenarioError, match=f"a key is too long, allowed: length <= {LONGEST_KEY}"
    ) as refusal:
        parse_toml(f"{name} = 1", "f.toml")
    assert len(str(refusal.value)) < 300
    assert parse_toml("k" * LONGEST_KEY + " = 1", "f.toml")


def test_tables_without_end(file: Path) -> None:
    found, *_ = mistakes(file, AIRCRAFT.format("{}," * 60_000))
    assert (found.key, found.allowed) == (
        "vehicle.input",
        "60000 tables [[vehicle.input]], allowed: at most 5000",
    )


def test_a_list_of_topics_without_end(file: Path) -> None:
    (found,) = mistakes(file, SCRIPT + "[recording]\nskip = [" + '"x",' * 60_000 + "]\n")
    assert found.allowed == "allowed: a list of topics"


@pytest.mark.parametrize(
    ("text", "allowed"),
    [
        (
            "".join(f"cueing.k{i} = [1, 2, 3, 4, 5, 6, 7, 8]\n" for i in range(10)),
            "1073741824 runs, allowed: runs <= 10000; several files may share the rest",
        ),
        (
            "draws = 1000000000\nduration_s = { low = 1, high = 2 }\n",
            "allowed: a whole number, 1 <= value <= 10000",
        ),
        (
            "draws = 10000\n" + "".join(f"k{i} = {{ low = 1, high = 2 }}\n" for i in range(17)),
            "17 keys, allowed: keys <= 16",
        ),
        (f'vehicle.script = "{"*a" * 100_000}"\n', "a pattern is too long, allowed: length <= 200"),
    ],
    ids=["grid", "draws", "keys", "pattern"],
)
def test_sweeps_without_end_are_refused_before_any_run_is_made(
    file: Path, text: str, allowed: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(sweep, "resolve")
    found, *_ = mistakes(file, f"{SCRIPT}[sweep]\n{text}", load_variants)
    assert found.allowed == allowed


def test_a_sweep_in_which_every_run_is_wrong_is_given_up(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked_at = []
    resolve = sweep.resolve

    def counted(*arguments: object, **options: object) -> object:
        looked_at.append(1)
        return resolve(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(sweep, "resolve", counted)
    (found,) = mistakes(
        file, SCRIPT + "[sweep]\nduration_s = [" + "-1," * MAX_RUNS + "]\n", load_variants
    )
    assert "duration_s = -1" in str(found)
    assert len(looked_at) == sweep.MAX_SPOILT


def test_runs_of_a_long_file_are_fewer(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every run is checked before the first one flies, and takes as long as the file has keys."""
    events = "".join(
        f'[[vehicle.input]]\ntime_s = {i}\nproperty = "fcs/rudder-cmd-norm"\nvalue = 0\n'
        for i in range(200)
    )
    (found,) = mistakes(
        file, f"{FLOWN}{events}[sweep]\nduration_s = [{'1, ' * 900}]", load_variants
    )
    assert (
        found.allowed
        == "900 runs of a file of 610 keys, allowed: runs <= 819; several files may share the rest"
    )
    file.write_text(f"{FLOWN}{events}[sweep]\nduration_s = [{'1, ' * 819}]")
    monkeypatch.setattr(sweep, "resolve", lambda *_, **__: (_ for _ in ()).throw(LookedAtError))
    with pytest.raises(LookedAtError):
        load_variants(file)


def test_a_file_with_nothing_but_a_sweep(file: Path) -> None:
    found = mistakes(file, "[sweep]\nduration_s = [1, 2]", load_variants)
    assert [(mistake.key, mistake.allowed) for mistake in found][:1] == [("name", "missing")]


class LookedAtError(Exception):
    """A run was looked at."""


def test_a_platform_file_is_read_once_for_all_runs(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A wrong one, too: hundreds of times 256 kB would take a minute."""
    opened, read = [], reading.read_toml

    def counted(path: Path) -> dict[str, object]:
        opened.append(path.name)
        return read(path)

    monkeypatch.setattr(reading, "read_toml", counted)
    file.write_text(
        SCRIPT.replace('preset = "atlas-2.9m"', 'file = "p.toml"')
        + "[sweep]\nplatform.sphere.radius_m = [1, 2, 3]"
    )
    (file.parent / "p.toml").write_text("[")
    with pytest.raises(ScenarioError, match=r"p\.toml: TOML: not valid"):
        load_variants(file)
    assert opened == ["p.toml"]
    (file.parent / "p.toml").write_bytes(presets()["atlas-1.5m"].read_bytes())
    assert len(load_variants(file)) == 3
    assert opened == ["p.toml"] * 2


def test_runs_share_what_the_sweep_leaves_alone(file: Path) -> None:
    """Ten thousand runs of a file with a hundred inputs have to fit into 200 MB."""
    events = '[[vehicle.input]]\ntime_s = 1\nproperty = "fcs/rudder-cmd-norm"\nvalue = 0\n' * 3
    file.write_text(f"{FLOWN}{events}[sweep]\nduration_s = [1, 2, 3]")
    first, *others = [variant.scenario for variant in load_variants(file)]
    for other in others:
        assert other.platform is first.platform
        assert all(
            mine is yours
            for mine, yours in zip(first.file.vehicle.input, other.file.vehicle.input, strict=True)
        )


@pytest.mark.parametrize(
    "swept",
    [
        "vehicle.input.1.value = [1, 2, 3]",
        "vehicle.script = ['c1722', 'ball']",
        "vehicle.initial.pitch_deg = [1, 2]",
    ],
)
def test_sharing_changes_nothing(file: Path, swept: str) -> None:
    """Each run is what the file gives with that run's settings alone."""
    events = '[[vehicle.input]]\ntime_s = 1\nproperty = "fcs/rudder-cmd-norm"\nvalue = 0\n' * 3
    file.write_text(
        f"{FLOWN}{events}[sweep]\n{swept}\nplatform.rider.head_m = [[0, 0, 0], [0, 0, 0.5]]"
    )
    runs = load_variants(file, ["cueing.method=force"])
    assert len(runs) >= 4
    file.write_text(FLOWN + events)
    for run in runs:
        settings = [f"{key}={value}" for key, value in run.settings.items()]
        assert run.scenario == load_scenario(file, ["cueing.method=force", *settings])


def test_what_one_run_leaves_out_the_next_one_has(file: Path) -> None:
    """A file's own method has a parameter that the first run's method does not know."""
    own = FLOWN + '[cueing]\nmethod = "blend"\nalign_time_s = 7.0\n'
    file.write_text(own + '[sweep]\ncueing.method = ["attitude", "blend"]')
    first, second = [variant.scenario.file.cueing for variant in load_variants(file)]
    assert (first.method, second.method) == ("attitude", "blend")
    assert second.model_dump()["align_time_s"] == 7.0


def test_a_description_that_would_fill_every_log(file: Path) -> None:
    (found,) = mistakes(file, f'description = "{"x" * 2001}"\n{SCRIPT}')
    assert found.allowed == "allowed: a text of at most 2000 characters"
    file.write_text(f'description = "{"x" * 2000}"\n{SCRIPT}')
    assert len(load_scenario(file).file.description) == 2000


def test_every_wrong_choice_of_a_sweep_is_not_told(file: Path) -> None:
    found = mistakes(
        file, SCRIPT + "[sweep]\n" + "".join(f"k{i} = 1\n" for i in range(1000)), load_variants
    )
    assert len(found) == sweep.MAX_MISTAKES + 1
    assert str(found[-1]).endswith("and 951 more mistakes")


def test_dates_are_shown_as_they_are_written(file: Path) -> None:
    (found,) = mistakes(file, SCRIPT.replace("0.5", "1979-05-27"))
    assert found.value == "1979-05-27"
    assert shown(parse_toml("t = 07:32:00", "f.toml")["t"]) == "07:32:00"
