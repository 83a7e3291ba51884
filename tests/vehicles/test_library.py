from pathlib import Path

from atlas_cueing.vehicles import own_aircraft, own_scripts, suggestion


def test_own_scripts_are_files_by_name() -> None:
    scripts = own_scripts()
    assert len(scripts) > 50
    assert all(path.is_file() and path.stem == name for name, path in scripts.items())
    assert {"c1722", "c172_elevator_doublet", "Test_F450_Launch"} <= scripts.keys()


def test_own_aircraft_are_models_by_name() -> None:
    aircraft = own_aircraft()
    assert len(aircraft) > 50
    assert all(path == Path(path.parent.parent, name, f"{name}.xml") and path.is_file() for name, path in aircraft.items())
    assert "aircraft_template" not in aircraft  # a file beside the folders, not a model


def test_suggestion_names_the_nearest_or_nothing() -> None:
    assert suggestion("ruder_kick", own_scripts()) == "; did you mean 'rudder_kick'?"
    assert suggestion("f-16", ["f16", "mk82"]) == "; did you mean 'f16'?"
    assert suggestion("qqqqqq", own_scripts()) == ""
