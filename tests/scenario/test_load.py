import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomli_w
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.cueing import CAUSAL_METHODS, METHODS
from atlas_cueing.errors import ScenarioError
from atlas_cueing.rotation import Vec3
from atlas_cueing.scenario import load_platform, load_scenario, presets
from atlas_cueing.scenario.load import Known
from atlas_cueing.scenario.overrides import apply_overrides, parse_overrides

from .conftest import Refused
from .texts import AIRCRAFT, SCRIPT


def written(folder: Path, text: str = SCRIPT) -> Path:
    path = folder / "s.toml"
    path.write_text(text)
    return path


def speed(folder: Path, *overrides: str) -> Vec3:
    return load_scenario(folder / "s.toml", overrides).platform.wheel_limit_values().speed


def test_platform_keys_go_over_the_presets(tmp_path: Path) -> None:
    written(tmp_path)
    assert speed(tmp_path) == (31.0,) * 3
    assert speed(tmp_path, "platform.wheel_limits.speed_rad_s=20") == (20.0,) * 3
    assert speed(tmp_path, "platform.wheel_limits.speed_rad_s=[31, 20, 10.5]") == (31.0, 20.0, 10.5)
    with pytest.raises(
        ScenarioError,
        match=r"^--set: platform\.wheel_limits\.speed_rad_s\.1 = 20: .* is not a table$",
    ):
        speed(tmp_path, "platform.wheel_limits.speed_rad_s.1=20")


def test_platform_file(tmp_path: Path) -> None:
    text = presets()["atlas-1.5m"].read_text().replace('"atlas-1.5m"', '"mine"')
    (tmp_path / "mine.toml").write_text(text)
    path = written(tmp_path, SCRIPT.replace('preset = "atlas-2.9m"', 'file = "mine.toml"'))
    assert load_scenario(path).platform.name == "mine"
    assert load_scenario(path, ["platform.preset=atlas-tabletop"]).platform.name == "atlas-tabletop"
    assert load_scenario(path, ["platform.name=other"]).platform.name == "other"


def test_mistakes_of_both_files_and_of_the_command_line_together(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        presets()["atlas-1.5m"].read_text().replace("radius_m = 0.75", "radius_m = -1")
    )
    path = written(
        tmp_path,
        SCRIPT.replace('preset = "atlas-2.9m"', 'file = "mine.toml"').replace("name", "nam"),
    )
    with pytest.raises(ScenarioError) as refusal:
        load_scenario(
            path,
            [
                "duration_s=abc",
                "platform.wheel_limits.speed_rad_s=0",
                "cueing.stage.bandwidth_hz=-1",
            ],
        )
    found = [(Path(mistake.file).name, mistake.key) for mistake in refusal.value.mistakes]
    assert found == [
        ("s.toml", "nam"),
        ("--set", "duration_s"),
        ("--set", "cueing.stage.bandwidth_hz"),
        ("s.toml", "name"),
        ("mine.toml", "sphere.radius_m"),
        ("--set", "platform.wheel_limits.speed_rad_s"),
    ]


def test_platform_mistakes_name_the_file(refused: Refused) -> None:
    assert refused(SCRIPT.replace('preset = "atlas-2.9m"', 'file = "none.toml"')) == [
        "none.toml: file: cannot be read: No such file or directory"
    ]
    (line,) = refused(SCRIPT.replace('preset = "atlas-2.9m"', 'file = "a\\nb"'))
    assert (
        line == r"bad.toml: platform.file = 'a\nb': allowed: path of a platform file, from the"
        r" scenario's folder"
    )
    both = SCRIPT.replace("[platform]", '[platform]\nfile = "none.toml"')
    assert refused(both) == ["bad.toml: platform: exactly one of preset and file"]
    assert refused(SCRIPT.replace('preset = "atlas-2.9m"', "")) == [
        "bad.toml: platform: exactly one of preset and file"
    ]
    assert refused(SCRIPT.split("[platform]")[0]) == ["bad.toml: platform: missing"]
    assert refused("platform = 3\n" + SCRIPT.split("[platform]")[0]) == [
        "bad.toml: platform = 3: allowed: a table"
    ]
    assert refused("") == [f"bad.toml: {key}: missing" for key in ("name", "vehicle", "platform")]


def test_another_method_leaves_the_files_own_keys_behind(tmp_path: Path) -> None:
    path = written(tmp_path, SCRIPT + "[cueing]\nmemory_s = 3.0\nforce_gain = 0.5")
    scenario = load_scenario(path, ["cueing.method=attitude", "cueing.return_time_s=4"])
    assert scenario.file.cueing.method == "attitude"
    assert scenario.file.cueing.force_gain == (0.5, 0.5, 0.5)
    with pytest.raises(ScenarioError, match=r"--set: cueing\.memory_s = 2: unknown key"):
        load_scenario(path, ["cueing.method=attitude", "cueing.memory_s=2"])


