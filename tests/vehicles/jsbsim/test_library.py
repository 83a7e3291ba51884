from pathlib import Path

import pytest

from atlas_cueing.vehicles import own_aircraft, own_scripts, suggestion
from atlas_cueing.vehicles.jsbsim.library import is_property_name, writable_names
from atlas_cueing.vehicles.jsbsim.loading import load

from ..flying import cessna


def test_own_scripts_are_files_by_name() -> None:
    scripts = own_scripts()
    assert len(scripts) > 50
    assert all(path.is_file() and path.stem == name for name, path in scripts.items())
    assert {"c1722", "c172_elevator_doublet", "Test_F450_Launch"} <= scripts.keys()


def test_own_aircraft_are_models_by_name() -> None:
    aircraft = own_aircraft()
    assert len(aircraft) > 50
    assert all(
        path == Path(path.parent.parent, name, f"{name}.xml") and path.is_file()
        for name, path in aircraft.items()
    )
    assert "aircraft_template" not in aircraft  # a file beside the folders, not a model


def test_suggestion_names_the_nearest_or_nothing() -> None:
    assert suggestion("ruder_kick", own_scripts()) == "; did you mean 'rudder_kick'?"
    assert suggestion("f-16", ["f16", "mk82"]) == "; did you mean 'f16'?"
    assert suggestion("qqqqqq", own_scripts()) == ""


def test_every_property_of_a_model_has_a_name() -> None:
    names = writable_names(load(cessna()))
    assert len(names) > 100
    assert [name for name in names if not is_property_name(name)] == []
    assert is_property_name("propulsion/engine[1]/set-running")
    assert is_property_name("/systems/electrical/outputs/bus115v")


@pytest.mark.parametrize(
    "name",
    [
        "",
        "/",
        "..",
        "../..",
        "a/../b",
        "[[[",
        "a[",
        "a[x]",
        "a[-1]",
        "%s%n",
        "-a",
        "a/",
        "a//b",
        "//a",
        "\u00e9",
    ],
)
def test_what_can_be_no_name(name: str) -> None:
    assert not is_property_name(name)
