"""What a log carries is enough to fly it again.

Resolved texts are read back as the same scenario.
"""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.scenario import Scenario, load_platform, load_scenario, presets
from atlas_cueing.scenario.cueing_table import TABLES

from .conftest import Refused
from .texts import AIRCRAFT, INITIAL, SCRIPT, USER_SCRIPT


def loaded(folder: Path, text: str, *overrides: str) -> Scenario:
    path = folder / "s.toml"
    path.write_text(text)
    return load_scenario(path, overrides)


def unpacked(scenario: Scenario, folder: Path) -> Scenario:
    """The scenario in a folder that has nothing but its attachments."""
    folder.mkdir()
    for name, content in scenario.attachments().items():
        (folder / name).write_bytes(content)
    return load_scenario(folder / "scenario.toml")


@pytest.mark.parametrize("text", [SCRIPT, AIRCRAFT])
def test_attachments_are_the_same_scenario(tmp_path: Path, text: str) -> None:
    scenario = loaded(
        tmp_path, text, "platform.wheel_limits.speed_rad_s=20", "recording.skip=['/tf']"
    )
    again = unpacked(scenario, tmp_path / "again")
    assert again.flight == scenario.flight
    assert again.platform == scenario.platform
    assert again.file.cueing == scenario.file.cueing
    assert again.file.recording == scenario.file.recording
    assert again.attachments() == scenario.attachments()


def test_a_users_script_goes_along(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "glide.xml").write_text(USER_SCRIPT.format(initial="start"))
    (tmp_path / "mine" / "start.xml").write_text(INITIAL)
    scenario = loaded(tmp_path, SCRIPT.replace("c1722", "mine/glide.xml"))
    assert set(scenario.attachments()) == {
        "scenario.toml",
        "platform.toml",
        "glide.xml",
        "start.xml",
    }
    again = unpacked(scenario, tmp_path / "again")
    assert again.attachments() == scenario.attachments()
    assert again.file.vehicle.user_script(again.folder) == tmp_path / "again" / "glide.xml"


def test_initial_conditions_elsewhere_do_not(tmp_path: Path) -> None:
    (tmp_path / "secret.xml").write_text(INITIAL)
    folder = tmp_path / "in"
    folder.mkdir()
    (folder / "link.xml").symlink_to(tmp_path / "secret.xml")
    for named in ("../secret", "link", "missing"):
        (folder / "glide.xml").write_text(USER_SCRIPT.format(initial=named))
        assert set(loaded(folder, SCRIPT.replace("c1722", "glide.xml")).attachments()) == {
            "scenario.toml",
            "platform.toml",
            "glide.xml",
        }


def test_a_script_named_as_an_own_one_stays_the_users(tmp_path: Path) -> None:
    (tmp_path / "c1722").write_text(USER_SCRIPT.format(initial="reset00"))
    again = unpacked(loaded(tmp_path, SCRIPT.replace("c1722", "./c1722")), tmp_path / "again")
    assert again.file.vehicle.user_script(again.folder) == tmp_path / "again" / "c1722"


def test_defaults_are_written_out(tmp_path: Path) -> None:
    text = loaded(tmp_path, SCRIPT).scenario_toml()
    for key in TABLES["hedge"].model_fields:
        assert f"{key} = " in text or f"[cueing.{key}]" in text
    assert "chunk_ticks = 512" in text


@given(st.floats(1.0, 1e6, allow_subnormal=False), st.floats(1e-9, 10.0))
def test_numbers_survive_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory, speed: float, gain: float
) -> None:
    folder = tmp_path_factory.mktemp("bits")
    scenario = loaded(
        folder,
        SCRIPT,
        f"platform.wheel_limits.speed_rad_s={speed!r}",
        f"cueing.force_gain={gain!r}",
    )
    again = unpacked(scenario, folder / "again")
    assert again.platform.wheel_limit_values().speed == (speed,) * 3
    assert again.file.cueing.force_gain == (gain,) * 3


@pytest.mark.parametrize("name", list(presets()))
def test_resolved_presets_are_platforms(tmp_path: Path, name: str) -> None:
    text = loaded(tmp_path, SCRIPT, f"platform.preset={name}").platform_toml()
    (tmp_path / "p.toml").write_text(text)
    assert load_platform(str(tmp_path / "p.toml")) == load_platform(name)


def test_only_dispensable_topics_can_be_left_out(refused: Refused) -> None:
    assert refused(SCRIPT + '[recording]\nskip = ["/motion"]') == [
        "bad.toml: recording.skip.0 = '/motion': allowed: /tf; a run is evaluated from the others"
    ]
    assert refused(SCRIPT + '[recording]\nskip = "/tf"') == [
        "bad.toml: recording.skip = '/tf': allowed: a list of topics"
    ]