@pytest.mark.parametrize("method", [m for m in CAUSAL_METHODS if METHODS[m].parameters])
def test_any_method_from_the_command_line(tmp_path: Path, method: str) -> None:
    """From a file of another method; the keys that both have stay, the others are left behind."""
    keys = "rotation_gain = 0.5\nalign_time_s = 3.0\n[cueing.stage]\nonset_rad_s = 2"
    path = written(tmp_path, SCRIPT + f'[cueing]\nmethod = "blend"\n{keys}')
    cueing = load_scenario(path, [f"cueing.method={method}"]).file.cueing
    assert cueing.method == method
    assert cueing.rotation_gain == (0.5, 0.5, 0.5)
    assert cueing.stage.onset_rad_s == (2.0, 2.0, 2.0)
    other = load_scenario(
        path, [f"cueing.method={method}", "cueing.stage.onset_rad_s=[1,2,3]"]
    ).file.cueing
    assert other.stage.onset_rad_s == (1.0, 2.0, 3.0)


def test_a_wrong_key_is_not_left_behind(tmp_path: Path) -> None:
    path = written(tmp_path, SCRIPT + "[cueing]\nalign_tim_s = 3.0")
    with pytest.raises(ScenarioError, match="align_tim_s"):
        load_scenario(path, ["cueing.method=attitude"])


def test_an_unknown_method_from_the_command_line(tmp_path: Path) -> None:
    allowed = ", ".join(sorted([*METHODS, "FILE.py:CLASS"]))
    with pytest.raises(
        ScenarioError, match=rf"^--set: cueing\.method = 'washout': allowed: {allowed}$"
    ):
        load_scenario(written(tmp_path), ["cueing.method=washout"])


def test_inputs_from_the_command_line(tmp_path: Path) -> None:
    scenario = load_scenario(written(tmp_path, AIRCRAFT), ["vehicle.input.1.value=0.25"])
    assert [event.value for event in scenario.file.vehicle.input] == [-0.2, 0.25]


def test_platform_by_name_or_path(tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text(presets()["atlas-tabletop"].read_text())
    assert load_platform(str(tmp_path / "p.toml")) == load_platform("atlas-tabletop")
    with pytest.raises(
        ScenarioError,
        match=r"atlas-2.9: file: no such file or platform; did you mean 'atlas-2.9m'\?",
    ):
        load_platform("atlas-2.9")
    with pytest.raises(ScenarioError, match="no such file or platform"):
        load_platform("x" * 5000)  # which no file system looks for
    (tmp_path / "p.toml").write_text("name = 3")
    with pytest.raises(ScenarioError, match=r"p\.toml: name = 3"):
        load_platform(str(tmp_path / "p.toml"))


def test_a_platform_is_the_same_after_another_was_made_of_its_file() -> None:
    known, file = Known(), presets()["atlas-2.9m"]
    higher, mistakes = known.platform(file, {("rider", "head_m"): [0.0, 0.0, 0.5]})
    assert higher is not None and higher.head_S == (0.0, 0.0, 0.5)  # noqa: PT018
    assert mistakes == []
    assert known.platform(file, {}) == (load_platform("atlas-2.9m"), [])


@pytest.mark.parametrize("bad", ["", "a/b", "..", "x" * 101, "sp ace", "a\\u001b"])
def test_a_name_must_fit_a_file(refused: Refused, bad: str) -> None:
    (line,) = refused(SCRIPT.replace('"short"', f'"{bad}"'))
    assert line.startswith("bad.toml: name = ")


scalars = st.one_of(
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=5),
    st.sampled_from(["blend", "c1722", "f16", "/tf"]),
)
anything = st.recursive(
    scalars,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=3), inner, max_size=2)
    ),
    max_leaves=6,
)
KEYS = [
    "name",
    "duration_s",
    "vehicle",
    "vehicle.script",
    "vehicle.aircraft",
    "vehicle.initial",
    "vehicle.input",
    "vehicle.source",
]
KEYS += [
    "platform",
    "platform.file",
    "platform.preset",
    "cueing",
    "cueing.method",
    "cueing.stage",
    "cueing.stage.travel_m",
    "cueing.stage.onset_rad_s",
    "cueing.force_gain",
    "cueing.angle_limit_deg",
    "recording",
]
KEYS += [
    "recording.skip",
    "vehicle.initial.trim",
    "vehicle.input.0",
    "vehicle.input.0.value",
    "description",
    "cueing.return_time_s",
]


@settings(max_examples=200)
@given(
    st.dictionaries(st.sampled_from(KEYS), anything, min_size=1, max_size=4),
    st.lists(st.sampled_from(KEYS), max_size=2),
)
def test_anything_anywhere_is_loaded_or_refused(
    tmp_path_factory: pytest.TempPathFactory, changes: dict[str, Any], lists: list[str]
) -> None:
    """Every value at every place gives a scenario, or mistakes that name files and keys."""
    data = tomllib.loads(AIRCRAFT)
    apply_overrides(
        data,
        {key: value for text, value in changes.items() for key in parse_overrides([f"{text}=0"])},
    )
    folder = tmp_path_factory.mktemp("any")
    (folder / "s.toml").write_text(tomli_w.dumps(data))
    try:
        assert load_scenario(folder / "s.toml", [f"{key}={[1]}" for key in lists]).name
    except ScenarioError as refusal:
        lines = str(refusal).splitlines()
        assert len(lines) == len(refusal.mistakes) >= 1  # noqa: PT017 - either outcome is right
        assert all(": " in line for line in lines)
