"""A script that is not JSBSim's own flies only when its user says so.

Reading and cueing anew need no trust.
"""

from pathlib import Path

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.scenario import load_scenario, load_variants
from atlas_cueing.vehicles import ScriptFlight

from .texts import AIRCRAFT, SCRIPT, SIGNALS, USER_SCRIPT

USERS = SCRIPT.replace("c1722", "mine.xml")


@pytest.fixture
def users(tmp_path: Path) -> Path:
    """A scenario with a script beside it."""
    (tmp_path / "mine.xml").write_text(USER_SCRIPT.format(initial="reset00"))
    (tmp_path / "s.toml").write_text(USERS)
    return tmp_path / "s.toml"


def test_it_does_not_fly_without_trust(users: Path) -> None:
    scenario = load_scenario(users)
    for flight in ("flight", "live_flight"):
        with pytest.raises(
            InputError, match=r"mine\.xml: this script is not one of JSBSim's own.*--trust-models"
        ) as refusal:
            getattr(scenario, flight)
        assert "\n" not in str(refusal.value)


def test_it_flies_with_trust(users: Path) -> None:
    trusted = load_scenario(users, trust_models=True)
    assert (
        trusted.flight
        == trusted.live_flight
        == ScriptFlight(users.parent / "mine.xml", None, users.parent)
    )


def test_all_but_the_flight_can_be_had_without_trust(users: Path) -> None:
    scenario = load_scenario(users)
    assert scenario.attachments() == load_scenario(users, trust_models=True).attachments()
    assert b"runscript" in scenario.attachments()["mine.xml"]


@pytest.mark.parametrize("text", [SCRIPT, AIRCRAFT, SIGNALS])
def test_nothing_else_needs_trust(tmp_path: Path, text: str) -> None:
    (tmp_path / "s.toml").write_text(text)
    assert (
        load_scenario(tmp_path / "s.toml").flight
        == load_scenario(tmp_path / "s.toml", trust_models=True).flight
    )


def test_every_run_of_a_sweep_is_trusted_or_none(users: Path) -> None:
    users.write_text(USERS + '[sweep]\ncueing.method = ["blend", "force"]')
    assert [variant.scenario.trust_models for variant in load_variants(users)] == [False, False]
    assert [
        variant.scenario.trust_models for variant in load_variants(users, trust_models=True)
    ] == [True, True]


def test_a_huge_script_does_not_fill_the_memory(users: Path) -> None:
    with (users.parent / "mine.xml").open("wb") as file:
        file.truncate(10**12)  # a hole: it takes no room on the disk
    with pytest.raises(InputError, match=r"mine\.xml: too large"):
        load_scenario(users).attachments()
